#include "scenes/scenarios.hpp"

#include <iterator>
#include <type_traits>

#include "measure/tank_def.hpp"

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
    WorldDef def = measure::tank_def(cells_x, cells_y, particles, bodies, vertices);
    def.cell_m = kCell;
    return def;
}

enum class Outline { closed, open };

/// Adds the body and remembers its name. Vertices in cells, at most eight. Without a motion it is
/// static.
template <class Real>
Status add(StageIn<Real>& stage, const Vec2f* ring, std::int32_t count, Vec2f at,
           const weir::Motion* motion, Outline outline = Outline::closed) {
    Vec2f metres[8];
    if (count > 8 || stage.bodies == kMostBodies) {
        return Status::polygon_too_many_vertices;
    }
    for (std::int32_t k = 0; k < count; ++k) {
        metres[k] = {ring[k].x * kCell, ring[k].y * kCell};
    }
    weir::BodyDef def;
    def.polygon = {metres, count};
    def.open = outline == Outline::open;
    def.motion = motion != nullptr ? *motion : weir::Motion{};
    def.motion.position_m = {at.x * kCell, at.y * kCell};
    weir::BodyId* id = &stage.body[stage.bodies];
    const Status added = motion != nullptr ? stage.world.add_moving_body(def, id)
                                           : stage.world.add_static_body(def, id);
    stage.bodies += added == Status::ok ? 1 : 0;
    return added;
}

template <class Real>
Status fill_cup(StageIn<Real>& stage) {
    return stage.world.fill(cells(0, 0, 5, 6));
}

template <class Real>
Status fill_resting_pool(StageIn<Real>& stage) {
    return stage.world.fill(cells(0, 0, 16, 16));
}

template <class Real>
Status fill_dam(StageIn<Real>& stage) {
    return stage.world.fill(cells(0, 0, 10, 14));
}

template <class Real>
Status fill_elastic_dam(StageIn<Real>& stage) {
    return stage.world.fill(cells(0, 0, 8, 12));
}

