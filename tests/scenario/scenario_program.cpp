// Every scene that fits, one after another in one block of memory, on host and boards. A line for
// each checkpoint: name, steps, particles, hash of the state, highest energy so far in parts per
// million of the first. The same text on every machine, or it is a bug.
//   steps=N  stop each scene after N steps (default: all)
//   scene=S  only that scene
//   facts=1  also what differs between machines: ticks, stack, code
// Nothing else is printed, so that the output is golden.txt to the byte.
#include "port/port.hpp"
#include "port/print.hpp"
#include "scenes/scenarios.hpp"

#ifndef WEIR_SCENARIO_BYTES
#define WEIR_SCENARIO_BYTES 98304
#endif
#ifndef WEIR_SCENARIO_FLOAT
#define WEIR_SCENARIO_FLOAT 1
#endif
#ifndef WEIR_SCENARIO_FIXED
#define WEIR_SCENARIO_FIXED 1
#endif
#ifndef WEIR_SCENARIO_SMALL
#define WEIR_SCENARIO_SMALL 1
#endif

namespace {

alignas(weir::world_alignment) std::byte g_memory[WEIR_SCENARIO_BYTES];
template <class Real>
scenes::StageIn<Real> g_stage;
bool g_facts = false;

constexpr std::int32_t kCheckpoints[] = {1, 10, 30, 100, 300};

bool is_checkpoint(std::int32_t steps) {
    for (const std::int32_t checkpoint : kCheckpoints) {
        if (steps == checkpoint) {
            return true;
        }
    }
    return false;
}

bool equal(const char* a, const char* b) {
    while (*a != '\0' && *a == *b) {
        ++a;
        ++b;
    }
    return *a == *b;
}

std::int32_t number(const char* text, std::int32_t otherwise) {
    std::int32_t value = 0;
    for (const char* digit = text; *digit >= '0' && *digit <= '9'; ++digit) {
        value = 10 * value + (*digit - '0');
    }
    return text[0] == '\0' ? otherwise : value;
}

/// Behind the names of scenes in fixed point.
template <class Real>
constexpr const char* in = "";
template <>
constexpr const char* in<weir::Fixed> = "_fixed";
template <>
constexpr const char* in<weir::SmallFixed> = "_small_fixed";

template <class Real>
bool run(const scenes::ScenarioIn<Real>& scenario, std::int32_t steps) {
    const weir::Status ready = scenes::begin(scenario, g_memory, sizeof g_memory, g_stage<Real>);
    if (ready != weir::Status::ok) {
        port::print(scenario.name, ": ", weir::status_text(ready), "\n");
        return false;
    }
    const std::int32_t particles = g_stage<Real>.world.particle_positions().size;
    const float first = scenes::energy(scenario, g_stage<Real>.world);
    float highest = first;
    const std::uint64_t start = port::ticks();
    for (std::int32_t step = 0; step < steps; ++step) {
        const weir::StepReport report = scenes::advance(scenario, g_stage<Real>, step);
        const float now = scenes::energy(scenario, g_stage<Real>.world);
        highest = now > highest ? now : highest;
        if (report.particles != particles || !scenes::all_inside(g_stage<Real>.world)) {
            port::print(scenario.name, ": lost a particle in step ", step, "\n");
            return false;
        }
        if (is_checkpoint(step + 1)) {
            const auto parts_per_million = static_cast<std::int32_t>(highest / first * 1.0e6F);
            port::print("scene ", scenario.name, in<Real>, " ", step + 1, " ", particles, " ",
                        port::hex(g_stage<Real>.world.state_hash()), " ", parts_per_million, "\n");
        }
    }
    if (g_facts) {
        port::print("ticks ", scenario.name, in<Real>, " ", port::ticks() - start, " ", port::tick_unit(),
                    "\n");
    }
    return true;
}

template <class Real>
bool run_all(const char* only, std::int32_t most) {
    bool ok = true;
    for (const scenes::ScenarioIn<Real>& scenario : scenes::scenarios<Real>()) {
        const bool wanted = only[0] == '\0' || equal(only, scenario.name);
        if (wanted && weir::world_bytes<Real>(scenario.def.capacity) <= sizeof g_memory) {
            ok = run(scenario, most < scenario.steps ? most : scenario.steps) && ok;
        }
    }
    return ok;
}

}  // namespace

int main() {
    port::init();
    char text[32];
    g_facts = port::argument("facts", text, sizeof text) != 0;
    port::argument("steps", text, sizeof text);
    const std::int32_t most = number(text, 1'000'000);
    port::argument("scene", text, sizeof text);
    bool ok = true;
    if constexpr (WEIR_SCENARIO_FLOAT != 0) {
        ok = run_all<float>(text, most);
    }
    if constexpr (WEIR_SCENARIO_FIXED != 0) {
        ok = run_all<weir::Fixed>(text, most) && ok;
    }
    if constexpr (WEIR_SCENARIO_SMALL != 0) {
        ok = run_all<weir::SmallFixed>(text, most) && ok;
    }
    if (g_facts && port::stack_bytes() != 0) {
        port::print("stack ", port::stack_high_water(), " of ", port::stack_bytes(), ", code ",
                    port::code_bytes(), ", ram ", port::ram_bytes(), " bytes\n");
    }
    return ok ? 0 : 1;
}
