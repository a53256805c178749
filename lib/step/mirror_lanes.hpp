// Four or eight faces at a time that mirror the liquid: the plain loop's sums, and so its bits.
#pragma once

#include "grid/staggered_grid.hpp"
#include "math/four_lanes.hpp"
#include "solid/bodies_lanes.hpp"
#include "step/wide_faces.hpp"

namespace weir {

#if WEIR_HAS_LANES

/// Both velocities that are mirrored, where nothing sticks.
struct MirrorTask {
    const GridShape& s;
    const float* distance;
    const float* level;
    const float* pressure;
    float most_slack;
    Vec2<float> fall;
    const float* now_u;
    const float* now_v;
    const float* was_u;
    const float* was_v;
    Vec2<float> low;   ///< what lies within the tank (`within_tank`)
    Vec2<float> high;
    float goes_along;      ///< as `Velocity` has it
    bool all_count;        ///< the same
    std::int32_t at_once;  ///< so many faces
    const float* open_u;
    const float* open_v;
    const float* density;
    bool thin;  ///< there are thin walls, which hide who reads a face
    const Walls<float>* moving;  ///< null: no wall does
};

/// Of eight cells, whose left and lower faces are to be mirrored: a bit each.
struct FacesToMirror {
    std::uint32_t u;
    std::uint32_t v;
};

/// As `is_mirrored`, where nothing sticks, and not `is_unread`.
template <class L>
inline FacesToMirror faces_to_mirror(const MirrorTask& task, std::int32_t first) {
    using Ints = typename L::Ints;
    const auto zero = L::all(0.0F);
    const std::int32_t stride = task.s.stride;
    FacesToMirror found{0, 0};
    for (std::int32_t k = 0; k < 8; k += L::kLanes) {
        const std::int32_t c = first + k;
        const auto node = L::load(task.distance + c);
        const auto wet = L::load(task.level + c) > zero;
        const auto empty = reinterpret_cast<Ints>(L::load(task.density + c)) == 0;
        const auto on = [&](const float* open, std::int32_t other, std::int32_t before) {
            const auto distance = L::all(0.5F) * (node + L::load(task.distance + c + other));
            const auto closed = ~((L::load(open + c) > zero) |
                                  (distance < L::all(kDeepestMirror<float>)));
            const auto read = wet | (L::load(task.level + c - before) > zero) |
                              ~(empty | (reinterpret_cast<Ints>(
                                             L::load(task.density + c - before)) == 0));
            return L::bits_of(task.thin ? closed : closed & read) << static_cast<std::uint32_t>(k);
        };
        found.u |= on(task.open_u, stride, 1);
        found.v |= on(task.open_v, 1, stride);
    }
    return found;
}

/// Faces that are to be mirrored together, row by row.
inline constexpr std::int32_t kMostMirrors = 8;
struct MirrorFaces {
    std::int32_t count = 0;
    std::int32_t face[kMostMirrors];
    std::int32_t column[kMostMirrors];
    std::int32_t row[kMostMirrors];

    void add(std::int32_t at, std::int32_t i, std::int32_t j) {
        face[count] = at;
        column[count] = i;
        row[count] = j;
        ++count;
    }
    /// To groups of four or eight: with the first one. Returns how many there were.
    std::int32_t fill_up() {
        const std::int32_t there = count;
        while (count % 4 != 0 || (there > 4 && count < kMostMirrors)) {
            add(face[0], column[0], row[0]);
        }
        return there;
    }
};

/// Where they take their velocities from.
struct Mirrors {
    Vec2<float> normal(std::int32_t k) const { return {normal_x[k], normal_y[k]}; }
    Vec2<float> point(std::int32_t k) const { return {point_x[k], point_y[k]}; }

    float normal_x[kMostMirrors];
    float normal_y[kMostMirrors];
    float point_x[kMostMirrors];
    float point_y[kMostMirrors];
    float wall_x[kMostMirrors] = {};  ///< its velocity
    float wall_y[kMostMirrors] = {};
    float ratio[kMostMirrors];
    std::int32_t at_u[kMostMirrors];  ///< stencils around the points
    std::int32_t at_v[kMostMirrors];
    float fx_u[kMostMirrors];
    float fy_u[kMostMirrors];
    float fx_v[kMostMirrors];
    float fy_v[kMostMirrors];
    std::uint32_t wet = 0;  ///< a bit for each of which the point lies in a cell of liquid
    float most[kMostMirrors];  ///< along the normal that is mirrored: 0 where the liquid may part
};

/// A vector in each lane.
template <class L>
struct LaneVectors {
    typename L::Floats x;
    typename L::Floats y;

