// Steps that are done in time: each takes the lowest rung of the ladder whose bound a frame's ticks
// pay for, by what a unit of work has cost so far. An inlet pours by the time that
// steps simulate: on the last two rungs that is less than a frame.
//   deadline [budget=TICKS]   of the port (host: ns), for each step; 3,000,000 if none is given
#include "port/port.hpp"
#include "port/print.hpp"
#include "weir/weir.hpp"

constexpr weir::WorldDef kWater = [] {
    weir::WorldDef def;
    def.capacity.particles = 1200;
    def.capacity.cells_x = 40, def.capacity.cells_y = 24;
    def.pressure_sweeps = 24;  // of the default 6 there is little to leave off
    def.ticks = port::ticks;
    return def;
}();
alignas(weir::world_alignment) std::byte g_memory[weir::world_bytes<float>(kWater.capacity)];
weir::World<float> g_world;

constexpr float kFrame_s = 1.0F / 60.0F;
constexpr float kInlet_mps = 0.5F;
constexpr float kRow_m = 0.5F * kWater.cell_m;  // as far from each other as at rest
constexpr weir::Vec2f kInlet{0.02F, 0.40F};

void require(weir::Status status) { if (status != weir::Status::ok) port::exit(1); }

std::uint64_t budget_ticks() {
    char text[11];
    if (port::argument("budget", text, sizeof text) == 0) return 3'000'000;
    std::uint64_t ticks = 0;
    for (const char* c = text; *c >= '0' && *c <= '9'; ++c) {
        ticks = 10 * ticks + static_cast<std::uint64_t>(*c - '0');
    }
    return ticks;
}

/// Two particles for each row that has come out since: the first of them is the furthest by now.
void pour(float dt_s, float* poured_m) {
    for (*poured_m += kInlet_mps * dt_s; *poured_m >= kRow_m; *poured_m -= kRow_m) {
        const float x = kInlet.x + *poured_m - kRow_m;
        for (int k = 0; k < 2; ++k) {
            const weir::Vec2f at{x, kInlet.y + static_cast<float>(k) * kRow_m};
            if (g_world.add_particle(at, {kInlet_mps, 0.0F}) != weir::Status::ok) {
                *poured_m = 0.0F;  // the world holds no more
                return;
            }
        }
    }
}

int main() {
    port::init();
    require(g_world.init(kWater, g_memory));
    require(g_world.fill({{0.0F, 0.0F}, {0.2F, 0.3F}}));
    const std::uint64_t budget = budget_ticks();
    std::uint64_t ticks = 0, work = 0;  // of the steps before; older ones count less and less
    float poured_m = 0.0F, second_s = 0.0F;
    std::int32_t highest = 0;
    for (int frame = 1; frame <= 180; ++frame) {
        port::wait_for_tick();
        const bool known = ticks > 0 && work > 0;  // the first step tells; without a counter none
        const std::uint64_t affordable = known ? budget * work / ticks : 0;
        const std::int32_t rung =
            known ? g_world.rung_within(kFrame_s, static_cast<std::int64_t>(affordable)) : 0;
        const weir::StepReport report = g_world.step(kFrame_s, rung);
        ticks -= ticks / 8, work -= work / 8;
        for (std::int32_t stage = 0; stage < weir::kStageCount; ++stage) {
            ticks += report.ticks[stage], work += report.work[stage];
        }
        pour(report.dt_s, &poured_m);
        highest = rung > highest ? rung : highest;
        second_s += report.dt_s;
        if (frame % 60 == 0) {
            port::print("frame ", frame, ": ", report.particles, " particles, highest rung ",
                        highest, ", ", static_cast<std::int32_t>(1000.0F * second_s + 0.5F),
                        " ms simulated\n");
            highest = 0, second_s = 0.0F;
        }
    }
    port::exit(0);
}
