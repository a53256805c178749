#include "cases.hpp"

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "measure/world_memory.hpp"

namespace skip {

namespace {

using namespace weir;

constexpr float kCell = 0.02F;
constexpr float kDt = 1.0F / 120.0F;

void require(Status status) {
    if (status != Status::ok) {
        std::fprintf(stderr, "%s\n", status_text(status));
        std::exit(1);
    }
}

/// A world, and what is done beside its steps.
struct Scene {
    WorldDef def;
    Box water{{0.0F, 0.0F}, {48 * kCell, 16 * kCell}};
    bool falls = false;   ///< by gravity, which its definition is without, until it is measured
    bool weighs = false;  ///< and then, too
    float drop_m = 0.0F;  ///< how far to the right and up a drop starts; 0: there is none
    BodyDef body;
    Vec2f places[3];
    int bodies = 0;
    int lattice = 0;  ///< bodies along each axis, besides
    bool moving = false;
    bool settle = false;  ///< to be at rest before it is measured
    bool look = false;
    bool diagnose = false;
    std::int32_t pools = 0;  ///< side by side, into one of which water falls; 0: another scene
    bool alone = false;      ///< only that pool has water
    int steps = 40;
};

constexpr std::int32_t kPools = 10;
constexpr std::int32_t kPoolCells = 24;
constexpr std::int32_t kPitchCells = 32;  ///< a pool and the wall beside it
constexpr std::int32_t kSplashed = 4;
constexpr std::int32_t kParticlesAPool = 4 * kPoolCells * 12;
constexpr std::int32_t kSplash = 4 * 12 * 12;

constexpr Vec2f kBar[] = {{-3 * kCell, -kCell}, {3 * kCell, -kCell}, {3 * kCell, kCell},
                          {-3 * kCell, kCell}};

constexpr Vec2f kLine[] = {{-3 * kCell, -kCell}, {3 * kCell, kCell}};

Scene tank(std::int32_t cells_x, std::int32_t cells_y) {
    Scene scene;
    scene.def.cell_m = kCell;
    scene.def.capacity.cells_x = cells_x;
    scene.def.capacity.cells_y = cells_y;
    scene.def.capacity.particles = 4 * 48 * 16;
    scene.body.polygon = {kBar, 4};
    return scene;
}

void add_bodies(Scene& scene, float height_m) {
    scene.def.capacity.bodies = 3;
    scene.def.capacity.vertices = 12;
    while (scene.bodies < 3) {
        scene.places[scene.bodies] = {0.2F + 0.3F * static_cast<float>(scene.bodies), height_m};
        ++scene.bodies;
    }
}

/// Bodies all over a tank, on a lattice that leaves out where the liquid is.
void add_level(Scene& scene, bool all_over) {
    constexpr int kLattice = 32;
    constexpr int kMost = kLattice * kLattice;
    scene.def.capacity.bodies = 3 + kMost;
    scene.def.capacity.vertices = 4 * scene.def.capacity.bodies;
    scene.def.capacity.moving_bodies = false;
    scene.lattice = all_over ? kLattice : 0;
}

constexpr Vec2f kWall[] = {{0, 0}, {8 * kCell, 0}, {8 * kCell, 30 * kCell}, {0, 30 * kCell}};

/// Pools with walls between them. Used: all of them go on while water falls into one.
Scene pools(Way way) {
    Scene scene = tank(kPools * kPitchCells, 48);
    scene.pools = kPools;
    scene.alone = way == Way::absent;
    Capacity& capacity = scene.def.capacity;
    capacity.particles = kPools * kParticlesAPool + kSplash;
    capacity.bodies = kPools;
    capacity.vertices = 4 * kPools;
    capacity.sleeping_regions = way == Way::skipped;
    scene.def.sleep.speed_mps = way == Way::skipped ? 0.02F : 0.0F;
    scene.def.sleep.after_s = 0.25F;
    return scene;
}

Scene scene_of(const char* name, Way way) {
    const auto is = [name](const char* other) { return std::strcmp(name, other) == 0; };
    Scene scene = tank(48, 48);
    WorldDef& def = scene.def;
    if (is("solids") && way != Way::absent) {
        add_bodies(scene, way == Way::used ? 0.15F : 0.75F);
    } else if (is("lines") && way != Way::absent) {
        add_bodies(scene, way == Way::used ? 0.15F : 0.75F);
        scene.body.polygon = {kLine, 2};
        scene.body.open = true;
        def.capacity.wall_edges = 200;
    } else if (is("raster") || is("rectangle")) {
        scene = is("rectangle") && way == Way::skipped ? tank(640, 192) : tank(160, 48);
        add_bodies(scene, 0.75F);
        scene.moving = is("rectangle") || way != Way::absent;
        scene.body.motion.spin_radps = is("rectangle") || way == Way::used ? 2.0F : 0.0F;
    } else if (is("columns")) {
        scene = tank(512, 128);
        def.capacity.particles += 16;
        scene.drop_m = (way == Way::absent ? 32 : 120) * kCell;
    } else if (is("viscosity") && way == Way::used) {
        scene.def.viscosity_m2ps = 1.0e-4F;
    } else if (is("weightless")) {
        scene.water = {{0.0F, 0.0F}, {24 * kCell, 32 * kCell}};
        scene.falls = way != Way::absent;
        scene.weighs = way == Way::skipped;
        def.gravity_mps2 = scene.falls ? Vec2f{} : def.gravity_mps2;
    } else if (is("tension") && way == Way::used) {
        scene.def.surface_tension_m3ps2 = 7.3e-5F;
    } else if (is("second_liquid") && way == Way::used) {
        scene.def.capacity.second_liquid = true;
    } else if (is("domain")) {
        scene = way == Way::absent ? tank(160, 64) : tank(4096, 4096);
        scene.def.capacity.window_cells = way == Way::skipped ? 162 * 66 : 0;
        if (way == Way::used) {  // in the upper right corner of a tank that is not that large
            scene = tank(512, 512);
            scene.water = {{464 * kCell, 496 * kCell}, {512 * kCell, 512 * kCell}};
            scene.def.gravity_mps2 = {0.0F, 9.81F};
        }
    } else if (is("level")) {
        scene = way == Way::absent ? tank(160, 64) : tank(4096, 4096);
        scene.def.capacity.window_cells = way == Way::skipped ? 162 * 66 : 0;
        add_bodies(scene, 0.15F);
        add_level(scene, way != Way::absent);
    } else if (is("sleep")) {
        scene.settle = true;
        def.sleep.speed_mps = way == Way::skipped ? 0.01F : 0.0F;
    } else if (is("regions")) {
        scene = pools(way);
    } else if (is("looking")) {
        scene.look = way != Way::absent;
        scene.diagnose = way == Way::used;
    }
    return scene;
}

/// Keeps the compiler from leaving out what is looked at.
double g_seen = 0.0;

void look_at(World<float>& world, bool diagnose) {
    const auto positions = world.particle_positions();
    const auto pressure = world.pressure();
    g_seen += static_cast<double>(positions[positions.size / 2].x + pressure.at(3, 3));
    if (diagnose) {
        Diagnostics diagnostics;
        require(world.diagnose(&diagnostics));
        g_seen += diagnostics.volume_m2;
    }
}

}  // namespace

/// What is counted.
extern "C" __attribute__((noinline)) void weir_skip_measured(World<float>& world, const Scene& scene,
                                                             Run& run) {
    for (int step = 0; step < scene.steps; ++step) {
        const StepReport report = world.step(kDt);
        const std::int32_t substeps = report.substeps > 0 ? report.substeps : 1;
        const std::int32_t count =
            scene.pools > 0 ? kParticlesAPool + kSplash : report.particles;
        run.particle_substeps += static_cast<std::int64_t>(count) * substeps;
        run.asleep = report.particles_asleep;
        run.nodes += report.nodes_rasterized;
        if (scene.look) {
            look_at(world, scene.diagnose);
        }
    }
}

namespace {

Box box_of(std::int32_t x, std::int32_t y, std::int32_t width, std::int32_t height) {
    return {{static_cast<float>(x) * kCell, static_cast<float>(y) * kCell},
            {static_cast<float>(x + width) * kCell, static_cast<float>(y + height) * kCell}};
}

void set_up_pools(World<float>& world, const Scene& scene) {
    for (std::int32_t k = 0; k < scene.pools; ++k) {
        BodyDef wall;
        wall.polygon = {kWall, 4};
        wall.motion.position_m = {static_cast<float>(k * kPitchCells + kPoolCells) * kCell, 0.0F};
        BodyId id;
        require(world.add_static_body(wall, &id));
        if (!scene.alone || k == kSplashed) {
            require(world.fill(box_of(k * kPitchCells, 0, kPoolCells, 12)));
        }
    }
    if (scene.def.capacity.sleeping_regions) {
        require(world.let_regions_sleep());
    }
    for (int step = 0; step < 200; ++step) {
        world.step(kDt);
    }
    require(world.fill(box_of(kSplashed * kPitchCells + 6, 20, 12, 12)));
}

}  // namespace

Run run(const Case& which, Way way) {
    Scene scene = scene_of(which.name, way);
    const auto memory = measure::memory_for<float>(scene.def);
    World<float> world;
    require(world.init(scene.def, memory.data(), memory.size()));
    for (int k = 0; k < scene.bodies; ++k) {
        BodyId id;
        scene.body.motion.position_m = scene.places[k];
        require(scene.moving ? world.add_moving_body(scene.body, &id)
                             : world.add_static_body(scene.body, &id));
    }
    for (int k = 0; k < scene.lattice * scene.lattice; ++k) {
        BodyId id;
        const auto place = [](int n) { return (64.0F + 126.0F * static_cast<float>(n)) * kCell; };
        scene.body.motion.position_m = {place(k % scene.lattice), 2.0F + place(k / scene.lattice)};
        require(world.add_static_body(scene.body, &id));
    }
    if (scene.pools > 0) {
        set_up_pools(world, scene);
    } else {
        require(world.fill(scene.water));
    }
    if (scene.drop_m > 0.0F) {
        const float right = 4.0F * scene.drop_m;
        require(world.fill({{right, scene.drop_m}, {right + 2 * kCell, scene.drop_m + 2 * kCell}}));
    }
    if (scene.falls) {
        require(world.set_gravity(WorldDef().gravity_mps2));
    }
    for (int step = 0; step < (scene.settle ? 150 : 10); ++step) {
        world.step(kDt);
    }
    if (scene.falls && !scene.weighs) {
        require(world.set_gravity({}));
    }
    Run result;
    const auto start = std::chrono::steady_clock::now();
    weir_skip_measured(world, scene, result);
    result.world_bytes = memory.size();
    if (scene.def.capacity.sleeping_regions && result.asleep != (kPools - 1) * kParticlesAPool) {
        std::fprintf(stderr, "%d asleep\n", static_cast<int>(result.asleep));
        std::exit(1);
    }
    result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return result;
}

}  // namespace skip
