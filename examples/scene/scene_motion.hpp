// Where a moving body of a scene is, and how fast, at a given step.
//
// Needs no library and no clock: additions, multiplications, divisions and integers only, so a
// firmware image and a desktop get the same bits. Turns and loops are counted in 2^-32 parts of one
// revolution, in integers that wrap: a wheel turns as evenly after a month as in the first second.
// The rate of a turn or loop is exact to one part in 10^7 (single precision).
#pragma once

#include <cstdint>

#include "scene.hpp"

namespace scene {

struct Motion {
    Point position_m;  // of the pivot
    float angle_rad;   // -pi .. pi, counter-clockwise, zero at the start
    Point velocity_mps;
    float spin_radps;
};

namespace detail {

inline constexpr float kTwoPi = 6.28318530717958647692f;
inline constexpr float kPhaseUnit = 4294967296.0f;  // one revolution

// Revolutions per step -> phase per step. Whole revolutions vanish, as they should. Rates beyond
// 10^6 revolutions a step count as standing still.
constexpr std::uint32_t phase_of(float revolutions) {
    const bool negative = revolutions < 0.0f;
    const float size = negative ? -revolutions : revolutions;
    if (!(size < 1.0e6f)) {
        return 0;
    }
    const float part = size - static_cast<float>(static_cast<std::int32_t>(size));
    const std::uint32_t phase = static_cast<std::uint32_t>(part * kPhaseUnit);
    return negative ? 0u - phase : phase;
}

// -1/2 .. 1/2 revolution, without relying on how a large unsigned converts to signed.
constexpr float signed_revolutions(std::uint32_t phase) {
    const bool negative = phase >= 0x80000000u;
    const float size = static_cast<float>(negative ? 0u - phase : phase) / kPhaseUnit;
    return negative ? -size : size;
}

// Position and velocity on the closed path at a share (0 .. 1) of the period.
constexpr void follow_path(const Moving& body, float share, Motion* motion) {
    std::int32_t from = 0;
    for (std::int32_t i = 1; i < body.path_count && body.path_fraction[i] <= share; ++i) {
        from = i;
    }
    const bool last = from + 1 == body.path_count;
    const Point a = body.path[from];
    const Point b = body.path[last ? 0 : from + 1];
    const float start = body.path_fraction[from];
    const float length = (last ? 1.0f : body.path_fraction[from + 1]) - start;
    const float along = (share - start) / length;
    motion->position_m = {a.x_m + (b.x_m - a.x_m) * along, a.y_m + (b.y_m - a.y_m) * along};
    const float time_s = length * body.period_s;
    motion->velocity_mps = {(b.x_m - a.x_m) / time_s, (b.y_m - a.y_m) / time_s};
}

}  // namespace detail

// The motion of a body after a number of steps of dt_s seconds each. Cost: one pass over the path.
constexpr Motion motion_at(const Moving& body, std::uint32_t step, float dt_s) {
    Motion motion{body.position_m, 0.0f, body.velocity_mps, body.spin_radps};
    const float turn = body.spin_radps * dt_s / detail::kTwoPi;
    motion.angle_rad = detail::signed_revolutions(detail::phase_of(turn) * step) * detail::kTwoPi;
    if (body.path_count >= 2) {
        const std::uint32_t phase = detail::phase_of(dt_s / body.period_s) * step;
        // The 24 upper bits: more would round up to a share of 1.
        const float share = static_cast<float>(phase >> 8) / 16777216.0f;
        detail::follow_path(body, share, &motion);
    } else {
        const float time_s = static_cast<float>(step) * dt_s;
        motion.position_m.x_m += body.velocity_mps.x_m * time_s;
        motion.position_m.y_m += body.velocity_mps.y_m * time_s;
    }
    return motion;
}

}  // namespace scene
