// Rasterizer, coverage and wall normals against brute force and against exact shapes.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "brute_distance.hpp"
#include "contour/gradient.hpp"
#include "contour/raster.hpp"
#include "fewer_lanes.hpp"
#include "weir/geometry.hpp"

namespace weir {
namespace {

constexpr int kNodes = 33;

struct Field {
    std::vector<float> distance = std::vector<float>(kNodes * kNodes, 1.5F);
    std::vector<float> scratch = std::vector<float>(kNodes * kNodes);
    std::vector<std::uint16_t> nearest = std::vector<std::uint16_t>(kNodes * kNodes, 0xFFFF);

    void draw(const std::vector<Point>& ring, std::uint16_t name) {
        std::vector<Vec2f> corners;
        for (const Point p : ring) {
            corners.push_back(convert<float>(p));
        }
        const auto count = static_cast<std::int32_t>(corners.size());
        const RasterPolygon<float> polygon{{corners.data(), count}, name, {}};
        const NodeBox box = nodes_near(corners.data(), count, 1.5F, kNodes - 1, kNodes - 1);
        rasterize(polygon, box, false, 1.5F, scratch.data(),
                  NodeField<float>{distance.data(), nearest.data(), 0, kNodes});
    }
    float at(int i, int j) const { return distance[static_cast<std::size_t>(j * kNodes + i)]; }
};

std::vector<Point> star(Point centre, double radius, int tips, double angle) {
    std::vector<Point> ring;
    for (int k = 0; k < 2 * tips; ++k) {
        const double r = k % 2 == 0 ? radius : 0.35 * radius;
        const double a = angle + M_PI * k / tips;
        ring.push_back({centre.x + r * std::cos(a), centre.y + r * std::sin(a)});
    }
    return ring;
}

TEST(Raster, UnionOfStarsAgreesWithBruteForceAlsoDeepInside) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (int scene = 0; scene < 40; ++scene) {
        Field field;
        std::vector<std::vector<Point>> rings;
        for (int k = 0; k < 3; ++k) {
            const Point centre{6.0 + 20.0 * unit(random), 6.0 + 20.0 * unit(random)};
            rings.push_back(star(centre, 2.0 + 9.0 * unit(random), 3 + k, 6.3 * unit(random)));
            field.draw(rings.back(), static_cast<std::uint16_t>(k));
        }
        for (int j = 0; j < kNodes; ++j) {
            for (int i = 0; i < kNodes; ++i) {
                double exact = 1.5;
                for (const auto& ring : rings) {
                    const Point p{double(i), double(j)};
                    exact = std::min(exact, brute_distance(ring, p, {1e9, 1e9}));
                }
                ASSERT_NEAR(double(field.at(i, j)), exact, 1e-4) << scene << ": " << i << ", " << j;
            }
        }
    }
}

/// A part of the box, drawn again, changes no bit: what refreshing a rectangle relies on.
TEST(Raster, DrawingAPartAgainChangesNothing) {
    Field field;
    const std::vector<Point> ring = star({15.3, 16.1}, 11.0, 5, 0.4);
    field.draw(ring, 0);
    const std::vector<float> before = field.distance;
    std::vector<Vec2f> corners;
    for (const Point p : ring) {
        corners.push_back(convert<float>(p));
    }
    const RasterPolygon<float> polygon{{corners.data(), 10}, 0, {}};
    rasterize(polygon, NodeBox{9, 12, 17, 20}, false, 1.5F, field.scratch.data(),
              NodeField<float>{field.distance.data(), field.nearest.data(), 0, kNodes});
    EXPECT_EQ(field.distance, before);
}

/// Of two bodies at one place the one of the lower name is named, whichever was drawn last.
TEST(Raster, OfTwoAsNearTheLowerNameStands) {
    std::vector<Vec2<double>> corners;
    for (const Point p : star({16.3, 15.8}, 9.0, 5, 0.4)) {
        corners.push_back({p.x, p.y});
    }
    const auto count = static_cast<std::int32_t>(corners.size());
    std::vector<double> distance(kNodes * kNodes, 1.5);
    std::vector<double> scratch(kNodes * kNodes);
    std::vector<std::uint16_t> nearest(kNodes * kNodes, 0xFFFF);
    const NodeBox box = nodes_near(corners.data(), count, 1.5, kNodes - 1, kNodes - 1);
    for (const std::uint16_t name : {std::uint16_t{5}, std::uint16_t{3}, std::uint16_t{4}}) {
        rasterize(RasterPolygon<double>{{corners.data(), count}, name, {}}, box, false, 1.5,
                  scratch.data(),
                  NodeField<double>{distance.data(), nearest.data(), 0, kNodes});
    }
    for (std::size_t node = 0; node < distance.size(); ++node) {
        ASSERT_EQ(nearest[node], distance[node] < 1.5 ? 3 : 0xFFFF) << node;
    }
}

/// Loops in lanes do a whole box, and beside it where there is room; a strip of one column is drawn
/// node by node.
TEST(Raster, AnyNumberOfLanesHasTheBitsOfNodeByNode) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    const float size = kNodes - 1;
    for (int scene = 0; scene < 400; ++scene) {
        const Fewer fewer(scene % 2 == 0 ? 4 : 0);
        Field whole;
        Field strips;
        for (int k = 0; k < 3; ++k) {
            const Point centre{-2.0 + 36.0 * unit(random), -2.0 + 36.0 * unit(random)};
            const double radius = 0.3 + (scene % 3 == 0 ? 12.0 : 3.0) * unit(random);
            std::vector<Vec2f> corners;
            for (const Point p : star(centre, radius, 3 + scene % 11, 6.3 * unit(random))) {
                corners.push_back(convert<float>(p));
            }
            const auto count = static_cast<std::int32_t>(corners.size());
            const RasterPolygon<float> polygon{{corners.data(), count},
                                               static_cast<std::uint16_t>(2 - k),
                                               {{}, {size, size}}};
            const NodeBox box = nodes_near(corners.data(), count, 1.5F, kNodes - 1, kNodes - 1);
            rasterize(polygon, box, false, 1.5F, whole.scratch.data(),
                      NodeField<float>{whole.distance.data(), whole.nearest.data(), 0, kNodes, 0,
                                       kNodes - 1});
            for (std::int32_t i = box.i0; i <= box.i1; ++i) {
                rasterize(polygon, NodeBox{i, box.j0, i, box.j1}, false, 1.5F,
                          strips.scratch.data(),
                          NodeField<float>{strips.distance.data(), strips.nearest.data(), 0,
                                           kNodes});
            }
        }
        ASSERT_EQ(whole.distance, strips.distance) << scene;
        ASSERT_EQ(whole.nearest, strips.nearest) << scene;
    }
}

