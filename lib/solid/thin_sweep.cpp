#include "solid/thin_sweep.hpp"

#include "fluid/particles.hpp"

namespace weir {

namespace {

/// Distance at which a particle is put before a wall, cells.
template <class Real>
constexpr Real kClearance = Real(1.0 / 512.0);

/// Who is found behind a wall gets as far in front of it, this at most, cells. Set to the wall
/// itself, or only some of the way back, particles that walls push into a corner would come nearer
/// to each other by so much in each substep until all are in one place.
template <class Real>
constexpr Real kMostBeyond = Real(0.5);

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

template <class Real>
bool comes_first(const Crossing<Real>& crossing, const WallEdge& edge,
                 const Nearest<Real>& nearest) {
    if (nearest.edge == nullptr || crossing.part != nearest.crossing.part) {
        return nearest.edge == nullptr || crossing.part < nearest.crossing.part;
    }
    return goes_before(edge, *nearest.edge);
}

/// A way that ends short of an edge by less than half of the clearance. What is not moved away from
/// it could be on its other side by rounding when it next moves.
template <class Real>
Crossing<Real> touch_edge(Vec2<Real> p, Vec2<Real> q, Vec2<Real> a, Vec2<Real> b) {
    const Vec2<Real> edge = b - a;
    const Real size = absolute(edge.x) + absolute(edge.y);
    const Product<Real> zero{};
    const Product<Real> short_of_it = cross(edge, q - a);
    const Product<Real> least = product(Real(0.25) * kClearance<Real>, size);
    Crossing<Real> crossing;
    if (short_of_it > zero - least && short_of_it < least) {
        const Product<Real> along = dot(q - a, edge);
        crossing.found = along >= zero && along <= dot(edge, edge);
        crossing.from_left = cross(edge, p - a) >= zero;
        crossing.part = Real(1);
    }
    return crossing;
}

/// First wall on the way to a place. `touching`: or at its end.
template <class Real>
Nearest<Real> first_wall(const Journey<Real>& journey, Vec2<Real> to, bool touching) {
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
            const Vec2<Real> a = thin.vertex[edge.from];
            const Vec2<Real> b = thin.vertex[edge.to];
            Crossing<Real> crossing = cross_edge(seen, to, a, b);
            if (touching && !crossing.found) {
                crossing = touch_edge(seen, to, a, b);
            }
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

/// An edge of a closed body as a place stands to it.
template <class Real>
struct NearEdge {
    std::uint16_t slot = 0;
    Real distance = Real(0);
    Real depth = Real(0);  ///< behind it, > 0 inside
    Vec2<Real> normal;     ///< outwards
};

template <class Real>
NearEdge<Real> near_edge(const ThinWalls<Real>& thin, const WallEdge& edge, Vec2<Real> place) {
    const Vec2<Real> a = thin.vertex[edge.from];
    const Vec2<Real> way = thin.vertex[edge.to] - a;
    const Vec2<Real> left = left_normal(thin, edge);
    const Real depth = dot(place - a, left);
    const Vec2<Real> along{left.y, Real(0) - left.x};
    const Real before = Real(0) - static_cast<Real>(dot(place - a, along));
    const Real behind = Real(0) - (static_cast<Real>(dot(way, along)) + before);
    const Real beyond = maximum(Real(0), maximum(before, behind));
    // At a corner both edges are as near: the one that is seen less slantingly decides.
    const Real distance = length(Vec2<Real>{beyond, depth}) + kHair<Real> * beyond;
    return {edge.slot, distance, depth, Vec2<Real>{} - left};
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
        const Nearest<Real> wall = first_wall(journey, stop.place, true);
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
        const Real depth = Real(0) - height_over(thin, stop, hit, vertex[hit]);
        const Real beyond = clamp<Real>(depth, Real(0), kMostBeyond<Real>);
        const Real short_of_it = kClearance<Real> + depth + beyond;
        stop.place = within_tank(shape, stop.place + short_of_it * stop.normal[hit]);
    }
    // In a corner too narrow to slide along: back to where it was, as the wall took it along.
    const Vec2<Real> places[] = {within_tank(shape, carried), before};
    for (const Vec2<Real> place : places) {
        if (first_wall(journey, place, false).edge == nullptr) {
            stop.place = place;
            return true;
        }
    }
    return false;
}

template <class Real>
bool way_out_of_thin(const ThinWalls<Real>& thin, const GridShape& shape,
                     const Body<Real>* bodies, Vec2<Real> place, ThinStop<Real>& stop) {
    if (!thin.any_closed) {
        return false;
    }
    // Bodies overlap: the nearest edge of each says whether it holds the place.
    NearEdge<Real> nearest[kMostHits];
    std::int32_t bodies_near = 0;
    const auto i = static_cast<std::int32_t>(place.x);
    const auto j = static_cast<std::int32_t>(place.y);
    for_each_edge_around(thin, shape, i, j, [&](const WallEdge& edge) {
        if (bodies[edge.slot].open) {
            return;
        }
        const NearEdge<Real> here = near_edge(thin, edge, place);
        std::int32_t n = 0;
        while (n < bodies_near && nearest[n].slot != edge.slot) {
            ++n;
        }
        if (n == bodies_near && n < kMostHits) {
            nearest[n] = {edge.slot, Real(0.5) * kThin<Real> + kHair<Real>, Real(0), {}};
            ++bodies_near;
        }
        if (n < kMostHits && here.distance < nearest[n].distance) {
            nearest[n] = here;
        }
    });
    const NearEdge<Real>* out = nullptr;
    for (std::int32_t n = 0; n < bodies_near; ++n) {
        if (nearest[n].depth > Real(0) && (out == nullptr || nearest[n].distance < out->distance)) {
            out = nearest + n;
        }
    }
    if (out == nullptr) {
        return false;
    }
    stop.slot[0] = out->slot;
    stop.normal[0] = out->normal;
    stop.count = 1;
    stop.place = within_tank(shape, place + (kClearance<Real> + out->depth) * stop.normal[0]);
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
