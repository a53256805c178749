// Words of a snapshot, out and in. What is written, what is checked and what is read back is one
// list (snapshot_members.hpp), gone through by each of the three streams.
#pragma once

#include <cstddef>
#include <cstring>

#include "math/scalar.hpp"
#include "world/validate.hpp"

namespace weir {

static_assert(kLittleEndian,
              "snapshots are copied as they lie in memory, lowest byte first");

/// FNV-1a's two operations on whole words: each is one to one, so that a single changed word always
/// changes the sum.
class Checksum {
public:
    void add(std::uint32_t word) { value_ = (value_ ^ word) * 0x100000001B3ULL; }
    std::uint64_t value() const { return value_; }

private:
    std::uint64_t value_ = 0xCBF29CE484222325ULL;
};

inline constexpr std::size_t kWordBytes = sizeof(std::uint32_t);

constexpr std::size_t words_of(std::size_t bytes) { return (bytes + kWordBytes - 1) / kWordBytes; }

/// Without memory it only counts.
class SnapshotWriter {
public:
    explicit SnapshotWriter(void* memory) : memory_(static_cast<std::byte*>(memory)) {}

    std::size_t bytes() const { return bytes_; }
    std::uint64_t checksum() const { return sum_.value(); }

    void word(std::uint32_t word) {
        if (memory_ != nullptr) {
            std::memcpy(memory_ + bytes_, &word, kWordBytes);
            sum_.add(word);
        }
        bytes_ += kWordBytes;
    }
    void word64(std::uint64_t value) {
        word(static_cast<std::uint32_t>(value));
        word(static_cast<std::uint32_t>(value >> 32U));
    }
    /// The last word is filled up with zeros.
    void array(const void* data, std::size_t size) {
        const auto* from = static_cast<const std::byte*>(data);
        for (std::size_t at = 0; at < size; at += kWordBytes) {
            std::uint32_t next = 0;
            std::memcpy(&next, from + at, size - at < kWordBytes ? size - at : kWordBytes);
            word(next);
        }
    }
    template <class T>
    T member(T& value, SameAs<T>, SameAs<T>) {
        if constexpr (sizeof(T) < kWordBytes) {
            word(static_cast<std::uint32_t>(value));
        } else {
            array(&value, sizeof value);
        }
        return value;
    }

private:
    std::byte* memory_;
    std::size_t bytes_ = 0;
    Checksum sum_;
};

/// Reads without believing: `sound` turns false at the first word that cannot be.
class SnapshotReader {
public:
    SnapshotReader(const void* data, std::size_t size)
        : data_(static_cast<const std::byte*>(data)), size_(size) {}

    bool sound() const { return sound_; }
    bool at_end() const { return at_ == size_; }
    void refuse() { sound_ = false; }

    std::uint32_t word() {
        std::uint32_t value = 0;
        const std::byte* from = take(kWordBytes);
        if (from != nullptr) {
            std::memcpy(&value, from, kWordBytes);
        }
        return value;
    }
    std::uint64_t word64() {
        const std::uint64_t low = word();
        return low | static_cast<std::uint64_t>(word()) << 32U;
    }
    /// Null if there is not that much left.
    const std::byte* array(std::size_t size) { return take(words_of(size) * kWordBytes); }

    /// A value within low … high, or low.
    template <class T>
    T value(SameAs<T> low, SameAs<T> high) {
        T result = low;
        if constexpr (sizeof(T) < kWordBytes) {
            const std::uint32_t raw = word();
            sound_ = sound_ && static_cast<std::uint32_t>(low) <= raw &&
                     raw <= static_cast<std::uint32_t>(high);
            result = sound_ ? static_cast<T>(raw) : low;
        } else {
            const std::byte* from = array(sizeof(T));
            if (from != nullptr) {
                std::memcpy(&result, from, sizeof result);
            }
            sound_ = sound_ && within(result, low, high);
            result = sound_ ? result : low;
        }
        return result;
    }

private:
    const std::byte* take(std::size_t bytes) {
        sound_ = sound_ && size_ - at_ >= bytes;
        if (!sound_) {
            return nullptr;
        }
        const std::byte* from = data_ + at_;
        at_ += bytes;
        return from;
    }

    const std::byte* data_;
    std::size_t size_;
    std::size_t at_ = 0;
    bool sound_ = true;
};

/// Checks members and changes nothing.
struct MemberCheck {
    SnapshotReader& reader;

    template <class T>
    T member(const T&, SameAs<T> low, SameAs<T> high) {
        return reader.value<T>(low, high);
    }
};

/// Takes members over.
struct MemberRead {
    SnapshotReader& reader;

    template <class T>
    T member(T& value, SameAs<T> low, SameAs<T> high) {
        value = reader.value<T>(low, high);
        return value;
    }
};

}  // namespace weir
