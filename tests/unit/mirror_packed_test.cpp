// Faces in solids: packed worlds, in whole numbers, against what Fixed makes of the same fields.
#include <cmath>
#include <cstdlib>

#include "step/boundary_condition.hpp"
#include "step/viscosity.hpp"
#include "world_inside.hpp"

namespace weir {
namespace {

/// What gravity gave in the step.
template <class Real>
constexpr Vec2<Real> kFall{Real(0.5), Real(-2.0)};

enum class Bodies { still, moving, sticking };

WorldDef tank_with(Bodies bodies) {
    WorldDef def = tank_def(24, 16, 1600, 2, 8);
    def.cell_m = 0.01F;
    def.viscosity_m2ps = bodies == Bodies::sticking ? 1.0e-5F : 0.0F;
    return def;
}

/// A triangle that leans, and a bar of a cell and a half, liquid on all sides but the right.
template <class Real>
class MirroredTank {
public:
    /// `at_once`: both fields in one look at each face, as in a step that is not cut.
    explicit MirroredTank(Bodies bodies, bool at_once = false) : world_(tank_with(bodies)) {
        BodyDef leaning = body_of(kTriangle, {0.03F, 0.02F}, 0.3F);
        leaning.surface.no_slip = bodies == Bodies::sticking;
        put_static(*world_, leaning);
        const Ring bar = {{0, 0}, {0.015F, 0}, {0.015F, 0.06F}, {0, 0.06F}};
        BodyDef thin = body_of(bar, {0.155F, 0.03F}, -0.2F);
        thin.motion.velocity_mps = {0.0F, bodies == Bodies::moving ? 0.02F : 0.0F};
        thin.motion.spin_radps = bodies == Bodies::moving ? 1.0F : 0.0F;
        put_moving(*world_, thin);
        expect_ok(world_->fill({{0.0F, 0.0F}, {0.24F, 0.15F}}));
        world_->step(1.0e-4F);
        for (std::int32_t c = 0; c < shape().size(); ++c) {
            const auto i = static_cast<double>(c % shape().stride);
            const auto j = static_cast<double>(c / shape().stride);
            grid().u[c] = Real(3.0 + 0.25 * j - 0.125 * i);
            grid().v[c] = Real(-2.0 + 0.125 * j + 0.25 * i);
            grid().mass_u[c] = Real(2.0 - 0.125 * j + 0.25 * i);
            grid().mass_v[c] = Real(-4.0 + 0.25 * j);
            simulation().pressure.level[c] = Real(i < 18.0 ? 1.0 : -1.0);
        }
        simulation().layers.walls.sticking =
            bodies == Bodies::sticking ? simulation().viscosity->sticking : nullptr;
        Progress progress;
        progress.begin();
        progress.resume(kMostWork);
        mirror_in_solids(domain_of(simulation()), kFall<Real>,
                         at_once ? Work(progress) : Work());
    }

    Simulation<Real>& simulation() {
        return state_of(world_).simulation;
    }
    StaggeredGrid<Real>& grid() { return simulation().grid; }
    const GridShape& shape() { return grid().shape; }
    const VelocityOf<Real>* field(int which) {
        const VelocityOf<Real>* fields[] = {grid().u, grid().v, grid().mass_u, grid().mass_v};
        return fields[which];
    }

private:
    TestWorld<Real> world_;
};

class PackedMirror : public ::testing::TestWithParam<Bodies> {};

TEST_P(PackedMirror, IsWhatFixedMakesOfTheSameFields) {
    MirroredTank<Fixed> fixed(GetParam());
    MirroredTank<SmallFixed> packed(GetParam());
    const GridShape& s = fixed.shape();
    for (int which = 0; which < 4; ++which) {
        double sum = 0.0;
        std::int32_t off = 0;
        std::int32_t images = 0;
        for (std::int32_t j = 0; j < s.ny; ++j) {
            for (std::int32_t i = 0; i < s.nx; ++i) {
                const std::int32_t c = s.index(i, j);
                const auto wanted = static_cast<double>(fixed.field(which)[c]);
                const auto found = static_cast<double>(packed.field(which)[c]);
                images += std::fabs(wanted * 8.0 - std::round(wanted * 8.0)) > 1.0e-3 ? 1 : 0;
                sum += std::fabs(found - wanted);
                off += std::fabs(found - wanted) > 0.1 ? 1 : 0;
            }
        }
        EXPECT_GT(images, 10) << which;
        EXPECT_LE(off, images / 20) << which;  // on a ridge either side is as near
        EXPECT_LT(sum / images, 0.03) << which;
    }
}

TEST_P(PackedMirror, IsTheSameInOneLookAtEachFaceAndFieldByField) {
    MirroredTank<SmallFixed> one(GetParam(), true);
    MirroredTank<SmallFixed> two(GetParam());
    for (int which = 0; which < 4; ++which) {
        for (std::int32_t c = 0; c < one.shape().size(); ++c) {
            ASSERT_EQ(one.field(which)[c].raw, two.field(which)[c].raw) << which << ' ' << c;
        }
    }
}

TEST_P(PackedMirror, LeavesNothingThatIsTakenForADiagonalAmidLiquid) {
    for (const bool at_once : {false, true}) {
        MirroredTank<SmallFixed> tank(GetParam(), at_once);
        const Walls<SmallFixed>& walls = tank.simulation().layers.walls;
        for_each_near(tank.shape(), walls, {0, tank.shape().ny},
                      [&](std::int32_t i, std::int32_t j) {
                          const std::int32_t c = tank.shape().index(i, j);
                          const auto left = tank.simulation().pressure.inverse_diagonal[c];
                          EXPECT_LE(std::abs(left.raw), 3) << i << ' ' << j;
                      });
    }
}

INSTANTIATE_TEST_SUITE_P(Unit, PackedMirror,
                         ::testing::Values(Bodies::still, Bodies::moving, Bodies::sticking));

}  // namespace
}  // namespace weir
