// Cells that solids cut: what density they show when full, and that liquid beside solids is as dense
// as elsewhere.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "fewer_lanes.hpp"
#include "solid/cut_cells.hpp"
#include "solid/cut_cells_groups.hpp"
#include "world_inside.hpp"

namespace weir {
namespace {

constexpr float kCell = 0.02F;
constexpr float kFrame = 1.0F / 60.0F;

const Simulation<float>& inside(TestWorld<float>& world) {
    return state_of(world).simulation;
}

/// Mean of a cell's four faces, as seen from its centre.
double kernel(double x, double y) {
    const auto hat = [](double at) { return std::max(0.0, 1.0 - std::abs(at)); };
    const auto wide = [&](double at) { return hat(at - 0.5) + hat(at + 0.5); };
    return 0.25 * (wide(x) * hat(y) + hat(x) * wide(y));
}

TEST(CutCells, FullDensityIsTheKernelOverTheOpenPart) {
    WorldDef def = tank_def(24, 24, 10, 1, 4);
    for (int trial = 0; trial < 12; ++trial) {
        TestWorld<float> world(def);
        const float angle = 0.55F * static_cast<float>(trial);
        const Ring box = rectangle(6.3F * kCell, 9.7F * kCell);
        const Vec2f at{12.13F, 11.78F};  // cells
        put_moving(*world, body_of(box, kCell * at, angle));
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

/// Largest difference of the density's mean from 1 in a row of cells on a floor one cell thick whose
/// top is at `height` cells, in a vessel that stands `off` cells from the tank's corner.
double worst_row_on_floor(std::int32_t off, float height) {
    WorldDef def = tank_def(24 + off, 24 + off, 2000, 3, 12);
    TestWorld<float> world(def);
    const auto at = [&](float x, float y) {
        const auto more = static_cast<float>(off);
        return Vec2f{kCell * (x + more), kCell * (y + more)};
    };
    const Ring floor = rectangle(18.0F * kCell, 1.0F * kCell);
    const Ring side = rectangle(3.0F * kCell, 16.0F * kCell);
    BodyId id;
    const Status added[] = {
        world->add_static_body(body_of(floor, at(12.0F, height - 0.5F)), &id),
        world->add_static_body(body_of(side, at(4.4F, 13.0F)), &id),
        world->add_static_body(body_of(side, at(19.6F, 13.0F)), &id),
        world->fill({at(6.0F, 6.6F), at(18.0F, 16.0F)})};
    for (const Status status : added) {
        EXPECT_EQ(status, Status::ok);
    }
    for (int step = 0; step < 1500; ++step) {
        world->step(kFrame);
    }
    const PressureFields<float>& fields = inside(world).pressure;
    const GridShape& s = inside(world).layers.shape;
    double worst = 0.0;
    for (int j = 6 + off; j < 10 + off; ++j) {
        double mean = 0.0;
        for (int i = 8 + off; i < 16 + off; ++i) {
            mean += static_cast<double>(fields.density[s.index(i, j)]) / 8.0;
        }
        worst = std::max(worst, std::abs(mean - 1.0));
    }
    return worst;
}

/// In the middle between its surfaces the distance has no slope, and beside it points downwards.
TEST(CutCells, LiquidOnAThinFloorIsNoDenserThanAbove) {
    for (const std::int32_t off : {0, 64}) {
        EXPECT_LT(worst_row_on_floor(off, 6.5F), 0.06) << off;
        EXPECT_LT(worst_row_on_floor(off, 6.7F), 0.09) << off;
    }
}

/// The contour of a small tank: two that are to be the same.
template <class Real>
struct Picture {
    GridShape shape{21, 13, 23};
    std::vector<DistanceOf<Real>> distance = field<DistanceOf<Real>>(Real(1.5));
    std::vector<std::uint8_t> cell_case = field<std::uint8_t>(std::uint8_t{0});
    std::vector<ShareOf<Real>> open_u = field<ShareOf<Real>>(Real(1));
    std::vector<ShareOf<Real>> open_v = open_u;
    std::vector<ShareOf<Real>> full = open_u;
    std::vector<VelocityOf<Real>> scratch = field<VelocityOf<Real>>(Real(0));
    std::vector<std::uint32_t> near = std::vector<std::uint32_t>(13, 0);

    template <class Number, class Value>
    std::vector<Number> field(Value value) const {
        Number number{};
        number = value;
        return std::vector<Number>(static_cast<std::size_t>(shape.size()) + 16, number);
    }
    void update(const NodeBox& nodes) {
        Walls<Real> walls;
        walls.distance = distance.data();
        walls.cell_case = cell_case.data();
        walls.open_u = open_u.data();
        walls.open_v = open_v.data();
        walls.full_density = full.data();
        walls.near = near.data();
        update_cut_cells(shape, nodes, {}, false, scratch.data(), walls);
    }
};

WEIR_SUITE(CutCellsOf, EveryScalar);

/// Blots come and go. All cells are looked at if all seem to have been solid.
TYPED_TEST(CutCellsOf, WhatIsTouchedAloneIsUpdated) {
    using Real = TypeParam;
    Picture<Real> step_by_step;
    Picture<Real> anew;
    const GridShape& s = step_by_step.shape;
    std::mt19937 random(5);
    const auto dice = [&](std::int32_t most) {
        return static_cast<std::int32_t>(random() % static_cast<std::uint32_t>(most + 1));
    };
    for (int trial = 0; trial < 600; ++trial) {
        const NodeBox box{dice(s.nx), dice(s.ny), dice(s.nx), dice(s.ny)};
        const bool wiped = random() % 2 == 0;
        const double x = dice(s.nx) + 0.01 * dice(99);
        const double y = dice(s.ny) + 0.01 * dice(99);
        const double radius = 0.03 * dice(99);
        for (std::int32_t j = box.j0; j <= box.j1; ++j) {
            for (std::int32_t i = box.i0; i <= box.i1; ++i) {
                const double distance = std::hypot(i - x, j - y) - radius;
                const Real now = Real(wiped ? 1.5 : std::clamp(distance, -1.5, 1.5));
                const auto c = static_cast<std::size_t>(s.index(i, j));
                if (wiped || now < Real(step_by_step.distance[c])) {
                    step_by_step.distance[c] = now;
                    anew.distance[c] = now;
                }
            }
        }
        step_by_step.update(box);
        std::fill(anew.cell_case.begin(), anew.cell_case.end(), kSolid);
        anew.update({0, 0, s.nx, s.ny});
        ASSERT_EQ(step_by_step.near, anew.near) << trial;
        for (std::int32_t j = 0; j <= s.ny; ++j) {
            for (std::int32_t i = 0; i <= s.nx; ++i) {
                const auto c = static_cast<std::size_t>(s.index(i, j));
                const auto same = [&](const std::vector<ShareOf<Real>>& a,
                                      const std::vector<ShareOf<Real>>& b) {
                    return Real(a[c]) == Real(b[c]);
                };
                const bool in_row = i < s.nx;
                const bool in_column = j < s.ny;
                ASSERT_TRUE(!in_column || same(step_by_step.open_u, anew.open_u)) << trial;
                ASSERT_TRUE(!in_row || same(step_by_step.open_v, anew.open_v)) << trial;
                ASSERT_TRUE(!in_row || !in_column ||
                            (same(step_by_step.full, anew.full) &&
                             step_by_step.cell_case[c] == anew.cell_case[c]))
                    << trial << ' ' << i << ' ' << j;
            }
        }
    }
}

/// Distances of packed worlds are divided in 32 bits.
TEST(CutCells, PackedSharesAreThoseOfRoomyNumbers) {
    for (std::int32_t outside = 1; outside <= 0x180; ++outside) {
        for (std::int32_t inside = 0; inside >= -0x180; --inside) {
            const Fixed out = Fixed::of_raw(256 * outside);
            const Fixed in = Fixed::of_raw(256 * inside);
            ASSERT_EQ(open_fraction(SmallFixed::of_raw(out.raw), SmallFixed::of_raw(in.raw)).raw,
                      open_fraction(out, in).raw)
                << outside << ' ' << inside;
        }
    }
    const SmallFixed most = SmallFixed::of_raw(kMostRaw);
    EXPECT_EQ(open_fraction(SmallFixed(), most).raw,
              open_fraction(Fixed(), Fixed::of_raw(kMostRaw)).raw);
}

#if WEIR_HAS_LANES

/// Four nodes of a cell that is cut, no saddle; some of them on the contour.
Corners<float> dice_corners(std::mt19937& random) {
    std::uniform_real_distribution<float> distance(-1.4F, 1.4F);
    Corners<float> corners{};
    do {
        for (float& one : corners.distance) {
            one = random() % 8 == 0 ? 0.0F : distance(random) * (random() % 4 == 0 ? 1e-3F : 1.0F);
        }
    } while (!is_cut(contour_case(corners.distance)) || is_saddle(contour_case(corners.distance)));
    return corners;
}

TEST(CutCells, LanesHaveTheBitsOfThePlainLoops) {
    std::mt19937 random(3);
    for (int trial = 0; trial < 4000; ++trial) {
        const Fewer fewer(trial % 2 == 0 ? 4 : 0);
        const CutLoops& loops = cut_loops();
        Corners<float> corners[8];
        float field[32];  // two rows of eight cells, apart
        std::int32_t cell[8];
        for (std::int32_t k = 0; k < 8; ++k) {
            corners[k] = dice_corners(random);
            const float* d = corners[k].distance;
            cell[k] = 2 * k;
            field[2 * k] = d[0];
            field[2 * k + 1] = d[1];
            field[16 + 2 * k] = d[3];
            field[16 + 2 * k + 1] = d[2];
        }
        CutTask task{};
        task.stride = 16;
        task.distance = field;
        float area[8];
        RowsOfShares shares[8];
        for (std::int32_t k = 0; k < 8; k += loops.lanes) {
            loops.areas(task, cell + k, area + k);
            loops.shares(field, 16, cell + k, shares + k);
        }
        for (std::int32_t k = 0; k < 8; ++k) {
            const float* d = corners[k].distance;
            if (!is_roomy(contour_case(d))) {
                ASSERT_EQ(area[k], open_area(d)) << trial;
            }
            const Shares<float> plain = kernel_shares(Hats<float>(open_moments(d)));
            for (std::int32_t row = 0; row < 3; ++row) {
                for (std::int32_t column = 0; column < 3; ++column) {
                    ASSERT_EQ(shares[k][row][column], plain.of[row][column]) << trial;
                }
                ASSERT_EQ(shares[k][row][3], 0.0F);
            }
        }
    }
}

#endif

}  // namespace
}  // namespace weir
