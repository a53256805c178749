// The end of grid-to-particle: a particle's way, kept within what is allowed and within the tank.
#pragma once

#include <type_traits>

#include "step/grid_to_particle.hpp"

namespace weir {

/// What `limited` makes of the few that are too fast or broken.
template <class Real>
Vec2<Real> refused(Vec2<Real> v, Real limit) {
    return is_finite(v) ? Vec2<Real>{clamp(v.x, -limit, limit), clamp(v.y, -limit, limit)}
                        : Vec2<Real>{};
}

/// Written so that a NaN is refused.
template <class Real>
inline bool is_within(Vec2<Real> v, Real limit) {
    return absolute(v.x) <= limit && absolute(v.y) <= limit;
}
template <class Real>
inline Vec2<Real> limited(Vec2<Real> v, Real limit) {
    return is_within(v, limit) ? v : refused(v, limit);
}
template <class Real>
inline Vec2<Real> limited(Vec2<Real> v, Real limit, TransferResult<Real>& count) {
    if (!is_within(v, limit)) {
        ++(is_finite(v) ? count.slowed : count.reset);
    }
    return limited(v, limit);
}

/// A blow of speed `into` (> 0) against a tank's wall rubs along it (Coulomb).
template <class Real>
[[gnu::cold]] inline Real rubbed(Real along, Real slide, const SurfaceLaw<Real>& wall,
                                 Real into) {
    const Real most = wall.friction * ((Real(1) + wall.restitution) * into);
    return along - clamp(along - slide, -most, most);
}

/// What a particle that hits the tank's walls gives to them.
template <class Real>
struct TankBlow {
    const Transfer<Real>& transfer;
    const Liquid* kind;  ///< of the particle; null: there is one liquid

    void give(Vec2<Real> before, Vec2<Real> after) const {
        if (transfer.tank != nullptr) {
            const bool second = kind != nullptr && *kind == Liquid::second;
            const Face<Real> mass = transfer.particle_mass[second ? 1 : 0];
            transfer.tank->linear =
                transfer.tank->linear + mass * convert<Face<Real>>(before - after);
        }
    }
};

/// The share of its way past a wall by which a particle is set back before it. What corners press
/// together over and over ends in one place in Fixed, as its last digits are coarse. So those of a
/// particle's velocity, whatever its signs, choose between 3/8 and 5/8. For what is slow, 2 cells/s
/// in all, it is half: leaning liquid would rest less.
template <class Real>
inline Real share_beyond([[maybe_unused]] Real v, [[maybe_unused]] Real along) {
    if constexpr (std::is_same_v<Real, Fixed>) {
        const auto digits = static_cast<std::uint32_t>(absolute(v).raw) +
                            static_cast<std::uint32_t>(absolute(along).raw);
        if (digits > 2U << 16U) {
            return Real::of_raw(24576 + static_cast<std::int32_t>(digits % 1024U) * 16);
        }
    }
    return Real(0.5);
}

/// Where a particle is set back to that went to x, past a wall: about half as far before it. Set to
/// the wall itself, all that go to a corner would meet in one place, and never part again.
template <class Real>
inline Real back_from(Real wall, Real x, Real share) {
    return wall + share * (wall - x);
}

/// One axis at the tank's walls: back to the wall, the velocity towards it given back, and rubbed
/// along it. `sense`: the axis along which the low wall's conveyor runs; the high one's runs the
/// other way. Whether it was hit.
template <class Real>
[[gnu::cold]] inline bool keep_inside(Real& x, Real& v, Real& along, Real size,
                                      const SurfaceLaw<Real>& low, const SurfaceLaw<Real>& high,
                                      Real sense) {
    if (x < kWallGap<Real>) {
        x = back_from(kWallGap<Real>, x, share_beyond(v, along));
        if (v < Real(0)) {
            along = low.friction > Real(0) ? rubbed(along, sense * low.conveyor, low, -v) : along;
            v = -low.restitution * v;
            return true;
        }
    } else if (x > size - kWallGap<Real>) {
        x = back_from(size - kWallGap<Real>, x, share_beyond(v, along));
        if (v > Real(0)) {
            along = high.friction > Real(0) ? rubbed(along, -sense * high.conveyor, high, v)
                                            : along;
            v = -high.restitution * v;
            return true;
        }
    }
    return false;
}

/// One axis across a seam. A step is far shorter than the tank, so once is enough; the last line
/// is for a number so small below zero that adding the size rounds it to the size.
template <class Real>
inline void wrap_around(Real& x, Real size) {
    if (x < Real(0)) {
        x += size;
    }
    if (!(x < size)) {
        x -= size;
    }
}

/// Who has come to the walls of a tank of that size stays in it. Few do: compiled for size.
template <class Real>
[[gnu::cold]] inline void meet_tank(Vec2<Real> size, const TankBlow<Real>& blow, Vec2<Real>& x,
                                    Vec2<Real>& v) {
    const Borders<Real>& b = blow.transfer.borders;
    const Vec2<Real> before = v;
    bool hit = false;
    if (b.wrap_x) {
        wrap_around(x.x, size.x);
    } else {
        hit = keep_inside(x.x, v.x, v.y, size.x, b.left, b.right, Real(-1));
    }
    if (b.wrap_y) {
        wrap_around(x.y, size.y);
    } else {
        hit = keep_inside(x.y, v.y, v.x, size.y, b.bottom, b.top, Real(1)) || hit;
    }
    if (hit) {
        blow.give(before, v);
    }
}

/// Limits the new velocity v, moves x with the velocity `along` and meets the walls of a tank of
/// that size.
template <class Real>
inline void advect(Vec2<Real> size, const TankBlow<Real>& blow, Vec2<Real> along, Vec2<Real>& x,
                   Vec2<Real>& v, TransferResult<Real>& result) {
    const Transfer<Real>& transfer = blow.transfer;
    v = limited(v, transfer.limit, result);
    result.far += is_within(along, transfer.near) ? 0 : 1;
    x = x + transfer.dt_s * limited(along, transfer.limit);
    meet_tank(size, blow, x, v);
    result.max_speed = maximum(result.max_speed, larger_part(v));
}

}  // namespace weir
