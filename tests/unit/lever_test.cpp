// What pushes gives no more than it has: spray out of reach, narrow gaps, too few sweeps, noise.
#include <gtest/gtest.h>

#include <iterator>
#include <vector>

#include "pressure/projection.hpp"
#include "step/grid_update.hpp"
#include "test_world.hpp"

namespace weir {
namespace {

/// A tank 16 cells wide with liquid in the lower half of 12 rows, and spray over it.
template <class Real>
struct Spray {
    static constexpr std::int32_t kWet = 6;
    GridShape shape{16, 12, 18};
    std::vector<Real> room;
    StaggeredGrid<Real> grid;
    PressureFields<Real> fields;
    Walls<Real> walls;

    Spray() : room(static_cast<std::size_t>(6 * shape.size()), Real(0)) {
        Real** const arrays[] = {&grid.u, &grid.v, &grid.mass_u, &grid.mass_v, &fields.pressure,
                                 &fields.level};
        for (std::size_t k = 0; k < std::size(arrays); ++k) {
            *arrays[k] = room.data() + k * static_cast<std::size_t>(shape.size());
        }
        grid.shape = shape;
        for (std::int32_t j = -1; j <= shape.ny; ++j) {
            for (std::int32_t i = -1; i <= shape.nx; ++i) {
                const std::int32_t c = shape.index(i, j);
                const float above = j == kWet ? -0.75F : -1.25F;
                fields.level[c] = Real(j + 1 < kWet ? 1.0F : (j < kWet ? 0.25F : above)) -
                                  least_head(fields);
                fields.pressure[c] = j < kWet ? Real(1) : Real(0);
            }
        }
    }

    /// The upper face of the air cell over the surface, when the liquid below moves with `liquid`.
    double after(double liquid, double spray, std::int32_t i) {
        Real& face = grid.v[shape.index(i, kWet + 1)];
        grid.v[shape.index(i, kWet)] = Real(static_cast<float>(liquid));
        face = Real(static_cast<float>(spray));
        extrapolate(Domain<Real>{grid, fields, Borders<Real>{}, walls}, false);
        return static_cast<double>(static_cast<float>(face));
    }
};

WEIR_SUITE(SprayOf, RoomyScalars);

TYPED_TEST(SprayOf, IsPushedToTheLiquidsSpeedAndTurnedRound) {
    // A pressure of 1 a quarter of a cell below the surface: 4 cells/s.
    for (std::int32_t i = 0; i < 16; ++i) {  // in groups of lanes and at their ends
        SCOPED_TRACE(i);
        EXPECT_NEAR(Spray<TypeParam>().after(10.0, 5.0, i), 9.0, 1e-3);
        EXPECT_NEAR(Spray<TypeParam>().after(10.0, 10.0, i), 12.0, 1e-3) << "a fifth faster";
        EXPECT_NEAR(Spray<TypeParam>().after(10.0, 13.0, i), 13.0, 1e-3) << "out of reach";
        EXPECT_NEAR(Spray<TypeParam>().after(-1.0, 2.0, i), 2.0, 1e-3) << "the other way";
        EXPECT_NEAR(Spray<TypeParam>().after(-1.0, -3.0, i), 1.0, 1e-3) << "falls on it";
        EXPECT_NEAR(Spray<TypeParam>().after(-1.0, -1.0, i), 1.0, 1e-3) << "no faster than before";
        Spray<TypeParam> heavy;
        heavy.fields.cell_weight = TypeParam(2.0F);
        EXPECT_NEAR(heavy.after(10.0, 10.0, i), 12.5, 1e-3) << "and a quarter of gravity's step";
    }
}

template <class Real>
std::uint64_t hash_after(const WorldDef& def) {
    TestWorld<Real> world(def);
    EXPECT_EQ(world->fill({{0.0F, 0.0F}, {0.2F, 0.3F}}), Status::ok);
    for (int step = 0; step < 60; ++step) {
        world->step(1.0F / 60.0F);
    }
    return world->state_hash();
}

TEST(Sweeps, FourAreMadeAtLeast) {
    WorldDef few;
    WorldDef four;
    WorldDef five;
    few.pressure_sweeps = 1;
    four.pressure_sweeps = 4;
    five.pressure_sweeps = 5;
    EXPECT_EQ(hash_after<float>(few), hash_after<float>(four));
    EXPECT_NE(hash_after<float>(five), hash_after<float>(four));
}

TEST(EquationOfState, TakesNoMoreFlipThanItsNoiseBears) {
    WorldDef lively;
    WorldDef most;
    lively.pressure = most.pressure = Pressure::equation_of_state;
    lively.flip_ratio = 1.0F;
    most.flip_ratio = 0.97F;
    EXPECT_EQ(hash_after<float>(lively), hash_after<float>(most));
    lively.pressure = most.pressure = Pressure::projection;
    EXPECT_NE(hash_after<float>(lively), hash_after<float>(most));
}

/// Liquid that falls past stones in a narrow tank: one leaves it a slot beside the wall, and slivers
/// of faces that hold far more liquid than they let through.
TEST(NarrowGap, GivesNoEnergyThatNothingLost) {
    const Ring stones[] = {
        {{6.15F, 28.34F}, {6.63F, 27.44F}, {7.57F, 27.37F}, {8.86F, 27.69F}, {9.11F, 28.70F},
         {8.85F, 29.26F}, {8.49F, 30.02F}, {7.83F, 30.33F}, {6.62F, 29.56F}, {6.25F, 29.28F}},
        {{8.16F, 39.33F}, {7.87F, 39.26F}, {7.62F, 39.47F}, {7.55F, 39.02F}, {7.34F, 38.89F},
         {7.32F, 38.50F}, {7.74F, 38.41F}, {8.15F, 38.57F}, {8.30F, 38.97F}}};
    WorldDef def;
    def.capacity.cells_x = 10;
    def.capacity.cells_y = 46;
    def.capacity.bodies = 2;
    def.capacity.vertices = 19;
    def.cell_m = 1.0F / 64.0F;
    def.gravity_mps2 = {5.22F, 4.45F};
    def.flip_ratio = 0.99F;
    def.volume_gain = 0.25F;
    def.cfl = 0.703F;
    def.max_substeps = 16;
    def.pressure_sweeps = 16;
    TestWorld<float> world(def);
    for (Ring stone : stones) {
        for (Vec2f& corner : stone) {
            corner = def.cell_m * corner;
        }
        put_static(*world, body_of(stone, {}));
    }
    ASSERT_EQ(world->fill({{def.cell_m * 7.188F, def.cell_m * 20.942F},
                           {def.cell_m * 9.459F, def.cell_m * 42.043F}}),
              Status::ok);
    const auto energy = [&] {  // above that of liquid in the tank's upper right corner
        Diagnostics d;
        EXPECT_EQ(world->diagnose(&d), Status::ok);
        const double corner = (5.22 * 10.0 + 4.45 * 46.0) / 64.0;
        return d.kinetic_energy_m4ps2 + d.potential_energy_m4ps2 + d.mass_m2 * corner;
    };
    const double start = energy();
    for (int step = 0; step < 60; ++step) {
        world->step(1.0F / 120.0F);
        ASSERT_LT(energy(), 1.0005 * start) << "step " << step;
    }
}

}  // namespace
}  // namespace weir
