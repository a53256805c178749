// Velocities that particles interpolate: what viscosity works on, and what nothing pulls at.
#include "step/mass_matrix.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>
#include <random>
#include <vector>

#include "step/particle_to_grid.hpp"
#include "test_world.hpp"

namespace weir {
namespace {

constexpr int kCells = 16;
constexpr int kHalf = kCells / 2;
constexpr double kBend = 0.8;  // ∂²u/∂y²

using Places = std::vector<Vec2<double>>;
using Flow = Vec2<double> (*)(Vec2<double>);

Vec2<double> linear(Vec2<double> x) { return {3.0 + 2.0 * x.y - x.x, 1.0 + x.y + 0.5 * x.x}; }
Vec2<double> bent(Vec2<double> x) { return {0.5 * kBend * x.y * x.y, 0.0}; }

/// Eight a cell, anywhere, but on numbers that have few digits.
Places fill(double low, double width, double height) {
    std::mt19937 random(3);
    const auto place = [&](double size) {
        std::uniform_int_distribution<int> steps(1, static_cast<int>(64.0 * size) - 1);
        return low + steps(random) / 64.0;
    };
    Places x;
    for (int k = 0; k < static_cast<int>(8.0 * width * height); ++k) {
        const double along = place(width);
        x.push_back({along, place(height)});
    }
    return x;
}

/// A tank all full of liquid, and what particles give to its faces.
template <class Real>
struct Faces {
    GridShape shape;
    std::vector<Real> u, v, mass_u, mass_v, edges, flow, level, coarse;
    std::vector<Vec2<Real>> x, w;
    StaggeredGrid<Real> grid;
    PressureFields<Real> fields;
    Walls<Real> walls;
    Borders<Real> borders;
    Particles<Real> particles;

    Faces(const Places& places, const Places& velocities, int rows = kCells,
          const Borders<Real>& sides = {})
        : shape{kCells, rows, kCells + 2}, x(convert(places)), w(convert(velocities)),
          borders(sides) {
        for (auto* field : {&u, &v, &mass_u, &mass_v, &edges, &flow}) {
            field->assign(static_cast<std::size_t>(shape.size()), Real(0));
        }
        level.assign(u.size(), Real(1));
        coarse.assign(static_cast<std::size_t>(2 * shape.stride + shape.size()), Real(0));
        grid = {shape, u.data(), v.data(), mass_u.data(), mass_v.data()};
        fields.divergence = edges.data();
        fields.inverse_diagonal = flow.data();
        fields.coarse.correction = coarse.data();
        fields.level = level.data();
        const auto count = static_cast<std::int32_t>(x.size());
        particles = {x.data(), w.data(), count, count};
        particle_to_grid<Real>(particles, borders, Real(1), grid, nullptr);
    }
    Faces(const Faces&) = delete;

    static std::vector<Vec2<Real>> convert(const Places& numbers) {
        std::vector<Vec2<Real>> converted;
        for (const Vec2<double> number : numbers) {
            converted.push_back({static_cast<Real>(number.x), static_cast<Real>(number.y)});
        }
        return converted;
    }

