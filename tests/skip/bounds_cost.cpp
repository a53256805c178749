// On a board: what steps cost in adversarial scenes, against what `World::work_bound` said before
// them. Ticks are instructions there. A table says how many instructions a unit of each stage takes
// at most; units times instructions is the bound, which no stage may exceed, and which the worst
// scene comes within a factor of two of. Then the longest slice, likewise.
#include "port/port.hpp"
#include "port/print.hpp"
#include "weir/weir.hpp"

namespace {

constexpr std::int32_t kCellsX = 24;
constexpr std::int32_t kCellsY = 16;
constexpr float kCell = 0.02F;
constexpr float kDt = 1.0F / 60.0F;
constexpr std::int32_t kSteps = 12;
constexpr std::int32_t kBudget = 256;

constexpr weir::Capacity kCapacity = [] {
    weir::Capacity c;
    c.particles = 4 * kCellsX * kCellsY;
    c.cells_x = kCellsX;
    c.cells_y = kCellsY;
    c.bodies = 8;
    c.vertices = 32;
    return c;
}();
alignas(weir::world_alignment) std::byte g_memory[weir::world_bytes<float>(kCapacity)];
weir::World<float> g_world;

/// Instructions a unit on a Cortex-M4F, contour … collide, a tenth more than the worst that the
/// scenes below show. A unit of grid-to-particle includes what collisions cost a particle: with
/// solids that is its way out of the middle of the largest body, here 6 cells deep.
struct Table {
    std::int64_t unit[weir::kStageCount];

