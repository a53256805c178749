// Small scenes that every kind of test runs: unit tests, firmware images, memory checks. Written
// without libc, so that one source serves host and boards; each fits a 128 KB part.
#pragma once

#include <cstddef>
#include <cstdint>

#include "weir/weir.hpp"

namespace scenes {

inline constexpr std::int32_t kMostBodies = 4;

/// A world while its scene runs: names of the bodies in the order in which they were added.
template <class Real>
struct StageIn {
    weir::World<Real> world;
    weir::BodyId body[kMostBodies];
    std::int32_t bodies = 0;
};

template <class Real>
struct ScenarioIn {
    const char* name;
    weir::WorldDef def;
    std::int32_t steps;
    float dt_s;
    bool bodies_move;  ///< bodies do work on the liquid: its energy may grow
    /// Fills a world that `init` accepted.
    weir::Status (*set_up)(StageIn<Real>& stage);
    /// Called before each step, from 0; null where nothing is to be done.
    weir::Status (*before_step)(StageIn<Real>& stage, std::int32_t step);
};

/// The scenes of float, Fixed and SmallFixed, smallest memory first; behind them one with thin
/// walls, which SmallFixed has not.
template <class Real>
weir::View<ScenarioIn<Real>> scenarios();

using Stage = StageIn<float>;
using Scenario = ScenarioIn<float>;

/// Null if there is no such scene.
const Scenario* find(const char* name);

/// Lays the scene in the memory, which `weir::world_bytes<Real>(scenario.def.capacity)` suits.
template <class Real>
weir::Status begin(const ScenarioIn<Real>& scenario, void* memory, std::size_t bytes,
                   StageIn<Real>& stage);

/// One step of the scene. A refusal by `before_step` is a broken scene and goes to weir_fault.
template <class Real>
weir::StepReport advance(const ScenarioIn<Real>& scenario, StageIn<Real>& stage,
                         std::int32_t step);

/// Kinetic and potential energy of the liquid, per mass of a particle, cells²/s². Potential energy
/// counts from the tank's corner that gravity points to. Summed in the particles' order.
template <class Real>
float energy(const ScenarioIn<Real>& scenario, const weir::World<Real>& world);

/// Whether every particle has finite numbers and lies in the tank.
template <class Real>
bool all_inside(const weir::World<Real>& world);

/// Largest of the scenes' needs that is not above `limit`.
std::size_t largest_world_bytes(std::size_t limit);

}  // namespace scenes
