// The contour of one cell: 16 cases by hand, saddles both ways, straight walls, open parts.
#include "contour/marching_squares.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "test_world.hpp"

namespace weir {
namespace {

constexpr double kDiagonal = 0.70710678118654752;
constexpr double kPi = 3.14159265358979324;

struct Line {
    Vec2<double> from;
    Vec2<double> to;
    Vec2<double> normal;
};

// Read off a drawing of the unit cell: solid nodes at -½, open ones at +½, all crossings mid-edge.
struct CaseRow {
    double distance[4];
    int lines;
    Line line[2];
    bool both_needed;
    double open_area;
};
constexpr double kS = -0.5;  // solid
constexpr double kO = +0.5;  // open
constexpr double kD = kDiagonal;
const CaseRow kTable[16] = {
    {{kO, kO, kO, kO}, 0, {}, false, 1.0},
    {{kS, kO, kO, kO}, 1, {{{0, 0.5}, {0.5, 0}, {kD, kD}}}, false, 0.875},
    {{kO, kS, kO, kO}, 1, {{{0.5, 0}, {1, 0.5}, {-kD, kD}}}, false, 0.875},
    {{kS, kS, kO, kO}, 1, {{{0, 0.5}, {1, 0.5}, {0, 1}}}, false, 0.5},
    {{kO, kO, kS, kO}, 1, {{{1, 0.5}, {0.5, 1}, {-kD, -kD}}}, false, 0.875},
    {{kS, kO, kS, kO}, 2,  // sum 0: joined, the open corners 1 and 3 are cut off
     {{{1, 0.5}, {0.5, 0}, {kD, -kD}}, {{0, 0.5}, {0.5, 1}, {-kD, kD}}}, true, 0.25},
    {{kO, kS, kS, kO}, 1, {{{0.5, 0}, {0.5, 1}, {-1, 0}}}, false, 0.5},
    {{kS, kS, kS, kO}, 1, {{{0, 0.5}, {0.5, 1}, {-kD, kD}}}, false, 0.125},
    {{kO, kO, kO, kS}, 1, {{{0.5, 1}, {0, 0.5}, {kD, -kD}}}, false, 0.875},
    {{kS, kO, kO, kS}, 1, {{{0.5, 1}, {0.5, 0}, {1, 0}}}, false, 0.5},
    {{kO, kS, kO, kS}, 2,  // sum 0: joined, the open corners 0 and 2 are cut off
     {{{0.5, 0}, {0, 0.5}, {-kD, -kD}}, {{0.5, 1}, {1, 0.5}, {kD, kD}}}, true, 0.25},
    {{kS, kS, kO, kS}, 1, {{{0.5, 1}, {1, 0.5}, {kD, kD}}}, false, 0.125},
    {{kO, kO, kS, kS}, 1, {{{1, 0.5}, {0, 0.5}, {0, -1}}}, false, 0.5},
    {{kS, kO, kS, kS}, 1, {{{1, 0.5}, {0.5, 0}, {kD, -kD}}}, false, 0.125},
    {{kO, kS, kS, kS}, 1, {{{0.5, 0}, {0, 0.5}, {-kD, -kD}}}, false, 0.125},
    {{kS, kS, kS, kS}, 0, {}, true, 0.0},
};

// Node k of the cell.
const Vec2<double> kNode[4] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};

template <class Real>
struct Distances {
    Real at[4];
};
template <class Real>
Distances<Real> distances(const double (&d)[4]) {
    return {{Real(d[0]), Real(d[1]), Real(d[2]), Real(d[3])}};
}

template <class Real>
void expect_near(Vec2<Real> found, Vec2<double> wanted, double tolerance = 1e-6) {
    EXPECT_NEAR(static_cast<double>(found.x), wanted.x, tolerance);
    EXPECT_NEAR(static_cast<double>(found.y), wanted.y, tolerance);
}

template <class Real>
void expect_line(const ContourLine<Real>& found, const Line& wanted) {
    expect_near(found.from, wanted.from);
    expect_near(found.to, wanted.to);
    expect_near(found.normal, wanted.normal);
}

using Reals = testing::Types<float, double>;
WEIR_SUITE(MarchingSquares, Reals);

TYPED_TEST(MarchingSquares, SixteenCases) {
    for (int which = 0; which < 16; ++which) {
        SCOPED_TRACE(which);
        const CaseRow& row = kTable[which];
        const auto d = distances<TypeParam>(row.distance);
        EXPECT_EQ(contour_case(d.at), which);
        const auto cell = contour_cell(d.at);
        ASSERT_EQ(cell.lines, row.lines);
        EXPECT_EQ(cell.both_needed, row.both_needed);
        for (int i = 0; i < row.lines; ++i) {
            expect_line(cell.line[i], row.line[i]);
        }
        EXPECT_EQ(static_cast<double>(open_area(d.at)), row.open_area);
    }
}

TYPED_TEST(MarchingSquares, SidesOfTheSixteenCases) {
    for (int which = 0; which < 16; ++which) {
        SCOPED_TRACE(which);
        const CaseRow& row = kTable[which];
        const auto d = distances<TypeParam>(row.distance);
        const auto cell = contour_cell(d.at);
        for (int k = 0; k < 4; ++k) {
            const auto hit = contour_hit(d.at, convert<TypeParam>(kNode[k]));
            EXPECT_EQ(hit.distance < TypeParam(0), row.distance[k] < 0.0) << k;
        }
        for (int i = 0; i < cell.lines; ++i) {  // solid right, liquid left of from → to
            const auto along = cell.line[i].to - cell.line[i].from;
            EXPECT_GT(cross(along, cell.line[i].normal), TypeParam(0));
            EXPECT_NEAR(static_cast<double>(dot(along, cell.line[i].normal)), 0.0, 1e-6);
        }
    }
}

TYPED_TEST(MarchingSquares, SaddlesAreSeparateWhenTheSumIsPositive) {
    const auto five = distances<TypeParam>({-0.25, 0.75, -0.25, 0.75});
    const auto cell_5 = contour_cell(five.at);
    ASSERT_EQ(contour_case(five.at), 5);
    ASSERT_EQ(cell_5.lines, 2);
    EXPECT_FALSE(cell_5.both_needed);
    expect_line(cell_5.line[0], {{0, 0.25}, {0.25, 0}, {kD, kD}});
    expect_line(cell_5.line[1], {{1, 0.75}, {0.75, 1}, {-kD, -kD}});
    EXPECT_NEAR(static_cast<double>(open_area(five.at)), 1.0 - 2.0 * 0.03125, 1e-6);
    EXPECT_GT(contour_hit(five.at, {TypeParam(0.5), TypeParam(0.5)}).distance, TypeParam(0));

    const auto ten = distances<TypeParam>({0.75, -0.25, 0.75, -0.25});
    const auto cell_10 = contour_cell(ten.at);
    ASSERT_EQ(contour_case(ten.at), 10);
    ASSERT_EQ(cell_10.lines, 2);
    EXPECT_FALSE(cell_10.both_needed);
    expect_line(cell_10.line[0], {{0.75, 0}, {1, 0.25}, {-kD, kD}});
    expect_line(cell_10.line[1], {{0.25, 1}, {0, 0.75}, {kD, -kD}});
    EXPECT_NEAR(static_cast<double>(open_area(ten.at)), 1.0 - 2.0 * 0.03125, 1e-6);
}

TYPED_TEST(MarchingSquares, SaddlesAreJoinedWhenTheSumIsNotPositive) {
    const auto five = distances<TypeParam>({-0.75, 0.25, -0.75, 0.25});
    const auto cell_5 = contour_cell(five.at);
    ASSERT_EQ(cell_5.lines, 2);
    EXPECT_TRUE(cell_5.both_needed);
    expect_line(cell_5.line[0], {{1, 0.25}, {0.75, 0}, {kD, -kD}});
    expect_line(cell_5.line[1], {{0, 0.75}, {0.25, 1}, {-kD, kD}});
    EXPECT_NEAR(static_cast<double>(open_area(five.at)), 2.0 * 0.03125, 1e-6);
    EXPECT_LT(contour_hit(five.at, {TypeParam(0.5), TypeParam(0.5)}).distance, TypeParam(0));

    const auto ten = distances<TypeParam>({0.25, -0.75, 0.25, -0.75});
    const auto cell_10 = contour_cell(ten.at);
    ASSERT_EQ(cell_10.lines, 2);
    EXPECT_TRUE(cell_10.both_needed);
    expect_line(cell_10.line[0], {{0.25, 0}, {0, 0.25}, {-kD, -kD}});
    expect_line(cell_10.line[1], {{0.75, 1}, {1, 0.75}, {kD, kD}});
}

TYPED_TEST(MarchingSquares, SaddleGivesTheLineToLeaveBy) {
    // Joined 5: solid is a band from node 0 to node 2; leave it by the nearer rim.
    const auto joined = distances<TypeParam>({-0.75, 0.25, -0.75, 0.25});
    const auto below = contour_hit(joined.at, {TypeParam(0.7), TypeParam(0.3)});
    expect_near(below.normal, {kD, -kD});
    EXPECT_NEAR(static_cast<double>(below.distance), (0.4 - 0.75) * kD, 1e-6);
    const auto above = contour_hit(joined.at, {TypeParam(0.3), TypeParam(0.7)});
    expect_near(above.normal, {-kD, kD});
    // Separate 5: solids at nodes 0 and 2; a point in one of them leaves by that one's line.
    const auto separate = distances<TypeParam>({-0.25, 0.75, -0.25, 0.75});
    const auto low = contour_hit(separate.at, {TypeParam(0.1), TypeParam(0.1)});
    expect_near(low.normal, {kD, kD});
    EXPECT_NEAR(static_cast<double>(low.distance), -0.05 * kD, 1e-6);
    const auto high = contour_hit(separate.at, {TypeParam(0.9), TypeParam(0.9)});
    expect_near(high.normal, {-kD, -kD});
    EXPECT_NEAR(static_cast<double>(high.distance), -0.05 * kD, 1e-6);
}

TYPED_TEST(MarchingSquares, CellsWithoutLines) {
    const auto open = distances<TypeParam>({2, 3, 3, 2});
    const auto full = distances<TypeParam>({-2, -3, 0, -2});
    const Vec2<TypeParam> p{TypeParam(0.5), TypeParam(0.5)};
    EXPECT_EQ(contour_hit(open.at, p).distance, TypeParam(1));
    EXPECT_EQ(contour_hit(full.at, p).distance, TypeParam(-1));
    EXPECT_EQ(contour_hit(full.at, p).normal.x, TypeParam(0));
}

TYPED_TEST(MarchingSquares, StraightWallsAreExactAt25Angles) {
    int with_line = 0;
    for (int k = 0; k < 25; ++k) {
        const double angle = 2.0 * kPi * (k + 0.37) / 25.0;
        const Vec2<double> normal{std::cos(angle), std::sin(angle)};
        for (double offset = -1.4; offset <= 1.4; offset += 0.0937) {
            double d[4];
            for (int node = 0; node < 4; ++node) {
                d[node] = dot(normal, kNode[node]) - offset;
            }
            const auto given = distances<TypeParam>(d);
            const auto cell = contour_cell(given.at);
            ASSERT_LE(cell.lines, 1);
            if (cell.lines == 0) {
                continue;
            }
            ++with_line;
            const auto& line = cell.line[0];
            EXPECT_NEAR(dot(normal, convert<double>(line.from)) - offset, 0.0, 1e-6);
            EXPECT_NEAR(dot(normal, convert<double>(line.to)) - offset, 0.0, 1e-6);
            const double off = std::atan2(cross(normal, convert<double>(line.normal)),
                                          dot(normal, convert<double>(line.normal)));
            EXPECT_LT(std::fabs(off) * 180.0 / kPi, 0.01) << angle << ' ' << offset;
            EXPECT_NEAR(static_cast<double>(length(line.normal)), 1.0, 1e-6);
            for (double y = 0.05; y < 1.0; y += 0.3) {
                for (double x = 0.05; x < 1.0; x += 0.3) {
                    const Vec2<TypeParam> p{TypeParam(x), TypeParam(y)};
                    EXPECT_NEAR(static_cast<double>(contour_hit(given.at, p).distance),
                                normal.x * x + normal.y * y - offset, 1e-6);
                }
            }
        }
    }
    EXPECT_GT(with_line, 300);
}

TYPED_TEST(MarchingSquares, WallOnNodesKeepsItsLine) {
    // Solid below y = 0: the cell above has its line on its lower rim, the face there is closed.
    const auto above = distances<TypeParam>({0, 0, 1, 1});
    ASSERT_EQ(contour_case(above.at), 3);
    expect_line(contour_cell(above.at).line[0], {{0, 0}, {1, 0}, {0, 1}});
    EXPECT_EQ(open_area(above.at), TypeParam(1));
    EXPECT_EQ(open_fraction(above.at[0], above.at[1]), TypeParam(0));
    EXPECT_EQ(open_fraction(above.at[0], above.at[3]), TypeParam(1));
    const auto below = distances<TypeParam>({-1, -1, 0, 0});
    EXPECT_EQ(contour_case(below.at), 15);
    EXPECT_EQ(open_area(below.at), TypeParam(0));
    // One cell thick, on nodes: full, not lost.
    const auto thin = distances<TypeParam>({0, 0, 0, 0});
    EXPECT_EQ(contour_case(thin.at), 15);
    const auto minus_zero = distances<TypeParam>({-0.0, -0.0, -0.0, -0.0});
    EXPECT_EQ(contour_case(minus_zero.at), 15);
    // Through two opposite nodes.
    const auto diagonal = distances<TypeParam>({0, -kDiagonal, 0, kDiagonal});
    ASSERT_EQ(contour_case(diagonal.at), 7);
    expect_line(contour_cell(diagonal.at).line[0], {{0, 0}, {1, 1}, {-kD, kD}});
    EXPECT_NEAR(static_cast<double>(open_area(diagonal.at)), 0.5, 1e-6);
}

TYPED_TEST(MarchingSquares, LineShrunkToANodeHasANormal) {
    const auto touch = distances<TypeParam>({0, 0.8, 1.4, 0.6});
    ASSERT_EQ(contour_case(touch.at), 1);
    const auto cell = contour_cell(touch.at);
    expect_line(cell.line[0], {{0, 0}, {0, 0}, {0.8, 0.6}});
    EXPECT_EQ(open_area(touch.at), TypeParam(1));
    const TypeParam tiny = std::numeric_limits<TypeParam>::denorm_min();
    const TypeParam flat[4] = {TypeParam(0), tiny, TypeParam(1), tiny};
    expect_near(contour_cell(flat).line[0].normal, {kD, kD});
    const TypeParam almost[4] = {-tiny, -tiny, tiny, tiny};
    expect_line(contour_cell(almost).line[0], {{0, 0.5}, {1, 0.5}, {0, 1}});
}

TYPED_TEST(MarchingSquares, EverySignAndZeroIsFinite) {
    const TypeParam small = std::numeric_limits<TypeParam>::min();
    const TypeParam values[] = {TypeParam(-4),   TypeParam(-0.3), -small, TypeParam(0), small,
                                TypeParam(1e-7), TypeParam(0.6),  TypeParam(4)};
    for (int code = 0; code < 8 * 8 * 8 * 8; ++code) {
        TypeParam d[4];
        for (int k = 0, rest = code; k < 4; ++k, rest /= 8) {
            d[k] = values[rest % 8];
        }
        const auto cell = contour_cell(d);
        for (int i = 0; i < cell.lines; ++i) {
            const auto& line = cell.line[i];
            ASSERT_NEAR(static_cast<double>(length(line.normal)), 1.0, 1e-6) << code;
            for (const auto end : {line.from, line.to}) {
                ASSERT_TRUE(end.x >= 0 && end.x <= 1 && end.y >= 0 && end.y <= 1) << code;
            }
            const auto along = line.to - line.from;
            ASSERT_NEAR(static_cast<double>(dot(along, line.normal)), 0.0, 1e-6) << code;
            ASSERT_GE(cross(along, line.normal), TypeParam(0)) << code;
        }
        const TypeParam area = open_area(d);
        ASSERT_TRUE(area >= 0 && area <= 1) << code;
    }
}

TYPED_TEST(MarchingSquares, NeighboursShareTheirCrossingToTheBit) {
    std::mt19937 random(9);
    std::uniform_real_distribution<double> size(0.001, 1.0);
    for (int trial = 0; trial < 1000; ++trial) {
        const auto inside = static_cast<TypeParam>(-size(random));
        const auto outside = static_cast<TypeParam>(size(random));
        const auto beyond = static_cast<TypeParam>(size(random));
        // One edge, solid at its lower end, seen from the cell to its left and to its right, and
        // another solid at its upper end.
        const TypeParam left[4] = {beyond, inside, outside, beyond};
        const TypeParam right[4] = {inside, -beyond, beyond, outside};
        const TypeParam crossing = contour_cell(left).line[0].to.y;
        EXPECT_EQ(contour_cell(right).line[0].from.y, crossing);
        EXPECT_NEAR(static_cast<double>(open_fraction(inside, outside)),
                    static_cast<double>(TypeParam(1) - crossing), 1e-6);
        const TypeParam above[4] = {inside, outside, beyond, beyond};
        const TypeParam below[4] = {-beyond, -beyond, outside, inside};
        EXPECT_EQ(contour_cell(above).line[0].to.x, contour_cell(below).line[0].from.x);
    }
}

TYPED_TEST(MarchingSquares, OpenFractionTable) {
    const double table[][3] = {
        {1, 2, 1},      {0.1, 0.1, 1}, {-1, -2, 0}, {-0.5, 0.5, 0.5}, {0.5, -0.5, 0.5},
        {-1, 3, 0.75},  {3, -1, 0.75}, {-3, 1, 0.25}, {0, 1, 1},      {1, 0, 1},
        {0, -1, 0},     {-1, 0, 0},    {0, 0, 0},   {-1e-30, 1, 1},   {1e-30, -1, 1e-30},
    };
    for (const auto& row : table) {
        EXPECT_NEAR(static_cast<double>(open_fraction(TypeParam(row[0]), TypeParam(row[1]))),
                    row[2], 1e-7)
            << row[0] << ' ' << row[1];
    }
}

// --- the cut cell as a polygon, clipped by each line in turn -----------------------------------

using Shape = std::vector<Vec2<double>>;

/// The part of a convex shape where side · dot(p - from, normal) ≥ 0 (Sutherland & Hodgman 1974).
Shape clip(const Shape& shape, const ContourLine<double>& line, double side) {
    Shape result;
    for (std::size_t k = 0; k < shape.size(); ++k) {
        const Vec2<double> a = shape[k];
        const Vec2<double> b = shape[(k + 1) % shape.size()];
        const double da = side * dot(a - line.from, line.normal);
        const double db = side * dot(b - line.from, line.normal);
        if (da >= 0.0) {
            result.push_back(a);
        }
        if ((da < 0.0) != (db < 0.0)) {
            result.push_back(a + (da / (da - db)) * (b - a));
        }
    }
    return result;
}

double area_of(const Shape& shape) {
    double sum = 0.0;
    for (std::size_t k = 0; k < shape.size(); ++k) {
        sum += 0.5 * cross(shape[k], shape[(k + 1) % shape.size()]);
    }
    return sum;
}

TYPED_TEST(MarchingSquares, OpenAreaMatchesClippingInAllCases) {
    std::mt19937 random(10);
    std::uniform_real_distribution<double> size(0.01, 1.0);
    int saddles[2] = {0, 0};
    for (int trial = 0; trial < 16 * 200; ++trial) {
        const int which = trial % 16;
        double d[4];
        for (int k = 0; k < 4; ++k) {
            d[k] = (which >> k & 1) != 0 ? -size(random) : size(random);
        }
        const auto cell = contour_cell<double>(d);
        const Shape whole = {kNode[0], kNode[1], kNode[2], kNode[3]};
        double open = cell.both_needed ? 0.0 : 1.0;
        if (cell.lines == 1) {
            open = area_of(clip(whole, cell.line[0], 1.0));
        } else if (cell.lines == 2) {
            ++saddles[cell.both_needed ? 1 : 0];
            const double side = cell.both_needed ? -1.0 : 1.0;
            const double band = area_of(clip(clip(whole, cell.line[0], side), cell.line[1], side));
            open = cell.both_needed ? 1.0 - band : band;
        }
        const auto given = distances<TypeParam>(d);
        EXPECT_NEAR(static_cast<double>(open_area(given.at)), open, 1e-6) << which;
    }
    EXPECT_GT(saddles[0], 50);
    EXPECT_GT(saddles[1], 50);
}

TYPED_TEST(MarchingSquares, OpenMomentsMatchSamplesInAllCases) {
    std::mt19937 random(12);
    std::uniform_real_distribution<double> size(0.01, 1.0);
    for (int trial = 0; trial < 16 * 8; ++trial) {
        const int which = trial % 16;
        double d[4];
        for (int k = 0; k < 4; ++k) {
            d[k] = (which >> k & 1) != 0 ? -size(random) : size(random);
        }
        constexpr int kSamples = 100;
        OpenMoments<double> sum;
        for (int k = 0; k < kSamples * kSamples; ++k) {
            const Vec2<double> p{(k % kSamples + 0.5) / kSamples, (k / kSamples + 0.5) / kSamples};
            if (contour_hit(d, p).distance > 0.0) {
                const double part = 1.0 / (kSamples * kSamples);
                const double x = p.x - 0.5;
                const double y = p.y - 0.5;
                sum.area += part;
                sum.first = sum.first + part * Vec2<double>{x, y};
                sum.upper = sum.upper + part * Vec2<double>{std::max(x, 0.0), std::max(y, 0.0)};
                sum.x_above += part * x * std::max(y, 0.0);
                sum.y_right += part * y * std::max(x, 0.0);
                sum.product += part * x * y;
            }
        }
        const auto given = distances<TypeParam>(d);
        const auto open = open_moments(given.at);
        const auto expect = [&](auto value, double exact) {
            EXPECT_NEAR(static_cast<double>(value), exact, 2e-3) << which;
        };
        EXPECT_NEAR(static_cast<double>(open.area), static_cast<double>(open_area(given.at)), 1e-4);
        expect(open.first.x, sum.first.x);
        expect(open.first.y, sum.first.y);
        expect(open.upper.x, sum.upper.x);
        expect(open.upper.y, sum.upper.y);
        expect(open.x_above, sum.x_above);
        expect(open.y_right, sum.y_right);
        expect(open.product, sum.product);
    }
}

}  // namespace
}  // namespace weir
