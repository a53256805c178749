// Points checks, area, inside test and distances, against answers worked out by hand and against
// brute force in double.
#include "geometry/polygon.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <vector>

#include "geometry/convex_decomposition.hpp"
#include "geometry/signed_distance.hpp"
#include "test_world.hpp"
#include "weir/config.hpp"

namespace weir {
namespace {

using Points = std::vector<Vec2f>;

Status check(const Points& outline) {
    return check_polygon({outline.data(), static_cast<std::int32_t>(outline.size())});
}

template <class Real>
std::vector<Vec2<Real>> ring_of(const Points& outline) {
    std::vector<Vec2<Real>> ring;
    for (const Vec2f v : outline) {
        ring.push_back(convert<Real>(v));
    }
    return ring;
}

const Points kSquare = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};

TEST(CheckPolygon, AcceptsSimpleCounterClockwiseOutlines) {
    EXPECT_EQ(check(kSquare), Status::ok);
    EXPECT_EQ(check({{0, 0}, {1, 0}, {0, 1}}), Status::ok);
    EXPECT_EQ(check({{0, 0}, {2, 0}, {2, 2}, {1, 0.5F}, {0, 2}}), Status::ok);   // reflex
    EXPECT_EQ(check({{0, 0}, {1, 0}, {2, 0}, {2, 1}, {0, 1}}), Status::ok);      // straight
    EXPECT_EQ(check({{0, 0}, {100, 0}, {100, 0.001F}, {0, 0.001F}}), Status::ok);  // thin wall
}

TEST(CheckPolygon, MissingComesFirst) {
    EXPECT_EQ(check_polygon({nullptr, 5}), Status::polygon_missing);
    EXPECT_EQ(check_polygon({}), Status::polygon_missing);
}

TEST(CheckPolygon, CountsVertices) {
    EXPECT_EQ(check_polygon({kSquare.data(), 0}), Status::polygon_too_few_vertices);
    EXPECT_EQ(check_polygon({kSquare.data(), 2}), Status::polygon_too_few_vertices);
    EXPECT_EQ(check_polygon({kSquare.data(), -3}), Status::polygon_too_few_vertices);
    EXPECT_EQ(check_polygon({kSquare.data(), 3}), Status::ok);
}

TEST(CheckPolygon, LimitOfVerticesAndOneBeyond) {
    // A row of teeth along x over a straight base: cheap for the pair test, as boxes are disjoint.
    Points comb = {{0, -1}, {static_cast<float>(kMaxBodyVertices), -1}};
    for (std::int32_t i = kMaxBodyVertices - 2; i > 0; --i) {
        comb.push_back({static_cast<float>(i), i % 2 == 0 ? 0.0F : 0.5F});
    }
    ASSERT_EQ(comb.size(), static_cast<std::size_t>(kMaxBodyVertices));
    EXPECT_EQ(check(comb), Status::ok);
    comb.push_back({0, 0});
    EXPECT_EQ(check(comb), Status::polygon_too_many_vertices);
}

TEST(CheckPolygon, NotFiniteAtEveryPlace) {
    const float bad[] = {std::numeric_limits<float>::infinity(),
                         -std::numeric_limits<float>::infinity(),
                         std::numeric_limits<float>::quiet_NaN()};
    for (const float value : bad) {
        for (std::size_t k = 0; k < kSquare.size(); ++k) {
            Points x = kSquare;
            x[k].x = value;
            EXPECT_EQ(check(x), Status::polygon_not_finite);
            Points y = kSquare;
            y[k].y = value;
            EXPECT_EQ(check(y), Status::polygon_not_finite);
        }
    }
}

TEST(CheckPolygon, RepeatedVerticesAreFine) {
    for (std::size_t k = 0; k < kSquare.size(); ++k) {
        for (const std::size_t times : {1U, 2U, 40U}) {
            Points outline = kSquare;
            outline.insert(outline.begin() + static_cast<std::ptrdiff_t>(k), times, outline[k]);
            EXPECT_EQ(check(outline), Status::ok) << k;
        }
    }
    Points closed = kSquare;
    closed.push_back(kSquare[0]);
    EXPECT_EQ(check(closed), Status::ok);
    EXPECT_EQ(check({{0.0F, 0}, {-0.0F, 0}, {1, 0}, {0, 1}}), Status::ok);
    EXPECT_EQ(check({{1, 2}, {1, 2}, {1, 2}}), Status::polygon_zero_area);
    EXPECT_EQ(check({{1, 2}, {1, 2}, {2, 2}, {1, 2}}), Status::polygon_zero_area);
}

TEST(CheckPolygon, ZeroAreaIsRelativeToTheDiagonal) {
    EXPECT_EQ(check({{0, 0}, {1, 0}, {2, 0}}), Status::polygon_zero_area);
    EXPECT_EQ(check({{0, 0}, {1, 1}, {3, 3}, {2, 2}}), Status::polygon_zero_area);
    for (const float scale : {1e-20F, 1.0F, 1e15F}) {
        const auto bar = [&](float thickness) {
            return check({{0, 0}, {scale, 0}, {scale, thickness * scale}, {0, thickness * scale}});
        };
        EXPECT_EQ(bar(0.9e-6F), Status::polygon_zero_area) << scale;
        EXPECT_EQ(bar(1.1e-6F), Status::ok) << scale;
    }
}

TEST(CheckPolygon, CrossesOrTouchesItself) {
    const Points table[] = {
        {{0, 0}, {2, 0}, {0, 1}, {2, 2}},                                  // bow tie, no area
        {{0, 0}, {2, 0}, {0, 1}, {2, 4}},                                  // unequal bow tie
        {{0, 0}, {4, 0}, {4, 4}, {2, 0}, {0, 4}},                          // vertex on an edge
        {{0, 0}, {4, 0}, {4, 4}, {2, -1}, {0, 4}},                         // through an edge
        {{0, 0}, {2, 0}, {2, 2}, {1, 1}, {2, 4}, {0, 4}, {1, 1}},          // vertex on vertex
        {{0, 0}, {2, 0}, {2, 1}, {3, 1}, {2, 1}, {2, 2}, {0, 2}},          // spike
        {{0, 0}, {3, 0}, {2, 0}, {2, 2}, {0, 2}},                          // fold
        {{2, 0}, {2, 2}, {0, 2}, {0, 0}, {3, 0}},                          // fold at the seam
        {{0, 0}, {4, 0}, {4, 2}, {3, 2}, {3, 0}, {1, 0}, {1, 2}, {0, 2}},  // edge on an edge
    };
    const Status crosses = Status::polygon_crosses_itself;
    for (const Points& outline : table) {
        EXPECT_EQ(check(outline), crosses) << &outline - table;
    }
    Points pentagram;
    for (int k = 0; k < 5; ++k) {
        const double angle = 4.0 * M_PI * k / 5.0;
        pentagram.push_back({static_cast<float>(std::cos(angle)),
                             static_cast<float>(std::sin(angle))});
    }
    EXPECT_EQ(check(pentagram), crosses);
}

TEST(CheckPolygon, TellsATouchFromTheNextFloat) {
    // Of 4 a step of the grid is 8 / 2^29; the next float above 0 is no step from it.
    EXPECT_EQ(check({{0, 0}, {4, 0}, {4, 4}, {2, 2e-8F}, {0, 4}}), Status::ok);
    const float above = std::nextafter(0.0F, 1.0F);
    EXPECT_EQ(check({{0, 0}, {4, 0}, {4, 4}, {2, above}, {0, 4}}),
              Status::polygon_crosses_itself);
    const float beside = std::nextafter(3.0F, 0.0F);
    EXPECT_EQ(check({{0, 0}, {4, 0}, {4, 4}, {1, 3}, {beside, beside}, {0, 4}}),
              Status::polygon_crosses_itself);
    EXPECT_EQ(check({{0, 0}, {4, 4}, {0, 4}, {2, std::nextafter(2.0F, 4.0F)}}), Status::ok);
    EXPECT_EQ(check({{0, 0}, {4, 4}, {0, 4}, {2, 2}}), Status::polygon_crosses_itself);
    std::mt19937 random(1);
    for (int trial = 0; trial < 200; ++trial) {  // on a lattice as fine as floats are
        const auto pick = [&] { return static_cast<std::int64_t>(random() % 4000000 + 4000000); };
        const std::int64_t bx = pick();
        const std::int64_t by = pick();
        const std::int64_t cx = bx / 3;
        const std::int64_t cy = cx * by / bx + trial % 2;  // just below or above the edge to b
        const Points outline = {{0, 0},
                                 {static_cast<float>(bx), static_cast<float>(by)},
                                 {0, 8e6F},
                                 {static_cast<float>(cx), static_cast<float>(cy)}};
        EXPECT_EQ(check(outline),
                  bx * cy - by * cx > 0 ? Status::ok : Status::polygon_crosses_itself);
    }
}

TEST(CheckPolygon, EitherWayRound) {
    EXPECT_EQ(check({{0, 1}, {1, 1}, {1, 0}, {0, 0}}), Status::ok);
    EXPECT_EQ(check({{0, 2}, {1, 0.5F}, {2, 2}, {2, 0}, {0, 0}}), Status::ok);
}

TEST(CheckPolygon, EveryFiniteFloatGetsAnAnswer) {
    const float big = std::numeric_limits<float>::max();
    EXPECT_EQ(check({{-big, -big}, {big, -big}, {big, big}, {-big, big}}), Status::ok);
    EXPECT_EQ(check({{-big, big}, {big, big}, {big, -big}, {-big, -big}}), Status::ok);
    const float small = 1e-30F;
    EXPECT_EQ(check({{0, 0}, {small, 0}, {small, small}, {0, small}}), Status::ok);
    const float tiny = std::numeric_limits<float>::denorm_min();
    EXPECT_EQ(check({{0, 0}, {tiny, 0}, {tiny, tiny}, {0, tiny}}), Status::polygon_zero_area);
    EXPECT_EQ(check({{0, 0}, {1e30F, 0}, {1e30F, 1e30F}, {-1e30F, 1e30F}}), Status::ok);
    EXPECT_EQ(check({{0, 0}, {big, tiny}, {-big, tiny}}), Status::polygon_zero_area);
    std::mt19937 random(7);
    for (int trial = 0; trial < 2000; ++trial) {
        Points outline(3 + random() % 6);
        for (Vec2f& v : outline) {
            const std::uint32_t bits[2] = {static_cast<std::uint32_t>(random()),
                                           static_cast<std::uint32_t>(random())};
            std::memcpy(&v, bits, sizeof v);
        }
        EXPECT_LT(check(outline), Status::count);
    }
}

using Reals = testing::Types<float, double>;
WEIR_SUITE(GeometryTest, Reals);

template <class Real>
Vec2<Real> point_of(double x, double y) {
    return {static_cast<Real>(x), static_cast<Real>(y)};
}

TYPED_TEST(GeometryTest, TurnAndArea) {
    using Point = Vec2<TypeParam>;
    const auto at = point_of<TypeParam>;
    EXPECT_EQ(turn(at(0, 0), at(2, 0), at(0, 3)), TypeParam(6));
    const Point ell[] = {{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 4}, {0, 4}};
    EXPECT_EQ(twice_signed_area(ell, 6), TypeParam(12));
    const Point reversed[] = {{0, 4}, {1, 4}, {1, 1}, {3, 1}, {3, 0}, {0, 0}};
    EXPECT_EQ(twice_signed_area(reversed, 6), TypeParam(-12));
    const Point far_out[] = {{4096, 4096}, {4097, 4096}, {4096, 4097}};
    EXPECT_EQ(twice_signed_area(far_out, 3), TypeParam(1));
}

TYPED_TEST(GeometryTest, DistanceToSegment) {
    using Point = Vec2<TypeParam>;
    const auto at = point_of<TypeParam>;
    const Point a{1, 1};
    const Point b{4, 5};
    EXPECT_EQ(distance_to_segment(at(1, 1), a, b), TypeParam(0));
    EXPECT_EQ(distance_to_segment(at(4, 5), a, b), TypeParam(0));
    EXPECT_EQ(distance_to_segment(at(2.5, 3), a, b), TypeParam(0));
    EXPECT_EQ(distance_to_segment(at(-2, -3), a, b), TypeParam(5));  // before a
    EXPECT_EQ(distance_to_segment(at(4, 7), a, b), TypeParam(2));    // after b
    EXPECT_EQ(distance_to_segment(at(6.5, 0), a, b), TypeParam(5));   // right: middle + (4, -3)
    EXPECT_EQ(distance_to_segment(at(-1.5, 6), a, b), TypeParam(5));  // left
    EXPECT_EQ(distance_to_segment(at(4, 5), a, a), TypeParam(5));    // no length
}

TYPED_TEST(GeometryTest, PointsOnAWallAreAtExactlyZero) {
    using Point = Vec2<TypeParam>;
    const auto at = point_of<TypeParam>;
    const Point a{TypeParam(0.1), 7};
    const Point b{TypeParam(61.7), 7};
    for (int i = 1; i < 61; ++i) {
        EXPECT_EQ(distance_to_segment(at(i, 7), a, b), TypeParam(0));
        EXPECT_NEAR(static_cast<double>(distance_to_segment(at(i, 9), a, b)), 2.0, 5e-7);
    }
}

TYPED_TEST(GeometryTest, DistanceToOutlineIsCutOff) {
    const auto at = point_of<TypeParam>;
    const auto ring = ring_of<TypeParam>(kSquare);
    const auto distance = [&](double x, double y, double far) {
        return distance_to_outline(Outline<TypeParam>{ring.data(), 4}, at(x, y), TypeParam(far));
    };
    EXPECT_EQ(distance(0.5, 0.5, 4), TypeParam(0.5));
    EXPECT_EQ(distance(0.5, 0.25, 4), TypeParam(0.25));
    EXPECT_EQ(distance(4, 5, 9), TypeParam(5));
    EXPECT_EQ(distance(4, 5, 4), TypeParam(4));
    EXPECT_EQ(distance(0.5, 0.5, 0.25), TypeParam(0.25));
    EXPECT_EQ(distance(1000, 5, 4), TypeParam(4));
}

// --- brute force, in double, by other formulas -------------------------------------------------

double brute_distance(const std::vector<Vec2<double>>& ring, Vec2<double> p) {
    double nearest = 1e300;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Vec2<double> a = ring[i];
        const Vec2<double> d = ring[(i + 1) % ring.size()] - a;
        const double t = std::fmin(1.0, std::fmax(0.0, dot(p - a, d) / dot(d, d)));
        const Vec2<double> foot = a + t * d;
        nearest = std::fmin(nearest, std::hypot(p.x - foot.x, p.y - foot.y));
    }
    return nearest;
}

