// Velocities between faces of which a thin wall hides some.
#pragma once

#include "solid/thin_walls.hpp"
#include "step/grid_to_particle.hpp"

namespace weir {

/// Which faces of a stencil stand in for those that are not `seen`: the next one along the row or
/// along the column, of two that are seen both, by their weights; else the one across. So it is the
/// same whichever way the tank is turned. At least one is seen.
template <class Real>
class StandIns {
public:
    StandIns(std::uint32_t seen, const Stencil<Real>& at) {
        const auto sees = [seen](std::uint32_t node) { return (seen >> node & 1U) != 0; };
        for (std::uint32_t node = 0; node < 4; ++node) {
            const std::uint32_t in_row = node ^ 1U;
            const std::uint32_t in_column = node ^ 2U;
            if (sees(node)) {
                of_[node] = {node, node, Real(0)};
            } else if (sees(in_row) && sees(in_column)) {
                of_[node] = {in_row, in_column, share(weight(in_column, at), weight(in_row, at))};
            } else {
                const std::uint32_t only = sees(in_row)      ? in_row
                                           : sees(in_column) ? in_column
                                                             : node ^ 3U;
                of_[node] = {only, only, Real(0)};
            }
        }
    }
    /// What stands for a face, from what the four have.
    Real of(std::uint32_t node, const Real (&four)[4]) const {
        const Two& two = of_[node];
        return four[two.first] + two.part * (four[two.second] - four[two.first]);
    }
    Sample<Real> sample(const Real (&four)[4], const Stencil<Real>& at) const {
        return bilinear(of(0, four), of(1, four), of(2, four), of(3, four), at);
    }

private:
    struct Two {
        std::uint32_t first;
        std::uint32_t second;
        Real part;  ///< of the second
    };

    static Real weight(std::uint32_t node, const Stencil<Real>& at) {
        return ((node & 1U) != 0 ? at.fx : Real(1) - at.fx) *
               ((node & 2U) != 0 ? at.fy : Real(1) - at.fy);
    }
    static Real share(Real one, Real other) {
        const Real both = one + other;
        return both > Real(0) ? one / both : Real(0.5);
    }

    Two of_[4];
};

/// Value and slopes from the four faces of a stencil, `step` numbers apart, or those that stand in
/// for them.
template <class Real>
inline Sample<Real> sample_seen(const VelocityOf<Real>* field, std::int32_t step,
                                std::int32_t stride, const Stencil<Real>& at,
                                const StandIns<Real>& face) {
    const VelocityOf<Real>* p = field + step * at.base;
    return face.sample({Real(p[0]), Real(p[step]), Real(p[step * stride]),
                        Real(p[step * (stride + 1)])}, at);
}

/// From a stencil's place to the one that `sample_seen` tells of.
template <class Real>
inline Vec2<Real> way_to_sample(const Stencil<Real>& at, const StandIns<Real>& face) {
    constexpr Real kZero = Real(0);
    constexpr Real kOne = Real(1);
    return {face.sample({kZero, kOne, kZero, kOne}, at).value - at.fx,
            face.sample({kZero, kZero, kOne, kOne}, at).value - at.fy};
}

}  // namespace weir
