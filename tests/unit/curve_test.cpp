// Curves to polylines, fewer vertices, measures: errors against their bounds by dense sampling.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "geometry/signed_distance.hpp"
#include "test_world.hpp"
#include "weir/geometry.hpp"

namespace weir {
namespace {

using Point = Vec2<double>;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

View<Vec2f> view(const Ring& ring) {
    return {ring.data(), static_cast<std::int32_t>(ring.size())};
}

double distance_to_polyline(const Ring& line, Point p) {
    double nearest = 1e300;
    for (std::size_t k = 1; k < line.size(); ++k) {
        nearest = std::min(nearest, distance_to_segment(p, convert<double>(line[k - 1]),
                                                        convert<double>(line[k])));
    }
    return nearest;
}

Point bezier(const std::vector<Point>& control, double t) {
    std::vector<Point> points = control;
    for (std::size_t left = points.size() - 1; left > 0; --left) {
        for (std::size_t k = 0; k < left; ++k) {
            points[k] = (1.0 - t) * points[k] + t * points[k + 1];
        }
    }
    return points[0];
}

/// The polyline, its first point included, of two or three control points after p0.
Ring flatten(const Ring& control, float tolerance) {
    Ring line(kMaxCurvePieces + 1, control[0]);
    const std::int32_t count =
        control.size() == 3
            ? flatten_quadratic(control[0], control[1], control[2], tolerance, line.data() + 1,
                                kMaxCurvePieces)
            : flatten_cubic(control[0], control[1], control[2], control[3], tolerance,
                            line.data() + 1, kMaxCurvePieces);
    line.resize(static_cast<std::size_t>(count) + 1);
    return line;
}

TEST(Curve, BezierStaysWithinTheTolerance) {
    std::mt19937 random(31);
    std::uniform_real_distribution<float> place(-1.0F, 1.0F);
    double worst = 0.0;
    for (int trial = 0; trial < 200; ++trial) {
        Ring control(trial % 2 == 0 ? 3 : 4);
        std::vector<Point> exact;
        for (Vec2f& p : control) {
            p = {place(random), place(random)};
            exact.push_back(convert<double>(p));
        }
        for (const float tolerance : {0.1F, 0.01F, 0.001F}) {
            const Ring line = flatten(control, tolerance);
            EXPECT_EQ(line.back().x, control.back().x);
            EXPECT_EQ(line.back().y, control.back().y);
            double furthest = 0.0;
            for (int k = 0; k <= 1000; ++k) {
                furthest = std::max(furthest, distance_to_polyline(line, bezier(exact, k / 1000.0)));
            }
            EXPECT_LE(furthest, static_cast<double>(tolerance) * 1.0001 + 1e-7);
            worst = std::max(worst, furthest / static_cast<double>(tolerance));
        }
    }
    EXPECT_GT(worst, 0.5);  // not far finer than asked for
}

TEST(Curve, ArcStaysWithinTheTolerance) {
    for (const float sweep : {6.2831853F, -6.2831853F, 1.0F, -0.01F, 0.0F}) {
        for (const float tolerance : {0.5F, 0.01F, 0.0001F}) {
            Ring line(kMaxCurvePieces + 1);
            const Vec2f centre{3, -2};
            line[0] = {centre.x + 2.0F * std::cos(0.7F), centre.y + 2.0F * std::sin(0.7F)};
            const std::int32_t count = flatten_arc(centre, 2.0F, 0.7F, sweep, tolerance,
                                                   line.data() + 1, kMaxCurvePieces);
            ASSERT_GE(count, 1);
            line.resize(static_cast<std::size_t>(count) + 1);
            for (int k = 0; k <= 1000; ++k) {
                const double angle = 0.7 + static_cast<double>(sweep) * k / 1000.0;
                const Point p{3.0 + 2.0 * std::cos(angle), -2.0 + 2.0 * std::sin(angle)};
                EXPECT_LE(distance_to_polyline(line, p), static_cast<double>(tolerance) + 1e-6);
            }
        }
    }
    EXPECT_GE(flatten_arc({0, 0}, 1.0F, 0.0F, 6.2831853F, 100.0F, nullptr, 0), 4);
}

TEST(Curve, SaysHowManyAndWritesNoMoreThanThereIsRoomFor) {
    const Ring control = {{0, 0}, {1, 2}, {2, 0}};
    const Ring whole = flatten(control, 0.001F);
    const auto count = static_cast<std::int32_t>(whole.size()) - 1;
    Ring part(4, Vec2f{-7, -7});
    EXPECT_EQ(flatten_quadratic(control[0], control[1], control[2], 0.001F, part.data(), 3), count);
    EXPECT_EQ(part[2].x, whole[3].x);
    EXPECT_EQ(part[3].x, -7.0F);
    EXPECT_EQ(flatten_cubic({0, 0}, {1, 0}, {2, 0}, {3, 0}, 0.1F, part.data(), 3), 1);  // a line
}

TEST(Curve, RefusesWhatItCannotDo) {
    Vec2f out[4];
    for (const float tolerance : {0.0F, -1.0F, kNan, 1e-12F}) {
        EXPECT_EQ(flatten_quadratic({0, 0}, {1, 2}, {2, 0}, tolerance, out, 4), 0);
        EXPECT_EQ(flatten_arc({0, 0}, 1.0F, 0.0F, 3.0F, tolerance, out, 4), 0);
    }
    for (int k = 0; k < 4; ++k) {
        Vec2f p[4] = {{0, 0}, {1, 2}, {3, 1}, {2, 0}};
        p[k].y = kNan;
        EXPECT_EQ(flatten_cubic(p[0], p[1], p[2], p[3], 0.1F, out, 4), 0);
        EXPECT_TRUE(k == 3 || flatten_quadratic(p[0], p[1], p[2], 0.1F, out, 4) == 0);
    }
    EXPECT_EQ(flatten_arc({0, 0}, 1.0F, 0.0F, 7.0F, 0.1F, out, 4), 0);
    EXPECT_EQ(flatten_arc({0, 0}, -1.0F, 0.0F, 1.0F, 0.1F, out, 4), 0);
    EXPECT_EQ(flatten_arc({0, kNan}, 1.0F, 0.0F, 1.0F, 0.1F, out, 4), 0);
    EXPECT_EQ(flatten_arc({0, 0}, 1.0F, kNan, 1.0F, 0.1F, out, 4), 0);
}

/// Simplifies, and checks all that is promised.
Ring simplified(const Ring& ring, float tolerance) {
    std::vector<std::uint8_t> keep(ring.size());
    Ring out(ring.size());
    std::int32_t count = 0;
    EXPECT_EQ(simplify_ring(view(ring), tolerance, keep.data(), out.data(), &count), Status::ok);
    out.resize(static_cast<std::size_t>(count));
    EXPECT_EQ(check_polygon(view(out)), Status::ok);
    // Each vertex left out is near the edge between the two around it that stayed.
    std::size_t at = 0;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Vec2f kept = out[at % out.size()];
        if (at < out.size() && kept.x == ring[i].x && kept.y == ring[i].y && keep[i] != 0) {
            ++at;
            continue;
        }
        const Point a = convert<double>(out[at - 1]);
        const Point b = convert<double>(out[at % out.size()]);
        EXPECT_LE(distance_to_segment(convert<double>(ring[i]), a, b),
                  static_cast<double>(tolerance) * 1.000001);
    }
    EXPECT_EQ(at, out.size());
    return out;
}

TEST(Simplify, KeepsTheBound) {
    std::mt19937 random(33);
    std::uniform_real_distribution<float> radius(0.9F, 1.0F);
    for (int trial = 0; trial < 60; ++trial) {
        Ring ring;
        const int count = 3 + trial * 9;
        for (int k = 0; k < count; ++k) {
            const float angle = 6.2831853F * static_cast<float>(k) / static_cast<float>(count);
            const float r = 10.0F * radius(random);
            ring.push_back({r * std::cos(angle), r * std::sin(angle)});
        }
        std::size_t last = ring.size();
        for (const float tolerance : {0.0F, 0.1F, 0.5F, 2.0F, 1000.0F}) {
            const Ring result = simplified(ring, tolerance);
            EXPECT_LE(result.size(), last);
            last = result.size();
        }
        EXPECT_LE(last, 4U);
    }
}

TEST(Simplify, DropsStraightCornersAtNoTolerance) {
    const Ring ring = {{0, 0}, {1, 0}, {2, 0}, {8, 0}, {8, 8}, {4, 8}, {0, 8}, {0, 1}};
    EXPECT_EQ(simplified(ring, 0.0F).size(), 4U);
}

TEST(Simplify, DoesNotLetARingCrossItself) {
    // A bay behind a thin bar, which the plain method lays across it.
    Ring bay = {{0, 0}, {10, 0}, {10, 10}, {0, 10}, {0, 6}};
    for (int k = 0; k < 30; ++k) {
        const auto step = 0.1F * static_cast<float>(k);
        bay.push_back({8.0F * std::sin(step), 6.0F - step});
    }
    simplified(bay, 1.0F);
    // Two arms of a spiral, closer together than the tolerance.
    Ring spiral;
    const auto on_arm = [](int k, float r) {
        const float angle = 0.2F * static_cast<float>(k);
        return Vec2f{(r + angle) * std::cos(angle), (r + angle) * std::sin(angle)};
    };
    for (int k = 0; k < 150; ++k) {
        spiral.push_back(on_arm(k, 3.0F));
    }
    for (int k = 149; k >= 0; --k) {
        spiral.push_back(on_arm(k, 2.9F));
    }
    for (const float tolerance : {0.05F, 0.2F, 0.5F, 2.0F, 8.0F}) {
        EXPECT_LE(simplified(spiral, tolerance).size(), tolerance < 0.5F ? 300U : 260U);
    }
}

/// However the vertices are spread along it, no more stay than it has corners.
TEST(Simplify, KeepsCornersOnly) {
    const Ring triangle = {{0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, 0}, {0, 4}};
    EXPECT_EQ(simplified(triangle, 0.1F).size(), 3U);
}

TEST(Simplify, RefusesWhatIsNoPolygon) {
    const Ring bow = {{0, 0}, {4, 4}, {4, 0}, {0, 4}};
    std::uint8_t keep[4];
    Vec2f out[4];
    std::int32_t count = -7;
    EXPECT_EQ(simplify_ring(view(bow), 1.0F, keep, out, &count), Status::polygon_crosses_itself);
    EXPECT_EQ(count, -7);
    const Ring box = rectangle(2, 2);
    EXPECT_EQ(simplify_ring(view(box), 1.0F, nullptr, out, &count), Status::output_missing);
    EXPECT_EQ(simplify_ring(view(box), 1.0F, keep, nullptr, &count), Status::output_missing);
    EXPECT_EQ(simplify_ring(view(box), 1.0F, keep, out, nullptr), Status::output_missing);
    EXPECT_EQ(simplify_ring(view(box), kNan, keep, out, &count), Status::ok);
    EXPECT_EQ(count, 4);
}

TEST(Measures, AreaCentroidAndInside) {
    Ring outer = {{0, 0}, {6, 0}, {6, 4}, {0, 4}};
    const Ring hole = {{4, 1}, {5, 1}, {5, 3}, {4, 3}};
    const View<Vec2f> holes[] = {view(hole)};
    for (int turned = 0; turned < 2; ++turned) {
        EXPECT_FLOAT_EQ(polygon_area(view(outer)), 24.0F);
        EXPECT_FLOAT_EQ(polygon_area(view(outer), {holes, 1}), 22.0F);
        EXPECT_FLOAT_EQ(polygon_centroid(view(outer)).x, 3.0F);
        const Vec2f centre = polygon_centroid(view(outer), {holes, 1});
        EXPECT_FLOAT_EQ(centre.x, (24 * 3 - 2 * 4.5F) / 22);
        EXPECT_FLOAT_EQ(centre.y, 2.0F);
        EXPECT_TRUE(polygon_contains(view(outer), {holes, 1}, {3, 2}));
        EXPECT_FALSE(polygon_contains(view(outer), {holes, 1}, {4.5F, 2}));
        EXPECT_TRUE(polygon_contains(view(outer), {}, {4.5F, 2}));
        EXPECT_FALSE(polygon_contains(view(outer), {}, {7, 2}));
        std::reverse(outer.begin(), outer.end());
    }
    EXPECT_EQ(polygon_area({}), 0.0F);
    EXPECT_EQ(polygon_centroid({}).x, 0.0F);
    EXPECT_FALSE(polygon_contains({}, {}, {0, 0}));
    EXPECT_EQ(polygon_centroid(view({{3, 4}, {3, 4}})).y, 4.0F);
}

}  // namespace
}  // namespace weir