    constexpr std::int64_t largest() const {
        std::int64_t most = 0;
        for (const std::int64_t entry : unit) {
            most = entry > most ? entry : most;
        }
        return most;
    }
};
constexpr Table kWithoutSolids = {{0, 44, 26, 32, 34, 114, 0}};
constexpr Table kWithSolids = {{783, 45, 33, 53, 52, 1400, 0}};

bool g_within = true;

void require(weir::Status status) {
    if (status != weir::Status::ok) {
        port::print("error ", weir::status_text(status), "\n");
        port::exit(1);
    }
}

/// Park & Miller 1988.
float dice() {
    static std::uint32_t state = 7;
    state = static_cast<std::uint32_t>(std::uint64_t{state} * 48271U % 2147483647U);
    return static_cast<float>(state) * (1.0F / 2147483647.0F);
}

void fill() { require(g_world.fill({{0.0F, 0.0F}, {kCellsX * kCell, kCellsY * kCell}})); }

void pile() {
    for (std::int32_t k = 0; k < kCapacity.particles; ++k) {
        require(g_world.add_particle({0.461F + 0.018F * dice(), 0.301F + 0.018F * dice()}, {}));
    }
}

void rim() {
    for (std::int32_t k = 0; k < kCapacity.particles; ++k) {
        const float along = dice();
        const float off = 0.005F * dice();
        const bool flat = k % 2 == 0;
        const bool far = k % 4 < 2;
        const float x = far ? kCellsX * kCell - off : off;
        const float y = far ? kCellsY * kCell - off : off;
        require(g_world.add_particle(flat ? weir::Vec2f{kCellsX * kCell * along, y}
                                          : weir::Vec2f{x, kCellsY * kCell * along},
                                     {}));
    }
}

/// Eight bars in the water; they turn, or stand still.
void add_bars(float spin_radps) {
    constexpr weir::Vec2f kBar[] = {
        {-0.05F, -0.01F}, {0.05F, -0.01F}, {0.05F, 0.01F}, {-0.05F, 0.01F}};
    for (std::int32_t k = 0; k < 8; ++k) {
        weir::BodyDef bar;
        weir::BodyId id;
        bar.polygon = {kBar, 4};
        bar.motion.position_m = {0.06F + 0.12F * static_cast<float>(k % 4),
                                 0.08F + 0.16F * static_cast<float>(k / 4)};
        bar.motion.spin_radps = spin_radps;
        require(g_world.add_moving_body(bar, &id));
    }
    fill();
}
void crowd() { add_bars(4.0F); }
/// So fast that most particles are hit, and swept along their paths.
void whisk() { add_bars(40.0F); }

/// A body is dropped on all the liquid: every particle inside looks for the nearest way out.
void bury() {
    fill();
    constexpr weir::Vec2f kLid[] = {
        {0.04F, 0.04F}, {0.44F, 0.04F}, {0.44F, 0.28F}, {0.04F, 0.28F}};
    weir::BodyDef lid;
    weir::BodyId id;
    lid.polygon = {kLid, 4};
    require(g_world.add_moving_body(lid, &id));
}

struct Scene {
    const char* name;
    void (*set_up)();
    const Table& table;
};
constexpr Scene kScenes[] = {
    {"full", fill, kWithoutSolids},
    {"pile", pile, kWithoutSolids},
    {"rim", rim, kWithoutSolids},
    {"moving", crowd, kWithSolids},
    {"fast", whisk, kWithSolids},
    {"buried", bury, kWithSolids},
};

struct Worst {
    std::uint64_t step = 0;   ///< instructions of the worst step
    std::uint64_t bound = 0;  ///< of that step
    std::uint64_t slice = 0;
    std::uint64_t unit[weir::kStageCount] = {};  ///< hundredths of instructions a unit, at most
};

void start(const Scene& scene) {
    weir::WorldDef def;
    def.capacity = kCapacity;
    def.ticks = port::ticks;
    require(g_world.init(def, g_memory));
    scene.set_up();
    g_world.step(kDt);
}

std::uint64_t instructions_of(const weir::WorkBound& bound, const Table& table) {
    std::uint64_t all = 0;
    for (std::int32_t k = 0; k < weir::kStageCount; ++k) {
        all += static_cast<std::uint64_t>(bound.substep[k] * bound.substeps * table.unit[k]);
    }
    return all;
}

void measure_steps(const Scene& scene, Worst& worst) {
    start(scene);
    for (std::int32_t step = 0; step < kSteps; ++step) {
        weir::WorkBound bound;
        require(g_world.work_bound(kDt, &bound));
        const std::uint64_t begin = port::ticks();
        weir::StepReport report = g_world.step(kDt);
        const std::uint64_t ticks = port::ticks() - begin;
        report.ticks[static_cast<int>(weir::Stage::grid_to_particle)] +=
            report.ticks[static_cast<int>(weir::Stage::collide)];
        report.ticks[static_cast<int>(weir::Stage::collide)] = 0;
        for (std::int32_t k = 0; k < weir::kStageCount; ++k) {
            const std::uint64_t most =
                static_cast<std::uint64_t>(bound.substep[k] * bound.substeps * scene.table.unit[k]);
            g_within = g_within && report.ticks[k] <= most;
            const std::uint64_t unit =
                report.work[k] > 0 ? 100 * report.ticks[k] / report.work[k] : 0;
            worst.unit[k] = unit > worst.unit[k] ? unit : worst.unit[k];
        }
        const std::uint64_t most = instructions_of(bound, scene.table);
        g_within = g_within && ticks <= most;
        // Scenes differ in substeps: what counts is how near the bound a step comes.
        if (ticks * worst.bound >= worst.step * most) {
            worst.step = ticks;
            worst.bound = most;
        }
    }
}

std::uint64_t longest_slice(const Scene& scene, std::int32_t& largest_item) {
    start(scene);
    std::uint64_t longest = 0;
    for (std::int32_t step = 0; step < kSteps; ++step) {
        weir::WorkBound bound;
        require(g_world.work_bound(kDt, &bound));
        largest_item = bound.largest_item;
        weir::StepReport report;
        require(g_world.begin_step(kDt, &report));
        for (bool done = false; !done;) {
            const std::uint64_t begin = port::ticks();
            done = g_world.advance(kBudget);
            const std::uint64_t ticks = port::ticks() - begin;
            longest = ticks > longest ? ticks : longest;
        }
    }
    return longest;
}

}  // namespace

int main() {
    port::init();
    std::uint64_t nearest = 0;  // per cent of its bound that the worst scene's worst step takes
    for (const Scene& scene : kScenes) {
        Worst worst;
        measure_steps(scene, worst);
        std::int32_t item = 0;
        const std::uint64_t slice = longest_slice(scene, item);
        const auto slice_bound =
            static_cast<std::uint64_t>((kBudget + item) * scene.table.largest());
        g_within = g_within && slice <= slice_bound;
        const std::uint64_t share = worst.bound > 0 ? 100 * worst.step / worst.bound : 0;
        nearest = share > nearest ? share : nearest;
        port::print("scene ", scene.name, " step ", worst.step, " bound ", worst.bound, " percent ",
                    share, "\n");
        port::print("scene ", scene.name, " slice ", slice, " bound ", slice_bound, " item ", item,
                    "\n");
        port::print("scene ", scene.name, " hundredths a unit");
        for (const std::uint64_t unit : worst.unit) {
            port::print(" ", unit);
        }
        port::print("\n");
    }
    if (g_within && nearest >= 50) {
        port::print("BOUND OK\n");
    }
    port::exit(0);
}
