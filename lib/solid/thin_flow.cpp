// What thin walls that move push into cells.
#include "solid/moving_walls.hpp"
#include "solid/thin_sight.hpp"

namespace weir {

namespace {

/// Velocity of the liquid in a cell before the substep, from its open faces.
template <class Real>
struct BesideWall {
    Vec2<Real> velocity{};
    bool knows_u = false;
    bool knows_v = false;

    BesideWall(const StaggeredGrid<Real>& grid, const Walls<Real>& walls, std::int32_t cell) {
        const auto mean = [](const VelocityOf<Real>* field, const ShareOf<Real>* open,
                             std::int32_t low, std::int32_t high, bool& known) {
            const auto holds = [&](std::int32_t face) {
                return Real(open[face]) > Real(0) && !is_no_velocity(Real(field[face]));
            };
            const bool first = holds(low);
            const bool second = holds(high);
            known = first || second;
            const Real sum = (first ? Real(field[low]) : Real(0)) +
                             (second ? Real(field[high]) : Real(0));
            return first && second ? Real(0.5) * sum : sum;
        };
        velocity.x = mean(grid.mass_u, walls.open_u, cell, cell + 1, knows_u);
        velocity.y = mean(grid.mass_v, walls.open_v, cell, cell + grid.shape.stride, knows_v);
    }
};

/// What goes through a face that a thin wall closes: the wall's velocity along its normal, and of
/// that along itself as much as the liquid goes with it.
template <class Real>
Real through_closed(const Walls<Real>& walls, const BesideWall<Real>& liquid, Vec2<Real> face,
                    std::int32_t before, std::int32_t cell, bool along_x) {
    const WallEdge* edge = edge_between(*walls.thin, face, before, cell, along_x);
    if (edge == nullptr) {
        return Real(0);
    }
    const Vec2<Real> wall = velocity_at(walls, edge->slot, face);
    const Vec2<Real> normal = left_normal(*walls.thin, *edge);
    const Vec2<Real> along{normal.y, Real(0) - normal.x};
    const Vec2<Real> beside{liquid.knows_u ? liquid.velocity.x : wall.x,
                            liquid.knows_v ? liquid.velocity.y : wall.y};
    const Real own = static_cast<Real>(dot(wall, along));
    const Real with = static_cast<Real>(dot(beside, along));
    const Real slides = own < Real(0) ? clamp(with, own, Real(0)) : clamp(with, Real(0), own);
    const Vec2<Real> through = static_cast<Real>(dot(wall, normal)) * normal + slides * along;
    return along_x ? through.x : through.y;
}

}  // namespace

template <class Real>
Real flow_of_thin_walls(const StaggeredGrid<Real>& grid, const Walls<Real>& walls,
                        std::int32_t i, std::int32_t j) {
    const ThinWalls<Real>& thin = *walls.thin;
    const GridShape& s = grid.shape;
    const std::int32_t c = s.index(i, j);
    const std::int32_t up = c + s.stride;
    const bool left = (thin.mark[c] & kLeftClosed) != 0;
    const bool right = (thin.mark[c + 1] & kLeftClosed) != 0;
    const bool lower = (thin.mark[c] & kLowerClosed) != 0;
    const bool upper = (thin.mark[up] & kLowerClosed) != 0;
    if (!left && !right && !lower && !upper) {
        return Real(0);
    }
    const BesideWall<Real> liquid(grid, walls, c);
    const auto x = static_cast<Real>(i);
    const auto y = static_cast<Real>(j);
    constexpr Real kHalf = Real(0.5);
    const auto through_u = [&](bool closed, Real at, std::int32_t face) {
        return closed ? through_closed(walls, liquid, {at, y + kHalf}, face - 1, face, true)
                      : Real(0);
    };
    const auto through_v = [&](bool closed, Real at, std::int32_t face) {
        return closed ? through_closed(walls, liquid, {x + kHalf, at}, face - s.stride, face, false)
                      : Real(0);
    };
    return (through_u(right, x + Real(1), c + 1) - through_u(left, x, c)) +
           (through_v(upper, y + Real(1), up) - through_v(lower, y, c));
}

#define WEIR_INSTANTIATE(Real)                                                                     \
    template Real flow_of_thin_walls(const StaggeredGrid<Real>&, const Walls<Real>&, std::int32_t, \
                                     std::int32_t);
WEIR_FOR_EACH_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
