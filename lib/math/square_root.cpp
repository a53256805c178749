// Square root for processors without one: digit by digit in integers, rounded to nearest.
// Bit for bit what IEEE 754 asks for, so that a soft-float chip joins the promise of same bits.
#include "math/scalar.hpp"

namespace weir {

namespace {

/// Integer square root of (mantissa · 2^shift), two result bits a loop; remainder tells rounding.
/// `digits` = bits of the root. Returns the root rounded to nearest (a tie cannot occur).
std::uint64_t rounded_root(std::uint64_t mantissa, int digits) {
    // Root bit by bit, consuming two bits of the radicand at a time from the top, then zeros.
    std::uint64_t root = 0;
    std::uint64_t remainder = 0;
    for (int digit = digits; digit >= 0; --digit) {  // one digit beyond, for rounding
        remainder = (remainder << 2U) | (mantissa >> 62U);
        mantissa <<= 2U;
        const std::uint64_t trial = (root << 2U) | 1U;
        root <<= 1U;
        if (remainder >= trial) {
            remainder -= trial;
            root |= 1U;
        }
    }
    return (root >> 1U) + (root & 1U);
}

/// Value = fraction · 2^(exponent): normalises a subnormal, makes the exponent even.
template <class Bits>
struct Parts {
    Bits fraction;
    int exponent;
};

template <class Bits>
Parts<Bits> split(Bits bits, int fraction_bits, int bias) {
    Bits fraction = bits & ((Bits(1) << fraction_bits) - 1);
    int exponent = static_cast<int>(bits >> fraction_bits);
    if (exponent == 0) {
        exponent = 1;
        while ((fraction >> fraction_bits) == 0) {
            fraction <<= 1U;
            --exponent;
        }
    } else {
        fraction |= Bits(1) << fraction_bits;
    }
    exponent -= bias;
    if ((exponent & 1) != 0) {
        fraction <<= 1U;
        --exponent;
    }
    return {fraction, exponent};
}

template <class Real, class Bits>
Real root_of(Real value, int fraction_bits, int bias) {
    if (!(value > Real(0)) || !is_finite(value)) {
        return value;
    }
    Bits bits = 0;
    WEIR_COPY_BYTES(&bits, &value, sizeof bits);
    const Parts<Bits> parts = split(bits, fraction_bits, bias);
    // The fraction has one or two bits before the point: bring the point behind bit 62.
    const std::uint64_t aligned = static_cast<std::uint64_t>(parts.fraction)
                                  << static_cast<unsigned>(62 - fraction_bits);
    const std::uint64_t root = rounded_root(aligned, fraction_bits + 1);
    const Bits exponent = static_cast<Bits>(parts.exponent / 2 + bias);
    // Adding lets a root that rounded up to 2 carry into the exponent.
    const Bits result = ((exponent - 1) << fraction_bits) + static_cast<Bits>(root);
    Real out{};
    WEIR_COPY_BYTES(&out, &result, sizeof out);
    return out;
}

}  // namespace

float square_root_in_integers(float value) { return root_of<float, std::uint32_t>(value, 23, 127); }
double square_root_in_integers(double value) {
    return root_of<double, std::uint64_t>(value, 52, 1023);
}

}  // namespace weir
