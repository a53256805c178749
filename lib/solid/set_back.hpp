// A particle behind the line of its cell is set back to it, if that is the side that it came from.
#pragma once

#include "solid/blow.hpp"
#include "solid/slide.hpp"

namespace weir {

/// What is found inside goes out at this speed at most, cells per substep.
template <class Real>
inline constexpr Real kFastestWayOut = Real(1);

/// Set to the contour itself, all that come to a corner, or that a body pushes along, would meet in
/// one place, and never part again: so much of their way back they go further.
template <class Real>
inline constexpr Real kBeyond = Real(0.5);

/// Between bodies that move particles are set back over and over, each time by another wall, and
/// half of their way brings them nearer to each other until they meet. All of it keeps them as far
/// apart as they were. Packed worlds part those who have met.
template <class Real>
Real part_beyond(const Walls<Real>& walls, std::uint16_t slot) {
    const bool moves = !Stored<Real>::coarse && walls.moving != nullptr &&
                       walls.body[slot].kind == BodyKind::moving;
    return moves ? Real(1) : kBeyond<Real>;
}

/// In a corner a particle that is set back to one wall may be behind the next: so often.
inline constexpr std::int32_t kMostWalls = 4;

/// A particle that ends further than this behind the plane that it is set back to has come through
/// the solid from its other side, cells. Less is the bend of a surface.
template <class Real>
inline constexpr Real kOtherSide = Real(0.0625);

/// A way from open to open leads through a solid if it ends further than this behind the line where
/// it goes in, or begins so behind that where it comes out, cells. Less cuts a corner.
template <class Real>
inline constexpr Real kThrough = Real(0.25);

/// Where a particle would be if it had moved with a body. Of those that stand still the picture
/// does not change.
template <class Real>
Vec2<Real> origin(const Scene<Real>& scene, std::uint16_t slot, Vec2<Real> before) {
    if (slot == kNoBody || scene.walls.moving == nullptr) {
        return before;
    }
    const Body<Real>& body = scene.walls.body[slot];
    return body.kind == BodyKind::moving ? scene.walls.moving->origin(scene, body, before)
                                         : before;
}

/// Blows that are to be answered once it is clear that the particle can stay where they put it.
template <class Real>
struct DueBlows {
    std::uint16_t slot[kMostWalls] = {};
    Vec2<Real> normal[kMostWalls];
    std::int32_t count = 0;
};

/// Whether a place in front of a wall lies on another side of it than a particle came from.
template <class Real>
[[gnu::noinline, gnu::cold]] bool on_other_side(const Scene<Real>& scene, Vec2<Real> to,
                                                Vec2<Real> normal, Vec2<Real> from) {
    const Real depth = dot(to - from, normal);
    return depth > kOtherSide<Real> && in_tank(scene.shape, from) &&
           !is_inside(scene.shape, scene.walls, from);
}

/// Whether a way of a cell along each axis at most may lead through half a cell of solid, between
/// places in the open: it is in it after a third or after two.
template <class Real>
bool is_crossed(const GridShape& s, const Walls<Real>& walls, Vec2<Real> from, Vec2<Real> to) {
    const Vec2<Real> third = ratio_of<Real>(1, 3) * (to - from);
    return is_inside(s, walls, from + third) || is_inside(s, walls, to - third);
}

/// Whether a way between two places in the open leads through a solid.
template <class Real>
[[gnu::noinline, gnu::cold]] bool leads_through(const Scene<Real>& scene, Vec2<Real> from,
                                                Vec2<Real> to) {
    if (!in_tank(scene.shape, from) || is_inside(scene.shape, scene.walls, from)) {
        return false;
    }
    const auto enters = [&](Vec2<Real> begin, Vec2<Real> end, bool& found) {
        const Entry<Real> entry = first_entry(scene.shape, scene.walls, begin, end);
        found = entry.found;
        return found && Real(dot(entry.place - end, line_normal(scene.shape, scene.walls,
                                                                entry.behind))) > kThrough<Real>;
    };
    bool found = false;
    return enters(from, to, found) || (found && enters(to, from, found));
}

/// Where a particle is set back to.
template <class Real>
struct PlaceBack {
    Vec2<Real> to;
    DueBlows<Real> blows;
};

/// On the line of its cell, and on that of the cell where it gets. False: it is too deep, or comes
/// out on another side than it came from. By itself: what it needs is gone when others are asked.
template <class Real>
[[gnu::noinline]] bool find_place_back(const Scene<Real>& scene, Standing<Real> at,
                                       Vec2<Real> from, PlaceBack<Real>& back) {
    const bool binary = scene.walls.binary;
    DueBlows<Real>& blows = back.blows;
    while (at.inside && blows.count < (binary ? 1 : kMostWalls)) {
        const Real way = kClearance<Real> - at.hit.distance;
        if (way > kFastestWayOut<Real> && !binary) {
            return false;
        }
        const Vec2<Real> normal = at.hit.normal;
        blows.slot[blows.count] = at.slot;
        blows.normal[blows.count] = normal;
        ++blows.count;
        const Vec2<Real> wall = back.to + minimum(way, kFastestWayOut<Real>) * normal;
        const Real part = binary ? Real(0) : part_beyond(scene.walls, at.slot);
        const Real beyond = Real(0) - part * at.hit.distance;
        back.to = as_kept(within_tank(scene.shape, wall + beyond * normal));
        at = standing(scene.shape, scene.walls, back.to);
        if (!binary && !at.inside && on_other_side(scene, wall, normal, from)) {
            return false;
        }
    }
    return binary || !at.inside;
}

/// Sets a particle back. False, and nothing has happened: see above, or its way leads through.
template <class Real>
[[gnu::noinline]] bool set_back(Scene<Real>& scene, std::int32_t k, const Standing<Real>& at,
                                Vec2<Real> before, bool further) {
    const bool binary = scene.walls.binary;
    const bool saddle = at.which == 5 || at.which == 10;
    const Vec2<Real> x = scene.particles.position[k];
    const Vec2<Real> from = binary ? before : origin(scene, at.slot, before);
    PlaceBack<Real> back{x, {}};
    if (!find_place_back(scene, at, from, back) ||
        (!binary && (further || saddle || back.blows.count > 1) &&
         leads_through(scene, from, back.to))) {
        return false;
    }
    scene.particles.position[k] = back.to;
    for (std::int32_t blow = 0; blow < back.blows.count; ++blow) {
        answer(scene, k, back.blows.slot[blow], x, back.blows.normal[blow]);
    }
    return true;
}

}  // namespace weir
