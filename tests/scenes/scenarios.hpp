// Small scenes that every kind of test runs: unit tests, firmware images, memory checks. Written
// without libc, so that one source serves host and boards; each fits a 128 KB part.
#pragma once

#include <cstddef>
#include <cstdint>

#include "weir/weir.hpp"

namespace scenes {

inline constexpr std::int32_t kMostBodies = 4;

/// A world while its scene runs: names of the bodies in the order in which they were added.
struct Stage {
    weir::World<float> world;
    weir::BodyId body[kMostBodies];
    std::int32_t bodies = 0;
};

struct Scenario {
    const char* name;
    weir::WorldDef def;
    std::int32_t steps;
    float dt_s;
    bool bodies_move;  ///< bodies do work on the liquid: its energy may grow
    /// Fills a world that `init` accepted.
    weir::Status (*set_up)(Stage& stage);
    /// Called before each step, from 0; null where nothing is to be done.
    weir::Status (*before_step)(Stage& stage, std::int32_t step);
};

inline constexpr std::int32_t kScenarioCount = 7;

/// The scenes, smallest memory first.
extern const Scenario kScenarios[kScenarioCount];

/// Null if there is no such scene.
const Scenario* find(const char* name);

/// Lays the scene in the memory, which `weir::world_bytes<float>(scenario.def.capacity)` suits.
weir::Status begin(const Scenario& scenario, void* memory, std::size_t bytes, Stage& stage);

/// One step of the scene. A refusal by `before_step` is a broken scene and goes to weir_fault.
weir::StepReport advance(const Scenario& scenario, Stage& stage, std::int32_t step);

/// Kinetic and potential energy of the liquid, per mass of a particle, cells²/s². Potential energy
/// counts from the tank's corner that gravity points to. Summed in the particles' order.
float energy(const Scenario& scenario, const weir::World<float>& world);

/// Whether every particle has finite numbers and lies in the tank.
bool all_inside(const weir::World<float>& world);

/// Largest of the scenes' needs that is not above `limit`.
std::size_t largest_world_bytes(std::size_t limit);

}  // namespace scenes
