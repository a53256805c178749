#include "solid/collide.hpp"

#include "contour/marching_squares.hpp"
#include "solid/reflect.hpp"

namespace weir {

namespace {

constexpr std::uint8_t kOutside = 0;
constexpr std::uint8_t kInside = 15;

/// A particle inside a solid leaves at this speed at most, cells per substep: as fast as it can
/// have come in at the default CFL number, and no faster.
template <class Real>
constexpr Real kLongestWayOut = Real(1);

/// Where a particle is put: this far in front of the wall, so that it is not found behind it again.
template <class Real>
constexpr Real kClearance = Real(1.0 / 1024.0);

template <class Real>
struct CellView {
    std::int32_t node = 0;  ///< lower left
    Vec2<Real> local;       ///< 0 … 1 within the cell
    Real corner[4] = {};
};

template <class Real>
CellView<Real> cell_of(const GridShape& s, const Walls<Real>& walls, Vec2<Real> x) {
    const auto i = static_cast<std::int32_t>(x.x);
    const auto j = static_cast<std::int32_t>(x.y);
    CellView<Real> cell;
    cell.node = s.index(i, j);
    cell.local = {x.x - static_cast<Real>(i), x.y - static_cast<Real>(j)};
    const Real* low = walls.distance + cell.node;
    const Real* high = low + s.stride;
    cell.corner[0] = low[0];
    cell.corner[1] = low[1];
    cell.corner[2] = high[1];
    cell.corner[3] = high[0];
    return cell;
}

/// On a ridge, where two ways out are equally long, either will do, but one has to be taken.
template <class Real>
Vec2<Real> away_from_centre(Vec2<Real> local) {
    const Vec2<Real> offset{local.x - Real(0.5), local.y - Real(0.5)};
    const Real size = length(offset);
    return size > Real(0) ? (Real(1) / size) * offset : Vec2<Real>{Real(0), Real(1)};
}

/// Distance and its direction of growth from the bilinear interpolant, for cells without a line.
template <class Real>
ContourHit<Real> interpolated_distance(const CellView<Real>& cell) {
    const Real* d = cell.corner;
    const Vec2<Real> f = cell.local;
    const Real low = d[0] + f.x * (d[1] - d[0]);
    const Real high = d[3] + f.x * (d[2] - d[3]);
    const Vec2<Real> gradient{(d[1] - d[0]) + f.y * ((d[2] - d[3]) - (d[1] - d[0])), high - low};
    const Real steepness = length(gradient);
    ContourHit<Real> hit;
    hit.distance = low + f.y * (high - low);
    hit.normal = steepness > Real(0) ? (Real(1) / steepness) * gradient : away_from_centre(f);
    return hit;
}

template <class Real>
ContourHit<Real> hit_in(const CellView<Real>& cell, std::uint8_t which) {
    return which == kInside ? interpolated_distance(cell)
                            : contour_distance(contour_cell(cell.corner), cell.local);
}

template <class Real>
std::uint8_t case_at(const GridShape& s, const Walls<Real>& walls, Vec2<Real> x) {
    return walls.cell_case[s.index(static_cast<std::int32_t>(x.x), static_cast<std::int32_t>(x.y))];
}

/// The body at the node of the cell that is deepest inside.
template <class Real>
std::uint16_t touched_body(const GridShape& s, const Walls<Real>& walls, std::int32_t node) {
    const std::int32_t corner[4] = {node, node + 1, node + s.stride + 1, node + s.stride};
    std::int32_t deepest = corner[0];
    for (const std::int32_t candidate : corner) {
        deepest = walls.distance[candidate] < walls.distance[deepest] ? candidate : deepest;
    }
    return walls.nearest[deepest];
}

}  // namespace

template <class Real>
CollideResult<Real> collide(const GridShape& shape, const Walls<Real>& walls,
                            Particles<Real>& particles) {
    CollideResult<Real> result;
    for (std::int32_t k = 0; k < particles.count; ++k) {
        const Vec2<Real> x = particles.position[k];
        const std::uint8_t which = case_at(shape, walls, x);
        if (which == kOutside) {
            continue;
        }
        ++result.tested;
        const CellView<Real> cell = cell_of(shape, walls, x);
        const ContourHit<Real> hit = hit_in(cell, which);
        if (!(hit.distance < Real(0))) {
            continue;
        }
        ++result.reflected;
        const Real way = minimum(kClearance<Real> - hit.distance, kLongestWayOut<Real>);
        particles.position[k] = within_tank(shape, x + way * hit.normal);
        const Body<Real>& body = walls.body[touched_body(shape, walls, cell.node)];
        const Vec2<Real> surface =
            surface_velocity(body.surface, velocity_at(body, x), hit.normal);
        const Vec2<Real> v =
            reflect(body.surface, surface, particles.velocity[k], hit.normal);
        particles.velocity[k] = v;
        result.max_speed = maximum(result.max_speed, maximum(absolute(v.x), absolute(v.y)));
    }
    return result;
}

template <class Real>
bool inside_solid(const GridShape& shape, const Walls<Real>& walls, Vec2<Real> point) {
    const std::uint8_t which = case_at(shape, walls, point);
    return which != kOutside && hit_in(cell_of(shape, walls, point), which).distance < Real(0);
}

template bool inside_solid(const GridShape&, const Walls<float>&, Vec2<float>);
template bool inside_solid(const GridShape&, const Walls<double>&, Vec2<double>);
template bool inside_solid(const GridShape&, const Walls<Fixed>&, Vec2<Fixed>);
template CollideResult<float> collide(const GridShape&, const Walls<float>&, Particles<float>&);
template CollideResult<double> collide(const GridShape&, const Walls<double>&,
                                       Particles<double>&);
template CollideResult<Fixed> collide(const GridShape&, const Walls<Fixed>&,
                                       Particles<Fixed>&);

}  // namespace weir
