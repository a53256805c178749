// Every way for `init` to refuse, every call before it, and the limits, which are good themselves.
#include <cstddef>
#include <cstdint>
#include <vector>

#include "bad_input.hpp"
#include "measure/world_memory.hpp"

namespace weir {
namespace {

/// A fresh `init` in memory of its own, after a change of the definition.
Status init_changed(void (*change)(WorldDef&)) {
    WorldDef def = small_def();
    change(def);
    alignas(world_alignment) static std::byte memory[64 * 1024];
    World<float> world;
    const Status status = world.init(def, memory, sizeof memory);
    EXPECT_EQ(world.state_hash(), 0U) << "a refused init made a world";
    return status;
}

#define CHANGED_INIT(field, value) \
    [](Fixture&) { return init_changed([](WorldDef& def) { def.field = value; }); }

}  // namespace

const std::vector<Row>& init_rows() {
    static const std::vector<Row> rows = {
        {"cells_x below", CHANGED_INIT(capacity.cells_x, kMinCells - 1),
         Status::cells_out_of_range},
        {"cells_x beyond", CHANGED_INIT(capacity.cells_x, kMaxCells + 1),
         Status::cells_out_of_range},
        {"cells_y below", CHANGED_INIT(capacity.cells_y, kMinCells - 1),
         Status::cells_out_of_range},
        {"cells_y beyond", CHANGED_INIT(capacity.cells_y, kMaxCells + 1),
         Status::cells_out_of_range},
        {"cells_x lowest", CHANGED_INIT(capacity.cells_x, INT32_MIN),
         Status::cells_out_of_range},
        {"cells_y highest", CHANGED_INIT(capacity.cells_y, INT32_MAX),
         Status::cells_out_of_range},
        {"largest cells need memory",
         [](Fixture&) {
             return init_changed([](WorldDef& def) {
                 def.capacity.cells_x = kMaxCells;
                 def.capacity.cells_y = kMaxCells;
             });
         },
         Status::memory_too_small},
        {"no particles", CHANGED_INIT(capacity.particles, 0),
         Status::particle_capacity_out_of_range},
        {"particles beyond", CHANGED_INIT(capacity.particles, kMaxParticles + 1),
         Status::particle_capacity_out_of_range},
        {"most particles need memory", CHANGED_INIT(capacity.particles, kMaxParticles),
         Status::memory_too_small},
        {"bodies below", CHANGED_INIT(capacity.bodies, -1), Status::body_capacity_out_of_range},
        {"bodies beyond", CHANGED_INIT(capacity.bodies, kMaxBodies + 1),
         Status::body_capacity_out_of_range},
        {"most bodies need memory", CHANGED_INIT(capacity.bodies, kMaxBodies),
         Status::memory_too_small},
        {"vertices below", CHANGED_INIT(capacity.vertices, -1),
         Status::vertex_capacity_out_of_range},
        {"vertices beyond", CHANGED_INIT(capacity.vertices, kMaxVertices + 1),
         Status::vertex_capacity_out_of_range},
        {"contacts below", CHANGED_INIT(capacity.contacts, -1),
         Status::contact_capacity_out_of_range},
        {"contacts beyond", CHANGED_INIT(capacity.contacts, kMaxBodies + 1),
         Status::contact_capacity_out_of_range},
        {"wall edges below", CHANGED_INIT(capacity.wall_edges, -1),
         Status::wall_edge_capacity_out_of_range},
        {"wall edges beyond", CHANGED_INIT(capacity.wall_edges, kMaxWallEdges + 1),
         Status::wall_edge_capacity_out_of_range},
        {"cell of no size", CHANGED_INIT(cell_m, 0.0F), Status::cell_size_out_of_range},
        {"cell too small", CHANGED_INIT(cell_m, 0.99e-6F), Status::cell_size_out_of_range},
        {"cell too large", CHANGED_INIT(cell_m, 1001.0F), Status::cell_size_out_of_range},
        {"cell NaN", CHANGED_INIT(cell_m, kNan), Status::cell_size_out_of_range},
        {"cell infinite", CHANGED_INIT(cell_m, kInf), Status::cell_size_out_of_range},
        {"gravity x NaN", CHANGED_INIT(gravity_mps2.x, kNan), Status::gravity_not_finite},
        {"gravity y infinite", CHANGED_INIT(gravity_mps2.y, -kInf), Status::gravity_not_finite},
        {"gravity x too strong", CHANGED_INIT(gravity_mps2.x, 1000.1F),
         Status::gravity_out_of_range},
        {"gravity y too strong", CHANGED_INIT(gravity_mps2.y, -1000.1F),
         Status::gravity_out_of_range},
        {"0 particles per cell", CHANGED_INIT(particles_per_cell, 0),
         Status::particles_per_cell_out_of_range},
        {"5 particles per cell", CHANGED_INIT(particles_per_cell, 5),
         Status::particles_per_cell_out_of_range},
        {"25 particles per cell", CHANGED_INIT(particles_per_cell, 25),
         Status::particles_per_cell_out_of_range},
        {"sweeps below", CHANGED_INIT(pressure_sweeps, 0), Status::sweeps_out_of_range},
        {"sweeps beyond", CHANGED_INIT(pressure_sweeps, 1001), Status::sweeps_out_of_range},
        {"substeps below", CHANGED_INIT(max_substeps, 0), Status::substeps_out_of_range},
        {"substeps beyond", CHANGED_INIT(max_substeps, 1001), Status::substeps_out_of_range},
        {"cfl below", CHANGED_INIT(cfl, 0.09F), Status::cfl_out_of_range},
        {"cfl beyond", CHANGED_INIT(cfl, 2.01F), Status::cfl_out_of_range},
        {"cfl NaN", CHANGED_INIT(cfl, kNan), Status::cfl_out_of_range},
        {"flip below", CHANGED_INIT(flip_ratio, -0.01F), Status::flip_ratio_out_of_range},
        {"flip beyond", CHANGED_INIT(flip_ratio, 1.01F), Status::flip_ratio_out_of_range},
        {"flip NaN", CHANGED_INIT(flip_ratio, kNan), Status::flip_ratio_out_of_range},
        {"volume gain below", CHANGED_INIT(volume_gain, -0.01F), Status::volume_gain_out_of_range},
        {"volume gain beyond", CHANGED_INIT(volume_gain, 1.01F), Status::volume_gain_out_of_range},
        {"volume gain NaN", CHANGED_INIT(volume_gain, kNan), Status::volume_gain_out_of_range},
        {"sound below", CHANGED_INIT(sound_speed_mps, -1.0F), Status::sound_speed_out_of_range},
        {"sound beyond", CHANGED_INIT(sound_speed_mps, 2.1e4F), Status::sound_speed_out_of_range},
        {"sound NaN", CHANGED_INIT(sound_speed_mps, kNan), Status::sound_speed_out_of_range},
        {"viscosity below", CHANGED_INIT(viscosity_m2ps, -1.0e-9F), Status::viscosity_out_of_range},
        {"viscosity beyond", CHANGED_INIT(viscosity_m2ps, 401.0F), Status::viscosity_out_of_range},
        {"viscosity NaN", CHANGED_INIT(viscosity_m2ps, kNan), Status::viscosity_out_of_range},
        {"surface tension below", CHANGED_INIT(surface_tension_m3ps2, -1.0e-9F),
         Status::surface_tension_out_of_range},
        {"surface tension beyond", CHANGED_INIT(surface_tension_m3ps2, 8.1e6F),
         Status::surface_tension_out_of_range},
        {"surface tension NaN", CHANGED_INIT(surface_tension_m3ps2, kNan),
         Status::surface_tension_out_of_range},
        {"surface tension without projection",
         CHANGED_INIT(surface_tension_m3ps2 = 7.3e-5F; def.pressure, Pressure::equation_of_state),
         Status::surface_tension_needs_projection},
        {"density ratio below", CHANGED_INIT(second_density_ratio, 0.0099F),
         Status::density_ratio_out_of_range},
        {"density ratio beyond", CHANGED_INIT(second_density_ratio, 100.1F),
         Status::density_ratio_out_of_range},
        {"density ratio NaN", CHANGED_INIT(second_density_ratio, kNan),
         Status::density_ratio_out_of_range},
        {"two liquids without projection",
         CHANGED_INIT(capacity.second_liquid = true; def.pressure, Pressure::equation_of_state),
         Status::second_liquid_needs_projection},
        {"bottom beyond", CHANGED_INIT(walls.bottom.conveyor_mps, 2.1e4F),
         Status::conveyor_out_of_range},
        {"top NaN", CHANGED_INIT(walls.top.conveyor_mps, kNan), Status::conveyor_out_of_range},
        {"left beyond", CHANGED_INIT(walls.left.conveyor_mps, -2.1e4F),
         Status::conveyor_out_of_range},
        {"right infinite", CHANGED_INIT(walls.right.conveyor_mps, kInf),
         Status::conveyor_out_of_range},
        {"sleep below", CHANGED_INIT(sleep.speed_mps, -0.1F), Status::sleep_out_of_range},
        {"sleep beyond", CHANGED_INIT(sleep.speed_mps, 2.1e4F), Status::sleep_out_of_range},
        {"sleep NaN", CHANGED_INIT(sleep.speed_mps, kNan), Status::sleep_out_of_range},
        {"sleep at once", CHANGED_INIT(sleep.after_s, 0.09F), Status::sleep_out_of_range},
        {"sleep late", CHANGED_INIT(sleep.after_s, 1001.0F), Status::sleep_out_of_range},
        {"sleep after NaN", CHANGED_INIT(sleep.after_s, kNan), Status::sleep_out_of_range},
        {"sleep gravity below", CHANGED_INIT(sleep.gravity_mps2, -0.1F),
         Status::sleep_out_of_range},
        {"sleep gravity beyond", CHANGED_INIT(sleep.gravity_mps2, 1001.0F),
         Status::sleep_out_of_range},
        {"sleep gravity NaN", CHANGED_INIT(sleep.gravity_mps2, kNan), Status::sleep_out_of_range},
        {"periodic x with bodies", CHANGED_INIT(periodic_x, true), Status::periodic_with_bodies},
        {"periodic y with bodies", CHANGED_INIT(periodic_y, true), Status::periodic_with_bodies},
        {"periodic odd", CHANGED_INIT(periodic_y = true; def.capacity.bodies = 0;
                                      def.capacity.cells_y, 15),
         Status::periodic_needs_even_cells},
        {"window below", CHANGED_INIT(capacity.window_cells, -1), Status::window_out_of_range},
        {"window beyond", CHANGED_INIT(capacity.window_cells, 8194 * 8194 + 1),
         Status::window_out_of_range},
        {"window with thin walls", CHANGED_INIT(capacity.wall_edges = 1;
                                                def.capacity.window_cells, 200),
         Status::window_without_thin_walls},
        {"window with forces", CHANGED_INIT(capacity.two_way = true;
                                            def.capacity.window_cells, 200),
         Status::window_without_forces},
        {"window too small", CHANGED_INIT(capacity.window_cells = 66 * 18 - 1;
                                          def.capacity.bodies = 0; def.capacity.cells_x, 500),
         Status::window_too_small},
        {"sleeping regions and forces", CHANGED_INIT(capacity.sleeping_regions = true;
                                                     def.capacity.two_way, true),
         Status::regions_out_of_place},
        {"wall restitution below", CHANGED_INIT(walls.left.restitution, -0.01F),
         Status::restitution_out_of_range},
        {"wall restitution beyond", CHANGED_INIT(walls.right.restitution, 1.01F),
         Status::restitution_out_of_range},
        {"wall restitution NaN", CHANGED_INIT(walls.top.restitution, kNan),
         Status::restitution_out_of_range},
        {"wall friction below", CHANGED_INIT(walls.top.friction, -0.01F),
         Status::friction_out_of_range},
        {"wall friction beyond", CHANGED_INIT(walls.bottom.friction, 1000.1F),
         Status::friction_out_of_range},
        {"wall friction NaN", CHANGED_INIT(walls.left.friction, kNan),
         Status::friction_out_of_range},
        {"unknown pressure", CHANGED_INIT(pressure, static_cast<Pressure>(2)),
         Status::unknown_option},
        {"unknown contour", CHANGED_INIT(contour, static_cast<Contour>(2)), Status::unknown_option},
        {"memory null",
         [](Fixture&) { return World<float>().init(small_def(), nullptr, 1 << 20); },
         Status::memory_missing},
        {"memory misaligned",
         [](Fixture&) {
             alignas(world_alignment) static std::byte memory[64 * 1024];
             return World<float>().init(small_def(), memory + 8, sizeof memory - 8);
         },
         Status::memory_misaligned},
        {"memory one byte short",
         [](Fixture&) {
             alignas(world_alignment) static std::byte memory[64 * 1024];
             const std::size_t needed = world_bytes<float>(small_def().capacity);
             return World<float>().init(small_def(), memory, needed - 1);
         },
         Status::memory_too_small},
        {"running world, bad definition",
         [](Fixture& f) {
             WorldDef def = small_def();
             def.cfl = kNan;
             alignas(world_alignment) static std::byte memory[64 * 1024];
             return (*f).init(def, memory, sizeof memory);
         },
         Status::cfl_out_of_range},
        {"running world, no memory",
         [](Fixture& f) { return (*f).init(small_def(), nullptr, 0); }, Status::memory_missing},
    };
    return rows;
}

const std::vector<Row>& uninitialised_rows() {
    static const std::vector<Row> rows = {
        {"add_static_body before init",
         [](Fixture&) {
             BodyId id;
             return World<float>().add_static_body(body_of(kTriangle, {0.1F, 0.1F}), &id);
         },
         Status::not_initialised},
        {"add_moving_body before init",
         [](Fixture&) {
             BodyId id;
             return World<float>().add_moving_body(body_of(kTriangle, {0.1F, 0.1F}), &id);
         },
         Status::not_initialised},
        {"set_motion before init",
         [](Fixture& f) { return World<float>().set_motion(f.moving, {}); },
         Status::not_initialised},
        {"motion before init",
         [](Fixture& f) {
             Motion motion;
             return World<float>().motion(f.moving, &motion);
         },
         Status::not_initialised},
        {"remove_body before init",
         [](Fixture& f) { return World<float>().remove_body(f.moving); }, Status::not_initialised},
        {"fill before init",
         [](Fixture&) { return World<float>().fill({{0, 0}, {0.1F, 0.1F}}); },
         Status::not_initialised},
        {"add_particle before init",
         [](Fixture&) { return World<float>().add_particle({0.1F, 0.1F}, {0, 0}); },
         Status::not_initialised},
        {"remove_particle before init",
         [](Fixture&) { return World<float>().remove_particle(0); }, Status::not_initialised},
        {"set_gravity before init",
         [](Fixture&) { return World<float>().set_gravity({0, 0}); }, Status::not_initialised},
        {"set_viscosity before init",
         [](Fixture&) { return World<float>().set_viscosity(0); }, Status::not_initialised},
        {"set_surface_tension before init",
         [](Fixture&) { return World<float>().set_surface_tension(0); }, Status::not_initialised},
        {"set_walls before init",
         [](Fixture&) { return World<float>().set_walls({}); }, Status::not_initialised},
    };
    return rows;
}

namespace {

TEST(BadInput, Init) { check_all(init_rows()); }

TEST(BadInput, BeforeInit) { check_all(uninitialised_rows()); }

// The limits themselves are good.
TEST(BadInput, LimitsAreInside) {
    const auto init = [](const WorldDef& def) {
        const auto memory = measure::memory_for<float>(def);
        return World<float>().init(def, memory.data(), memory.size());
    };
    const auto accepted = [&](void (*change)(WorldDef&)) {
        WorldDef def = small_def();
        change(def);
        return init(def);
    };
    EXPECT_EQ(accepted([](WorldDef& def) { def.capacity.cells_x = kMinCells; }), Status::ok);
    EXPECT_EQ(accepted([](WorldDef& def) { def.capacity.cells_y = kMinCells; }), Status::ok);
    EXPECT_EQ(accepted([](WorldDef& def) { def.capacity.cells_x = kMaxCells; }), Status::ok);
    EXPECT_EQ(accepted([](WorldDef& def) { def.capacity.cells_y = kMaxCells; }), Status::ok);
    EXPECT_EQ(accepted([](WorldDef& def) { def.capacity.particles = 1; }), Status::ok);
    EXPECT_EQ(accepted([](WorldDef& def) { def.capacity.bodies = kMaxBodies; }), Status::ok);
    EXPECT_EQ(accepted([](WorldDef& def) { def.capacity.vertices = kMaxVertices; }), Status::ok);
    EXPECT_EQ(accepted([](WorldDef& def) { def.cell_m = 1.0e-6F; }), Status::ok);
    EXPECT_EQ(accepted([](WorldDef& def) { def.cell_m = 1.0e3F; }), Status::ok);
    EXPECT_EQ(accepted([](WorldDef& def) { def.gravity_mps2 = {-1000.0F, 1000.0F}; }), Status::ok);
    EXPECT_EQ(accepted([](WorldDef& def) { def.pressure_sweeps = 1; }), Status::ok);
    EXPECT_EQ(accepted([](WorldDef& def) { def.pressure_sweeps = 1000; }), Status::ok);
    EXPECT_EQ(accepted([](WorldDef& def) { def.max_substeps = 1000; }), Status::ok);
    EXPECT_EQ(accepted([](WorldDef& def) { def.cfl = 0.1F; }), Status::ok);
    EXPECT_EQ(accepted([](WorldDef& def) { def.cfl = 2.0F; }), Status::ok);
    EXPECT_EQ(accepted([](WorldDef& def) { def.flip_ratio = 0.0F; }), Status::ok);
    EXPECT_EQ(accepted([](WorldDef& def) { def.flip_ratio = 1.0F; }), Status::ok);
    EXPECT_EQ(accepted([](WorldDef& def) { def.volume_gain = 1.0F; }), Status::ok);
    EXPECT_EQ(accepted([](WorldDef& def) { def.walls.left.restitution = 1.0F; }), Status::ok);
    EXPECT_EQ(accepted([](WorldDef& def) { def.surface_tension_m3ps2 = 7.9e6F; }), Status::ok);
    EXPECT_EQ(accepted([](WorldDef& def) { def.second_density_ratio = 0.01F; }), Status::ok);
    EXPECT_EQ(accepted([](WorldDef& def) { def.second_density_ratio = 100.0F; }), Status::ok);
    for (const std::int32_t per_cell : {1, 4, 9, 16}) {
        WorldDef def = small_def();
        def.particles_per_cell = per_cell;
        EXPECT_EQ(init(def), Status::ok);
    }
}

}  // namespace
}  // namespace weir
