// On a board: what a step of a settled pool of 2,000 particles costs awake and asleep, and that a
// tilt wakes it at once. Ticks are instructions there, so a bound on them is no matter of time.
#include "port/port.hpp"
#include "port/print.hpp"
#include "weir/weir.hpp"

namespace {

constexpr weir::Capacity kCapacity = [] {
    weir::Capacity c;
    c.particles = 2000;
    c.cells_x = 40;
    c.cells_y = 24;
    return c;
}();
alignas(weir::world_alignment) std::byte g_memory[weir::world_bytes<float>(kCapacity)];
weir::World<float> g_world;

constexpr float kDt = 1.0F / 60.0F;

void require(bool right, const char* what) {
    if (!right) {
        port::print("error ", what, "\n");
        port::exit(1);
    }
}

struct Timed {
    weir::StepReport report;
    std::uint64_t ticks = 0;
};

Timed step() {
    Timed timed;
    const std::uint64_t start = port::ticks();
    timed.report = g_world.step(kDt);
    timed.ticks = port::ticks() - start;
    return timed;
}

}  // namespace

int main() {
    port::init();
    weir::WorldDef def;
    def.capacity = kCapacity;
    def.sleep.speed_mps = 0.01F;
    require(g_world.init(def, g_memory) == weir::Status::ok, "init");
    require(g_world.fill({{0.0F, 0.0F}, {0.8F, 0.25F}}) == weir::Status::ok, "fill");
    std::uint64_t awake = 0;
    std::int32_t steps = 0;
    for (Timed last; !last.report.asleep && steps < 600; ++steps) {
        last = step();
        awake = last.ticks;
    }
    std::uint64_t asleep = 0;
    for (std::int32_t k = 0; k < 60; ++k) {
        const Timed still = step();
        require(still.report.asleep && still.report.substeps == 0, "did not sleep");
        asleep = still.ticks > asleep ? still.ticks : asleep;
    }
    require(g_world.set_gravity({0.5F, -9.8F}) == weir::Status::ok, "tilt");
    const Timed woken = step();
    require(!woken.report.asleep && woken.report.substeps > 0, "did not wake");
    port::print("particles ", g_world.particle_positions().size, "\n");
    port::print("steps ", steps, "\n");
    port::print("ticks awake ", awake, "\n");
    port::print("ticks asleep ", asleep, "\n");
    port::print("ticks woken ", woken.ticks, "\n");
    if (awake > 0 && 50 * asleep <= awake) {  // 2 %
        port::print("SLEEP OK\n");
    }
    port::exit(0);
}