    LaneVectors operator-(const LaneVectors& b) const { return {x - b.x, y - b.y}; }
    LaneVectors times(typename L::Floats s) const { return {s * x, s * y}; }
    typename L::Floats dot(const LaneVectors& b) const { return x * b.x + y * b.y; }
};

/// A component around mirrors' points: where in their squares, and how much particles reach.
template <class L>
struct GroupStencil {
    using Floats = typename L::Floats;
    Floats fx;
    Floats fy;
    Floats share[4] = {};  ///< of the faces that are reached, others 0
    Floats weight = {};    ///< their sum
    typename L::Ints film = {};  ///< which are `of_reached`
    bool any_film = false;

    /// @param was the velocity before the step there.
    template <class Squares>
    void find_films(const Squares& was) {
        using Ints = typename L::Ints;
        const Floats one = L::all(1.0F);
        const Floats zero = L::all(0.0F);
        const Floats none = L::all(kNoVelocity<float>);
        const auto reached = [&](Floats velocity, Floats of) {
            return reinterpret_cast<Ints>(velocity) != reinterpret_cast<Ints>(none) ? of : zero;
        };
        share[0] = reached(was.low_left, (one - fx) * (one - fy));
        share[1] = reached(was.low_right, fx * (one - fy));
        share[2] = reached(was.high_left, (one - fx) * fy);
        share[3] = reached(was.high_right, fx * fy);
        weight = ((share[0] + share[1]) + share[2]) + share[3];
        film = (weight < L::all(kFilmWeight)) & (weight > L::all(kLeastFilmWeight));
        any_film = L::bits_of(film) != 0;
    }
};

/// As `of_reached`.
template <class L, class Squares>
inline typename L::Floats interpolate_group(const Squares& p, const GroupStencil<L>& at) {
    const auto low = p.low_left + at.fx * (p.low_right - p.low_left);
    const auto high = p.high_left + at.fx * (p.high_right - p.high_left);
    const auto all = low + at.fy * (high - low);
    if (!at.any_film) {
        return all;
    }
    const auto sum = ((at.share[0] * p.low_left + at.share[1] * p.low_right) +
                      at.share[2] * p.high_left) +
                     at.share[3] * p.high_right;
    return at.film ? sum / (at.film ? at.weight : L::all(1.0F)) : all;
}

/// As the one for a single face, of the velocity before the step.
template <class L, class Squares>
inline typename L::Floats mean_of_faces(const Squares& of, bool all_count) {
    using Floats = typename L::Floats;
    using Ints = typename L::Ints;
    const Floats one = L::all(1.0F);
    const Floats none = L::all(kNoVelocity<float>);
    const Floats least = all_count ? one : L::all(0.0F);
    const auto counts = [&](Floats velocity) {
        return reinterpret_cast<Ints>(velocity) != reinterpret_cast<Ints>(none) ? one : least;
    };
    const Floats count = (counts(of.low_left) + counts(of.low_right)) +
                         (counts(of.high_left) + counts(of.high_right));
    const Floats sum = (of.low_left + of.low_right) + (of.high_left + of.high_right);
    return (sum + L::all(0.0F)) / L::maximum(count, one);  // −0 if all four are
}

/// As `FaceAxis` has them.
template <class L>
struct GroupDistances {
    typename L::Floats distance;
    LaneVectors<L> gradient;
};
template <class L, bool OnU>
inline GroupDistances<L> distances_at(const MirrorTask& task, const std::int32_t* face) {
    const float* d = task.distance;
    const std::int32_t t = task.s.stride;
    const auto quarter = L::all(0.25F);
    const auto half = L::all(0.5F);
    if constexpr (OnU) {
        const auto low = L::threes_at(d, face);
        const auto high = L::threes_at(d + t, face);
        return {half * (low.middle + high.middle),
                {quarter * ((low.right + high.right) - (low.left + high.left)),
                 high.middle - low.middle}};
    } else {
        const auto rows = L::squares_at(d, d + t, face);
        const auto below = L::squares_at(d - t, d - t, face);
        return {half * (rows.low_left + rows.low_right),
                {rows.low_right - rows.low_left,
                 quarter * ((rows.high_left + rows.high_right) -
                            (below.low_left + below.low_right))}};
    }
}

/// The stencils around points, and which of these lie in liquid. Returns where pressure is slack.
template <class L>
inline typename L::Ints look_at_points(const MirrorTask& task, const std::int32_t* face,
                                       const LaneVectors<L>& point, Mirrors& found) {
    const GridShape& s = task.s;
    const auto half = L::all(0.5F);
    const auto shifted_x = point.x + half;
    const auto shifted_y = point.y + half;
    const auto i = L::whole(point.x);
    const auto j = L::whole(point.y);
    const auto shifted_i = L::whole(shifted_x);
    const auto shifted_j = L::whole(shifted_y);
    const auto cell = (j + 1) * s.stride + i + 1;
    L::store(found.fx_u, point.x - L::floats(i));
    L::store(found.fy_u, shifted_y - L::floats(shifted_j));
    L::store(found.fx_v, shifted_x - L::floats(shifted_i));
    L::store(found.fy_v, point.y - L::floats(j));
    L::store_whole(found.at_u, shifted_j * s.stride + i + 1);
    L::store_whole(found.at_v, (j + 1) * s.stride + shifted_i);
    const auto inside = (i < s.i0 + s.nx) & (j < s.j0 + s.ny);
    const auto level = L::numbers_at(task.level, inside ? cell : L::load_whole(face));
    found.wet = L::bits_of(inside & (level > L::all(0.0F)));
    const auto pressure = L::numbers_at(task.pressure, inside ? cell : L::load_whole(face));
    return inside & (L::absolute(pressure) <= L::all(task.most_slack));
}

/// As `MovingWalls::velocity`, at the faces' middles.
template <class L, bool OnU>
inline void find_walls(const Walls<float>& walls, const MirrorFaces& faces, std::int32_t stride,
                       const LaneVectors<L>& middle, Mirrors& found) {
    const auto zero = L::all(0.0F);
    const auto a = L::load_whole(faces.face);
    const auto b = a + (OnU ? stride : 1);
    const auto nearer = L::numbers_at(walls.distance, a) < L::numbers_at(walls.distance, b);
    const NearestBodies<L> bodies(walls, L::shorts_at(walls.nearest, nearer ? a : b));
    constexpr std::size_t kY = sizeof(float);
    const LaneVectors<L> arm =
        middle - LaneVectors<L>{bodies.number(offsetof(Body<float>, position)),
                                bodies.number(offsetof(Body<float>, position) + kY)};
    const auto spin = bodies.number(offsetof(Body<float>, spin));
    const auto x = bodies.number(offsetof(Body<float>, velocity)) + -spin * arm.y;
    const auto y = bodies.number(offsetof(Body<float>, velocity) + kY) + spin * arm.x;
    L::store(found.wall_x, bodies.any ? x : zero);
    L::store(found.wall_y, bodies.any ? y : zero);
}

template <class L, bool OnU>
inline void find_mirrors(const MirrorTask& task, const MirrorFaces& faces, Mirrors& found) {
    const auto zero = L::all(0.0F);
    const auto one = L::all(1.0F);
    const auto half = L::all(0.5F);
    const GroupDistances<L> at = distances_at<L, OnU>(task, faces.face);
    const auto steepness = L::square_root(at.gradient.dot(at.gradient));
    const LaneVectors<L> along = at.gradient.times(one / steepness);
    const auto steep = steepness > zero;
    const LaneVectors<L> normal{steep ? along.x : (OnU ? one : zero),
                                steep ? along.y : (OnU ? zero : one)};
    const auto depth = -L::minimum(at.distance, zero);
    const auto reach = L::maximum(depth, one);
    const auto x = L::floats(L::load_whole(faces.column) + task.s.i0);
    const auto y = L::floats(L::load_whole(faces.row) + task.s.j0);
    const LaneVectors<L> middle{OnU ? x : x + half, OnU ? y + half : y};
    if (task.moving != nullptr) {
        find_walls<L, OnU>(*task.moving, faces, task.s.stride, middle, found);
    }
    const LaneVectors<L> way = normal.times(depth + reach);
    const LaneVectors<L> point{
        L::clamp(middle.x + way.x, L::all(task.low.x), L::all(task.high.x)),
        L::clamp(middle.y + way.y, L::all(task.low.y), L::all(task.high.y))};
    const auto slack = look_at_points<L>(task, faces.face, point, found);
    const LaneVectors<L> fall{L::all(task.fall.x), L::all(task.fall.y)};
    const auto free = slack & (normal.dot(fall) > zero);
    L::store(found.most, free ? zero : L::all(__builtin_inff()));
    L::store(found.normal_x, normal.x);
    L::store(found.normal_y, normal.y);
    L::store(found.point_x, point.x);
    L::store(found.point_y, point.y);
    L::store(found.ratio, depth / reach);
}

/// What faces take from the liquid.
struct MirrorChanges {
    float now[kMostMirrors];
    float was[kMostMirrors];
};
template <class L, bool OnU>
inline void mirror_faces(const MirrorTask& task, const std::int32_t* face, const Mirrors& m,
                         MirrorChanges& changes) {
    using Floats = typename L::Floats;
    const std::int32_t t = task.s.stride;
    const LaneVectors<L> normal{L::load(m.normal_x), L::load(m.normal_y)};
    const LaneVectors<L> wall{L::load(m.wall_x), L::load(m.wall_y)};
    GroupStencil<L> at_u{L::load(m.fx_u), L::load(m.fy_u)};
    GroupStencil<L> at_v{L::load(m.fx_v), L::load(m.fy_v)};
    const auto was_u = L::squares_at(task.was_u, task.was_u + t, m.at_u);
    const auto was_v = L::squares_at(task.was_v, task.was_v + t, m.at_v);
    if (!task.all_count) {
        at_u.find_films(was_u);
        at_v.find_films(was_v);
    }
    // As `mirrored`.
    const LaneVectors<L> liquid{
        interpolate_group<L>(L::squares_at(task.now_u, task.now_u + t, m.at_u), at_u),
        interpolate_group<L>(L::squares_at(task.now_v, task.now_v + t, m.at_v), at_v)};
    const Floats towards = L::minimum((liquid - wall).dot(normal), L::load(m.most));
    const Floats across = towards * (L::all(1.0F) + L::load(m.ratio));
    L::store(changes.now, OnU ? liquid.x - across * normal.x : liquid.y - across * normal.y);
    // As `before`.
    const LaneVectors<L> there = LaneVectors<L>{interpolate_group<L>(was_u, at_u),
                                                interpolate_group<L>(was_v, at_v)} -
                                 wall;
    const Floats own = L::numbers_at(OnU ? task.was_u : task.was_v, L::load_whole(face));
    const float* others = OnU ? task.was_v - 1 : task.was_u - t;
    const Floats other = mean_of_faces<L>(L::squares_at(others, others + t, face), task.all_count);
    const LaneVectors<L> here = LaneVectors<L>{OnU ? own : other, OnU ? other : own} - wall;
    const Floats liquid_along = normal.x * there.y - normal.y * there.x;
    const Floats along = normal.x * here.y - normal.y * here.x;
    const Floats most = L::all(task.goes_along) * L::absolute(liquid_along);
    const Floats taken = L::clamp(along, -most, most) - liquid_along;
    const Floats there_towards = there.dot(normal);
    const Floats turned =
        L::minimum(there_towards, L::load(m.most)) * (L::all(1.0F) + L::load(m.ratio));
    const Floats beyond = here.dot(normal) - (there_towards - turned);
    const Floats bend = L::all(kAlongBend<float>) * L::absolute(along);
    const Floats free = L::maximum(beyond, -bend);
    L::store(changes.was, OnU ? own - (free * normal.x - taken * normal.y)
                              : own - (taken * normal.x + free * normal.y));
}

/// How many faces are worth their while together.
inline std::int32_t mirrors_at_once() {
    return has_wide_lanes() ? 8 : 4;
}

#endif

}  // namespace weir
