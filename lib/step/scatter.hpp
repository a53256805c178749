// What a particle gives to the four faces of a stencil.
#pragma once

#include "grid/staggered_grid.hpp"

namespace weir {

/// Bits: lower left, lower right, upper left, upper right.
inline constexpr std::uint32_t kAllFour = 15U;

/// Whether a face takes one more particle. Sums in fixed point would saturate at twice as much:
/// what goes on falling would be held back, and gain what it does not lose in height. The mean of
/// those that came first is the face's velocity as well.
template <class Mass, class Real>
inline bool has_room([[maybe_unused]] Mass mass, [[maybe_unused]] Real momentum) {
    if constexpr (std::is_same<Real, Fixed>::value) {
        constexpr std::uint32_t kHalf = 1U << 30U;
        const std::uint32_t beyond = (static_cast<std::uint32_t>(mass.raw) + kHalf) |
                                     (static_cast<std::uint32_t>(momentum.raw) + kHalf);
        return (beyond & (1U << 31U)) == 0;
    } else {
        return true;
    }
}

/// Mass and momentum. @return the faces that took nothing.
template <class Mass, class Real>
inline std::int32_t scatter(Mass* mass, Real* momentum, std::int32_t stride,
                            const Stencil<Real>& at, Real velocity) {
    const Real w1 = at.fx * at.fy;
    const Real right = at.fx - w1;                       // fx (1 − fy)
    const Real upper = at.fy - w1;                       // (1 − fx) fy
    const Real w0 = (Real(1) - at.fx) - upper;           // (1 − fx)(1 − fy)
    Mass* m = mass + at.base;
    Real* p = momentum + at.base;
    std::int32_t full = 0;
    const auto add = [&](std::int32_t k, Real weight) {
        if (!has_room(m[k], p[k])) {
            ++full;
            return;
        }
        m[k] += weight;
        p[k] += weight * velocity;
    };
    add(0, w0);
    add(1, right);
    m = whole(m + stride);  // one address for two numbers
    p = whole(p + stride);
    add(0, upper);
    add(1, w1);
    return full;
}

/// The same of a particle of some density.
template <class Real>
inline std::int32_t scatter_dense(VelocityOf<Real>* volume, VelocityOf<Real>* mass,
                                  Real* momentum, std::int32_t stride, const Stencil<Real>& at,
                                  Real density, Real velocity) {
    const Real w1 = at.fx * at.fy;
    const Real right = at.fx - w1;
    const Real upper = at.fy - w1;
    std::int32_t full = 0;
    const auto add = [&](std::int32_t node, Real weight) {
        if (!has_room(mass[node], momentum[node])) {
            ++full;
            return;
        }
        const Real share = weight * density;
        volume[node] += weight;
        mass[node] += share;
        momentum[node] += share * velocity;
    };
    add(at.base, (Real(1) - at.fx) - upper);
    add(at.base + 1, right);
    add(at.base + stride, upper);
    add(at.base + stride + 1, w1);
    return full;
}

/// The same to those of the four that `seen` names. `mass` null: one liquid, whose count is its
/// mass. `step`: numbers from one face to the next.
template <class Real>
inline std::int32_t scatter_weighed(VelocityOf<Real>* volume, VelocityOf<Real>* mass,
                                    Real* momentum, std::int32_t stride, const Stencil<Real>& at,
                                    Real density, Real velocity, std::uint32_t seen,
                                    std::int32_t step = 1) {
    const Real w1 = at.fx * at.fy;
    const Real right = at.fx - w1;
    const Real upper = at.fy - w1;
    const Real weight[] = {(Real(1) - at.fx) - upper, right, upper, w1};
    const std::int32_t first = step * at.base;
    const std::int32_t upwards = step * stride;
    const std::int32_t node[] = {first, first + step, first + upwards, first + upwards + step};
    std::int32_t full = 0;
    for (std::uint32_t k = 0; k < 4; ++k) {
        if ((seen >> k & 1U) == 0) {
            continue;
        }
        if (!has_room(mass != nullptr ? mass[node[k]] : volume[node[k]], momentum[node[k]])) {
            ++full;
            continue;
        }
        const Real share = weight[k] * density;
        volume[node[k]] += weight[k];
        if (mass != nullptr) {
            mass[node[k]] += share;
        }
        momentum[node[k]] += share * velocity;
    }
    return full;
}

}  // namespace weir
