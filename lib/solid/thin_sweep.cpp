#include "solid/thin_sweep.hpp"

#include "fluid/particles.hpp"

namespace weir {

namespace {

/// Distance at which a particle is put before a wall, cells.
template <class Real>
constexpr Real kClearance = Real(1.0 / 512.0);

/// Where a place of the tank would be if it had moved with the body since particles met it.
template <class Real>
Vec2<Real> seen_from(const ThinBody<Real>& at, const Body<Real>& body, Vec2<Real> place) {
    return body.position + at.turned.apply(place - body.met_position);
}

template <class Real>
struct Nearest {
    Crossing<Real> crossing;
    const WallEdge* edge = nullptr;
    Vec2<Real> from;
};

template <class Real>
struct Journey {
    const ThinWalls<Real>& thin;
    const GridShape& shape;
    const Body<Real>* bodies;
    Vec2<Real> before;
    bool follow;
};

template <class Real>
Vec2<Real> start(const Journey<Real>& journey, std::uint16_t slot) {
    const ThinBody<Real>& at = journey.thin.body[slot];
    return journey.follow && at.swept ? seen_from(at, journey.bodies[slot], journey.before)
                                      : journey.before;
}

/// Of two walls at the same place always the same one, in whatever order the records stand.
template <class Real>
bool comes_first(const Crossing<Real>& crossing, const WallEdge& edge,
                 const Nearest<Real>& nearest) {
    if (nearest.edge == nullptr || crossing.part != nearest.crossing.part) {
        return nearest.edge == nullptr || crossing.part < nearest.crossing.part;
    }
    return edge.slot != nearest.edge->slot ? edge.slot < nearest.edge->slot
                                           : edge.from < nearest.edge->from;
}

/// First wall on the way to a place.
template <class Real>
Nearest<Real> first_wall(const Journey<Real>& journey, Vec2<Real> to) {
    const ThinWalls<Real>& thin = journey.thin;
    const Real reach = journey.follow ? thin.reach : Real(0);
    const Vec2<Real> from = journey.before;
    const Real left = minimum(from.x, to.x) - reach;
    const Real low = minimum(from.y, to.y) - reach;
    const Real right = maximum(from.x, to.x) + reach;
    const Real high = maximum(from.y, to.y) + reach;
    Nearest<Real> nearest;
    for_each_wall_edge(
        thin, journey.shape, floor_to_int(left), floor_to_int(low), floor_to_int(right),
        floor_to_int(high), [&](const WallEdge& edge) {
            const Vec2<Real> seen = start(journey, edge.slot);
            const Crossing<Real> crossing =
                cross_edge(seen, to, thin.vertex[edge.from], thin.vertex[edge.to]);
            const bool closed = !journey.bodies[edge.slot].open && crossing.from_left;
            if (crossing.found && !closed && comes_first(crossing, edge, nearest)) {
                nearest = {crossing, &edge, seen};
            }
        });
    return nearest;
}

/// Height of the place that a particle has got to over a wall that it met, `vertex` on it.
template <class Real>
Real height_over(const ThinWalls<Real>& thin, const ThinStop<Real>& stop, std::int32_t hit,
                 std::int32_t vertex) {
    return static_cast<Real>(dot(stop.place - thin.vertex[vertex], stop.normal[hit]));
}

/// Of the walls that a particle met, one that sliding along the others has brought it back to: so
/// near that rounding, when that wall next moves, could put it on the other side. −1: none.
template <class Real>
std::int32_t wall_too_near(const ThinWalls<Real>& thin, const ThinStop<Real>& stop,
                           const std::int32_t* vertex) {
    for (std::int32_t hit = 0; hit < stop.count; ++hit) {
        if (absolute(height_over(thin, stop, hit, vertex[hit])) < Real(0.5) * kClearance<Real>) {
            return hit;
        }
    }
    return -1;
}

}  // namespace

template <class Real>
bool keep_side(const ThinWalls<Real>& thin, const GridShape& shape, const Body<Real>* bodies,
               Vec2<Real> before, Vec2<Real> after, bool follow, ThinStop<Real>& stop) {
    const Journey<Real> journey{thin, shape, bodies, before, follow};
    stop.place = after;
    Vec2<Real> carried = before;
    std::int32_t vertex[kMostHits];
    for (stop.count = 0; stop.count < kMostHits; ++stop.count) {
        const std::int32_t hit = stop.count;
        const Nearest<Real> wall = first_wall(journey, stop.place);
        if (wall.edge != nullptr) {
            const Vec2<Real> left = left_normal(thin, *wall.edge);
            stop.slot[hit] = wall.edge->slot;
            stop.normal[hit] = wall.crossing.from_left ? left : Vec2<Real>{} - left;
            vertex[hit] = wall.edge->from;
            carried = wall.from;
        } else {
            const std::int32_t again = wall_too_near(thin, stop, vertex);
            if (again < 0) {
                return true;
            }
            stop.slot[hit] = stop.slot[again];
            stop.normal[hit] = stop.normal[again];
            vertex[hit] = vertex[again];
        }
        const Real short_of_it = kClearance<Real> - height_over(thin, stop, hit, vertex[hit]);
        stop.place = within_tank(shape, stop.place + short_of_it * stop.normal[hit]);
    }
    // In a corner too narrow to slide along: back to where it was, as the wall took it along.
    const Vec2<Real> places[] = {within_tank(shape, carried), before};
    for (const Vec2<Real> place : places) {
        if (first_wall(journey, place).edge == nullptr) {
            stop.place = place;
            return true;
        }
    }
    return false;
}

template <class Real>
bool way_out_of_thin(const ThinWalls<Real>& thin, const GridShape& shape,
                     const Body<Real>* bodies, Vec2<Real> place, ThinStop<Real>& stop) {
    constexpr Real kHalf = Real(0.5);
    const auto i = static_cast<std::int32_t>(place.x);
    const auto j = static_cast<std::int32_t>(place.y);
    Real least = kHalf * kThin<Real> + kHair<Real>;
    Real depth = Real(0);
    bool inside = false;
    for_each_wall_edge(thin, shape, i - 1, j - 1, i + 1, j + 1, [&](const WallEdge& edge) {
        if (bodies[edge.slot].open) {
            return;
        }
        const Vec2<Real> a = thin.vertex[edge.from];
        const Vec2<Real> way = thin.vertex[edge.to] - a;
        const Vec2<Real> left = left_normal(thin, edge);
        const Real height = dot(place - a, left);
        const Vec2<Real> along{left.y, Real(0) - left.x};
        const Real before = Real(0) - static_cast<Real>(dot(place - a, along));
        const Real behind = Real(0) - (static_cast<Real>(dot(way, along)) + before);
        const Real beyond = maximum(Real(0), maximum(before, behind));
        // At a corner both edges are as near: the one that is seen less slantingly decides.
        const Real distance = length(Vec2<Real>{beyond, height}) + kHair<Real> * beyond;
        if (!(distance < least)) {
            return;
        }
        least = distance;
        depth = height;
        inside = height > Real(0);
        stop.slot[0] = edge.slot;
        stop.normal[0] = Vec2<Real>{} - left;
    });
    if (!inside) {
        return false;
    }
    stop.count = 1;
    stop.place = within_tank(shape, place + (kClearance<Real> + depth) * stop.normal[0]);
    return true;
}

#define WEIR_INSTANTIATE(Real)                                                                 \
    template bool keep_side(const ThinWalls<Real>&, const GridShape&, const Body<Real>*,       \
                            Vec2<Real>, Vec2<Real>, bool, ThinStop<Real>&);                    \
    template bool way_out_of_thin(const ThinWalls<Real>&, const GridShape&, const Body<Real>*, \
                                  Vec2<Real>, ThinStop<Real>&);
WEIR_FOR_EACH_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
