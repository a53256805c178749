// The library under valgrind: no stdio, no allocation of its own, so that whatever valgrind counts
// is the library's. Ends with 0, or with the number of the check that failed.
#include "measure/tank_def.hpp"
#include "scenes/scenarios.hpp"

extern "C" [[noreturn]] void weir_fault(const char*, const char*, int) { __builtin_trap(); }

namespace {

alignas(weir::world_alignment) std::byte g_memory[98304];
scenes::Stage g_stage;

constexpr weir::Vec2f kSquare[] = {{0, 0}, {0.04F, 0}, {0.04F, 0.04F}, {0, 0.04F}};

/// Every branch on the state is one that valgrind checks for uninitialised values.
bool run(const scenes::Scenario& scenario) {
    if (scenes::begin(scenario, g_memory, sizeof g_memory, g_stage) != weir::Status::ok) {
        return false;
    }
    for (std::int32_t step = 0; step < 30; ++step) {
        scenes::advance(scenario, g_stage, step);
    }
    return scenes::all_inside(g_stage.world) && g_stage.world.state_hash() != 0;
}

/// Bodies come and go while the liquid moves.
bool churn() {
    weir::WorldDef def = measure::tank_def(16, 16, 256, 3, 12);
    weir::World<float>& world = g_stage.world;
    if (world.init(def, g_memory) != weir::Status::ok ||
        world.fill({{0, 0}, {0.16F, 0.16F}}) != weir::Status::ok) {
        return false;
    }
    weir::BodyDef body;
    body.polygon = {kSquare, 4};
    weir::BodyId ids[3];
    for (std::int32_t round = 0; round < 12; ++round) {
        const std::int32_t slot = round % 3;
        if (round >= 3 && world.remove_body(ids[slot]) != weir::Status::ok) {
            return false;
        }
        body.motion.position_m = {0.02F * static_cast<float>(round), 0.1F};
        body.motion.spin_radps = 1.0F;
        const weir::Status added = round % 2 == 0 ? world.add_moving_body(body, &ids[slot])
                                                  : world.add_static_body(body, &ids[slot]);
        if (added != weir::Status::ok) {
            return false;
        }
        world.step(1.0F / 60.0F);
    }
    return world.remove_particle(0) == weir::Status::ok && scenes::all_inside(world) &&
           world.state_hash() != 0;
}

}  // namespace

int main() {
    int check = 1;
    for (const scenes::Scenario& scenario : scenes::scenarios<float>()) {
        if (!run(scenario)) {
            return check;
        }
        ++check;
    }
    return churn() ? 0 : check;
}
