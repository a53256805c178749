// The scalar of `World<Fixed>`: a whole number of 1/65536ths, the same bits on every processor, no
// FPU wanted. Data and conversions only; the arithmetic is the library's own.
#pragma once

#include <cstdint>
#include <type_traits>

#include "weir/inline.hpp"

namespace weir {

/// How a world stores numbers of a kind: `Roomy`, all of them in 32 bits, or `Packed`, as few bits
/// as each quantity bears (weir/storage.hpp).
struct RoomyStorage {};
struct PackedStorage {};

inline constexpr std::int32_t kMostRaw = 0x7FFFFFFF;
inline constexpr std::int32_t kLeastRaw = -0x7FFFFFFF - 1;

namespace fixed {

constexpr std::int32_t saturate(std::int64_t value) {
    const auto low = static_cast<std::int32_t>(value);
    if (static_cast<std::int64_t>(low) == value) {
        return low;
    }
    return value < 0 ? kLeastRaw : kMostRaw;
}
/// value · 2^−shift, rounded.
constexpr std::int64_t shifted(std::int64_t value, int shift) {
    const std::int64_t half = std::int64_t{1} << (shift - 1);
    return (value + half + (value >> 63)) >> shift;
}

}  // namespace fixed

/// raw · 2^−Fraction, Fraction 1 … 31. Conversions round to the nearest, ties away from zero, and
/// saturate: no input wraps around. NaN becomes 0.
template <int Fraction, class Storage = RoomyStorage>
struct FixedPoint {
    std::int32_t raw = 0;

    static constexpr int fraction = Fraction;

    constexpr FixedPoint() = default;
    WEIR_ALWAYS_INLINE static constexpr FixedPoint of_raw(std::int32_t bits) {
        FixedPoint value;
        value.raw = bits;
        return value;
    }

    template <class Whole, std::enable_if_t<std::is_integral<Whole>::value, int> = 0>
    WEIR_ALWAYS_INLINE constexpr explicit FixedPoint(Whole value)
        : raw(std::is_unsigned<Whole>::value && static_cast<std::uint64_t>(value) >> 63U != 0U
                  ? kMostRaw
                  : of_whole(static_cast<WholeNumber<Whole>>(value))) {}

    /// Meant for constants: costs double arithmetic where the compiler cannot fold it.
    WEIR_ALWAYS_INLINE constexpr explicit FixedPoint(double value) {
        const double scaled = value * static_cast<double>(1U << static_cast<unsigned>(Fraction));
        if (scaled >= 2147483647.0) {
            raw = kMostRaw;
        } else if (scaled <= -2147483648.0) {
            raw = kLeastRaw;
        } else if (scaled == scaled) {
            raw = static_cast<std::int32_t>(scaled < 0.0 ? scaled - 0.5 : scaled + 0.5);
        }
    }

    /// From the bits of the float, without float arithmetic.
    explicit FixedPoint(float value);

    /// From another kind of fixed-point number.
    template <int Other, std::enable_if_t<Other != Fraction, int> = 0>
    constexpr explicit FixedPoint(FixedPoint<Other, Storage> value)
        : raw(of_other<Other>(value.raw)) {}

    constexpr explicit operator double() const {
        return static_cast<double>(raw) /
               static_cast<double>(1U << static_cast<unsigned>(Fraction));
    }
    constexpr explicit operator float() const {
        return static_cast<float>(raw) / static_cast<float>(1U << static_cast<unsigned>(Fraction));
    }
    /// Towards zero, as a float does.
    WEIR_ALWAYS_INLINE constexpr explicit operator std::int32_t() const {
        return raw >= 0 ? raw >> Fraction
                        : -static_cast<std::int32_t>((0U - static_cast<std::uint32_t>(raw)) >>
                                                     static_cast<unsigned>(Fraction));
    }

private:
    template <int Other>
    WEIR_ALWAYS_INLINE static constexpr std::int32_t of_other(std::int32_t value) {
        if constexpr (Other < Fraction) {
            return fixed::saturate(value * (std::int64_t{1} << (Fraction - Other)));
        } else {
            return fixed::saturate(fixed::shifted(value, Other - Fraction));
        }
    }
    /// Few are more than 32 bits: only those are compared as such.
    template <class Whole>
    using WholeNumber =
        std::conditional_t<(sizeof(Whole) > 4 || (sizeof(Whole) == 4 &&
                                                  std::is_unsigned<Whole>::value)),
                           std::int64_t, std::int32_t>;
    template <class Whole>
    WEIR_ALWAYS_INLINE static constexpr std::int32_t of_whole(Whole value) {
        constexpr Whole kLimit = Whole{1} << (31 - Fraction);
        if (value >= kLimit) {
            return kMostRaw;
        }
        return value < -kLimit ? kLeastRaw
                               : static_cast<std::int32_t>(static_cast<std::uint32_t>(value)
                                                           << static_cast<unsigned>(Fraction));
    }
};

/// −32768 … 32767.99998 in steps of 1.5e-5: cells, cells a second, and what is made of them.
using Fixed = FixedPoint<16>;
/// The same arithmetic in the smallest world: 8 bytes a particle.
using SmallFixed = FixedPoint<16, PackedStorage>;

}  // namespace weir
