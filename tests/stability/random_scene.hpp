// A scene made from a seed: tank, liquid, solids, motion, settings. The same seed, the same scene.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "measure/random.hpp"
#include "tank.hpp"

namespace stability {

using measure::Random;

struct Polygon {
    Ring ring;
    weir::Vec2f at;
    weir::Vec2f velocity;
    float spin = 0.0F;
    float restitution = 0.0F;
    bool moving = false;
    bool teleports = false;
};

struct RandomScene {
    std::uint64_t seed = 0;
    bool tame = false;  ///< settings within what is known to be stable: see S10 and the map
    Scheme scheme;
    bool is_double = false;
    weir::WorldDef def;
    std::vector<weir::Box> liquid;  ///< cells
    bool liquid_overlaps = false;
    std::vector<Polygon> solids;
    bool solids_late = false;  ///< added to a tank that is full: liquid is pushed out of them
    bool gravity_changes = false;
    float dt_s = kFrame;
    float jitter = 0.0F;       ///< each step's length varies by this share
    std::int32_t steps = 100;

    bool any_moving() const;
    /// Whether nothing but gravity does work on the liquid, and nothing is compressed at the start.
    bool energy_only_falls() const;
    /// Whether solids stand still and were there before the liquid.
    bool solids_stand() const { return !any_moving() && !solids_late; }
    /// One line for people.
    std::string text() const;
};

RandomScene random_scene(std::uint64_t seed);

}  // namespace stability
