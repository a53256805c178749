#include "solid/moving_walls.hpp"

#include "geometry/outline.hpp"
#include "solid/blow.hpp"
#include "solid/slide.hpp"
#include "solid/thin_sight.hpp"

namespace weir {

namespace {

template <class Real>
Vec2<Real> velocity_of_nearest(const Walls<Real>& walls, std::int32_t a, std::int32_t b,
                               Vec2<Real> point) {
    const std::uint16_t slot = nearest_body(walls, a, b);
    return slot == kNoBody ? Vec2<Real>{} : velocity_at(walls.body[slot], point);
}

template <class Real>
Real wall_flow(const StaggeredGrid<Real>& grid, const Walls<Real>& walls, std::int32_t i,
               std::int32_t j) {
    const GridShape& shape = grid.shape;
    const std::int32_t node = shape.index(i, j);
    const std::int32_t up = node + shape.stride;
    const Vec2<Real> corner = corner_of<Real>(shape, i, j);
    constexpr Real kHalf = Real(0.5);
    const auto thin = [&](std::int32_t face, ThinMark closed) {  // flow_of_thin_walls
        return walls.thin != nullptr && (walls.thin->mark[face] & closed) != 0;
    };
    const auto closed_u = [&](std::int32_t low, std::int32_t high, Real x) {
        const Real closed = Real(1) - walls.open_u[low];
        const Vec2<Real> middle{x, corner.y + kHalf};
        return closed > Real(0) && !thin(low, kLeftClosed)
                   ? closed * velocity_of_nearest(walls, low, high, middle).x
                   : Real(0);
    };
    const auto closed_v = [&](std::int32_t left, std::int32_t right, Real y) {
        const Real closed = Real(1) - walls.open_v[left];
        const Vec2<Real> middle{corner.x + kHalf, y};
        return closed > Real(0) && !thin(left, kLowerClosed)
                   ? closed * velocity_of_nearest(walls, left, right, middle).y
                   : Real(0);
    };
    const Real flow =
        (closed_u(node + 1, up + 1, corner.x + Real(1)) - closed_u(node, up, corner.x)) +
        (closed_v(up, up + 1, corner.y + Real(1)) - closed_v(node, node + 1, corner.y));
    if constexpr (kHasThinWalls<Real>) {
        if (walls.thin != nullptr) {
            return flow + flow_of_thin_walls(grid, walls, i, j);
        }
    }
    return flow;
}

template <class Real>
bool is_shifting(const Walls<Real>& walls, std::int32_t cell, std::int32_t up) {
    if (!walls.active || walls.cell_case[cell] == 0) {
        return false;
    }
    const auto shifts = [&](std::int32_t node) {
        const std::uint16_t slot = nearest_at(walls, node);
        return slot != kNoBody && walls.body[slot].has_speed();
    };
    return shifts(cell) || shifts(cell + 1) || shifts(up) || shifts(up + 1);
}

// Where a particle beside a thin body that moves comes from. Nodes show a wall of a cell up to half
// a cell too thin, each time elsewhere: a place that was in the open may be in the solid next time.

/// Bodies that have nodes deeper than this near a place are thick: the way out of them leads to the
/// side from which a particle came. Cells.
template <class Real>
inline constexpr Real kThick = Real(0.75);

template <class Real>
bool is_stored_at(const GridShape& s, const Walls<Real>& walls, Vec2<Real> x) {
    return is_stored(walls, s, static_cast<std::int32_t>(x.x), static_cast<std::int32_t>(x.y));
}

/// Whether a body is thin around the cell of a place, as nodes tell.
template <class Real>
bool is_thin_at(const GridShape& s, const Walls<Real>& walls, Vec2<Real> x) {
    const auto i = static_cast<std::int32_t>(x.x);
    const auto j = static_cast<std::int32_t>(x.y);
    for (std::int32_t row = maximum(j - 1, 0); row <= minimum(j + 2, s.ny); ++row) {
        for (std::int32_t column = maximum(i - 1, 0); column <= minimum(i + 2, s.nx); ++column) {
            if (walls.distance[s.index(column, row)] < -kThick<Real>) {
                return false;
            }
        }
    }
    return true;
}

/// The place on an outline that is nearest to a point.
template <class Real>
Vec2<Real> nearest_on(const Outline<Real>& outline, Vec2<Real> point) {
    Vec2<Real> nearest = outline.vertex[0];
    Product<Real> least = dot(nearest - point, nearest - point);
    for_each_edge(outline, [&](Vec2<Real> a, Vec2<Real> b) {
        const Vec2<Real> edge = b - a;
        const Real size = length(edge);
        if (!(size > Real(0))) {
            return;
        }
        const Vec2<Real> along = (Real(1) / size) * edge;
        const Real part = clamp(Real(dot(point - a, along)), Real(0), size);
        const Vec2<Real> place = a + part * along;
        const Product<Real> square = dot(place - point, place - point);
        if (square < least) {
            least = square;
            nearest = place;
        }
    });
    return nearest;
}

/// `MovingWalls::carried`.
template <class Real>
Vec2<Real> carried_along(const Scene<Real>& scene, const Body<Real>& body, Vec2<Real> x) {
    return body.kind == BodyKind::moving ? x + scene.dt_s * velocity_at(body, x) : x;
}

/// Where a particle would be if it had moved with a body. If nodes show the solid there now: the
/// nearest place on the outline, where they show none.
template <class Real>
[[gnu::cold]] Vec2<Real> origin_beside(const Scene<Real>& scene, const Body<Real>& body,
                                       Vec2<Real> before) {
    const GridShape& s = scene.shape;
    const Walls<Real>& walls = scene.walls;
    const Vec2<Real> seen = carried_along(scene, body, before);
    const Vec2<Real> from = within_tank(s, seen);
    if (scene.bodies == nullptr || !is_stored_at(s, walls, from)) {
        return seen;
    }
    const bool inside = is_inside(s, walls, from);
    if ((!inside && in_tank(s, seen)) || !is_thin_at(s, walls, from)) {
        return seen;
    }
    if (!inside) {
        return from;
    }
    const Vec2<Real> on = nearest_on(scene.bodies->outline(body), from);
    const Vec2<Real> way = on - from;
    const Real far = length(way);
    if (!(far > Real(0))) {
        return from;
    }
    const Vec2<Real> place = as_kept(within_tank(s, on + (kClearance<Real> / far) * way));
    return is_inside(s, walls, place) ? from : place;
}

/// A body whose surface is on a particle's way, or kNoBody.
template <class Real>
std::uint16_t body_on_way(const Scene<Real>& scene, Vec2<Real> before, Vec2<Real> x) {
    for (std::int32_t half = 0; half <= 2; ++half) {
        const Vec2<Real> at = x + ratio_of<Real>(half, 2) * (before - x);
        if (!is_stored_at(scene.shape, scene.walls, at)) {
            continue;
        }
        const std::uint16_t slot =
            touched_body(scene.shape, scene.walls,
                         scene.shape.index(static_cast<std::int32_t>(at.x),
                                           static_cast<std::int32_t>(at.y)));
        if (slot != kNoBody) {
            return slot;
        }
    }
    return kNoBody;
}

}  // namespace

template <class Real>
const MovingWalls<Real>& moving_walls() {
    static constexpr MovingWalls<Real> kTable{
        wall_flow<Real>,     is_shifting<Real>,   velocity_of_nearest<Real>, velocity_at<Real>,
        carried_along<Real>, origin_beside<Real>, body_on_way<Real>};
    return kTable;
}

template <class Real>
void move_bodies(BodyTable<Real>& table, Walls<Real>& walls, Seconds<Real> dt_s) {
    const bool held = !(dt_s > Seconds<Real>{});
    walls.moving = nullptr;
    for (std::int32_t slot = table.movable.first; slot < table.movable.end; ++slot) {
        Body<Real>& body = table.body[slot];
        body.leapt = false;
        if (body.kind != BodyKind::moving ||
            (table.load != nullptr && table.load[slot].is_free())) {
            continue;
        }
        if (body.has_speed()) {
            walls.moving = &moving_walls<Real>();
            if (held) {
                continue;
            }
            body.position = body.position + dt_s * body.velocity;
            body.angle = wrapped_angle(body.angle + dt_s * body.spin);
            body.moved = true;
            place(table, body);
        }
    }
}

template <class Real>
void note_moving(const BodyTable<Real>& table, Walls<Real>& walls) {
    walls.moving = nullptr;
    for (std::int32_t slot = table.movable.first; slot < table.movable.end; ++slot) {
        if (table.body[slot].kind == BodyKind::moving && table.body[slot].has_speed()) {
            walls.moving = &moving_walls<Real>();
        }
    }
}

#define WEIR_INSTANTIATE(Real)                                        \
    template const MovingWalls<Real>& moving_walls();                 \
    template void note_moving(const BodyTable<Real>&, Walls<Real>&);  \
    template void move_bodies(BodyTable<Real>&, Walls<Real>&, Seconds<Real>);
WEIR_FOR_EACH_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
