// Four faces at a time that mirror the liquid: the plain loop's sums, and so its bits.
#pragma once

#include "fluid/particles.hpp"
#include "math/lanes.hpp"
#include "solid/walls.hpp"

namespace weir {

#if WEIR_HAS_LANES

/// Both velocities that are mirrored, where nothing sticks.
struct MirrorTask {
    const GridShape& s;
    const Walls<float>& walls;
    const float* level;
    const float* now_u;
    const float* now_v;
    const float* was_u;
    const float* was_v;
};

/// Four vectors.
struct LaneVectors {
    Lanes x;
    Lanes y;
};
inline LaneVectors operator+(LaneVectors a, LaneVectors b) { return {a.x + b.x, a.y + b.y}; }
inline LaneVectors operator-(LaneVectors a, LaneVectors b) { return {a.x - b.x, a.y - b.y}; }
inline LaneVectors operator*(Lanes s, LaneVectors a) { return {s * a.x, s * a.y}; }
inline Lanes dot(LaneVectors a, LaneVectors b) { return a.x * b.x + a.y * b.y; }
inline Vec2<float> of_lane(LaneVectors a, std::int32_t k) { return {a.x[k], a.y[k]}; }

/// Three numbers in a row at four places, of which the last is there.
struct Threes {
    Lanes left;
    Lanes middle;
    Lanes right;
};
inline Threes threes_before(const float* last, const std::int32_t* at) {
    const auto four = [&](std::int32_t k) { return load_lanes(last - 3 + at[k]); };
    const Lanes a = shuffle<0, 4, 1, 5>(four(0), four(1));
    const Lanes b = shuffle<0, 4, 1, 5>(four(2), four(3));
    const Lanes c = shuffle<2, 6, 3, 7>(four(0), four(1));
    const Lanes d = shuffle<2, 6, 3, 7>(four(2), four(3));
    return {shuffle<2, 3, 6, 7>(a, b), shuffle<0, 1, 4, 5>(c, d), shuffle<2, 3, 6, 7>(c, d)};
}

/// As `interpolate`.
inline Lanes interpolate_four(const float* field, std::int32_t stride, const std::int32_t* base,
                              Lanes fx, Lanes fy) {
    const Squares p = squares_at(field, field + stride, base);
    const Lanes low = p.low_left + fx * (p.low_right - p.low_left);
    const Lanes high = p.high_left + fx * (p.high_right - p.high_left);
    return low + fy * (high - low);
}

/// As `FaceAxis` has them.
struct FourDistances {
    Lanes distance;
    LaneVectors gradient;
};
template <bool OnU>
inline FourDistances distances_at(const MirrorTask& task, const std::int32_t* face) {
    const float* d = task.walls.distance;
    const std::int32_t t = task.s.stride;
    const Lanes quarter = all_lanes(0.25F);
    const Lanes half = all_lanes(0.5F);
    if constexpr (OnU) {
        const Threes low = threes_before(d + 1, face);
        const Threes high = threes_before(d + t + 1, face);
        return {half * (low.middle + high.middle),
                {quarter * ((low.right + high.right) - (low.left + high.left)),
                 high.middle - low.middle}};
    } else {
        const Squares rows = squares_at(d, d + t, face);
        const Squares below = squares_at(d - t, d - t, face);
        return {half * (rows.low_left + rows.low_right),
                {rows.low_right - rows.low_left,
                 quarter * ((rows.high_left + rows.high_right) -
                            (below.low_left + below.low_right))}};
    }
}

/// Where four faces take their velocities from.
struct FourMirrors {
    LaneVectors normal;
    LaneVectors wall;  ///< its velocity
    Lanes ratio;
    std::int32_t at_u[4];  ///< stencils around the mirror points
    std::int32_t at_v[4];
    Lanes fx_u;
    Lanes fy_u;
    Lanes fx_v;
    Lanes fy_v;
    LaneVectors point;
    std::uint32_t wet = 0;  ///< a bit for each of which the point lies in a cell of liquid
};

/// The stencils, and whether the points lie in liquid.
inline void look_at_points(const MirrorTask& task, FourMirrors& mirrors) {
    const GridShape& s = task.s;
    const LaneVectors point = mirrors.point;
    const Lanes half = all_lanes(0.5F);
    const auto whole = [](Lanes a) { return __builtin_convertvector(a, LaneMask); };
    const auto floats = [](LaneMask a) { return __builtin_convertvector(a, Lanes); };
    const Lanes shifted_x = point.x + half;
    const Lanes shifted_y = point.y + half;
    const LaneMask i = whole(point.x);
    const LaneMask j = whole(point.y);
    const LaneMask shifted_i = whole(shifted_x);
    const LaneMask shifted_j = whole(shifted_y);
    mirrors.fx_u = point.x - floats(i);
    mirrors.fy_u = shifted_y - floats(shifted_j);
    mirrors.fx_v = shifted_x - floats(shifted_i);
    mirrors.fy_v = point.y - floats(j);
    for (std::int32_t k = 0; k < 4; ++k) {
        const std::int32_t row = (j[k] + 1) * s.stride;
        mirrors.at_u[k] = shifted_j[k] * s.stride + i[k] + 1;
        mirrors.at_v[k] = row + shifted_i[k];
        const bool inside = i[k] < s.i0 + s.nx && j[k] < s.j0 + s.ny;
        mirrors.wet |= inside && task.level[row + i[k] + 1] > 0.0F ? 1U << k : 0U;
    }
}

template <bool OnU>
inline FourMirrors mirrors_of(const MirrorTask& task, const std::int32_t* face,
                              const std::int32_t* column, std::int32_t j) {
    const GridShape& s = task.s;
    const Lanes zero = all_lanes(0.0F);
    const Lanes one = all_lanes(1.0F);
    const FourDistances at = distances_at<OnU>(task, face);
    const Lanes steepness = square_root(dot(at.gradient, at.gradient));
    const LaneVectors along = (one / steepness) * at.gradient;
    const LaneMask steep = steepness > zero;
    FourMirrors mirrors;
    mirrors.normal = {steep ? along.x : (OnU ? one : zero), steep ? along.y : (OnU ? zero : one)};
    const Lanes depth = -minimum(at.distance, zero);
    const Lanes reach = maximum(depth, one);
    mirrors.ratio = depth / reach;
    const LaneMask columns{column[0], column[1], column[2], column[3]};
    const Lanes x = __builtin_convertvector(columns + s.i0, Lanes);
    const Lanes y = all_lanes(static_cast<float>(s.j0 + j));
    const LaneVectors centre{OnU ? x : x + all_lanes(0.5F), OnU ? y + all_lanes(0.5F) : y};
    const LaneVectors out = centre + (depth + reach) * mirrors.normal;
    const Vec2<float> low = within_tank(s, Vec2<float>{-1.0F, -1.0F});
    const Vec2<float> high = within_tank(s, Vec2<float>{__builtin_inff(), __builtin_inff()});
    mirrors.point = {clamp(out.x, all_lanes(low.x), all_lanes(high.x)),
                     clamp(out.y, all_lanes(low.y), all_lanes(high.y))};
    look_at_points(task, mirrors);
    mirrors.wall = {zero, zero};
    if (task.walls.moving) {
        for (std::int32_t k = 0; k < 4; ++k) {
            const Vec2<float> wall =
                wall_velocity(task.walls, face[k], face[k] + (OnU ? s.stride : 1),
                              of_lane(centre, k));
            mirrors.wall.x[k] = wall.x;
            mirrors.wall.y[k] = wall.y;
        }
    }
    return mirrors;
}

struct FourChanges {
    Lanes now;
    Lanes was;
};

/// What four faces take from the liquid.
template <bool OnU>
inline FourChanges mirror_four(const MirrorTask& task, const std::int32_t* face,
                               const FourMirrors& m) {
    const std::int32_t t = task.s.stride;
    const auto at_mirror = [&](const float* u, const float* v) {
        return LaneVectors{interpolate_four(u, t, m.at_u, m.fx_u, m.fy_u),
                           interpolate_four(v, t, m.at_v, m.fx_v, m.fy_v)};
    };
    // As `mirrored`.
    const LaneVectors liquid = at_mirror(task.now_u, task.now_v);
    const Lanes across = dot(liquid - m.wall, m.normal) * (all_lanes(1.0F) + m.ratio);
    const Lanes now = OnU ? liquid.x - across * m.normal.x : liquid.y - across * m.normal.y;
    // As `before`.
    const LaneVectors there = at_mirror(task.was_u, task.was_v) - m.wall;
    const float* own_field = OnU ? task.was_u : task.was_v;
    const Lanes own{own_field[face[0]], own_field[face[1]], own_field[face[2]],
                    own_field[face[3]]};
    const Lanes half = all_lanes(0.5F);
    const float* other_field = OnU ? task.was_v - 1 : task.was_u - t;
    const Lanes other = interpolate_four(other_field, t, face, half, half);
    const LaneVectors here = LaneVectors{OnU ? own : other, OnU ? other : own} - m.wall;
    const Lanes towards = dot(here, m.normal);
    const LaneVectors along = here - towards * m.normal;
    const LaneVectors liquid_along = there - dot(there, m.normal) * m.normal;
    const LaneMask brakes = dot(liquid_along, liquid_along) < dot(along, along);
    const Lanes was =
        OnU ? (m.wall.x + (brakes ? along.x : liquid_along.x)) + towards * m.normal.x
            : (m.wall.y + (brakes ? along.y : liquid_along.y)) + towards * m.normal.y;
    return {now, was};
}

#endif

}  // namespace weir
