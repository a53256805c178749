// Where a particle beside a thin body that moves comes from. Nodes show a wall of a cell up to half
// a cell too thin, each time elsewhere: a place that was in the open may be in the solid next time.
#pragma once

#include "geometry/outline.hpp"
#include "solid/blow.hpp"
#include "solid/slide.hpp"

namespace weir {

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

/// Where a particle would be if it had moved with a body. If nodes show the solid there now: the
/// nearest place on the outline, where they show none.
template <class Real>
[[gnu::noinline, gnu::cold]] Vec2<Real> origin_beside(const Scene<Real>& scene,
                                                      const Body<Real>& body, Vec2<Real> before) {
    const GridShape& s = scene.shape;
    const Walls<Real>& walls = scene.walls;
    const Vec2<Real> seen = carried(scene, body, before);
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

/// The same for any body: of those that stand still the picture does not change.
template <class Real>
Vec2<Real> origin(const Scene<Real>& scene, std::uint16_t slot, Vec2<Real> before) {
    if (slot == kNoBody || !scene.walls.moving) {
        return before;
    }
    const Body<Real>& body = scene.walls.body[slot];
    return body.kind == BodyKind::moving ? origin_beside(scene, body, before) : before;
}

}  // namespace weir
