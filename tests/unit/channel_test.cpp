// Viscous liquid between walls that it sticks to: driven for ever, in rows that never mix, and still.
#include <cmath>

#include "measure/random.hpp"
#include "pressure/smooth_excess.hpp"
#include "test_world.hpp"

namespace weir {
namespace {

/// 4 × 2 cells amid ghosts, all of them liquid.
struct Cells {
    float level[24] = {};
    float open[24] = {};
    float from[24] = {};
    float to[24] = {};
    GridShape shape{4, 2, 6};

    Cells() {
        for (int k = 0; k < 24; ++k) {
            level[k] = open[k] = 1.0F;
        }
    }
    float& at(float* field, int i, int j) { return field[shape.index(i, j)]; }
    template <bool Solids>
    void smooth(std::int32_t step) {
        smooth_rows<Solids, float>(shape, level, open, step, {0, 2}, from, to);
    }
};

TEST(SmoothExcess, IsAMeanOfThree) {
    Cells cells;
    cells.at(cells.from, 1, 0) = 0.8F;
    cells.smooth<false>(1);
    EXPECT_FLOAT_EQ(cells.at(cells.to, 0, 0), 0.2F);
    EXPECT_FLOAT_EQ(cells.at(cells.to, 1, 0), 0.4F);
    EXPECT_FLOAT_EQ(cells.at(cells.to, 2, 0), 0.2F);
    EXPECT_EQ(cells.at(cells.to, 3, 0), 0.0F);
    cells.smooth<false>(cells.shape.stride);
    EXPECT_FLOAT_EQ(cells.at(cells.to, 1, 1), 0.2F);
}

TEST(SmoothExcess, KnowsNothingOfAirNorOfWhatASolidHides) {
    Cells cells;
    cells.at(cells.from, 1, 0) = 0.8F;
    cells.at(cells.level, 0, 0) = -1.0F;
    cells.at(cells.open, 2, 0) = 0.0F;
    cells.smooth<true>(1);
    EXPECT_EQ(cells.at(cells.to, 0, 0), 0.0F) << "air keeps its own";
    EXPECT_FLOAT_EQ(cells.at(cells.to, 1, 0), 0.8F);
    EXPECT_EQ(cells.at(cells.to, 2, 0), 0.0F) << "behind a closed face";
}

/// Four a cell, each anywhere in its quarter, all over a tank 8 cells wide.
template <class Real>
void fill_anyhow(TestWorld<Real>& world, int height) {
    measure::Random dice(5);
    for (int k = 0; k < 32 * height; ++k) {
        const float i = static_cast<float>(k % 16) + dice.uniform(0.1F, 0.9F);
        const float j = static_cast<float>(k / 16) + dice.uniform(0.1F, 0.9F);
        expect_ok(world->add_particle({0.5F * i, 0.5F * j}, {}));
    }
}

/// Flow of a full channel at Re = 10 after 25 H²/ν over that of Poiseuille's profile.
template <class Real>
float flow_over_exact(int height) {
    constexpr int kLength = 8;
    const float h = static_cast<float>(height);
    const float viscosity = h * h / 10.0F;
    WorldDef def = measure::tank_def(kLength, height, 4 * kLength * height);
    def.cell_m = 1.0F;
    def.viscosity_m2ps = viscosity;
    def.gravity_mps2 = {8.0F * viscosity / h, 0.0F};  // mean speed ⅔ h
    def.periodic_x = true;
    def.walls = every_wall({0.0F, 0.0F, true, 0.0F});
    def.top_speed_mps = 1.25F * h;
    TestWorld<Real> world{def};
    fill_anyhow(world, height);
    const float interval = 0.1F / std::ceil(0.2F * h);
    for (float time = 0.0F; time < 250.0F; time += interval) {
        world->step(interval);
    }
    float sum = 0.0F;
    for (const auto& v : world->particle_velocities()) {
        sum += convert<float>(v).x;
    }
    return sum / (4.0F * kLength * h) / (h / 1.5F);
}

WEIR_SUITE(Channel, RoomyScalars);

/// It was 0.74 in float, 0.86 in double, 0.986 in Fixed: a particle's own share of the excess drove
/// all off the walls to one line of faces.
TYPED_TEST(Channel, CarriesAsMuchForEver) {
    const float flow = flow_over_exact<TypeParam>(12);
    EXPECT_GT(flow, 0.99F);
    EXPECT_LT(flow, 1.02F);
}

/// Of Couette flow over 16 cells, started from rest, in the end: mean difference of particles that
/// began anywhere in their quarters of a cell, over the wall's speed.
template <class Real>
double couette_error() {
    constexpr int kHeight = 16;
    WorldDef def = measure::tank_def(8, kHeight, 32 * kHeight);
    def.cell_m = 1.0F;
    def.gravity_mps2 = {};
    def.viscosity_m2ps = 0.1F * kHeight * kHeight;
    def.periodic_x = true;
    def.walls = every_wall({0.0F, 0.0F, true, 0.0F});
    def.walls.top.conveyor_mps = -float{kHeight};
    def.max_substeps = 64;
    TestWorld<Real> world{def};
    fill_anyhow(world, kHeight);
    for (int step = 0; step < 600; ++step) {
        world->step(1.0F / 60.0F);
    }
    double error = 0.0;
    for (std::int32_t k = 0; k < world->particle_positions().size; ++k) {
        const double y = static_cast<double>(world->particle_positions()[k].y);
        error += std::fabs(static_cast<double>(convert<float>(world->particle_velocities()[k]).x) - y);
    }
    return error / (32 * kHeight) / kHeight;
}

/// A face's velocity that was that of its particles' mean place made it 0.0069 off.
TYPED_TEST(Channel, IsAsStraightAsItsParticlesAreNot) {
    EXPECT_LT(couette_error<TypeParam>(), 0.001);
}

/// Fastest component in a pool 8 cells deep after 100 steps, over √(gh). It sticks to the tank, or
/// to two bodies that stand before its sides and end between lines of the grid.
template <class Real>
float fastest_in_pool(bool bodies) {
    WorldDef def = measure::tank_def(16, 16, 4 * 16 * 8);
    def.cell_m = 0.01F;
    def.viscosity_m2ps = 1.0e-3F;
    constexpr Surface kSticks{0.0F, 0.0F, true, 0.0F};
    if (bodies) {
        def.capacity.bodies = 2;
        def.capacity.vertices = 8;
    } else {
        def.walls = every_wall(kSticks);
    }
    TestWorld<Real> world{def};
    const Ring side = rectangle(0.026F, 0.16F);
    for (const float x : {0.013F, 0.147F}) {
        BodyDef body = body_of(side, {x, 0.08F});
        body.surface = kSticks;
        if (bodies) {
            put_static(*world, body);
        }
    }
    EXPECT_EQ(world->fill({{0.0F, 0.0F}, {0.16F, 0.08F}}), Status::ok);
    for (int k = 0; k < 100; ++k) {
        world->step(1.0F / 60.0F);
    }
    float fastest = 0.0F;
    for (const auto& packed : world->particle_velocities()) {
        const Vec2<float> v = convert<float>(packed);
        fastest = std::fmax(fastest, std::fmax(std::fabs(v.x), std::fabs(v.y)));
    }
    return fastest / std::sqrt(981.0F * 8.0F);
}

WEIR_SUITE(StickingPool, EveryScalar);

/// It went round for ever at 0.1, between bodies at 0.06: what gravity gives in a step fell past the
/// walls, which pulled.
TYPED_TEST(StickingPool, Rests) {
    EXPECT_LT(fastest_in_pool<TypeParam>(false), 0.005F);
    EXPECT_LT(fastest_in_pool<TypeParam>(true), 0.01F) << "between bodies";
}

}  // namespace
}  // namespace weir
