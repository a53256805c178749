// A dam break without solids, viscosity, surface tension or a second liquid; prints its state.
#include <cstdio>
#include <cstdlib>

#include "weir/weir.hpp"

extern "C" [[noreturn]] void weir_fault(const char*, const char*, int) { std::abort(); }

namespace {

constexpr weir::Capacity kCapacity = [] {
    weir::Capacity c;
    c.particles = 4 * 24 * 16;
    c.cells_x = 48;
    c.cells_y = 24;
    return c;
}();
alignas(weir::world_alignment) std::byte g_memory[weir::world_bytes<float>(kCapacity)];

}  // namespace

int main() {
    weir::WorldDef def;
    def.capacity = kCapacity;
    weir::World<float> world{};
    if (world.init(def, g_memory) != weir::Status::ok ||
        world.fill({{0.0F, 0.0F}, {0.48F, 0.32F}}) != weir::Status::ok) {
        return 1;
    }
    for (int step = 0; step < 100; ++step) {
        world.step(1.0F / 60.0F);
    }
    std::printf("%016llx\n", static_cast<unsigned long long>(world.state_hash()));
    return 0;
}
