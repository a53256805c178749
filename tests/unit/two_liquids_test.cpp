// Two liquids of unlike density in one tank: rest, overturn, conservation, and one liquid's bits.
// Units here: a cell of 1 m, gravity 1 m/s², unless said otherwise.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "step/grid_update.hpp"
#include "step/particle_to_grid.hpp"
#include "test_world.hpp"
#include "weir/weir.hpp"

namespace weir {
namespace {

constexpr double kPi = 3.14159265358979;

WorldDef layers_def(std::int32_t cells_x, std::int32_t cells_y, float ratio) {
    WorldDef def = tank_def(cells_x, cells_y, 4 * cells_x * cells_y);
    def.capacity.second_liquid = true;
    def.cell_m = 1.0F;
    def.gravity_mps2 = {0, -1.0F};
    def.second_density_ratio = ratio;
    def.pressure_sweeps = 32;
    return def;
}

struct Energy {
    double kinetic = 0.0;
    double potential = 0.0;
    double total() const { return kinetic + potential; }
};

template <class Real>
double density(const World<Real>& world, std::int32_t k, double ratio) {
    return world.particle_kinds()[k] == Liquid::second ? ratio : 1.0;
}

/// Half a step before the positions', when velocities are what they are.
template <class Real>
Energy energy(const World<Real>& world, double ratio, double gravity, double dt_s = 0.0) {
    Energy sum;
    for (std::int32_t k = 0; k < world.particle_positions().size; ++k) {
        const Vec2<Real> v = world.particle_velocities()[k];
        const double m = density(world, k, ratio);
        sum.kinetic += 0.5 * m * static_cast<double>(v.x * v.x + v.y * v.y);
        const double height = static_cast<double>(world.particle_positions()[k].y);
        sum.potential += m * gravity * (height - 0.5 * dt_s * static_cast<double>(v.y));
    }
    return sum;
}

template <class Real>
double rms_speed(const World<Real>& world) {
    double sum = 0.0;
    for (const Vec2<Real> v : world.particle_velocities()) {
        sum += static_cast<double>(v.x * v.x + v.y * v.y);
    }
    return std::sqrt(sum / world.particle_velocities().size);
}

std::int32_t count(const World<float>& world, Liquid kind) {
    const View<Liquid> kinds = world.particle_kinds();
    return static_cast<std::int32_t>(std::count(kinds.begin(), kinds.end(), kind));
}

/// Two layers of 14 cells, the second liquid below: pressure within 1 % of ρgh, and at rest.
template <class Real>
void expect_layers_at_rest(float ratio, std::int32_t sweeps) {
    SCOPED_TRACE(ratio);
    WorldDef def = layers_def(24, 32, ratio);
    def.pressure_sweeps = sweeps;
    TestWorld<Real> world(def);
    ASSERT_EQ(world->fill({{0, 0}, {24, 14}}, nullptr, Liquid::second), Status::ok);
    ASSERT_EQ(world->fill({{0, 14}, {24, 28}}), Status::ok);
    const double rho = static_cast<double>(ratio);
    const double start = energy(*world, rho, 1.0).total();
    for (int step = 0; step < 300; ++step) {
        ASSERT_EQ(world->step(0.3F).clamped, 0U);
        ASSERT_LE(energy(*world, rho, 1.0).total(), start * (1.0 + 1e-4));
    }
    EXPECT_LT(rms_speed(*world), 1e-3 * std::sqrt(28.0));
    const double bottom = 14.0 + rho * 14.0;
    for (std::int32_t j = 0; j < 28; ++j) {
        const double y = j + 0.5;
        const double p = static_cast<double>(world->pressure().at(9, j)) *
                         static_cast<double>(world->pressure_scale());
        EXPECT_NEAR(p, y < 14.0 ? 14.0 + rho * (14.0 - y) : 28.0 - y, 0.01 * bottom) << j;
    }
    for (std::int32_t k = 0; k < world->particle_positions().size; ++k) {
        const double y = static_cast<double>(world->particle_positions()[k].y);
        const bool below = world->particle_kinds()[k] == Liquid::second;
        ASSERT_TRUE(below ? y < 14.6 : y > 13.4) << k;  // nothing has crossed
    }
}

TEST(TwoLiquids, LightOverHeavyRests) {
    expect_layers_at_rest<float>(1.5F, 32);
    expect_layers_at_rest<float>(10.0F, 32);
    expect_layers_at_rest<float>(100.0F, 32);
    expect_layers_at_rest<double>(3.0F, 32);
}

/// Heavy over light, an interface h + a cos kx in a closed flow that decays on both sides: while
/// a is small it grows as cosh nt, n = √(A g k) (Rayleigh 1883; Taylor 1950).
void expect_growth(float ratio, float dt_s) {
    SCOPED_TRACE(ratio);
    constexpr std::int32_t kWave = 24;
    constexpr double kStart = 0.5;
    WorldDef def = layers_def(kWave, 2 * kWave + 4, ratio);
    def.pressure_sweeps = 300;
    TestWorld<float> world(def);
    const double k = 2.0 * kPi / kWave;
    for (std::int32_t b = 0; b < 4 * kWave; ++b) {
        for (std::int32_t a = 0; a < 2 * kWave; ++a) {
            const double x = 0.5 * a + 0.25;
            const double y = 0.5 * b + 0.25;
            const bool above = y > kWave;
            const double depth = k * (above ? 2 * kWave - y : y);
            const double along = std::cosh(depth) / std::sinh(k * kWave) * (above ? 1 : -1);
            const double up = std::sinh(depth) / std::sinh(k * kWave);
            const Vec2f at{float(std::clamp(x + kStart * along * std::sin(k * x), 0.0, 1.0 * kWave)),
                           float(y + kStart * up * std::cos(k * x))};
            ASSERT_EQ(world->add_particle(at, {0, 0}, above ? Liquid::second : Liquid::first),
                      Status::ok);
        }
    }
    const auto amplitude = [&] {
        double sum = 0.0;
        for (std::int32_t p = 0; p < world->particle_positions().size; ++p) {
            const double x = static_cast<double>(world->particle_positions()[p].x);
            sum -= world->particle_kinds()[p] == Liquid::second ? std::cos(k * x) : 0.0;
        }
        return 0.25 * sum * 2.0 / kWave;
    };
    const double rho = static_cast<double>(ratio);
    const double rate = std::sqrt((rho - 1) / (rho + 1) * k);
    const double first = amplitude();
    EXPECT_NEAR(first, kStart, 0.01);
    const double start = energy(*world, rho, 1.0).total();
    double t = 0.0;
    while (amplitude() < 4.0 * first && t < 100.0) {
        const StepReport report = world->step(dt_s);
        ASSERT_EQ(report.clamped, 0U);
        t += static_cast<double>(report.dt_s);
        const double step = static_cast<double>(report.dt_s);
        ASSERT_LE(energy(*world, rho, 1.0, step).total(), start * (1.0 + 1.0e-6));
    }
    EXPECT_NEAR(std::acosh(amplitude() / first) / t, rate, 0.1 * rate);
}

TEST(TwoLiquids, HeavyOverLightOverturnsAtRayleighsRate) {
    expect_growth(1.5F, 0.3F);
    expect_growth(3.0F, 0.3F);
    expect_growth(10.0F, 0.15F);
}

/// Left to itself the heavy liquid ends below, mostly, and no energy comes from nowhere.
TEST(TwoLiquids, HeavyOverLightEndsBelow) {
    WorldDef def = layers_def(24, 32, 4.0F);
    TestWorld<float> world(def);
    ASSERT_EQ(world->fill({{0, 0}, {24, 12}}), Status::ok);
    ASSERT_EQ(world->fill({{0, 12}, {24, 24}}, nullptr, Liquid::second), Status::ok);
    const double start = energy(*world, 4.0, 1.0).total();
    for (int step = 0; step < 1200; ++step) {
        world->step(0.25F);
        ASSERT_LE(energy(*world, 4.0, 1.0, 0.25).total(), start * (1.0 + 1.0e-4)) << step;
    }
    EXPECT_EQ(count(*world, Liquid::first), 4 * 24 * 12);
    EXPECT_EQ(count(*world, Liquid::second), 4 * 24 * 12);
    double height[2] = {};
    for (std::int32_t k = 0; k < world->particle_positions().size; ++k) {
        height[world->particle_kinds()[k] == Liquid::second] +=
            static_cast<double>(world->particle_positions()[k].y) / (4 * 24 * 12);
    }
    EXPECT_GT(height[0], height[1] + 6.0);
    EXPECT_TRUE(all_inside(*world));
}

/// What falls freely knows nothing of its densities.
TEST(TwoLiquids, AMixedBlockFallsAsOne) {
    WorldDef def = layers_def(24, 64, 8.0F);
    def.volume_gain = 0.0F;
    TestWorld<double> world(def);
    ASSERT_EQ(world->fill({{8, 40}, {12, 56}}, nullptr, Liquid::second), Status::ok);
    ASSERT_EQ(world->fill({{12, 40}, {16, 56}}), Status::ok);
    double t = 0.0;
    for (int step = 0; step < 20; ++step) {
        t += static_cast<double>(world->step(0.25F).dt_s);
        for (const Vec2<double> v : world->particle_velocities()) {
            ASSERT_NEAR(v.x, 0.0, 1e-6);
            ASSERT_NEAR(v.y, -t, 1e-6);
        }
    }
}

/// The scatter conserves volume, mass and momentum, also at every wall.
TEST(TwoLiquids, TransferConserves) {
    const GridShape shape{9, 7, 11};
    const auto cells = std::size_t(shape.size());
    std::vector<double> u(cells), v(cells), volume_u(cells), volume_v(cells), mass_u(cells),
        mass_v(cells);
    StaggeredGrid<double> grid{shape,           u.data(),      v.data(),     volume_u.data(),
                               volume_v.data(), mass_u.data(), mass_v.data()};
    std::vector<Vec2<double>> x, w;
    std::vector<Liquid> kinds;
    double px = 0.0;
    double py = 0.0;
    double mass = 0.0;
    for (int k = 0; k < 400; ++k) {
        const Liquid kind = k % 3 == 0 ? Liquid::second : Liquid::first;
        x.push_back({0.02 + 8.96 * ((k * 37) % 400) / 400.0, 0.02 + 6.96 * ((k * 91) % 400) / 400.0});
        w.push_back({0.01 * k - 1.0, 2.0 - 0.02 * k});
        kinds.push_back(kind);
        const double m = kind == Liquid::second ? 7.5 : 1.0;
        mass += m;
        px += m * w.back().x;
        py += m * w.back().y;
    }
    const Particles<double> particles{x.data(), w.data(), 400, 400, kinds.data()};
    particle_to_grid(particles, Borders<double>{}, 7.5, grid);
    const auto sum = [&](const std::vector<double>& field, bool on_u) {
        double total = 0.0;  // a face on a wall was doubled by its mirror image
        for (std::int32_t j = 0; j < shape.ny + (on_u ? 0 : 1); ++j) {
            for (std::int32_t i = 0; i < shape.nx + (on_u ? 1 : 0); ++i) {
                const bool wall = on_u ? i == 0 || i == shape.nx : j == 0 || j == shape.ny;
                total += (wall ? 0.5 : 1.0) * field[std::size_t(shape.index(i, j))];
            }
        }
        return total;
    };
    EXPECT_NEAR(sum(volume_u, true), 400.0, 1e-10);
    EXPECT_NEAR(sum(volume_v, false), 400.0, 1e-10);
    EXPECT_NEAR(sum(mass_u, true), mass, 1e-10);
    EXPECT_NEAR(sum(mass_v, false), mass, 1e-10);
    EXPECT_NEAR(sum(u, true), px, 1e-10);
    EXPECT_NEAR(sum(v, false), py, 1e-10);
}

/// Runs a world with one kind beside one with two kinds of equal density.
template <class Real>
void expect_same_bits(WorldDef def, int steps) {
    def.capacity.second_liquid = false;
    TestWorld<Real> one(def);
    def.capacity.second_liquid = true;
    TestWorld<Real> two(def);
    for (TestWorld<Real>* world : {&one, &two}) {
        const Liquid other = world == &two ? Liquid::second : Liquid::first;
        if (def.capacity.bodies > 0) {
            BodyId id;
            ASSERT_EQ((*world)->add_static_body(body_of(kTriangle, {0.3F, 0.0F}), &id), Status::ok);
            BodyDef bar = body_of(kSquare4cm, {0.41F, 0.2F}, 0.3F);
            bar.motion.spin_radps = 3.0F;
            ASSERT_EQ((*world)->add_moving_body(bar, &id), Status::ok);
        }
        ASSERT_EQ((*world)->fill({{0.0F, 0.0F}, {0.2F, 0.14F}}), Status::ok);
        ASSERT_EQ((*world)->fill({{0.0F, 0.14F}, {0.2F, 0.3F}}, nullptr, other), Status::ok);
    }
    for (int step = 0; step < steps; ++step) {
        one->step(1.0F / 60.0F);
        two->step(1.0F / 60.0F);
    }
    for (std::int32_t k = 0; k < one->particle_positions().size; ++k) {
        ASSERT_EQ(one->particle_positions()[k].x, two->particle_positions()[k].x) << k;
        ASSERT_EQ(one->particle_positions()[k].y, two->particle_positions()[k].y) << k;
        ASSERT_EQ(one->particle_velocities()[k].x, two->particle_velocities()[k].x) << k;
        ASSERT_EQ(one->particle_velocities()[k].y, two->particle_velocities()[k].y) << k;
    }
    for (std::int32_t j = 0; j < one->cells_y(); ++j) {
        for (std::int32_t i = 0; i < one->cells_x(); ++i) {
            ASSERT_EQ(one->pressure().at(i, j), two->pressure().at(i, j));
        }
    }
}

TEST(TwoLiquids, EqualDensitiesAreOneLiquidToTheBit) {
    WorldDef def = tank_def(30, 20, 1000);
    expect_same_bits<float>(def, 100);
    expect_same_bits<double>(def, 50);
    def.periodic_x = true;
    def.periodic_y = true;
    expect_same_bits<float>(def, 50);
    def.periodic_x = false;
    def.viscosity_m2ps = 1.0e-3F;
    def.walls = every_wall({0.0F, 0.0F, true, 0.0F});
    def.walls.left.conveyor_mps = -0.3F;
    expect_same_bits<float>(def, 50);
    def.periodic_y = false;
    def.capacity.bodies = 2;
    def.capacity.vertices = 7;
    def.surface_tension_m3ps2 = 1.0e-3F;
    expect_same_bits<float>(def, 100);
}

/// Solids, a great ratio, few sweeps: nothing is lost, nothing leaves, energy does not rise.
TEST(TwoLiquids, SolidsAndAGreatRatio) {
    for (const float ratio : {0.01F, 0.3F, 100.0F}) {
        SCOPED_TRACE(ratio);
        WorldDef def = small_def();
        def.capacity.particles = 1000;
        def.capacity.second_liquid = true;
        def.second_density_ratio = ratio;
        TestWorld<float> world(def);
        put_static(*world, body_of(kTriangle, {0.12F, 0.0F}));
        ASSERT_EQ(world->fill({{0, 0}, {0.1F, 0.24F}}, nullptr, Liquid::second), Status::ok);
        ASSERT_EQ(world->fill({{0.2F, 0.0F}, {0.32F, 0.2F}}), Status::ok);
        const std::int32_t before[] = {count(*world, Liquid::first), count(*world, Liquid::second)};
        const double rho = static_cast<double>(ratio);
        const double gravity = 9.81 / 0.02;
        const double start = energy(*world, rho, gravity).total();
        for (int step = 0; step < 300; ++step) {
            world->step(1.0F / 60.0F);
            ASSERT_LE(energy(*world, rho, gravity).total(), start) << step;
        }
        EXPECT_EQ(count(*world, Liquid::first), before[0]);
        EXPECT_EQ(count(*world, Liquid::second), before[1]);
        EXPECT_TRUE(all_inside(*world));
    }
}

TEST(TwoLiquids, KindsFollowTheirParticles) {
    WorldDef def = small_def();
    def.capacity.second_liquid = true;
    TestWorld<float> world(def);
    EXPECT_EQ(world->particle_kinds().size, 0);
    const Liquid kinds[] = {Liquid::first, Liquid::second, Liquid::first, Liquid::second};
    for (int k = 0; k < 4; ++k) {
        const Vec2f at{0.04F * static_cast<float>(k + 1), 0.1F};
        ASSERT_EQ(world->add_particle(at, {0, 0}, kinds[k]), Status::ok);
    }
    ASSERT_EQ(world->remove_particle(0), Status::ok);  // the last takes its place
    ASSERT_EQ(world->particle_kinds().size, 3);
    EXPECT_EQ(world->particle_kinds()[0], Liquid::second);
    EXPECT_EQ(world->particle_kinds()[1], Liquid::second);
    EXPECT_EQ(world->particle_kinds()[2], Liquid::first);
    EXPECT_NEAR(world->particle_positions()[0].x, 8.0F, 1e-5F);
    const std::uint64_t mixed = world->state_hash();
    ASSERT_EQ(world->remove_particle(2), Status::ok);
    ASSERT_EQ(world->add_particle({0.12F, 0.1F}, {0, 0}, Liquid::second), Status::ok);
    EXPECT_NE(world->state_hash(), mixed);  // only a kind differs
}

TEST(TwoLiquids, ASecondLiquidIsAByteAParticleAndTwoNumbersACell) {
    WorldDef def = small_def();
    const std::size_t one = world_bytes<float>(def.capacity);
    def.capacity.second_liquid = true;
    const std::size_t two = world_bytes<float>(def.capacity);
    const std::size_t added = 200 + 2 * 18 * 18 * 4 + 2 * 6 * 6 * 4;  // coarse cells, too
    EXPECT_GE(two, one + added);
    EXPECT_LE(two, one + added + 4 * world_alignment);
    TestWorld<float> world(small_def());
    ASSERT_EQ(world->fill({{0, 0}, {0.1F, 0.1F}}), Status::ok);
    EXPECT_EQ(world->particle_kinds().data, nullptr);
    EXPECT_EQ(world->particle_kinds().size, 0);
}

/// A drop of liquid three times as dense gives a free body three times the momentum.
TEST(TwoLiquids, TheDenserOneHitsHarder) {
    float pushed[2] = {};
    for (const Liquid kind : {Liquid::first, Liquid::second}) {
        WorldDef def = tank_def(32, 32, 4, 1, 4);
        def.gravity_mps2 = {};
        def.capacity.two_way = def.capacity.second_liquid = true;
        def.second_density_ratio = 3.0F;
        TestWorld<float> world(def);
        BodyDef body = body_of(kSquare4cm, {0.32F, 0.32F});
        body.density_ratio = 1.0F;
        const BodyId id = put_free(*world, body);
        expect_ok(world->add_particle({0.25F, 0.32F}, {1.0F, 0.0F}, kind));
        for (int step = 0; step < 20; ++step) {
            world->step(1.0F / 120.0F);
        }
        pushed[kind == Liquid::second ? 1 : 0] = motion_of(*world, id).velocity_mps.x;
    }
    EXPECT_GT(pushed[0], 0.01F);
    EXPECT_NEAR(pushed[1] / pushed[0], 3.0F, 0.5F);
}

}  // namespace
}  // namespace weir
