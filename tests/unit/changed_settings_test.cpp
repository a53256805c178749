// A living world's viscosity, surface tension and walls, set anew: to the bit as if defined so, kept
// by snapshots, and refused without a trace.
#include <limits>

#include "test_world.hpp"

namespace weir {
namespace {

constexpr float kDt = 1.0F / 60.0F;
constexpr float kHoney = 7.0e-3F;
constexpr float kSoap = 4.0e-5F;

/// Places and velocities.
template <class Real>
std::vector<std::byte> particles_of(const World<Real>& world) {
    const auto x = world.particle_positions();
    const auto v = world.particle_velocities();
    const auto* first = reinterpret_cast<const std::byte*>(x.data);
    std::vector<std::byte> bytes(first, first + x.size * static_cast<std::int32_t>(sizeof x[0]));
    const auto* next = reinterpret_cast<const std::byte*>(v.data);
    bytes.insert(bytes.end(), next, next + v.size * static_cast<std::int32_t>(sizeof v[0]));
    return bytes;
}

/// A column that falls onto a leaning solid, beside a turning one that is rough and sticks, if there
/// is room for them.
template <class Real>
void pour(World<Real>& world, const WorldDef& def) {
    if (def.capacity.bodies > 0) {
        static const Ring bar = rectangle(0.12F, 0.04F);
        BodyDef body = body_of(bar, {0.22F, 0.05F}, 0.4F);
        body.surface.no_slip = true;
        put_static(world, body);
        body = body_of(kSquare4cm, {0.08F, 0.05F});
        body.surface.no_slip = true;
        body.motion.spin_radps = 3.0F;
        put_moving(world, body);
    }
    expect_ok(world.fill({{0.02F, 0.1F}, {0.2F, 0.28F}}));
    if (def.capacity.second_liquid) {
        expect_ok(world.fill({{0.22F, 0.12F}, {0.3F, 0.2F}}, nullptr, Liquid::second));
    }
}

/// Returns the work.
template <class Real>
std::int64_t run(World<Real>& world, int steps) {
    std::int64_t work = 0;
    for (int k = 0; k < steps; ++k) {
        work += work_of(world.step(k % 4 == 0 ? 0.5F * kDt : kDt));
    }
    return work;
}

WorldDef changing_def() {
    WorldDef def = tank_def(16, 16, 700, 3, 12);
    def.viscosity_m2ps = 1.0e-3F;
    def.walls.left = {0.1F, 0.2F, true, 0.0F};
    return def;
}

struct Change {
    const char* name;
    void (*begin)(WorldDef& def);  ///< what both have
    void (*change)(WorldDef& def);
    bool roomy = false;  ///< packed worlds have none of it
};

/// Tells a world what its definition has become.
template <class Real>
void set_all(World<Real>& world, const WorldDef& def) {
    expect_ok(world.set_viscosity(def.viscosity_m2ps));
    expect_ok(world.set_surface_tension(def.surface_tension_m3ps2));
    expect_ok(world.set_walls(def.walls));
}

void nothing(WorldDef&) {}
void full_of_forces(WorldDef& def) { def.capacity.two_way = true; }
void elastic(WorldDef& def) { def.pressure = Pressure::equation_of_state; }
void in_a_ring(WorldDef& def) {
    def.capacity.bodies = 0;
    def.capacity.vertices = 0;
    def.periodic_x = true;
    def.walls = every_wall({0.0F, 0.0F, true, 0.1F});
}
void soapy(WorldDef& def) { def.surface_tension_m3ps2 = kSoap; }
void oil_and_soap(WorldDef& def) {
    soapy(def);
    def.capacity.second_liquid = true;
    def.second_density_ratio = 0.8F;
}
void thin_walls(WorldDef& def) { def.capacity.wall_edges = 200; }
void to_honey(WorldDef& def) { def.viscosity_m2ps = kHoney; }
void to_water(WorldDef& def) { def.viscosity_m2ps = 0.0F; }
void to_more_soap(WorldDef& def) { def.surface_tension_m3ps2 = 3.0F * kSoap; }
void to_no_soap(WorldDef& def) { def.surface_tension_m3ps2 = 0.0F; }
void to_a_belt(WorldDef& def) { def.walls.left.conveyor_mps = 0.4F; }
void to_ice(WorldDef& def) { def.walls = every_wall({0.5F, 0.0F, false, 0.0F}); }
void to_glue(WorldDef& def) { def.walls = every_wall({0.0F, 1.0F, true, 0.0F}); }

constexpr Change kChanges[] = {
    {"honey", nothing, to_honey},
    {"water", nothing, to_water},
    {"belt", nothing, to_a_belt},
    {"ice", nothing, to_ice},
    {"glue", nothing, to_glue},
    {"honey, forces", full_of_forces, to_honey},
    {"water, forces", full_of_forces, to_water},
    {"glue, elastic", elastic, to_glue},
    {"honey, elastic", elastic, to_honey},
    {"honey in a ring", in_a_ring, to_honey},
    {"water in a ring", in_a_ring, to_water},
    {"ice in a ring", in_a_ring, to_ice},
    {"more soap", soapy, to_more_soap, true},
    {"no soap", soapy, to_no_soap, true},
    {"more soap, two liquids", oil_and_soap, to_more_soap, true},
    {"honey, two liquids", oil_and_soap, to_honey, true},
    {"water, thin walls", thin_walls, to_water, true},
};

/// body(definition as it begins, row) for the rows of that arithmetic, under sanitizers for every
/// third one.
template <class Real, class Body>
void for_each_change(const Body& body) {
    constexpr bool kPacked = std::is_same_v<Real, SmallFixed>;
    for (const Change& row : kChanges) {
        if ((row.roomy && kPacked) || (kSanitized && (&row - kChanges) % 3 != 0)) {
            continue;
        }
        SCOPED_TRACE(row.name);
        WorldDef def = changing_def();
        row.begin(def);
        body(def, row);
    }
}

WEIR_SUITE(ChangedSettings, EveryScalar);

TYPED_TEST(ChangedSettings, BeforeTheFirstStepAreAsIfDefinedSo) {
    for_each_change<TypeParam>([](WorldDef def, const Change& row) {
        TestWorld<TypeParam> changed(def);
        TestWorld<TypeParam> unchanged(def);
        row.change(def);
        TestWorld<TypeParam> defined(def);
        set_all(*changed, def);
        for (TestWorld<TypeParam>* world : {&changed, &unchanged, &defined}) {
            pour(**world, def);
        }
        EXPECT_EQ(run(*changed, 40), run(*defined, 40)) << "none is no work";
        run(*unchanged, 40);
        EXPECT_EQ(particles_of(*changed), particles_of(*defined));
        EXPECT_NE(particles_of(*changed), particles_of(*unchanged)) << "or it tells nothing";
    });
}

TYPED_TEST(ChangedSettings, ThereAndBackNothingIsLeft) {
    for_each_change<TypeParam>([](WorldDef def, const Change& row) {
        TestWorld<TypeParam> changed(def);
        TestWorld<TypeParam> unchanged(def);
        for (TestWorld<TypeParam>* world : {&changed, &unchanged}) {
            pour(**world, def);
            run(**world, 10);
        }
        WorldDef other = def;
        row.change(other);
        const std::uint64_t hash = unchanged->state_hash();
        set_all(*changed, other);
        EXPECT_NE(changed->state_hash(), hash);
        set_all(*changed, def);
        // A packed world looks for particles that have met whenever something is changed.
        if (!std::is_same_v<TypeParam, SmallFixed>) {
            EXPECT_EQ(changed->state_hash(), hash);
            run(*changed, 10);
            run(*unchanged, 10);
            EXPECT_EQ(particles_of(*changed), particles_of(*unchanged));
        }
    });
}

/// Into a world as it was defined, and into one where something else was set.
TYPED_TEST(ChangedSettings, GoWithASnapshot) {
    for_each_change<TypeParam>([](WorldDef def, const Change& row) {
        TestWorld<TypeParam> going(def);
        pour(*going, def);
        run(*going, 10);
        WorldDef other = def;
        row.change(other);
        set_all(*going, other);
        const std::vector<std::byte> at_once = saved(*going, def.capacity);
        run(*going, 10);
        const std::vector<std::byte> later = saved(*going, def.capacity);
        TestWorld<TypeParam> fresh(def);
        TestWorld<TypeParam> used(def);
        to_glue(other);
        other.walls.top.conveyor_mps = 0.2F;
        other.viscosity_m2ps = 2.0F * kHoney;
        set_all(*used, other);
        pour(*used, def);
        run(*used, 5);
        run(*going, 10);
        const std::vector<std::byte> end = saved(*going, def.capacity);
        for (TestWorld<TypeParam>* world : {&fresh, &used}) {
            expect_ok((*world)->restore(at_once.data(), at_once.size()));
            EXPECT_EQ(saved(**world, def.capacity), at_once);
            run(**world, 10);
            EXPECT_EQ(saved(**world, def.capacity), later);
            expect_ok((*world)->restore(later.data(), later.size()));
            run(**world, 10);
            EXPECT_EQ(saved(**world, def.capacity), end);
            EXPECT_EQ((*world)->state_hash(), going->state_hash());
        }
    });
}

template <class Real>
std::vector<std::byte> memory_of(TestWorld<Real>& world, const WorldDef& def) {
    return {world.memory(), world.memory() + world_bytes<Real>(def.capacity)};
}

TYPED_TEST(ChangedSettings, RefusedLeaveEveryByte) {
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    WorldDef def = changing_def();
    WorldDef plain_def = def;
    plain_def.viscosity_m2ps = 0.0F;
    plain_def.pressure = Pressure::equation_of_state;
    TestWorld<TypeParam> world(def);
    TestWorld<TypeParam> plain(plain_def);
    pour(*world, def);
    run(*world, 5);
    const std::vector<std::byte> before = memory_of(world, def);
    const std::vector<std::byte> plain_before = memory_of(plain, def);
    const float most = 1.0e6F * def.cell_m * def.cell_m;
    for (const float wrong : {-1.0e-6F, 1.001F * most, kNan, -kNan}) {
        EXPECT_EQ(world->set_viscosity(wrong), Status::viscosity_out_of_range) << wrong;
    }
    const bool small = std::is_same_v<TypeParam, SmallFixed>;
    const float most_tension = 1.0e12F * def.cell_m * def.cell_m * def.cell_m;
    for (const float wrong : {-1.0e-6F, 1.001F * most_tension, kNan}) {
        EXPECT_EQ(world->set_surface_tension(wrong), Status::surface_tension_out_of_range) << wrong;
    }
    EXPECT_EQ(world->set_surface_tension(kSoap),
              small ? Status::small_fixed_has_no_tension : Status::surface_tension_missing);
    EXPECT_EQ(plain->set_viscosity(kHoney), Status::viscosity_missing);
    EXPECT_EQ(plain->set_surface_tension(kSoap), Status::surface_tension_needs_projection);
    TankWalls walls = def.walls;
    walls.top.restitution = 0.5F;  // of which nothing is taken
    walls.left.friction = -0.1F;
    EXPECT_EQ(world->set_walls(walls), Status::friction_out_of_range);
    walls.left.friction = 0.1F;
    walls.left.conveyor_mps = kNan;
    EXPECT_EQ(world->set_walls(walls), Status::conveyor_out_of_range);
    walls.left.conveyor_mps = 0.0F;
    walls.bottom.restitution = 1.1F;
    EXPECT_EQ(world->set_walls(walls), Status::restitution_out_of_range);
    // What there is already, which is nothing.
    EXPECT_EQ(plain->set_viscosity(0.0F), Status::ok);
    EXPECT_EQ(world->set_surface_tension(0.0F), Status::ok);
    EXPECT_EQ(world->set_viscosity(def.viscosity_m2ps), Status::ok);
    EXPECT_EQ(world->set_walls(def.walls), Status::ok);
    EXPECT_EQ(memory_of(world, def), before);
    EXPECT_EQ(memory_of(plain, def), plain_before);
    StepReport report;
    expect_ok(world->begin_step(kDt, &report));
    ASSERT_FALSE(world->advance(500));
    const std::vector<std::byte> amid = memory_of(world, def);
    EXPECT_EQ(world->set_viscosity(kHoney), Status::step_in_progress);
    EXPECT_EQ(world->set_surface_tension(0.0F), Status::step_in_progress);
    EXPECT_EQ(world->set_walls({}), Status::step_in_progress);
    EXPECT_EQ(memory_of(world, def), amid);
}

WEIR_SUITE(ChangedTension, RoomyScalars);

/// Once it is gone nothing of it is left: not that what is there were drops.
TYPED_TEST(ChangedTension, GoneIsGone) {
    WorldDef def = tank_def(16, 16, 700);
    def.surface_tension_m3ps2 = 1.0e-3F;
    TestWorld<TypeParam> late(def);
    TestWorld<TypeParam> early(def);
    expect_ok(early->set_surface_tension(0.0F));
    for (TestWorld<TypeParam>* world : {&late, &early}) {
        run(**world, 3);
    }
    expect_ok(late->set_surface_tension(0.0F));
    for (TestWorld<TypeParam>* world : {&late, &early}) {
        expect_ok((*world)->fill({{0.02F, 0.0F}, {0.2F, 0.2F}}));
        run(**world, 30);
    }
    EXPECT_EQ(particles_of(*late), particles_of(*early));
    EXPECT_EQ(late->state_hash(), early->state_hash());
}

/// What the next step costs is known of what was set.
TYPED_TEST(ChangedSettings, WorkIsBoundedAsTheyAre) {
    for_each_change<TypeParam>([](WorldDef def, const Change& row) {
        TestWorld<TypeParam> world(def);
        pour(*world, def);
        run(*world, 5);
        row.change(def);
        set_all(*world, def);
        WorkBound bound;
        expect_ok(world->work_bound(kDt, &bound));
        const StepReport report = world->step(kDt);
        EXPECT_EQ(report.substeps, bound.substeps);
        EXPECT_LE(work_of(report), bound.step);
    });
    WorldDef def = changing_def();
    TestWorld<TypeParam> world(def);
    WorkBound thin;
    WorkBound thick;
    expect_ok(world->work_bound(kDt, &thin));
    expect_ok(world->set_viscosity(5.0F * kHoney));
    expect_ok(world->work_bound(kDt, &thick));
    EXPECT_GT(thick.substeps, thin.substeps);
}

}  // namespace
}  // namespace weir
