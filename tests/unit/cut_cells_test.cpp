// Cells that solids cut: what density they show when full, and that liquid beside solids is as dense
// as elsewhere.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "test_world.hpp"
#include "world/world_state.hpp"

namespace weir {
namespace {

constexpr float kCell = 0.02F;
constexpr float kFrame = 1.0F / 60.0F;

const Simulation<float>& inside(TestWorld<float>& world) {
    return reinterpret_cast<const detail::WorldState<float>*>(world.memory())->simulation;
}

/// Mean of a cell's four faces, as seen from its centre.
double kernel(double x, double y) {
    const auto hat = [](double at) { return std::max(0.0, 1.0 - std::abs(at)); };
    const auto wide = [&](double at) { return hat(at - 0.5) + hat(at + 0.5); };
    return 0.25 * (wide(x) * hat(y) + hat(x) * wide(y));
}

TEST(CutCells, FullDensityIsTheKernelOverTheOpenPart) {
    WorldDef def;
    def.capacity.cells_x = 24;
    def.capacity.cells_y = 24;
    def.capacity.particles = 10;
    def.capacity.bodies = 1;
    def.capacity.vertices = 4;
    for (int trial = 0; trial < 12; ++trial) {
        TestWorld<float> world(def);
        const float angle = 0.55F * static_cast<float>(trial);
        const Ring box = rectangle(6.3F * kCell, 9.7F * kCell);
        const Vec2f at{12.13F, 11.78F};  // cells
        BodyId id;
        ASSERT_EQ(world->add_moving_body(body_of(box, kCell * at, angle), &id), Status::ok);
        world->step(kFrame);
        const Walls<float>& walls = inside(world).layers.walls;
        const GridShape& s = inside(world).layers.shape;
        constexpr int kSamples = 24;
        for (int j = 3; j < 21; ++j) {
            for (int i = 3; i < 21; ++i) {
                double open = 0.0;
                bool corner = false;  // it is cut by a straight line
                for (int k = 0; k < 9 * kSamples * kSamples; ++k) {
                    const double x = (k % (3 * kSamples) + 0.5) / kSamples - 1.5;
                    const double y = (k / (3 * kSamples) + 0.5) / kSamples - 1.5;
                    const double right = i + 0.5 + x - static_cast<double>(at.x);
                    const double up = j + 0.5 + y - static_cast<double>(at.y);
                    const double c = std::cos(static_cast<double>(angle));
                    const double s_ = std::sin(static_cast<double>(angle));
                    const double across = std::abs(c * right + s_ * up) - 3.15;
                    const double along = std::abs(c * up - s_ * right) - 4.85;
                    const bool solid = across < 0.0 && along < 0.0;
                    corner = corner || (std::abs(across) < 0.7 && std::abs(along) < 0.7);
                    open += solid ? 0.0 : kernel(x, y) / (kSamples * kSamples);
                }
                if (!corner) {
                    EXPECT_NEAR(static_cast<double>(walls.full_density[s.index(i, j)]), open, 0.013)
                        << i << ' ' << j << ' ' << angle;
                }
            }
        }
    }
}

/// A floor one cell thick between nodes: the distance has no slope in its middle.
TEST(CutCells, LiquidOnAThinFloorIsNoDenserThanAbove) {
    WorldDef def;
    def.capacity.cells_x = 24;
    def.capacity.cells_y = 24;
    def.capacity.particles = 2000;
    def.capacity.bodies = 3;
    def.capacity.vertices = 12;
    TestWorld<float> world(def);
    const Ring floor = rectangle(18.0F * kCell, 1.0F * kCell);
    const Ring side = rectangle(3.0F * kCell, 16.0F * kCell);
    BodyId id;
    ASSERT_EQ(world->add_static_body(body_of(floor, {12.0F * kCell, 6.0F * kCell}), &id),
              Status::ok);
    ASSERT_EQ(world->add_static_body(body_of(side, {4.4F * kCell, 13.0F * kCell}), &id),
              Status::ok);
    ASSERT_EQ(world->add_static_body(body_of(side, {19.6F * kCell, 13.0F * kCell}), &id),
              Status::ok);
    ASSERT_EQ(world->fill({{6.0F * kCell, 6.6F * kCell}, {18.0F * kCell, 16.0F * kCell}}),
              Status::ok);
    for (int step = 0; step < 1500; ++step) {
        world->step(kFrame);
    }
    const PressureFields<float>& fields = inside(world).pressure;
    const GridShape& s = inside(world).layers.shape;
    double rows[4] = {};
    for (int j = 6; j < 10; ++j) {
        for (int i = 8; i < 16; ++i) {
            rows[j - 6] += static_cast<double>(fields.density[s.index(i, j)]) / 8.0;
        }
    }
    for (const double density : rows) {
        EXPECT_NEAR(density, 1.0, 0.06);
    }
}

}  // namespace
}  // namespace weir