double sum(const std::vector<float>& share) {
    double total = 0.0;
    for (const float one : share) {
        EXPECT_GE(one, 0.0F);
        EXPECT_LE(one, 1.000001F);
        total += double(one);
    }
    return total;
}

TEST(Coverage, CountsHolesAndCutsOffWhatIsBeyondTheGrid) {
    std::vector<float> share(64);
    const Vec2f outer[] = {{1.5F, 1.25F}, {6.5F, 1.25F}, {6.5F, 6.25F}, {1.5F, 6.25F}};
    const Vec2f hole[] = {{3.0F, 3.0F}, {5.0F, 3.0F}, {4.0F, 5.5F}};
    const View<Vec2f> holes[] = {{hole, 3}};
    ASSERT_EQ(cover_cells({outer, 4}, {holes, 1}, 8, 8, share.data()), Status::ok);
    EXPECT_NEAR(sum(share), 25.0 - 2.5, 1e-5);
    EXPECT_FLOAT_EQ(share[1 * 8 + 1], 0.5F * 0.75F);
    EXPECT_FLOAT_EQ(share[3 * 8 + 2], 1.0F);
    const Vec2f clockwise[] = {{-3.0F, -2.0F}, {-3.0F, 2.5F}, {1.5F, 2.5F}, {1.5F, -2.0F}};
    ASSERT_EQ(cover_cells({clockwise, 4}, {}, 8, 8, share.data()), Status::ok);
    EXPECT_NEAR(sum(share), 1.5 * 2.5, 1e-6);
    const Vec2f right[] = {{7.0F, 0.0F}, {12.0F, 0.0F}, {12.0F, 5.0F}};
    ASSERT_EQ(cover_cells({right, 3}, {}, 8, 8, share.data()), Status::ok);
    EXPECT_NEAR(sum(share), 0.5, 1e-6);
}

