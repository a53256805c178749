// Hashes of the worlds to which everything happens, a line for each kind and seed: the same for
// every build, loops in lanes or not.
#include <cinttypes>
#include <cstdio>

#include "unit/busy_world.hpp"

int main() {
    constexpr std::uint64_t kSeeds = 6;
    constexpr std::int32_t kSteps = 60;
    for (std::int32_t kind = 0; kind < weir::kBusyKinds; ++kind) {
        for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
            weir::WorldDef def = weir::busy_def(kind);
            // Rows of all lengths, against those of lanes.
            def.capacity.cells_x += static_cast<std::int32_t>(seed) * (def.periodic_x ? 12 : 11);
            def.capacity.cells_y += static_cast<std::int32_t>(seed) * 4;
            def.capacity.particles *= 1 + static_cast<std::int32_t>(seed);
            weir::TestWorld<float> world(def);
            weir::Dice dice(seed);
            const float wide = 0.004F * static_cast<float>(def.capacity.cells_x);
            if (world->fill({{0.0F, 0.0F}, {wide, 0.2F}}) != weir::Status::ok) {
                return 1;
            }
            weir::live(*world, dice, kSteps);
            std::printf("kind %d seed %d hash %016" PRIx64 " particles %d\n", kind,
                        static_cast<int>(seed), world->state_hash(),
                        world->particle_positions().size);
        }
    }
    return testing::Test::HasFailure() ? 1 : 0;
}
