#include "scenes/scenarios.hpp"

namespace scenes {

namespace {

using weir::Box;
using weir::Status;
using weir::Vec2f;
using weir::WorldDef;

constexpr float kCell = 0.02F;
constexpr std::size_t kMostBytes = 96 * 1024;

/// A box given in cells.
Box cells(float x0, float y0, float x1, float y1) {
    return {{x0 * kCell, y0 * kCell}, {x1 * kCell, y1 * kCell}};
}

constexpr WorldDef tank(std::int32_t cells_x, std::int32_t cells_y, std::int32_t particles,
                        std::int32_t bodies, std::int32_t vertices) {
    WorldDef def;
    def.capacity.cells_x = cells_x;
    def.capacity.cells_y = cells_y;
    def.capacity.particles = particles;
    def.capacity.bodies = bodies;
    def.capacity.vertices = vertices;
    def.cell_m = kCell;
    return def;
}

/// Adds the body and remembers its name. Vertices in cells, at most eight. Without a motion it is
/// static.
Status add(Stage& stage, const Vec2f* ring, std::int32_t count, Vec2f at,
           const weir::Motion* motion) {
    Vec2f metres[8];
    if (count > 8 || stage.bodies == kMostBodies) {
        return Status::polygon_too_many_vertices;
    }
    for (std::int32_t k = 0; k < count; ++k) {
        metres[k] = {ring[k].x * kCell, ring[k].y * kCell};
    }
    weir::BodyDef def;
    def.polygon = {metres, count};
    def.motion = motion != nullptr ? *motion : weir::Motion{};
    def.motion.position_m = {at.x * kCell, at.y * kCell};
    weir::BodyId* id = &stage.body[stage.bodies];
    const Status added = motion != nullptr ? stage.world.add_moving_body(def, id)
                                           : stage.world.add_static_body(def, id);
    stage.bodies += added == Status::ok ? 1 : 0;
    return added;
}

Status fill_cup(Stage& stage) { return stage.world.fill(cells(0, 0, 5, 6)); }

Status fill_resting_pool(Stage& stage) { return stage.world.fill(cells(0, 0, 16, 16)); }

Status fill_dam(Stage& stage) { return stage.world.fill(cells(0, 0, 10, 14)); }

Status fill_dam_with_solids(Stage& stage) {
    // Reaches one cell beyond the tank, so that no gap is left at its walls.
    static constexpr Vec2f kRamp[] = {{-2, -1}, {10, -1}, {10, 5}};
    static constexpr Vec2f kBlock[] = {
        {-1.5F, -1.25F}, {1.5F, -1.25F}, {1.5F, 1.25F}, {-1.5F, 1.25F}};
    static constexpr Vec2f kPaddle[] = {{-4, -0.75F}, {4, -0.75F}, {4, 0.75F}, {-4, 0.75F}};
    weir::Motion turning;
    turning.angle_rad = 0.3F;
    turning.spin_radps = 2.0F;
    Status status = add(stage, kRamp, 3, {23, 0}, nullptr);
    if (status == Status::ok) {
        status = add(stage, kBlock, 4, {14.3F, 3.1F}, nullptr);
    }
    if (status == Status::ok) {
        status = add(stage, kPaddle, 4, {21.5F, 10}, &turning);
    }
    return status == Status::ok ? fill_dam(stage) : status;
}

Status fill_splash(Stage& stage) {
    const Status pool = stage.world.fill(cells(0, 0, 24, 5));
    return pool == Status::ok ? stage.world.fill(cells(9, 13, 15, 19)) : pool;
}

Status fill_piston(Stage& stage) {
    static constexpr Vec2f kPiston[] = {{-2, -2}, {2, -2}, {2, 20}, {-2, 20}};
    const weir::Motion motion;
    const Status status = add(stage, kPiston, 4, {2, 0}, &motion);
    return status == Status::ok ? stage.world.fill(cells(4, 0, 28, 7)) : status;
}

/// To and fro: half a second at 4 cells a second each way.
Status move_piston(Stage& stage, std::int32_t step) {
    constexpr std::int32_t kHalfPeriod = 30;
    if (step % kHalfPeriod != 0) {
        return Status::ok;
    }
    weir::Motion motion;
    const Status known = stage.world.motion(stage.body[0], &motion);
    if (known != Status::ok) {
        return known;
    }
    motion.velocity_mps.x = (step / kHalfPeriod) % 2 == 0 ? 4.0F * kCell : -4.0F * kCell;
    return stage.world.set_motion(stage.body[0], motion);
}

constexpr WorldDef elastic(WorldDef def) {
    def.pressure = weir::Pressure::equation_of_state;
    def.sound_speed_mps = 4.0F;
    return def;
}

constexpr float kFrame = 1.0F / 60.0F;
constexpr float kShortFrame = 1.0F / 240.0F;

bool equal(const char* a, const char* b) {
    while (*a != '\0' && *a == *b) {
        ++a;
        ++b;
    }
    return *a == *b;
}

}  // namespace

constexpr Scenario kTable[kScenarioCount] = {
    {"cup", tank(12, 10, 120, 0, 0), 300, kFrame, false, fill_cup, nullptr},
    {"eos_dam_break", elastic(tank(24, 16, 400, 0, 0)), 300, kShortFrame, false,
     [](Stage& stage) { return stage.world.fill(cells(0, 0, 8, 12)); }, nullptr},
    {"resting_pool", tank(16, 24, 1024, 0, 0), 300, kFrame, false, fill_resting_pool, nullptr},
    {"dam_break", tank(32, 20, 560, 0, 0), 300, kFrame, false, fill_dam, nullptr},
    {"splash", tank(24, 24, 624, 0, 0), 300, kFrame, false, fill_splash, nullptr},
    {"moving_piston", tank(28, 18, 672, 1, 4), 300, kFrame, true, fill_piston, move_piston},
    {"dam_break_solids", tank(32, 20, 560, 3, 11), 300, kFrame, true, fill_dam_with_solids,
     nullptr},
};

constexpr bool all_fit() {
    for (const Scenario& scenario : kTable) {
        if (weir::world_bytes<float>(scenario.def.capacity) > kMostBytes) {
            return false;
        }
    }
    return true;
}
static_assert(all_fit(), "a scene must leave room on a 128 KB part");
static_assert(weir::world_bytes<float>(kTable[0].def.capacity) <= 9728, "the cup fits 16 KB parts");

const Scenario kScenarios[kScenarioCount] = {kTable[0], kTable[1], kTable[2], kTable[3],
                                             kTable[4], kTable[5], kTable[6]};

const Scenario* find(const char* name) {
    for (const Scenario& scenario : kScenarios) {
        if (equal(scenario.name, name)) {
            return &scenario;
        }
    }
    return nullptr;
}

Status begin(const Scenario& scenario, void* memory, std::size_t bytes, Stage& stage) {
    stage = Stage{};
    const Status ready = stage.world.init(scenario.def, memory, bytes);
    return ready == Status::ok ? scenario.set_up(stage) : ready;
}

weir::StepReport advance(const Scenario& scenario, Stage& stage, std::int32_t step) {
    if (scenario.before_step != nullptr && scenario.before_step(stage, step) != Status::ok) {
        weir_fault("scenario.before_step", __FILE__, __LINE__);
    }
    return stage.world.step(scenario.dt_s);
}

float energy(const Scenario& scenario, const weir::World<float>& world) {
    const Vec2f gravity = scenario.def.gravity_mps2;
    const float gx = gravity.x / scenario.def.cell_m;
    const float gy = gravity.y / scenario.def.cell_m;
    const float corner_x = gx > 0.0F ? static_cast<float>(world.cells_x()) : 0.0F;
    const float corner_y = gy > 0.0F ? static_cast<float>(world.cells_y()) : 0.0F;
    const weir::View<Vec2f> x = world.particle_positions();
    const weir::View<Vec2f> v = world.particle_velocities();
    float sum = 0.0F;
    for (std::int32_t k = 0; k < x.size; ++k) {
        const float kinetic = 0.5F * (v[k].x * v[k].x + v[k].y * v[k].y);
        sum += kinetic - (gx * (x[k].x - corner_x) + gy * (x[k].y - corner_y));
    }
    return sum;
}

bool all_inside(const weir::World<float>& world) {
    const auto width = static_cast<float>(world.cells_x());
    const auto height = static_cast<float>(world.cells_y());
    constexpr float kAbsurd = 1.0e9F;
    const weir::View<Vec2f> x = world.particle_positions();
    const weir::View<Vec2f> v = world.particle_velocities();
    for (std::int32_t k = 0; k < x.size; ++k) {
        // Each comparison is false for a NaN.
        const bool inside = x[k].x > 0.0F && x[k].x < width && x[k].y > 0.0F && x[k].y < height;
        const bool sane = v[k].x > -kAbsurd && v[k].x < kAbsurd && v[k].y > -kAbsurd &&
                          v[k].y < kAbsurd;
        if (!inside || !sane) {
            return false;
        }
    }
    return true;
}

std::size_t largest_world_bytes(std::size_t limit) {
    std::size_t largest = 0;
    for (const Scenario& scenario : kScenarios) {
        const std::size_t bytes = weir::world_bytes<float>(scenario.def.capacity);
        largest = bytes <= limit && bytes > largest ? bytes : largest;
    }
    return largest;
}

}  // namespace scenes
