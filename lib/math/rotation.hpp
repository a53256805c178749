// Rotation by an angle, from + and × alone so that every machine turns by the same bits.
#pragma once

#include "math/vec2.hpp"

namespace weir {

template <class Real>
struct Rotation {
    Real cosine = Real(1);
    Real sine = Real(0);

    constexpr Vec2<Real> apply(Vec2<Real> v) const {
        return {cosine * v.x - sine * v.y, sine * v.x + cosine * v.y};
    }
};

/// The same angle within ±2π of zero once it has left ±2π: a body may spin for ever.
template <class Real>
inline Real wrapped_angle(Real angle_rad) {
    constexpr Real kTurn = Real(6.283185307179586477);
    if (angle_rad > kTurn || angle_rad < -kTurn) {
        // Not a difference: where floats are added by a function, that is another one.
        return angle_rad + kTurn * static_cast<Real>(-floor_to_int(angle_rad / kTurn));
    }
    return angle_rad;
}

/// Angle in radians, counter-clockwise, |angle| ≤ 1e5.
template <class Real>
Rotation<Real> rotation(Real angle_rad);

}  // namespace weir
