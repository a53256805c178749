#include "solid/walls.hpp"

#include "solid/thin_sight.hpp"

namespace weir {

template <class Real>
Real wall_flow(const GridShape& shape, const Walls<Real>& walls, std::int32_t i, std::int32_t j) {
    const std::int32_t node = shape.index(i, j);
    const std::int32_t up = node + shape.stride;
    const Vec2<Real> corner = corner_of<Real>(shape, i, j);
    constexpr Real kHalf = Real(0.5);
    const auto thin = [&](std::int32_t face, ThinMark closed) {
        return walls.thin != nullptr && (walls.thin->mark[face] & closed) != 0;
    };
    const auto closed_u = [&](std::int32_t low, std::int32_t high, Real x) {
        if (thin(low, kLeftClosed)) {
            return flow_of_thin_wall(*walls.thin, walls.body, Vec2<Real>{x, corner.y + kHalf},
                                     low - 1, low, true);
        }
        const Real closed = Real(1) - walls.open_u[low];
        return closed > Real(0)
                   ? closed * wall_velocity(walls, low, high, Vec2<Real>{x, corner.y + kHalf}).x
                   : Real(0);
    };
    const auto closed_v = [&](std::int32_t left, std::int32_t right, Real y) {
        if (thin(left, kLowerClosed)) {
            return flow_of_thin_wall(*walls.thin, walls.body, Vec2<Real>{corner.x + kHalf, y},
                                     left - shape.stride, left, false);
        }
        const Real closed = Real(1) - walls.open_v[left];
        return closed > Real(0)
                   ? closed * wall_velocity(walls, left, right, Vec2<Real>{corner.x + kHalf, y}).y
                   : Real(0);
    };
    return (closed_u(node + 1, up + 1, corner.x + Real(1)) - closed_u(node, up, corner.x)) +
           (closed_v(up, up + 1, corner.y + Real(1)) - closed_v(node, node + 1, corner.y));
}

#define WEIR_INSTANTIATE(Real) \
    template Real wall_flow(const GridShape&, const Walls<Real>&, std::int32_t, std::int32_t);
WEIR_FOR_EACH_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
