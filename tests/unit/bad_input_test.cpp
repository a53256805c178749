// Every way to be refused, in tables: after a refusal nothing has changed, and the world goes on as
// one that never got the bad call. `init` has its own file.
#include <cstdint>
#include <vector>

#include "bad_input.hpp"

namespace weir {
namespace {

Status add(Fixture& f, const Ring& ring, Vec2f at = {0.16F, 0.16F}) {
    BodyId id;
    return (*f).add_static_body(body_of(ring, at), &id);
}

Status add_holed(Fixture& f, const Ring& hole) {
    const View<Vec2f> holes[] = {{hole.data(), static_cast<std::int32_t>(hole.size())}};
    BodyDef def = body_of(kTriangle, {0.16F, 0.16F});
    def.holes = {holes, 1};
    BodyId id;
    return (*f).add_static_body(def, &id);
}

/// Both ways to add a body must agree on a changed definition.
Status add_changed(Fixture& f, void (*change)(BodyDef&)) {
    BodyDef def = body_of(kTriangle, {0.16F, 0.16F});
    change(def);
    BodyId id;
    const Status fixed = (*f).add_static_body(def, &id);
    const Status moving = (*f).add_moving_body(def, &id);
    EXPECT_EQ(fixed, moving);
    EXPECT_EQ(id.slot, BodyId{}.slot) << "a refused call wrote its output";
    return fixed;
}

Status move_changed(Fixture& f, void (*change)(Motion&)) {
    Motion motion;
    motion.position_m = {0.1F, 0.2F};
    change(motion);
    return (*f).set_motion(f.moving, motion);
}

#define CHANGED_BODY(field, value) \
    [](Fixture& f) { return add_changed(f, [](BodyDef& def) { def.field = value; }); }
#define CHANGED_MOTION(field, value) \
    [](Fixture& f) { return move_changed(f, [](Motion& motion) { motion.field = value; }); }

const std::vector<Row>& polygon_rows() {
    static const std::vector<Row> rows = {
        {"polygon null", [](Fixture& f) { return add_changed(f, [](BodyDef& def) {
             def.polygon = {nullptr, 3}; }); },
         Status::polygon_missing},
        {"polygon empty", CHANGED_BODY(polygon.size, 0), Status::polygon_too_few_vertices},
        {"polygon of negative size", CHANGED_BODY(polygon.size, -1),
         Status::polygon_too_few_vertices},
        {"polygon of two", CHANGED_BODY(polygon.size, 2), Status::polygon_too_few_vertices},
        {"polygon one past the limit",
         [](Fixture& f) { return add(f, regular_polygon(kMaxBodyVertices + 1, 0.05F)); },
         Status::polygon_too_many_vertices},
        {"vertex NaN", [](Fixture& f) { return add(f, {{0, 0}, {kNan, 0}, {0, 0.1F}}); },
         Status::polygon_not_finite},
        {"vertex infinite", [](Fixture& f) { return add(f, {{0, 0}, {0.1F, 0}, {0, kInf}}); },
         Status::polygon_not_finite},
        {"holes null", CHANGED_BODY(holes.size, 1), Status::polygon_missing},
        {"hole of two", [](Fixture& f) { return add_holed(f, {{0.01F, 0.01F}, {0.02F, 0.02F}}); },
         Status::polygon_too_few_vertices},
        {"hole NaN",
         [](Fixture& f) { return add_holed(f, {{0.01F, 0.01F}, {0.02F, 0.01F}, {kNan, 0.02F}}); },
         Status::polygon_not_finite},
        {"hole across the outline",
         [](Fixture& f) { return add_holed(f, {{0.01F, 0.01F}, {0.09F, 0.01F}, {0.01F, 0.02F}}); },
         Status::polygon_hole_crosses},
        {"hole beside the outline",
         [](Fixture& f) { return add_holed(f, {{0.1F, 0.01F}, {0.12F, 0.01F}, {0.1F, 0.02F}}); },
         Status::polygon_hole_outside},
        {"no area", [](Fixture& f) { return add(f, {{0, 0}, {0.05F, 0}, {0.1F, 0}}); },
         Status::polygon_zero_area},
        {"bow tie",
         [](Fixture& f) { return add(f, {{0, 0}, {0.1F, 0.1F}, {0.1F, 0}, {0, 0.1F}}); },
         Status::polygon_crosses_itself},
        {"touches itself",
         [](Fixture& f) {
             return add(f, {{0, 0}, {0.1F, 0}, {0.05F, 0.0F}, {0.1F, 0.1F}, {0, 0.1F}});
         },
         Status::polygon_crosses_itself},
        {"right of the tank", [](Fixture& f) { return add(f, kTriangle, {0.5F, 0.1F}); },
         Status::polygon_outside_domain},
        {"below the tank", [](Fixture& f) { return add(f, kTriangle, {0.1F, -0.2F}); },
         Status::polygon_outside_domain},
        {"vertex too far out",
         [](Fixture& f) { return add(f, {{0, 0}, {3000.0F, 0}, {0, 3000.0F}}); },
         Status::position_out_of_range},
        {"polyline of no wall edges", CHANGED_BODY(open, true), Status::no_free_wall_edge},
        {"polyline with a hole",
         [](Fixture& f) {
             return add_changed(f, [](BodyDef& def) {
                 static const View<Vec2f> hole{kTriangle.data(), 3};
                 def.open = true;
                 def.holes = {&hole, 1};
             });
         },
         Status::polyline_has_holes},
        {"polyline of one vertex",
         [](Fixture& f) {
             return add_changed(f, [](BodyDef& def) { def.open = true, def.polygon.size = 1; });
         },
         Status::polygon_too_few_vertices},
        {"polyline of no length",
         [](Fixture& f) {
             return add_changed(f, [](BodyDef& def) {
                 static const Vec2f twice[] = {{0.1F, 0.1F}, {0.1F, 0.1F}};
                 def.open = true;
                 def.polygon = {twice, 2};
             });
         },
         Status::polygon_zero_area},
        {"polyline of NaN",
         [](Fixture& f) {
             return add_changed(f, [](BodyDef& def) {
                 static const Vec2f nan[] = {{0.1F, 0.1F}, {0.1F, kNan}};
                 def.open = true;
                 def.polygon = {nan, 2};
             });
         },
         Status::polygon_not_finite},
        {"more vertices than are left",
         [](Fixture& f) { return add(f, regular_polygon(6, 0.05F)); }, Status::no_free_vertex},
        {"more bodies than there is room for",
         [](Fixture& f) {
             BodyId id;
             EXPECT_EQ((*f).add_static_body(body_of(kTriangle, {0.16F, 0.16F}), &id), Status::ok);
             const Status refused = add(f, kTriangle);
             EXPECT_EQ((*f).remove_body(id), Status::ok);
             return refused;
         },
         Status::no_free_body},
    };
    return rows;
}

const std::vector<Row>& body_rows() {
    static const std::vector<Row> rows = {
        {"restitution below", CHANGED_BODY(surface.restitution, -0.01F),
         Status::restitution_out_of_range},
        {"restitution beyond", CHANGED_BODY(surface.restitution, 1.01F),
         Status::restitution_out_of_range},
        {"restitution NaN", CHANGED_BODY(surface.restitution, kNan),
         Status::restitution_out_of_range},
        {"friction below", CHANGED_BODY(surface.friction, -0.01F), Status::friction_out_of_range},
        {"friction beyond", CHANGED_BODY(surface.friction, 1000.1F),
         Status::friction_out_of_range},
        {"friction NaN", CHANGED_BODY(surface.friction, kNan), Status::friction_out_of_range},
        {"body density below", CHANGED_BODY(density_ratio, 0.9e-3F),
         Status::body_density_out_of_range},
        {"body density NaN", CHANGED_BODY(density_ratio, kNan),
         Status::body_density_out_of_range},
        {"free body without room for forces",
         [](Fixture& world) {
             BodyId id;
             return (*world).add_free_body(body_of(kSquare4cm, {0.1F, 0.2F}), &id);
         },
         Status::two_way_missing},
        {"regions without room for them",
         [](Fixture& world) { return (*world).let_regions_sleep(); }, Status::regions_missing},
        {"free body in a small world",
         [](Fixture&) {
             WorldDef def = small_def();
             def.capacity.two_way = true;
             TestWorld<SmallFixed> small{def};
             BodyId id;
             return small->add_free_body(body_of(kSquare4cm, {0.1F, 0.2F}), &id);
         },
         Status::free_body_in_small_world},
        {"conveyor beyond", CHANGED_BODY(surface.conveyor_mps, 2.1e4F),
         Status::conveyor_out_of_range},
        {"conveyor NaN", CHANGED_BODY(surface.conveyor_mps, kNan), Status::conveyor_out_of_range},
        {"body's position x NaN", CHANGED_BODY(motion.position_m.x, kNan),
         Status::motion_not_finite},
        {"body's position y infinite", CHANGED_BODY(motion.position_m.y, kInf),
         Status::motion_not_finite},
        {"body's angle NaN", CHANGED_BODY(motion.angle_rad, kNan), Status::motion_not_finite},
        {"body's angle too large", CHANGED_BODY(motion.angle_rad, 1.1e4F),
         Status::motion_out_of_range},
        {"body's velocity NaN", CHANGED_BODY(motion.velocity_mps.x, kNan),
         Status::motion_not_finite},
        {"body's spin infinite", CHANGED_BODY(motion.spin_radps, -kInf), Status::motion_not_finite},
        {"body too far out", CHANGED_BODY(motion.position_m.x, 2.1e3F),
         Status::position_out_of_range},
        {"static body without output",
         [](Fixture& f) {
             return (*f).add_static_body(body_of(kTriangle, {0.16F, 0.16F}), nullptr);
         },
         Status::output_missing},
        {"moving body without output",
         [](Fixture& f) {
             return (*f).add_moving_body(body_of(kTriangle, {0.16F, 0.16F}), nullptr);
         },
         Status::output_missing},
        {"position x NaN", CHANGED_MOTION(position_m.x, kNan), Status::motion_not_finite},
        {"position y infinite", CHANGED_MOTION(position_m.y, -kInf), Status::motion_not_finite},
        {"velocity x NaN", CHANGED_MOTION(velocity_mps.x, kNan), Status::motion_not_finite},
        {"velocity y infinite", CHANGED_MOTION(velocity_mps.y, kInf), Status::motion_not_finite},
        {"angle NaN", CHANGED_MOTION(angle_rad, kNan), Status::motion_not_finite},
        {"spin NaN", CHANGED_MOTION(spin_radps, kNan), Status::motion_not_finite},
        {"position too far", CHANGED_MOTION(position_m.y, -2.1e3F), Status::position_out_of_range},
        {"velocity too large", CHANGED_MOTION(velocity_mps.y, 2.1e4F), Status::motion_out_of_range},
        {"angle too large", CHANGED_MOTION(angle_rad, -1.1e4F), Status::motion_out_of_range},
        {"spin too large", CHANGED_MOTION(spin_radps, 1.1e4F), Status::motion_out_of_range},
        {"static body moved", [](Fixture& f) { return (*f).set_motion(f.fixed, {}); },
         Status::body_is_static},
        {"stale body moved", [](Fixture& f) { return (*f).set_motion(f.stale, {}); },
         Status::stale_body},
        {"stale body removed", [](Fixture& f) { return (*f).remove_body(f.stale); },
         Status::stale_body},
        {"stale body asked",
         [](Fixture& f) {
             Motion motion;
             return (*f).motion(f.stale, &motion);
         },
         Status::stale_body},
        {"another world's body moved", [](Fixture& f) { return (*f).set_motion(f.foreign, {}); },
         Status::stale_body},
        {"another world's body removed", [](Fixture& f) { return (*f).remove_body(f.foreign); },
         Status::stale_body},
        {"nobody's name removed", [](Fixture& f) { return (*f).remove_body(BodyId{}); },
         Status::stale_body},
        {"slot one past the table",
         [](Fixture& f) {
             BodyId id = f.moving;
             id.slot = 3;
             return (*f).remove_body(id);
         },
         Status::stale_body},
        {"motion without output", [](Fixture& f) { return (*f).motion(f.moving, nullptr); },
         Status::output_missing},
    };
    return rows;
}

Status fill(Fixture& f, Box box) {
    std::int32_t added = -7;
    const Status status = (*f).fill(box, &added);
    if (status == Status::no_free_particle) {
        EXPECT_GT(added, 0) << "it tells how many it would have been";
    } else {
        EXPECT_EQ(added, -7) << "a refused call wrote its output";
    }
    return status;
}

const std::vector<Row>& liquid_rows() {
    static const std::vector<Row> rows = {
        {"particle x NaN", [](Fixture& f) { return (*f).add_particle({kNan, 0.1F}, {0, 0}); },
         Status::particle_not_finite},
        {"particle y infinite", [](Fixture& f) { return (*f).add_particle({0.1F, kInf}, {0, 0}); },
         Status::particle_not_finite},
        {"particle's velocity NaN",
         [](Fixture& f) { return (*f).add_particle({0.1F, 0.1F}, {kNan, 0}); },
         Status::particle_not_finite},
        {"particle's velocity infinite",
         [](Fixture& f) { return (*f).add_particle({0.1F, 0.1F}, {0, -kInf}); },
         Status::particle_not_finite},
        {"particle left of the tank",
         [](Fixture& f) { return (*f).add_particle({-0.001F, 0.1F}, {0, 0}); },
         Status::particle_outside_domain},
        {"particle above the tank",
         [](Fixture& f) { return (*f).add_particle({0.1F, 0.321F}, {0, 0}); },
         Status::particle_outside_domain},
        {"particle in a solid",
         [](Fixture& f) { return (*f).add_particle({0.21F, 0.03F}, {0, 0}); },
         Status::particle_inside_solid},
        {"particle too fast",
         [](Fixture& f) { return (*f).add_particle({0.1F, 0.1F}, {2.1e4F, 0}); },
         Status::velocity_out_of_range},
        {"particle of a second liquid without room for one",
         [](Fixture& f) { return (*f).add_particle({0.1F, 0.1F}, {0, 0}, Liquid::second); },
         Status::no_second_liquid},
        {"particle of no liquid",
         [](Fixture& f) {
             return (*f).add_particle({0.1F, 0.1F}, {0, 0}, static_cast<Liquid>(2));
         },
         Status::unknown_option},
        {"box of a second liquid without room for one",
         [](Fixture& f) {
             return (*f).fill({{0, 0}, {0.1F, 0.1F}}, nullptr, Liquid::second);
         },
         Status::no_second_liquid},
        {"box of no liquid",
         [](Fixture& f) {
             return (*f).fill({{0, 0}, {0.1F, 0.1F}}, nullptr, static_cast<Liquid>(7));
         },
         Status::unknown_option},
        {"one particle too many",
         [](Fixture& f) {
             World<float>& world = *f;
             const std::int32_t before = world.particle_positions().size;
             while (world.particle_positions().size < small_def().capacity.particles) {
                 EXPECT_EQ(world.add_particle({0.05F, 0.25F}, {0, 0}), Status::ok);
             }
             const Status refused = world.add_particle({0.05F, 0.25F}, {0, 0});
             while (world.particle_positions().size > before) {
                 EXPECT_EQ(world.remove_particle(world.particle_positions().size - 1), Status::ok);
             }
             return refused;
         },
         Status::no_free_particle},
        {"particle −1 removed", [](Fixture& f) { return (*f).remove_particle(-1); },
         Status::no_such_particle},
        {"particle one past the end removed",
         [](Fixture& f) { return (*f).remove_particle((*f).particle_positions().size); },
         Status::no_such_particle},
        {"box NaN", [](Fixture& f) { return fill(f, {{kNan, 0}, {0.1F, 0.1F}}); },
         Status::box_not_finite},
        {"box infinite", [](Fixture& f) { return fill(f, {{0, 0}, {0.1F, kInf}}); },
         Status::box_not_finite},
        {"box upside down", [](Fixture& f) { return fill(f, {{0, 0.1F}, {0.1F, 0}}); },
         Status::box_is_empty},
        {"box of no width", [](Fixture& f) { return fill(f, {{0.1F, 0}, {0.1F, 0.1F}}); },
         Status::box_is_empty},
        {"box left of the tank", [](Fixture& f) { return fill(f, {{-0.01F, 0}, {0.1F, 0.1F}}); },
         Status::box_outside_domain},
        {"box above the tank", [](Fixture& f) { return fill(f, {{0, 0}, {0.1F, 0.33F}}); },
         Status::box_outside_domain},
        {"tags of a world without",
         [](Fixture& f) { return (*f).tag({{0, 0}, {0.1F, 0.1F}}, 1); },
         Status::no_particle_tags},
        {"stirred by more than all",
         [](Fixture& f) { return (*f).stir({{0, 0}, {0.1F, 0.1F}}, {0.1F, 0}, 1.01F); },
         Status::share_out_of_range},
        {"stirred by less than nothing",
         [](Fixture& f) { return (*f).stir({{0, 0}, {0.1F, 0.1F}}, {0.1F, 0}, -0.01F); },
         Status::share_out_of_range},
        {"more liquid than has room", [](Fixture& f) { return fill(f, {{0, 0}, {0.32F, 0.32F}}); },
         Status::no_free_particle},
        {"gravity NaN", [](Fixture& f) { return (*f).set_gravity({kNan, 0}); },
         Status::gravity_not_finite},
        {"viscosity where none was defined",
         [](Fixture& f) { return (*f).set_viscosity(1e-3F); }, Status::viscosity_missing},
        {"viscosity beyond", [](Fixture& f) { return (*f).set_viscosity(401.0F); },
         Status::viscosity_out_of_range},
        {"viscosity NaN", [](Fixture& f) { return (*f).set_viscosity(kNan); },
         Status::viscosity_out_of_range},
        {"tension where none was defined",
         [](Fixture& f) { return (*f).set_surface_tension(1e-5F); },
         Status::surface_tension_missing},
        {"tension NaN", [](Fixture& f) { return (*f).set_surface_tension(kNan); },
         Status::surface_tension_out_of_range},
        {"wall's restitution beyond",
         [](Fixture& f) { return (*f).set_walls(every_wall({1.01F, 0, false, 0})); },
         Status::restitution_out_of_range},
        {"gravity infinite", [](Fixture& f) { return (*f).set_gravity({0, kInf}); },
         Status::gravity_not_finite},
    };
    return rows;
}

TEST(BadInput, Polygons) { check_all(polygon_rows()); }

TEST(BadInput, Bodies) { check_all(body_rows()); }

TEST(BadInput, Liquid) { check_all(liquid_rows()); }

// What can be answered at all has a row: a new status without a row fails here.
TEST(BadInput, EveryStatusHasARow) {
    std::vector<bool> seen(static_cast<std::size_t>(Status::count), false);
    seen[static_cast<std::size_t>(Status::ok)] = true;
    seen[static_cast<std::size_t>(Status::step_in_progress)] = true;  // slices_test.cpp
    std::size_t rows = 0;
    for (const auto* table : {&init_rows(), &polygon_rows(), &body_rows(), &liquid_rows(),
                              &uninitialised_rows(), &snapshot_rows(), &fixed_rows()}) {
        for (const Row& row : *table) {
            seen[static_cast<std::size_t>(row.expected)] = true;
            ++rows;
        }
    }
    EXPECT_GE(rows, 45U);
    for (std::size_t status = 0; status < seen.size(); ++status) {
        EXPECT_TRUE(seen[status]) << status_text(static_cast<Status>(status));
    }
}

TEST(BadInput, FillToTheLastParticle) {
    WorldDef def = small_def();
    def.capacity.particles = 5 * 5 * 4;
    TestWorld<float> world(def);
    std::int32_t added = 0;
    EXPECT_EQ(world->fill({{0, 0}, {0.12F, 0.1F}}, &added), Status::no_free_particle);
    EXPECT_EQ(added, 120) << "how many it would have been";
    EXPECT_EQ(world->particle_positions().size, 0);
    EXPECT_EQ(world->fill({{0, 0}, {0.1F, 0.1F}}, &added), Status::ok);
    EXPECT_EQ(added, 100);
    EXPECT_EQ(world->fill({{0.2F, 0.2F}, {0.22F, 0.22F}}), Status::no_free_particle);
    EXPECT_EQ(world->remove_particle(0), Status::ok);
    EXPECT_EQ(world->add_particle({0.3F, 0.3F}, {0, 0}), Status::ok);
    EXPECT_EQ(world->add_particle({0.3F, 0.3F}, {0, 0}), Status::no_free_particle);
}

}  // namespace
}  // namespace weir
