#include "solid/collide.hpp"

#include "fluid/extent_lanes.hpp"
#include "solid/blow.hpp"
#include "solid/look_packed.hpp"
#include "solid/near_wall_lanes.hpp"
#include "solid/open_around.hpp"
#include "solid/set_back.hpp"
#include "solid/thin_marks.hpp"
#include "solid/thin_sweep.hpp"
#include "solid/way_out.hpp"

namespace weir {

namespace {

/// A pressed particle may go this far around what presses it, cells.
constexpr std::int32_t kSlip = 1;

/// In a notch the velocity that a blow leaves may lead into the solid again, or the particle is
/// `wedged`. Then there is no way on, and what is left of it goes, too: it would grow for ever.
template <class Real>
[[gnu::noinline, gnu::cold]] void stop_if_blocked(Scene<Real>& scene, std::int32_t k,
                                                  std::uint16_t slot, Vec2<Real> place,
                                                  bool wedged) {
    const Vec2<Real> wall = velocity_at(scene.walls, slot, place);
    const Vec2<Real> relative = Vec2<Real>(scene.particles.velocity[k]) - wall;
    const Real speed = length(relative);
    if (!(speed > Real(0))) {
        return;
    }
    const Vec2<Real> back = (Real(-1) / speed) * relative;
    const Vec2<Real> ahead = within_tank(scene.shape, place - Real(1.0 / 32.0) * back);
    if (wedged || is_inside(scene.shape, scene.walls, ahead)) {
        answer(scene, k, slot, place, back);
    }
}

/// Stops a particle where its path, seen from the body, first meets a solid. `slot`: the body that
/// it is in, or kNoBody. `far`: nobody tried to set it back. False: the path began inside a solid.
template <class Real>
[[gnu::noinline, gnu::cold]] bool stop_on_path(Scene<Real>& scene, std::int32_t k,
                                               std::uint16_t slot, Vec2<Real> before, bool far) {
    const Vec2<Real> x = scene.particles.position[k];
    Vec2<Real> from = before;
    Entry<Real> entry;
    Standing<Real> at;
    for (std::int32_t look = 0; look < 2; ++look) {
        from = origin(scene, slot, before);
        if (!in_tank(scene.shape, from) || is_inside(scene.shape, scene.walls, from)) {
            return false;
        }
        entry = first_entry(scene.shape, scene.walls, from, x);
        if (!entry.found) {
            return true;
        }
        at = standing(scene.shape, scene.walls, entry.behind);
        if (slot != kNoBody) {
            break;
        }
        slot = at.slot;  // who passed through a moving body is looked at again from there
    }
    ++scene.result.reflected;
    answer(scene, k, at.slot, entry.place, at.hit.normal);
    const auto stays = [&] { return Real(16) * length(entry.place - from) <= length(x - from); };
    bool wedged = !far && stays();
    if (wedged) {
        entry.place = slide(scene.shape, scene.walls, entry, x);
        wedged = stays();
    }
    scene.particles.position[k] = entry.place;
    stop_if_blocked(scene, k, at.slot, entry.place, wedged);
    return true;
}

/// Leads a particle that was inside already to the nearest place outside. False: there is none.
template <class Real>
[[gnu::noinline, gnu::cold]] bool lead_out(Scene<Real>& scene, std::int32_t k, std::uint16_t slot,
                                           Vec2<Real> before) {
    const Body<Real>& body = scene.walls.body[slot];
    const MovingWalls<Real>* moving = scene.walls.moving;
    const Vec2<Real> seen = moving != nullptr ? moving->carried(scene, body, before) : before;
    const Vec2<Real> from = within_tank(scene.shape, seen);
    if (scene.beyond) {  // it goes along until there is a picture, or the body is gone
        scene.particles.position[k] = from;
        blow(scene, k, slot, from, velocity_at(scene.walls, slot, from));
        ++scene.result.stuck;
        return true;
    }
    bool pressed = !in_tank(scene.shape, seen);
    if (moving != nullptr && body.kind == BodyKind::moving && !pressed) {
        const Standing<Real> at = standing(scene.shape, scene.walls, from);
        pressed = at.inside && at.slot != slot;
    }
    Vec2<Real> place;
    if (!nearest_free_place(scene.shape, scene.walls, from, pressed ? kSlip : kLongestWayOut,
                            place)) {
        return false;
    }
    const Vec2<Real> way = place - from;
    const Real distance = length(way);
    const Vec2<Real> normal = distance > Real(0) ? (Real(1) / distance) * way : Vec2<Real>{};
    ++scene.result.reflected;
    scene.result.covered |= distance > (body.kind == BodyKind::moving ? Real(1) : Real(0.5));
    if (distance > kFastestWayOut<Real>) {
        scene.particles.position[k] = from + kFastestWayOut<Real> * normal;
        blow(scene, k, slot, from, velocity_at(scene.walls, slot, from));
        ++scene.result.stuck;
    } else {
        const Vec2<Real> further =
            within_tank(scene.shape, place + Real(0.25) * kBeyond<Real> * way);
        const bool blocked = is_inside(scene.shape, scene.walls, further);
        scene.particles.position[k] = blocked ? place : further;
        answer(scene, k, slot, place, normal);
    }
    return true;
}

/// Whether a particle that is in the open may have come there through a solid. `slot`: the body.
template <class Real>
[[gnu::noinline, gnu::cold]] bool came_through(const Scene<Real>& scene, Vec2<Real> before,
                                               Vec2<Real> x, Went went, std::uint16_t& slot) {
    if (scene.walls.moving != nullptr) {
        slot = scene.walls.moving->body_on_way(scene, before, x);
    }
    if (went == Went::far) {
        return true;
    }
    // Beside a body that slides by, that may be far from the tank.
    const Vec2<Real> from = origin(scene, slot, before);
    return in_tank(scene.shape, from) && is_crossed(scene.shape, scene.walls, from, x) &&
           leads_through(scene, from, x);
}

/// A particle near the contour of a solid, to which it stands so. False: it has no way out.
template <class Real>
WEIR_ALWAYS_INLINE bool meet_at(Scene<Real>& scene, std::int32_t k,
                                const Standing<Real>& at, Vec2<Real> before,
                                Went went) {
    if (scene.walls.binary) {
        scene.result.reflected += at.inside ? 1 : 0;
        return !at.inside || set_back(scene, k, at, before, false);
    }
    if (!at.inside) {
        std::uint16_t slot = kNoBody;
        if (went != Went::near &&
            came_through(scene, before, Vec2<Real>(scene.particles.position[k]), went, slot)) {
            stop_on_path(scene, k, slot, before, went == Went::far);
        }
        return true;
    }
    if (went != Went::far && set_back(scene, k, at, before, went != Went::near)) {
        ++scene.result.reflected;
        return true;
    }
    return stop_on_path(scene, k, at.slot, before, went == Went::far) ||
           lead_out(scene, k, at.slot, before);
}

template <class Real>
bool meet_contour(Scene<Real>& scene, std::int32_t k, Vec2<Real> before, Went went) {
    const Standing<Real> at = standing<Real>(scene.shape, scene.walls, scene.particles.position[k]);
    scene.result.tested += at.which != kCellOutside ? 1 : 0;
    return meet_at(scene, k, at, before, went);
}

template <class Real>
void answer_all(Scene<Real>& scene, std::int32_t k, const ThinStop<Real>& stop) {
    for (std::int32_t hit = 0; hit < stop.count; ++hit) {
        bool again = false;  // a wall that is met twice has answered
        for (std::int32_t other = 0; other < hit; ++other) {
            again = again || (stop.slot[other] == stop.slot[hit] &&
                              stop.normal[other].x == stop.normal[hit].x &&
                              stop.normal[other].y == stop.normal[hit].y);
        }
        if (!again) {
            answer(scene, k, stop.slot[hit], stop.place, stop.normal[hit]);
        }
    }
}

/// A particle near a thin wall. False: it has no way out.
template <class Real>
bool meet_thin(Scene<Real>& scene, std::int32_t k, Vec2<Real> before, bool follow) {
    const ThinWalls<Real>& thin = *scene.walls.thin;
    const Vec2<Real> x = scene.particles.position[k];
    ThinStop<Real> stop;
    if (!keep_side(thin, scene.shape, scene.walls.body, before, x, follow, stop)) {
        return false;
    }
    const Vec2<Real> kept = stop.place;
    if (stop.count > 0) {
        scene.particles.position[k] = kept;
        answer_all(scene, k, stop);
        scene.result.reflected += follow ? 1 : 0;
    }
    ThinStop<Real> way;
    if (way_out_of_thin(thin, scene.shape, scene.walls.body, kept, stop) &&
        keep_side(thin, scene.shape, scene.walls.body, kept, stop.place, false, way)) {
        scene.particles.position[k] = way.place;
        answer_all(scene, k, stop);
        scene.result.reflected += follow ? 1 : 0;
    }
    return true;
}

/// Thin walls first, then the contour, and who is set back from there keeps its side, too.
template <class Real>
bool meet(Scene<Real>& scene, std::int32_t k, Vec2<Real> before, Went went, bool thin) {
    if (!thin) {
        return meet_contour(scene, k, before, went);
    }
    ++scene.result.tested;
    if (!meet_thin(scene, k, before, true)) {
        return false;
    }
    const Vec2<Real> kept = scene.particles.position[k];
    if (case_at(scene.shape, scene.walls, kept) == kCellOutside &&
        !goes_further(before, kept, kPastCorner<Real>)) {
        return true;
    }
    if (!meet_contour(scene, k, before, went)) {
        return false;
    }
    const Vec2<Real> x = scene.particles.position[k];
    return (x.x == kept.x && x.y == kept.y) || meet_thin(scene, k, kept, false);
}

/// Whether a particle of a block that stays beside thin walls may have met one, or another wall.
template <class Real>
bool may_have_met(const GridShape& s, const Walls<Real>& walls, Vec2<Real> x) {
    return case_at(s, walls, x) != kCellOutside || (mark_at(*walls.thin, s, x) & kTouching) != 0;
}

/// A particle of a block that is not passed over by the cells of all.
template <class Real>
void meet_one(Scene<Real>& scene, const Flight<Real>& flight, std::int32_t first, std::int32_t n) {
    const GridShape& s = scene.shape;
    const Walls<Real>& walls = scene.walls;
    const Vec2<Real> x = scene.particles.position[first + n];
    const Vec2<Real> before = flight.before[n];
    const Went how = went(before, x);
    const bool thin = walls.thin != nullptr && near_thin(s, *walls.thin, x, how == Went::far);
    if (case_at(s, walls, x) != kCellOutside || goes_further(before, x, kPastCorner<Real>) ||
        thin) {
        note(scene, first + n, meet(scene, first + n, before, how, thin), before,
             flight.mark_removed);
    }
}

#if WEIR_HAS_LANES
/// Whether a block cannot have met anything.
[[gnu::noinline]] bool is_in_the_open(const BlockTask& task, std::int32_t count) {
    Extent<float> ways = extent_of_places(task.before, count);
    ways.add(extent_of_places(task.position, count));
    return is_open_around(task.shape, task.cell_case, ways, count);
}

/// A block without thin walls. Most particles are clearly outside.
void collide_in_lanes(Scene<float>& scene, const Flight<float>& flight, std::int32_t first,
                      std::int32_t count) {
    const GridShape& s = scene.shape;
    const Vec2<float>* position = scene.particles.position + first;
    const BlockTask block{s, scene.walls.cell_case, flight.before, position, flight.far};
    const ClearTask task{scene.walls.cell_case + s.index(0, 0),
                         scene.walls.distance + s.index(0, 0), s.stride, &position->x,
                         &flight.before->x, kClear<float>};
    if (flight.far && is_in_the_open(block, count)) {
        return;
    }
    std::int32_t numbers[kBlock<float> + 8];
    std::uint32_t cells[kBlock<float> + 8];
    NearWall near{0, numbers, cells};
    find_near_wall(block, count, near);
    for (std::int32_t next = 0; next < near.count; next += 8) {
        const std::uint32_t all = (1U << minimum(8, near.count - next)) - 1U;
        for (std::uint32_t left = all & ~clear_of_eight(task, near, next); left != 0;
             left &= left - 1U) {
            const std::int32_t n = near.n[next + WEIR_TRAILING_ZEROS(left)];
            const Vec2<float> before(flight.before[n]);
            const Standing<float> at = standing_near(s, scene.walls, position[n]);
            scene.result.tested -= at.which == kCellOutside ? 1 : 0;
            const Went how = went(before, position[n]);
            note(scene, first + n, meet_at(scene, first + n, at, before, how), before,
                 flight.mark_removed);
        }
    }
    scene.result.tested += near.count;
}

/// A block that stays beside thin walls.
void collide_beside_in_lanes(Scene<float>& scene, const Flight<float>& flight, std::int32_t first,
                             std::int32_t count) {
    const GridShape& s = scene.shape;
    const Walls<float>& walls = scene.walls;
    const Vec2<float>* position = scene.particles.position + first;
    const MarkedInBlock<float> marked(*walls.thin, s, position, count);
    if (marked.count() == 0) {
        collide_in_lanes(scene, flight, first, count);
        return;
    }
    std::int32_t numbers[kBlock<float> + 8];
    std::uint32_t cells[kBlock<float> + 8];
    NearWall near{0, numbers, cells};
    find_near_wall({s, walls.cell_case, flight.before, position, false}, count, near);
    std::int32_t of_marked = 0;
    for (std::int32_t of_near = 0; of_near < near.count || of_marked < marked.count();) {
        const std::int32_t by_contour = of_near < near.count ? near.n[of_near] : -1;
        const std::int32_t by_mark = of_marked < marked.count() ? marked[of_marked] : -1;
        const std::int32_t n = maximum(by_contour, by_mark);
        of_near += n == by_contour ? 1 : 0;
        of_marked += n == by_mark ? 1 : 0;
        if (may_have_met(s, walls, position[n])) {
            meet_one(scene, flight, first, n);
        }
    }
}
#endif

/// Nearly all particles are in cells without solid, and nearly all others clearly in the open.
inline void collide_packed(Scene<SmallFixed>& scene, const Flight<SmallFixed>& flight,
                           std::int32_t first, std::int32_t count) {
    for (std::int32_t n = count; n > 0;) {
        const packed::Found found = packed::next_at_wall(
            scene.shape, scene.walls, scene.particles.position + first,
            {flight.before, flight.far}, n, scene.result.tested);
        n = found.n;
        if (n >= 0) {
            const Vec2<SmallFixed> before(flight.before[n]);
            note(scene, first + n, meet_contour(scene, first + n, before, found.went), before,
                 flight.mark_removed);
        }
    }
}

/// Block by block, without lanes.
template <class Real>
void collide_plain(Scene<Real>& scene, const Flight<Real>& flight, std::int32_t first,
                   std::int32_t count) {
    const GridShape& s = scene.shape;
    const Walls<Real>& walls = scene.walls;
    const Vec2<Real>* position = scene.particles.position + first;
    const bool beside = walls.thin != nullptr && stays_beside(flight, *walls.thin);
    const bool one_by_one = walls.thin != nullptr || flight.beyond;
    for (std::int32_t n = count; n > 0;) {
        n = one_by_one   ? n - 1
            : flight.far ? last_past_wall(s, walls.cell_case, flight.before, position, n)
                         : last_near_wall(s, walls.cell_case, position, n);
        if (n < 0) {
            return;
        }
        if (!beside || may_have_met<Real>(s, walls, position[n])) {
            meet_one(scene, flight, first, n);
        }
    }
}

}  // namespace

template <class Real>
void collide(const GridShape& shape, const Walls<Real>& walls, const Flight<Real>& flight,
             std::int32_t first, std::int32_t count, Particles<Real>& particles,
             Contacts<Real>& contacts, CollideResult<Real>& result) {
    Scene<Real> scene{shape, walls, particles, contacts, result, flight.dt_s, flight.beyond,
                      flight.bodies};
    if constexpr (Stored<Real>::coarse) {  // those have no thin walls, and no windows
        collide_packed(scene, flight, first, count);
    } else {
#if WEIR_HAS_LANES
        if constexpr (kHasLanes<Real>) {
            const auto in_lanes = walls.thin == nullptr ? collide_in_lanes
                                                        : collide_beside_in_lanes;
            if (!flight.beyond && maximum(shape.stride, shape.ny) < 0x8000 &&
                (walls.thin == nullptr || stays_beside(flight, *walls.thin))) {
                in_lanes(scene, flight, first, count);
                return;
            }
        }
#endif
        collide_plain(scene, flight, first, count);
    }
}

template <class Real>
bool inside_solid(const GridShape& shape, const Walls<Real>& walls, Vec2<Real> point) {
    ThinStop<Real> stop;
    return is_inside(shape, walls, point) ||
           (walls.thin != nullptr &&
            way_out_of_thin(*walls.thin, shape, walls.body, point, stop));
}

#define WEIR_INSTANTIATE(Real)                                                           \
    template bool inside_solid(const GridShape&, const Walls<Real>&, Vec2<Real>);        \
    template void collide(const GridShape&, const Walls<Real>&, const Flight<Real>&,     \
                          std::int32_t, std::int32_t, Particles<Real>&, Contacts<Real>&, \
                          CollideResult<Real>&);
WEIR_FOR_EACH_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
