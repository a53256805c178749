// Sine and cosine: reduction to ±π/4 in three parts (Cody & Waite 1980), then Taylor sums.
#include "math/rotation.hpp"

namespace weir {

namespace {

// Leading bits of π/2, short enough that a whole number of them is exact, and the rest.
template <class Real>
struct HalfPi;
template <>
struct HalfPi<float> {
    static constexpr float high = 1.5703125F;
    static constexpr float middle = 4.837512969970703125e-4F;
    static constexpr float low = 7.54978995489188216e-8F;
};
template <class S>
struct HalfPi<FixedPoint<16, S>> {
    static constexpr FixedPoint<16, S> high{1.57079632679489662};
    static constexpr FixedPoint<16, S> middle{};
    static constexpr FixedPoint<16, S> low{};
};
template <>
struct HalfPi<double> {
    static constexpr double high = 1.57079632673412561417e+00;
    static constexpr double middle = 6.07710050630396597660e-11;
    static constexpr double low = 2.02226624879595063154e-21;
};

}  // namespace

template <class Real>
Rotation<Real> rotation(Real angle_rad) {
    constexpr Real kTwoOverPi = Real(0.63661977236758134308);
    const std::int32_t quarter = floor_to_int(angle_rad * kTwoOverPi + Real(0.5));
    const Real turns = static_cast<Real>(quarter);
    const Real r = ((angle_rad - turns * HalfPi<Real>::high) - turns * HalfPi<Real>::middle) -
                   turns * HalfPi<Real>::low;
    const Real r2 = r * r;
    // Taylor to r^13 and r^14: within 1.2e-7 in float and 2.1e-14 in double.
    Real s = Real(1.0 / 6227020800.0);
    s = s * r2 - Real(1.0 / 39916800.0);
    s = s * r2 + Real(1.0 / 362880.0);
    s = s * r2 - Real(1.0 / 5040.0);
    s = s * r2 + Real(1.0 / 120.0);
    s = s * r2 - Real(1.0 / 6.0);
    s = r + r * (s * r2);
    Real c = -Real(1.0 / 87178291200.0);
    c = c * r2 + Real(1.0 / 479001600.0);
    c = c * r2 - Real(1.0 / 3628800.0);
    c = c * r2 + Real(1.0 / 40320.0);
    c = c * r2 - Real(1.0 / 720.0);
    c = c * r2 + Real(1.0 / 24.0);
    c = c * r2 - Real(0.5);
    c = Real(1) + c * r2;
    switch (static_cast<std::uint32_t>(quarter) & 3U) {
        case 0: return {c, s};
        case 1: return {-s, c};
        case 2: return {-c, -s};
        default: return {s, -c};
    }
}

#define WEIR_INSTANTIATE(Real) template Rotation<Real> rotation(Real);
WEIR_FOR_EACH_NUMBER(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
