// Runs a drawing on whatever this was built for and prints what it took, one fact a line:
// `name value ...`, integers only, so that a host and a chip without printf say it alike.
//
// Arguments, key=value: steps (default: the drawing's), frames (a file to write for draw_frames, at
// most 255 characters), every (steps between frames, default 5). Numbers are whole, 1 … 10,000,000.
#include "drawing.hpp"
#include "port/port.hpp"
#include "port/print.hpp"
#include "scene_world.hpp"

namespace {

constexpr weir::WorldDef kDef = scene::world_def_of(kScene);
constexpr weir::Layout kLayout = weir::layout<float>(kDef.capacity);
constexpr std::int32_t kMovingRoom = kScene.moving_count > 0 ? kScene.moving_count : 1;

alignas(weir::world_alignment) std::byte g_memory[kLayout.total_bytes];
weir::World<float> g_world;
weir::BodyId g_moving[kMovingRoom];
weir::Vec2f g_vertices[kScene.max_vertices > 0 ? kScene.max_vertices : 1];
weir::View<weir::Vec2f> g_holes[kScene.max_holes > 0 ? kScene.max_holes : 1];

/// Ticks of each stage over the run: their sum, and the worst step.
struct StageTicks {
    std::uint64_t sum = 0;
    std::uint64_t worst = 0;

    void add(std::uint64_t ticks) {
        sum += ticks;
        worst = ticks > worst ? ticks : worst;
    }
};

struct Totals {
    StageTicks stage[weir::kStageCount];
    StageTicks step;
    std::int64_t substeps = 0;
    std::uint32_t clamped = 0;
};

void require(weir::Status status) {
    if (status != weir::Status::ok) {
        port::print("error ", weir::status_text(status), "\n");
        port::exit(1);
    }
}

[[noreturn]] void refuse(const char* key) {
    port::print("error ", key, "= is no whole number from 1 to 10000000, or too long\n");
    port::exit(1);
}

std::int32_t number_argument(const char* key, std::int32_t otherwise) {
    char text[9];
    const std::size_t digits = port::argument(key, text, sizeof text);
    if (digits == 0) {
        return otherwise;
    }
    std::int32_t value = 0;
    for (const char* digit = text; *digit != '\0'; ++digit) {
        if (*digit < '0' || *digit > '9') {
            refuse(key);
        }
        value = 10 * value + (*digit - '0');
    }
    if (digits >= sizeof text || value < 1 || value > 10'000'000) {
        refuse(key);
    }
    return value;
}

/// One frame: step, particles, moving bodies; position and velocity of each particle in cells;
/// position (m) and angle of each moving body.
void write_frame(const char* file, std::int32_t step) {
    const auto positions = g_world.particle_positions();
    const auto velocities = g_world.particle_velocities();
    const std::int32_t head[3] = {step, positions.size, kScene.moving_count};
    const auto bytes = static_cast<std::size_t>(positions.size) * sizeof(weir::Vec2f);
    bool written = port::file_write(file, head, sizeof head, step != 0) &&
                   port::file_write(file, positions.data, bytes, true) &&
                   port::file_write(file, velocities.data, bytes, true);
    for (std::int32_t k = 0; k < kScene.moving_count; ++k) {
        weir::Motion motion;
        require(g_world.motion(g_moving[k], &motion));
        const float pose[3] = {motion.position_m.x, motion.position_m.y, motion.angle_rad};
        written = written && port::file_write(file, pose, sizeof pose, true);
    }
    if (!written) {
        port::print("error cannot write frames\n");
        port::exit(1);
    }
}

void take_step(std::int32_t step, Totals& totals) {
    require(scene::steer(g_world, kScene, g_moving, step));
    const std::uint64_t start = port::ticks();
    const weir::StepReport report = g_world.step(kScene.dt_s);
    totals.step.add(port::ticks() - start);
    for (std::int32_t k = 0; k < weir::kStageCount; ++k) {
        totals.stage[k].add(report.ticks[k]);
    }
    totals.substeps += report.substeps;
    totals.clamped |= report.clamped;
}

void print_facts() {
    port::print("scene ", kScene.name, "\n");
    port::print("cells ", kScene.cells_x, " ", kScene.cells_y, "\n");
    port::print("particles ", g_world.particle_positions().size, "\n");
    port::print("bodies ", kScene.solid_count, " ", kScene.moving_count, "\n");
    for (std::int32_t k = 0; k < weir::kOwnerCount; ++k) {
        port::print("memory ", weir::owner_name(static_cast<weir::Owner>(k)), " ",
                    static_cast<std::uint64_t>(kLayout.owner_bytes[k]), "\n");
    }
    port::print("memory total ", static_cast<std::uint64_t>(kLayout.total_bytes), "\n");
}

void print_totals(std::int32_t steps, const Totals& totals) {
    const auto mean = [&](const StageTicks& ticks) {
        return ticks.sum / static_cast<std::uint64_t>(steps > 0 ? steps : 1);
    };
    port::print("steps ", steps, "\nsubsteps ", totals.substeps, "\n");
    port::print("unit ", port::tick_unit(), "\n");
    for (std::int32_t k = 0; k < weir::kStageCount; ++k) {
        port::print("ticks ", weir::stage_name(static_cast<weir::Stage>(k)), " ",
                    mean(totals.stage[k]), " ", totals.stage[k].worst, "\n");
    }
    port::print("ticks step ", mean(totals.step), " ", totals.step.worst, "\n");
    port::print("clamped ", totals.clamped, "\n");
    port::print("stack ", static_cast<std::uint64_t>(port::stack_high_water()), " ",
                static_cast<std::uint64_t>(port::stack_bytes()), "\n");
    port::print("code ", static_cast<std::uint64_t>(port::code_bytes()), "\n");
    port::print("hash ", port::hex(g_world.state_hash()), "\n");
}

}  // namespace

int main() {
    port::init();
    char frames[256];
    const std::size_t name = port::argument("frames", frames, sizeof frames);
    const bool record = name != 0;
    if (name >= sizeof frames) {
        refuse("frames");
    }
    const std::int32_t steps = number_argument("steps", kScene.steps);
    const std::int32_t every = number_argument("every", 5);

    weir::WorldDef def = kDef;
    def.ticks = port::ticks;
    require(g_world.init(def, g_memory));
    require(scene::set_up(g_world, kScene, {g_vertices, g_holes}, g_moving));
    print_facts();

    Totals totals;
    for (std::int32_t step = 0; step < steps; ++step) {
        if (record && step % every == 0) {
            write_frame(frames, step);
        }
        if (step % 60 == 0) {
            port::print("progress ", step, " ", steps, "\n");
        }
        take_step(step, totals);
    }
    print_totals(steps, totals);
    port::exit(0);
}
