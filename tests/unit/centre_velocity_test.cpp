// Velocities of faces' middles: what viscosity works on.
#include "step/centre_velocity.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "step/grid_update.hpp"
#include "step/particle_to_grid.hpp"
#include "test_world.hpp"

namespace weir {
namespace {

constexpr int kCells = 16;
constexpr Vec2<double> kFall{0.0, -7.0};

Vec2<double> linear(Vec2<double> x) { return {3.0 + 2.0 * x.y - x.x, 1.0 + x.y + 0.5 * x.x}; }
Vec2<double> at_rest(Vec2<double>) { return {}; }

/// Particles anywhere in a box of cells, moving as a flow does, and the faces around them.
struct Scattered {
    GridShape shape{kCells, kCells, kCells + 2};
    std::vector<double> u, v, mass_u, mass_v, scratch[2], level;
    std::vector<Vec2<double>> x, w;
    StaggeredGrid<double> grid;
    PressureFields<double> fields;
    Walls<double> walls;
    Borders<double> borders;
    Particles<double> particles;
    std::vector<double> counts;  ///< of particles on u's faces

    Scattered(double low, double high, Vec2<double> (*flow)(Vec2<double>)) {
        for (auto* field : {&u, &v, &mass_u, &mass_v, &scratch[0], &scratch[1], &level}) {
            field->assign(static_cast<std::size_t>(shape.size()), 0.0);
        }
        grid = {shape, u.data(), v.data(), mass_u.data(), mass_v.data()};
        fields.divergence = scratch[0].data();
        fields.inverse_diagonal = scratch[1].data();
        level.assign(level.size(), 1.0);
        fields.level = level.data();
        std::mt19937 random(3);
        std::uniform_real_distribution<double> place(low, high);
        for (int k = 0; k < static_cast<int>(8.0 * (high - low) * (high - low)); ++k) {
            x.push_back({place(random), place(random)});
            w.push_back(flow(x.back()));
        }
        const auto count = static_cast<std::int32_t>(x.size());
        particles = {x.data(), w.data(), count, count};
        particle_to_grid(particles, borders, 1.0, grid);
        counts = mass_u;
        grid_update(domain(), kFall);
    }
    Domain<double> domain() { return {grid, fields, borders, walls}; }
    void pass(bool again) {
        extend_velocity(borders, shape, grid.mass_u, grid.mass_v);
        centre_velocity<double>(domain(), particles, 1.0, kFall, again);
    }
    /// Of the faces well within the tank, from the flow.
    double largest_error(Vec2<double> (*flow)(Vec2<double>)) const {
        double largest = 0.0;
        for (int j = 3; j < kCells - 3; ++j) {
            for (int i = 3; i < kCells - 3; ++i) {
                const auto face = static_cast<std::size_t>(shape.index(i, j));
                const double of_u = flow({i + 0.0, j + 0.5}).x + kFall.x;
                const double of_v = flow({i + 0.5, j + 0.0}).y + kFall.y;
                largest = std::fmax(largest, std::fabs(u[face] - of_u));
                largest = std::fmax(largest, std::fabs(v[face] - of_v));
            }
        }
        return largest;
    }
    double momentum() const {
        double sum = 0.0;
        for (std::size_t face = 0; face < u.size(); ++face) {
            sum += counts[face] > 0.0 ? counts[face] * mass_u[face] : 0.0;
        }
        return sum;
    }
};

TEST(CentreVelocity, IsThatOfTheFacesMiddle) {
    Scattered faces(0.0, kCells, linear);
    const double scattered = faces.largest_error(linear);
    EXPECT_GT(scattered, 0.3) << "of the mean place of what they read";
    faces.pass(false);
    faces.pass(true);
    EXPECT_LT(faces.largest_error(linear), 0.2 * scattered);
}

TEST(CentreVelocity, GivesNoMomentum) {
    Scattered faces(4.0, 12.0, linear);
    const double before = faces.momentum();
    faces.pass(false);
    faces.pass(true);
    EXPECT_NEAR(faces.momentum(), before, 1.0e-12 * before);
    for (int i = 5; i < 11; ++i) {
        const auto face = static_cast<std::size_t>(faces.shape.index(i, 8));
        EXPECT_NEAR(faces.u[face] - faces.mass_u[face], kFall.x, 1.0e-12);
        EXPECT_NEAR(faces.v[face] - faces.mass_v[face], kFall.y, 1.0e-12);
    }
}

TEST(CentreVelocity, StaysAsScatteredAtTheSurface) {
    Scattered faces(0.0, kCells, linear);
    faces.level[static_cast<std::size_t>(faces.shape.index(8, 8))] = -0.5;
    const std::vector<double> scattered = faces.u;
    faces.pass(false);
    faces.pass(true);
    for (const int i : {8, 9}) {
        const auto face = static_cast<std::size_t>(faces.shape.index(i, 8));
        EXPECT_EQ(faces.u[face], scattered[face]);
        EXPECT_NE(faces.u[face + 2], scattered[face + 2]);
    }
}

/// What gravity has given is none of the flow's: the wall below has stopped it already.
TEST(CentreVelocity, LetsLiquidRest) {
    Scattered faces(0.0, kCells, at_rest);
    const std::vector<double> fallen = faces.v;
    faces.pass(false);
    faces.pass(true);
    EXPECT_EQ(faces.v, fallen);
    for (const double velocity : faces.mass_v) {
        EXPECT_EQ(velocity, 0.0);
    }
}

}  // namespace
}  // namespace weir