    void solve(bool to_surface = false) {
        detail::mass_matrix<Real>().solve({grid, fields, borders, walls}, particles, Real(1),
                                          to_surface, {});
    }
    /// Cells from that row on have no liquid.
    void dry_from(int row) {
        std::fill(level.begin() + shape.index(-1, row), level.end(), Real(-0.5));
    }
    Vec2<double> velocity(int i, int j) const {
        const auto face = static_cast<std::size_t>(shape.index(i, j));
        return {double(u[face] / mass_u[face]), double(v[face] / mass_v[face])};
    }
    /// Of the faces well within the tank, from the flow.
    double largest_error(Flow exact) const {
        double largest = 0.0;
        for (int j = 3; j < kCells - 3; ++j) {
            for (int i = 3; i < kCells - 3; ++i) {
                const double off_u = velocity(i, j).x - exact({i + 0.0, j + 0.5}).x;
                const double off_v = velocity(i, j).y - exact({i + 0.5, j + 0.0}).y;
                largest = std::fmax(largest, std::fmax(std::fabs(off_u), std::fabs(off_v)));
            }
        }
        return largest;
    }
};

Places carried(const Places& x, Flow flow) {
    Places w;
    for (const Vec2<double> at : x) {
        w.push_back(flow(at));
    }
    return w;
}

double sum(const std::vector<double>& field) {
    return std::accumulate(field.begin(), field.end(), 0.0);
}

TEST(MassMatrix, KnowsTheFlowAtTheFacesMiddle) {
    const Places x = fill(0.0, kCells, kCells);
    Faces<double> faces(x, carried(x, linear));
    const double scattered = faces.largest_error(linear);
    EXPECT_GT(scattered, 0.3) << "of the mean place of what they read";
    faces.solve();
    EXPECT_LT(faces.largest_error(linear), 0.2 * scattered);
}

/// A scatter smooths like 1 + ∇²/12, and so does a gather.
TEST(MassMatrix, SmoothsNothing) {
    const Places x = fill(0.0, kCells, kCells);
    Faces<double> faces(x, carried(x, bent));
    const auto mean_error = [&] {
        double error = 0.0;
        for (int j = 3; j < kCells - 3; ++j) {
            for (int i = 3; i < kCells - 3; ++i) {
                error += faces.velocity(i, j).x - bent({i + 0.0, j + 0.5}).x;
            }
        }
        return error / ((kCells - 6) * (kCells - 6));
    };
    EXPECT_NEAR(mean_error(), kBend / 12.0, 0.2 * kBend / 12.0) << "of the scatter alone";
    faces.solve();
    EXPECT_NEAR(mean_error(), -kBend / 12.0, 0.2 * kBend / 12.0) << "what a gather adds";
}

TEST(MassMatrix, GivesNoMomentum) {
    const Places x = fill(4.0, 8.0, 8.0);
    Faces<double> faces(x, carried(x, linear));
    const std::vector<double> u = faces.u;
    const std::vector<double> v = faces.v;
    faces.solve();
    EXPECT_NEAR(sum(faces.u), sum(u), 1.0e-12 * sum(u));
    EXPECT_NEAR(sum(faces.v), sum(v), 1.0e-12 * sum(v));
    EXPECT_NE(faces.u, u);
}

TEST(MassMatrix, LeavesTheSurfaceAsScattered) {
    const Places x = fill(0.0, kCells, kCells);
    Faces<double> faces(x, carried(x, linear));
    faces.level[static_cast<std::size_t>(faces.shape.index(8, 8))] = -0.5;
    const std::vector<double> u = faces.u;
    faces.solve();
    for (const int i : {8, 9}) {
        const auto face = static_cast<std::size_t>(faces.shape.index(i, 8));
        EXPECT_EQ(faces.u[face], u[face]);
        EXPECT_NE(faces.u[face + 2], u[face + 2]);
    }
}

/// Of faces at the surface by the slope on that side on which there are particles.
TEST(MassMatrix, OrKnowsTheFlowThereToo) {
    constexpr int kSurface = 8;
    const Places x = fill(0.0, kCells, kSurface + 0.25);
    const auto largest_error = [&](bool solved, bool to_surface) {
        Faces<double> faces(x, carried(x, linear));
        faces.dry_from(kSurface);
        if (solved) {
            faces.solve(to_surface);
        }
        double largest = 0.0;
        for (int i = 3; i < kCells - 3; ++i) {
            const Vec2<double> middle{i + 0.5, double(kSurface)};
            largest = std::fmax(largest, std::fabs(faces.velocity(i, kSurface).y -
                                                   linear(middle).y));
        }
        return largest;
    };
    const double scattered = largest_error(false, false);
    EXPECT_GT(scattered, 0.3);
    EXPECT_EQ(largest_error(true, false), scattered);
    EXPECT_LT(largest_error(true, true), 0.4 * scattered);
}

/// What is moved by half a tank with two seams gives the same, as far away.
TEST(MassMatrix, SeesNoSeam) {
    const Places x = fill(0.0, kCells, kCells);
    const Places w = carried(x, linear);
    Places moved;
    for (const Vec2<double> at : x) {
        moved.push_back({std::fmod(at.x + kHalf, kCells), std::fmod(at.y + kHalf, kCells)});
    }
    Borders<double> seams;
    seams.wrap_x = seams.wrap_y = true;
    seams.odd = &detail::odd_borders<double>();
    Faces<double> here(x, w, kCells, seams);
    Faces<double> there(moved, w, kCells, seams);
    here.solve();
    there.solve();
    for (int j = 0; j < kCells; ++j) {
        for (int i = 0; i < kCells; ++i) {
            const Vec2<double> a = here.velocity(i, j);
            const Vec2<double> b = there.velocity((i + kHalf) % kCells, (j + kHalf) % kCells);
            EXPECT_NEAR(a.x, b.x, 1.0e-12) << i << ", " << j;
            EXPECT_NEAR(a.y, b.y, 1.0e-12) << i << ", " << j;
        }
    }
    for (int k = 0; k < kCells; ++k) {
        EXPECT_EQ(here.velocity(kCells, k).x, here.velocity(0, k).x);
        EXPECT_EQ(here.velocity(k, kCells).y, here.velocity(k, 0).y);
    }
}

/// Beyond a wall are images: half a tank gives what a whole one does that holds both.
TEST(MassMatrix, SeesImagesBeyondWalls) {
    for (const bool no_slip : {false, true}) {
        const Places x = fill(0.0, kCells, kHalf);
        const Places w = carried(x, linear);
        Borders<double> sides;
        sides.odd = &detail::odd_borders<double>();
        sides.viscous = true;
        sides.top.no_slip = no_slip;
        Faces<double> half(x, w, kHalf, sides);
        Places all = x;
        Places velocities = w;
        for (std::size_t k = 0; k < x.size(); ++k) {
            all.push_back({x[k].x, kCells - x[k].y});
            velocities.push_back({no_slip ? -w[k].x : w[k].x, -w[k].y});
        }
        Faces<double> whole(all, velocities);
        half.solve();
        whole.solve();
        for (int j = 0; j < kHalf; ++j) {
            for (int i = 0; i < kCells; ++i) {
                const Vec2<double> a = half.velocity(i, j);
                const Vec2<double> b = whole.velocity(i, j);
                EXPECT_NEAR(a.x, b.x, 1.0e-12) << i << ", " << j;
                EXPECT_NEAR(a.y, b.y, 1.0e-12) << i << ", " << j;
            }
        }
    }
}

/// Solids that close no face, and the names of liquids, make loops plain.
TEST(MassMatrix, LanesHaveThePlainLoopsBits) {
    const Places x = fill(0.0, kCells, 11.25);
    const Places w = carried(x, bent);
    for (const bool to_surface : {false, true}) {
        Faces<float> lanes(x, w);
        Faces<float> plain(x, w);
        lanes.dry_from(11);
        lanes.level[static_cast<std::size_t>(lanes.shape.index(5, 9))] = -0.5F;
        plain.level = lanes.level;
        std::vector<float> open(plain.u.size(), 1.0F);
        std::vector<Liquid> kind(x.size(), Liquid::first);
        plain.walls.active = true;
        plain.walls.open_u = plain.walls.open_v = open.data();
        plain.particles.kind = kind.data();
        lanes.solve(to_surface);
        plain.solve(to_surface);
        EXPECT_EQ(lanes.u, plain.u);
        EXPECT_EQ(lanes.v, plain.v);
    }
}

/// Edges and diagonals of more particles than there is room for count as many, and no fewer.
TEST(MassMatrix, HoldsACrowd) {
    Places x = fill(4.0, 8.0, 8.0);
    x.insert(x.end(), 2000, {8.25, 8.25});
    Faces<double> faces(x, carried(x, linear));
    faces.solve();
    const auto largest = [](const auto& field, auto zero) {
        std::vector<decltype(zero)> numbers(field.size() * sizeof(double) / sizeof zero);
        std::memcpy(numbers.data(), field.data(), field.size() * sizeof(double));
        return *std::max_element(numbers.begin(), numbers.end());
    };
    EXPECT_EQ(largest(faces.edges, std::uint16_t{0}), 16383);
    const auto rows = faces.coarse.begin() + 2 * (kCells + 2);
    const std::vector<double> diagonals(rows, faces.coarse.end());
    EXPECT_EQ(largest(diagonals, std::uint8_t{0}), 127);
}

}  // namespace
}  // namespace weir