/// By the sum of the angles under which the edges are seen.
bool brute_inside(const std::vector<Vec2<double>>& ring, Vec2<double> p) {
    double angle = 0.0;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Vec2<double> a = ring[i] - p;
        const Vec2<double> b = ring[(i + 1) % ring.size()] - p;
        angle += std::atan2(cross(a, b), dot(a, b));
    }
    return angle > M_PI;
}

template <class Real>
void expect_distances_right(const Points& outline, double tolerance) {
    const auto count = static_cast<std::int32_t>(outline.size());
    const auto ring = ring_of<Real>(outline);
    const auto exact = ring_of<double>(outline);
    const Outline<Real> walls{ring.data(), count};
    const double far = 1.0;
    for (double y = -2.0; y <= 12.0; y += 0.25) {
        for (double x = -2.0; x <= 12.0; x += 0.25) {
            const bool inside = brute_inside(exact, {x, y});
            const double full = brute_distance(exact, {x, y});
            const double brute = inside ? full : std::fmin(far, full);
            const Vec2<Real> p{static_cast<Real>(x), static_cast<Real>(y)};
            const double distance =
                static_cast<double>(distance_to_outline(walls, p, Real(inside ? 100.0 : far)));
            ASSERT_NEAR(distance, brute, tolerance) << x << ' ' << y;
            if (brute > tolerance) {
                ASSERT_EQ(covers(walls, p), inside) << x << ' ' << y;
            }
        }
    }
}

