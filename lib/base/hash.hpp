// FNV-1a, 64 bit (Fowler, Noll, Vo 1991), over 32-bit words in a stated order.
#pragma once

#include <cstdint>
#include <cstring>

#include "base/compiler.hpp"
#include "weir/storage.hpp"

namespace weir {

class Hash {
public:
    void add(std::uint32_t word) {
        for (int byte = 0; byte < 4; ++byte) {
            value_ = (value_ ^ ((word >> (8 * byte)) & 0xFFU)) * 0x100000001B3ULL;
        }
    }
    /// As many words that are 0, one after the other.
    void add_zeros(std::uint32_t words) {
        constexpr std::uint64_t kPrime = 0x100000001B3ULL;
        std::uint64_t factor = (kPrime * kPrime) * (kPrime * kPrime);
        for (; words != 0; words >>= 1U, factor *= factor) {
            value_ *= (words & 1U) != 0 ? factor : 1U;
        }
    }
    void add(std::int32_t word) { add(static_cast<std::uint32_t>(word)); }
    /// -0 and +0 compare equal, so they hash equal. The state never holds a NaN.
    void add(float number) {
        std::uint32_t bits = 0;
        const float canonical = number == 0.0F ? 0.0F : number;
        WEIR_COPY_BYTES(&bits, &canonical, sizeof bits);
        add(bits);
    }
    void add(double number) {
        std::uint64_t bits = 0;
        const double canonical = number == 0.0 ? 0.0 : number;
        WEIR_COPY_BYTES(&bits, &canonical, sizeof bits);
        add(static_cast<std::uint32_t>(bits));
        add(static_cast<std::uint32_t>(bits >> 32U));
    }
    template <int Fraction, class Storage>
    void add(FixedPoint<Fraction, Storage> number) {
        add(number.raw);
    }
    template <class Bits, int Fraction>
    void add(Packed<Bits, Fraction> number) {
        add(static_cast<std::int32_t>(number.raw));
    }
    std::uint64_t value() const { return value_; }

private:
    std::uint64_t value_ = 0xCBF29CE484222325ULL;
};

}  // namespace weir
