// Memory for a world on the host.
#pragma once

#include <cstddef>
#include <memory>
#include <new>

#include "weir/weir.hpp"

namespace measure {

/// Aligned, and of exactly the bytes that the world asks for: sanitizers see what goes beyond.
class WorldMemory {
public:
    WorldMemory() = default;
    explicit WorldMemory(std::size_t bytes)
        : memory_(static_cast<std::byte*>(
              ::operator new(bytes, std::align_val_t{weir::world_alignment}))),
          size_(bytes) {}

    std::byte* data() const { return memory_.get(); }
    std::size_t size() const { return size_; }

private:
    struct Release {
        void operator()(std::byte* memory) const {
            ::operator delete(memory, std::align_val_t{weir::world_alignment});
        }
    };
    std::unique_ptr<std::byte, Release> memory_;
    std::size_t size_ = 0;
};

template <class Real>
WorldMemory memory_for(const weir::WorldDef& def) {
    return WorldMemory(weir::world_bytes<Real>(def.capacity));
}

}  // namespace measure