template <class Real>
Status fill_dam_with_solids(StageIn<Real>& stage) {
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

template <class Real>
Status fill_splash(StageIn<Real>& stage) {
    const Status pool = stage.world.fill(cells(0, 0, 24, 5));
    return pool == Status::ok ? stage.world.fill(cells(9, 13, 15, 19)) : pool;
}

/// A cup of lines without thickness tips over and pours into one half of the tank, which a line
/// divides.
template <class Real>
Status fill_tipping_cup(StageIn<Real>& stage) {
    static constexpr Vec2f kDivide[] = {{0, -1}, {0, 2.8F}};
    static constexpr Vec2f kCup[] = {{-2, 2}, {-1.9F, -1.2F}, {1.9F, -1.2F}, {2, 2}};
    weir::Motion tipping;
    tipping.spin_radps = -0.7F;
    Status status = add(stage, kDivide, 2, {7.4F, 0}, nullptr, Outline::open);
    if (status == Status::ok) {
        status = add(stage, kCup, 4, {4.1F, 5.2F}, &tipping, Outline::open);
    }
    return status == Status::ok ? stage.world.fill(cells(2.5F, 4, 6, 7)) : status;
}

template <class Real>
Status fill_piston(StageIn<Real>& stage) {
    static constexpr Vec2f kPiston[] = {{-2, -2}, {2, -2}, {2, 20}, {-2, 20}};
    const weir::Motion motion;
    const Status status = add(stage, kPiston, 4, {2, 0}, &motion);
    return status == Status::ok ? stage.world.fill(cells(4, 0, 28, 7)) : status;
}

/// To and fro: half a second at 4 cells a second each way.
template <class Real>
Status move_piston(StageIn<Real>& stage, std::int32_t step) {
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

/// Of packed worlds the unit of time is 2 s then.
constexpr WorldDef up_to(float cells_per_s, WorldDef def) {
    def.top_speed_mps = cells_per_s * kCell;
    return def;
}

constexpr WorldDef with_edges(std::int32_t wall_edges, WorldDef def) {
    def.capacity.wall_edges = wall_edges;
    return def;
}

constexpr float kFrame = 1.0F / 60.0F;
constexpr float kShortFrame = 1.0F / 240.0F;

template <class Real>
Vec2f in_float(weir::Vec2<Real> v) {
    return {static_cast<float>(v.x), static_cast<float>(v.y)};
}

bool equal(const char* a, const char* b) {
    while (*a != '\0' && *a == *b) {
        ++a;
        ++b;
    }
    return *a == *b;
}

template <class Real>
constexpr ScenarioIn<Real> kTable[] = {
    {"cup", tank(12, 10, 120, 0, 0), 300, kFrame, false, fill_cup<Real>, nullptr},
    {"eos_dam_break", elastic(tank(24, 16, 400, 0, 0)), 300, kShortFrame, false,
     fill_elastic_dam<Real>, nullptr},
    {"resting_pool", tank(16, 24, 1024, 0, 0), 300, kFrame, false, fill_resting_pool<Real>,
     nullptr},
    {"dam_break", tank(32, 20, 560, 0, 0), 300, kFrame, false, fill_dam<Real>, nullptr},
    {"splash", tank(24, 24, 624, 0, 0), 300, kFrame, false, fill_splash<Real>, nullptr},
    {"moving_piston", up_to(120.0F, tank(28, 18, 672, 1, 4)), 300, kFrame, true,
     fill_piston<Real>, move_piston<Real>},
    {"dam_break_solids", tank(32, 20, 560, 3, 11), 300, kFrame, true, fill_dam_with_solids<Real>,
     nullptr},
    {"tipping_cup", with_edges(80, tank(10, 9, 42, 2, 6)), 300, kFrame, true,
     fill_tipping_cup<Real>, nullptr},
};

constexpr bool all_fit() {
    for (const Scenario& scenario : kTable<float>) {
        if (weir::world_bytes<float>(scenario.def.capacity) > kMostBytes) {
            return false;
        }
    }
    return true;
}
static_assert(all_fit(), "a scene must leave room on a 128 KB part");
static_assert(weir::world_bytes<float>(kTable<float>[0].def.capacity) <= 10272,
              "the cup fits 16 KB parts");

}  // namespace

const Scenario* find(const char* name) {
    for (const Scenario& scenario : scenarios<float>()) {
        if (equal(scenario.name, name)) {
            return &scenario;
        }
    }
    return nullptr;
}

template <class Real>
weir::View<ScenarioIn<Real>> scenarios() {
    constexpr bool kThin = !std::is_same_v<Real, weir::SmallFixed>;
    return {kTable<Real>, static_cast<std::int32_t>(std::size(kTable<Real>)) - (kThin ? 0 : 1)};
}

template <class Real>
Status begin(const ScenarioIn<Real>& scenario, void* memory, std::size_t bytes,
             StageIn<Real>& stage) {
    stage = StageIn<Real>{};
    const Status ready = stage.world.init(scenario.def, memory, bytes);
    return ready == Status::ok ? scenario.set_up(stage) : ready;
}

template <class Real>
weir::StepReport advance(const ScenarioIn<Real>& scenario, StageIn<Real>& stage,
                         std::int32_t step) {
    if (scenario.before_step != nullptr && scenario.before_step(stage, step) != Status::ok) {
        weir_fault("scenario.before_step", __FILE__, __LINE__);
    }
    return stage.world.step(scenario.dt_s);
}

template <class Real>
float energy(const ScenarioIn<Real>& scenario, const weir::World<Real>& world) {
    const Vec2f gravity = scenario.def.gravity_mps2;
    const float gx = gravity.x / scenario.def.cell_m;
    const float gy = gravity.y / scenario.def.cell_m;
    const float corner_x = gx > 0.0F ? static_cast<float>(world.cells_x()) : 0.0F;
    const float corner_y = gy > 0.0F ? static_cast<float>(world.cells_y()) : 0.0F;
    const auto positions = world.particle_positions();
    const auto velocities = world.particle_velocities();
    const float per_s = world.velocity_scale() / world.cell_m();
    float sum = 0.0F;
    for (std::int32_t k = 0; k < positions.size; ++k) {
        const Vec2f x = in_float(positions[k]);
        const Vec2f v = in_float(velocities[k]);
        const float kinetic = 0.5F * per_s * per_s * (v.x * v.x + v.y * v.y);
        sum += kinetic - (gx * (x.x - corner_x) + gy * (x.y - corner_y));
    }
    return sum;
}

template <class Real>
bool all_inside(const weir::World<Real>& world) {
    const auto width = static_cast<float>(world.cells_x());
    const auto height = static_cast<float>(world.cells_y());
    constexpr float kAbsurd = 1.0e9F;
    const auto positions = world.particle_positions();
    const auto velocities = world.particle_velocities();
    for (std::int32_t k = 0; k < positions.size; ++k) {
        const Vec2f x = in_float(positions[k]);
        const Vec2f v = in_float(velocities[k]);
        // Each comparison is false for a NaN.
        const bool inside = x.x > 0.0F && x.x < width && x.y > 0.0F && x.y < height;
        const bool sane = v.x > -kAbsurd && v.x < kAbsurd && v.y > -kAbsurd && v.y < kAbsurd;
        if (!inside || !sane) {
            return false;
        }
    }
    return true;
}

#define WEIR_INSTANTIATE(Real)                                                                 \
    template weir::View<ScenarioIn<Real>> scenarios();                                         \
    template Status begin(const ScenarioIn<Real>&, void*, std::size_t, StageIn<Real>&);        \
    template weir::StepReport advance(const ScenarioIn<Real>&, StageIn<Real>&, std::int32_t);  \
    template float energy(const ScenarioIn<Real>&, const weir::World<Real>&);                  \
    template bool all_inside(const weir::World<Real>&);
WEIR_INSTANTIATE(float)
WEIR_INSTANTIATE(weir::Fixed)
WEIR_INSTANTIATE(weir::SmallFixed)
#undef WEIR_INSTANTIATE

std::size_t largest_world_bytes(std::size_t limit) {
    std::size_t largest = 0;
    for (const Scenario& scenario : scenarios<float>()) {
        const std::size_t bytes = weir::world_bytes<float>(scenario.def.capacity);
        largest = bytes <= limit && bytes > largest ? bytes : largest;
    }
    return largest;
}

}  // namespace scenes
