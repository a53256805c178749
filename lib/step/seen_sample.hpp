// Velocities between faces of which a thin wall hides some.
#pragma once

#include "solid/thin_walls.hpp"
#include "step/grid_to_particle.hpp"

namespace weir {

/// Which faces of a stencil stand in for those that are not `seen`: along the row, else along the
/// column, else across. At least one is seen.
struct StandIns {
    std::uint32_t of[4];

    explicit StandIns(std::uint32_t seen) {
        for (std::uint32_t node = 0; node < 4; ++node) {
            const std::uint32_t others[] = {node, node ^ 1U, node ^ 2U, node ^ 3U};
            std::uint32_t k = 0;
            while (k < 3 && (seen >> others[k] & 1U) == 0) {
                ++k;
            }
            of[node] = others[k];
        }
    }
};

/// Value and slopes from the four faces of a stencil, `step` numbers apart, or those that stand in
/// for them.
template <class Real>
inline Sample<Real> sample_seen(const VelocityOf<Real>* field, std::int32_t step,
                                std::int32_t stride, const Stencil<Real>& at,
                                const StandIns& face) {
    const VelocityOf<Real>* p = field + step * at.base;
    const Real known[4] = {Real(p[0]), Real(p[step]), Real(p[step * stride]),
                           Real(p[step * (stride + 1)])};
    return bilinear(known[face.of[0]], known[face.of[1]], known[face.of[2]], known[face.of[3]],
                    at);
}

/// From a stencil's place to the one that `sample_seen` tells of.
template <class Real>
inline Vec2<Real> way_to_sample(const Stencil<Real>& at, const StandIns& face) {
    Real x[4];
    Real y[4];
    for (std::int32_t node = 0; node < 4; ++node) {
        x[node] = Real((face.of[node] & 1U) != 0 ? 1 : 0);
        y[node] = Real((face.of[node] & 2U) != 0 ? 1 : 0);
    }
    return {bilinear(x[0], x[1], x[2], x[3], at).value - at.fx,
            bilinear(y[0], y[1], y[2], y[3], at).value - at.fy};
}

}  // namespace weir