/// By hand: a side that is upright off a cell's middle, and one that leans through two cells.
TEST(Coverage, KnowsWhichSideOfACellIsCovered) {
    std::vector<float> share(4);
    const Vec2f box[] = {{0.25F, 0.0F}, {2.125F, 0.0F}, {2.125F, 1.0F}, {0.25F, 1.0F}};
    ASSERT_EQ(cover_cells({box, 4}, {}, 4, 1, share.data()), Status::ok);
    EXPECT_EQ(share, (std::vector<float>{0.75F, 1.0F, 0.125F, 0.0F}));
    const Vec2f ramp[] = {{0.0F, 0.0F}, {2.0F, 0.0F}, {0.0F, 1.0F}};
    ASSERT_EQ(cover_cells({ramp, 3}, {}, 4, 1, share.data()), Status::ok);
    EXPECT_EQ(share, (std::vector<float>{0.75F, 0.25F, 0.0F, 0.0F}));
}

/// A grid that shows a part of another one has that part's shares, and beyond a polygon there is
/// none at all: no dust of rounding.
TEST(Coverage, OfAPartIsThatOfTheWhole) {
    std::mt19937 random(17);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    constexpr int kWhole = 40;
    constexpr int kPart = 9;
    for (int scene = 0; scene < 200; ++scene) {
        std::vector<Vec2f> whole;
        std::vector<Vec2f> part;
        const int i0 = 1 + int(30 * unit(random));
        const int j0 = 1 + int(30 * unit(random));
        const Point centre{8.0 + 20.0 * unit(random), 8.0 + 20.0 * unit(random)};
        for (const Point p : star(centre, 1.0 + 7.0 * unit(random), 3 + scene % 4, scene)) {
            whole.push_back(convert<float>(p));
            part.push_back({whole.back().x - float(i0), whole.back().y - float(j0)});
        }
        std::vector<float> all(kWhole * kWhole);
        std::vector<float> some(kPart * kPart);
        ASSERT_EQ(cover_cells(whole, {}, kWhole, kWhole, all.data()), Status::ok);
        ASSERT_EQ(cover_cells(part, {}, kPart, kPart, some.data()), Status::ok);
        for (int j = 0; j < kPart; ++j) {
            for (int i = 0; i < kPart; ++i) {
                ASSERT_NEAR(some[std::size_t(j * kPart + i)],
                            all[std::size_t((j0 + j) * kWhole + i0 + i)], 2e-5F) << scene;
            }
        }
        for (int j = 0; j < kWhole; ++j) {
            ASSERT_EQ(all[std::size_t(j * kWhole + kWhole - 1)], 0.0F) << scene << ' ' << j;
        }
    }
}

TEST(Coverage, WritesNothingWhereThereAreNoColumns) {
    const Vec2f square[] = {{-1.0F, 0.0F}, {1.0F, 0.0F}, {1.0F, 2.0F}, {-1.0F, 2.0F}};
    float share = 7.0F;
    EXPECT_EQ(cover_cells(square, {}, 0, 2, &share), Status::ok);
    EXPECT_EQ(share, 7.0F);
}