TYPED_TEST(GeometryTest, DistanceAndInsideMatchBruteForce) {
    const double tolerance = sizeof(TypeParam) == 4 ? 4e-6 : 1e-13;
    const Points ell = {{0, 0}, {10, 0}, {10, 3}, {3, 3}, {3, 10}, {0, 10}};
    const Points plus = {{3, 0}, {6, 0}, {6, 3}, {9, 3}, {9, 6}, {6, 6},
                          {6, 9}, {3, 9}, {3, 6}, {0, 6}, {0, 3}, {3, 3}};
    const Points zigzag = {{0, 0}, {5, 2}, {10, 0}, {10, 1}, {5, 9.5F}, {0, 1}};
    for (const Points& outline : {kSquare, ell, plus, zigzag}) {
        expect_distances_right<TypeParam>(outline, tolerance);
    }
    std::mt19937 random(11);
    std::uniform_real_distribution<double> radius(1.0, 5.0);
    for (int trial = 0; trial < 12; ++trial) {
        Points star;
        const int count = 3 + 5 * trial;
        for (int k = 0; k < count; ++k) {
            const double r = radius(random);
            const double angle = 2.0 * M_PI * k / count;
            star.push_back({static_cast<float>(5.0 + r * std::cos(angle)),
                            static_cast<float>(5.0 + r * std::sin(angle))});
        }
        ASSERT_EQ(check(star), Status::ok);
        expect_distances_right<TypeParam>(star, tolerance);
    }
}

TYPED_TEST(GeometryTest, NodesOnTheRingAreCoveredAtPositiveZero) {
    const auto ring = ring_of<TypeParam>({{1, 1}, {7, 1}, {7, 4}, {4, 4}, {4, 7}, {1, 7}});
    const Outline<TypeParam> outline{ring.data(), 6};
    for (int i = 1; i <= 7; ++i) {
        const Vec2<TypeParam> p{TypeParam(i), 1};
        const TypeParam d = distance_to_outline(outline, p, TypeParam(4));
        EXPECT_EQ(d, TypeParam(0));
        EXPECT_FALSE(std::signbit(d));
        EXPECT_TRUE(covers(outline, p));
    }
}

}  // namespace
}  // namespace weir