TEST(Coverage, RefusesWhatIsNoPolygon) {
    float share[4] = {};
    const Vec2f bow[] = {{0.0F, 0.0F}, {2.0F, 2.0F}, {2.0F, 0.0F}, {0.0F, 1.0F}};
    EXPECT_NE(cover_cells({bow, 4}, {}, 2, 2, share), Status::ok);
    const Vec2f good[] = {{0.0F, 0.0F}, {2.0F, 0.0F}, {2.0F, 2.0F}};
    EXPECT_EQ(cover_cells({good, 3}, {}, 2, 2, nullptr), Status::output_missing);
}

TEST(WallNormal, IsRadialAtACircle) {
    Field field;
    std::vector<Point> ring;
    for (int k = 0; k < 400; ++k) {
        const double a = 2.0 * M_PI * k / 400.0;
        ring.push_back({16.2 + 6.0 * std::cos(a), 15.7 + 6.0 * std::sin(a)});
    }
    field.draw(ring, 0);
    for (int k = 0; k < 90; ++k) {
        const double a = 0.07 * k;
        const Vec2f exact{float(std::cos(a)), float(std::sin(a))};
        const Vec2f at = Vec2f{16.2F, 15.7F} + 6.0F * exact;
        const int i = int(at.x);
        const int j = int(at.y);
        const Vec2f n = wall_normal(field.distance.data() + j * kNodes + i, kNodes,
                                    Vec2f{at.x - float(i), at.y - float(j)}, Neighbours{}, 1.5F,
                                    exact);
        EXPECT_LT(std::abs(cross(n, exact)), 0.01F) << k;  // half a degree
    }
}

/// A plane's gradient everywhere in a cell, whatever nodes say that know no wall, or that are none
/// of the field's.
TEST(WallNormal, DoesNotLookWhereThereIsNoWallOrNoNode) {
    constexpr float kFar = 1.5F;
    const Vec2f slope{0.6F, -0.8F};
    for (int side = 0; side < 4; ++side) {
        for (const bool beyond : {false, true}) {
            float node[16];
            for (int k = 0; k < 16; ++k) {
                const Vec2f from{static_cast<float>(k % 4) - 1.5F,
                                 static_cast<float>(k / 4) - 1.5F};
                const bool off = side == 0   ? k % 4 == 0
                                 : side == 1 ? k % 4 == 3
                                 : side == 2 ? k / 4 == 0
                                             : k / 4 == 3;
                node[k] = off ? (beyond ? -100.0F : kFar) : 0.5F * dot(slope, from);
            }
            const Neighbours has{!beyond || side != 0, !beyond || side != 1, !beyond || side != 2,
                                 !beyond || side != 3};
            for (const Vec2f at : {Vec2f{0.1F, 0.2F}, {0.9F, 0.1F}, {0.2F, 0.8F}, {0.7F, 0.9F}}) {
                const Vec2f n = distance_gradient(node + 5, 4, at, has, kFar);
                EXPECT_NEAR(n.x, 0.3F, 1e-6F) << side << beyond;
                EXPECT_NEAR(n.y, -0.4F, 1e-6F) << side << beyond;
            }
        }
    }
}

TEST(WallNormal, KeepsTheLinesOwnWhereTheFieldBends) {
    // A sheet one cell thick: nodes on both sides, the gradient across it says nothing.
    const float node[] = {0.6F, 0.6F, 0.6F, 0.6F, -0.4F, -0.4F, -0.4F, -0.4F,
                          0.6F, 0.6F, 0.6F, 0.6F, 1.5F,  1.5F,  1.5F,  1.5F};
    const Vec2f line{0.6F, -0.8F};
    const Vec2f n = wall_normal(node + 5, 4, Vec2f{0.5F, 0.4F}, Neighbours{}, 1.5F, line);
    EXPECT_EQ(n.x, line.x);
    EXPECT_EQ(n.y, line.y);
}

}  // namespace
}  // namespace weir
