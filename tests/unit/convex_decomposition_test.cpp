// Convex pieces: they cover the polygon exactly once, each is convex, and they are few.
#include "geometry/convex_decomposition.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <random>
#include <vector>

#include "geometry/ring_copy.hpp"
#include "geometry/signed_distance.hpp"
#include "math/rotation.hpp"
#include "measure/convex_piece.hpp"

namespace weir {
namespace {

using Ring = std::vector<Vec2f>;
using Piece = std::vector<std::uint16_t>;

struct Decomposition {
    std::int32_t used = 0;
    std::vector<std::uint16_t> flat;
    std::vector<Piece> pieces;
};

const Ring kPlus = {{3, 0}, {6, 0}, {6, 3}, {9, 3}, {9, 6}, {6, 6},
                    {6, 9}, {3, 9}, {3, 6}, {0, 6}, {0, 3}, {3, 3}};

constexpr std::uint16_t kCanary = 0xA5A5;

/// Memory of exactly the promised size, with a canary behind it.
template <class Real>
Decomposition decompose_all(const std::vector<Vec2<Real>>& ring) {
    const auto count = static_cast<std::int32_t>(ring.size());
    const std::int32_t room = 4 * (count - 2);
    std::vector<std::uint16_t> scratch(static_cast<std::size_t>(5 * count) + 1, kCanary);
    Decomposition result;
    result.flat.assign(static_cast<std::size_t>(room) + 1, kCanary);
    result.used = decompose(Outline<Real>{ring.data(), count},
                            ArrayView<std::uint16_t>{scratch.data(), 5 * count},
                            ArrayView<std::uint16_t>{result.flat.data(), room});
    EXPECT_EQ(scratch.back(), kCanary);
    EXPECT_EQ(result.flat.back(), kCanary);
    EXPECT_LE(result.used, room);
    for (std::int32_t at = 0; at < result.used;) {
        const std::uint16_t size = result.flat[static_cast<std::size_t>(at)];
        const auto first = result.flat.begin() + at + 1;
        result.pieces.emplace_back(first, first + size);
        at += 1 + size;
    }
    return result;
}

std::vector<Vec2<double>> in_double(const Ring& ring) {
    std::vector<Vec2<double>> result;
    for (const Vec2f v : ring) {
        result.push_back(convert<double>(v));
    }
    return result;
}

double twice_area(const std::vector<Vec2<double>>& ring, const Piece& piece) {
    double sum = 0.0;
    for (std::size_t k = 0; k < piece.size(); ++k) {
        sum += cross(ring[piece[k]], ring[piece[(k + 1) % piece.size()]]);
    }
    return sum;
}

double twice_area(const std::vector<Vec2<double>>& ring) {
    Piece all(ring.size());
    std::iota(all.begin(), all.end(), std::uint16_t{0});
    return twice_area(ring, all);
}

double twice_area(const std::vector<Vec2<double>>& ring, const std::vector<Piece>& pieces) {
    double sum = 0.0;
    for (const Piece& piece : pieces) {
        EXPECT_GT(twice_area(ring, piece), 0.0);
        sum += twice_area(ring, piece);
    }
    return sum;
}

int reflex_corners(const std::vector<Vec2<double>>& ring) {
    int reflex = 0;
    for (std::size_t k = 0; k < ring.size(); ++k) {
        const std::size_t n = ring.size();
        reflex += turn(ring[k], ring[(k + 1) % n], ring[(k + 2) % n]) < 0.0 ? 1 : 0;
    }
    return reflex;
}

/// Sines of all bends, 1 for a bend of more than 90 degrees to the left.
double sharpest_right_bend(const std::vector<Vec2<double>>& ring, const Piece& piece) {
    double least = 1.0;
    for (std::size_t k = 0; k < piece.size(); ++k) {
        const Vec2<double> a = ring[piece[k]];
        const Vec2<double> b = ring[piece[(k + 1) % piece.size()]];
        const Vec2<double> c = ring[piece[(k + 2) % piece.size()]];
        least = std::min(least, cross(b - a, c - b) / (length(b - a) * length(c - b)));
    }
    return least;
}

/// Every edge of a piece is an edge of the ring, once, or has its opposite in another piece.
void expect_edges_matched(const Ring& ring, const std::vector<Piece>& pieces) {
    std::map<std::pair<int, int>, int> edges;
    const auto count = static_cast<int>(ring.size());
    for (const Piece& piece : pieces) {
        for (std::size_t k = 0; k < piece.size(); ++k) {
            ++edges[{piece[k], piece[(k + 1) % piece.size()]}];
        }
    }
    int outline = 0;
    for (const auto& [edge, times] : edges) {
        EXPECT_EQ(times, 1);
        if (edge.second == (edge.first + 1) % count) {
            ++outline;
        } else {
            EXPECT_EQ(edges.count({edge.second, edge.first}), 1U);
        }
    }
    EXPECT_EQ(outline, count);
}

void expect_sound(const Ring& ring) {
    const Decomposition result = decompose_all(ring);
    ASSERT_GT(result.used, 0);
    const auto exact = in_double(ring);
    for (const Piece& piece : result.pieces) {
        ASSERT_GE(piece.size(), 3U);
        EXPECT_GE(sharpest_right_bend(exact, piece), -1.0000001e-6);
    }
    const double whole = twice_area(exact);
    EXPECT_NEAR(twice_area(exact, result.pieces), whole,
                1e-11 * (1.0 + std::fabs(whole)) * static_cast<double>(ring.size()));
    expect_edges_matched(ring, result.pieces);
    // Two diagonals for each corner that is not convex would do.
    EXPECT_LE(static_cast<int>(result.pieces.size()), 1 + 2 * reflex_corners(exact));
}

Ring regular(int count, double radius) {
    Ring ring;
    for (int k = 0; k < count; ++k) {
        const double angle = 2.0 * M_PI * k / count;
        ring.push_back({static_cast<float>(radius * std::cos(angle)),
                        static_cast<float>(radius * std::sin(angle))});
    }
    return ring;
}

/// Whether a body may have that outline; if so, it becomes the ring that the body keeps.
bool acceptable(Ring& ring) {
    const View<Vec2f> outline{ring.data(), static_cast<std::int32_t>(ring.size())};
    if (check_polygon(outline) != Status::ok) {
        return false;
    }
    Ring kept;
    copy_ring(RingsOnGrid({outline, {}}), 0, [&](Vec2f v) { kept.push_back(v); });
    ring = kept;
    return true;
}

/// Random points joined in random order, then crossings undone two by two: twisted, but simple.
Ring noise_polygon(std::mt19937& random, int count) {
    std::uniform_real_distribution<float> place(0.0F, 50.0F);
    Ring ring;
    for (int k = 0; k < count; ++k) {
        ring.push_back({place(random), place(random)});
    }
    const auto cross_at = [&](std::size_t i, std::size_t j) {
        const auto at = [&](std::size_t k) { return convert<double>(ring[k % ring.size()]); };
        return turn(at(i), at(i + 1), at(j)) * turn(at(i), at(i + 1), at(j + 1)) <= 0.0 &&
               turn(at(j), at(j + 1), at(i)) * turn(at(j), at(j + 1), at(i + 1)) <= 0.0;
    };
    for (bool crossed = true; crossed;) {
        crossed = false;
        for (std::size_t i = 0; i < ring.size(); ++i) {
            for (std::size_t j = i + 2; j < ring.size() - (i == 0 ? 1U : 0U); ++j) {
                if (cross_at(i, j)) {
                    std::reverse(ring.begin() + static_cast<std::ptrdiff_t>(i) + 1,
                                 ring.begin() + static_cast<std::ptrdiff_t>(j) + 1);
                    crossed = true;
                }
            }
        }
    }
    if (twice_signed_area(ring.data(), count) < 0.0F) {
        std::reverse(ring.begin(), ring.end());
    }
    return ring;
}

bool in_any(const std::vector<Piece>& pieces, const Ring& ring, Vec2f p) {
    return std::any_of(pieces.begin(), pieces.end(), [&](const Piece& piece) {
        return inside_convex(ring.data(), piece.data(), static_cast<std::int32_t>(piece.size()), p);
    });
}

TEST(Decompose, ConvexRingIsOnePieceInItsOwnOrder) {
    for (const int count : {3, 4, 5, 17, 1000}) {
        const Decomposition result = decompose_all(regular(count, 5.0));
        ASSERT_EQ(result.pieces.size(), 1U) << count;
        ASSERT_EQ(result.pieces[0].size(), static_cast<std::size_t>(count));
        for (int k = 0; k < count; ++k) {
            EXPECT_EQ(result.pieces[0][static_cast<std::size_t>(k)], k);
        }
    }
}

TEST(Decompose, ConvexRingWithVerticesOnItsEdgesIsOnePiece) {
    for (const double angle : {0.0, 0.3, 1.1}) {
        Ring ring;  // a square with five vertices a side, which rounding puts off the straight line
        const Rotation<double> turned = rotation(angle);
        const Vec2<double> corner[] = {{0, 0}, {7, 0}, {7, 7}, {0, 7}};
        for (int side = 0; side < 4; ++side) {
            for (int k = 0; k < 5; ++k) {
                const Vec2<double> along = corner[(side + 1) % 4] - corner[side];
                ring.push_back(convert<float>(turned.apply(corner[side] + (k / 5.0) * along)));
            }
        }
        ASSERT_TRUE(acceptable(ring));
        EXPECT_EQ(decompose_all(ring).pieces.size(), 1U) << angle;
    }
}

TEST(Decompose, KnownShapes) {
    const Ring dart = {{0, 0}, {4, -3}, {1, 0}, {4, 3}};
    EXPECT_EQ(decompose_all(dart).pieces.size(), 2U);
    const Ring ell = {{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 5}, {0, 5}};
    EXPECT_EQ(decompose_all(ell).pieces.size(), 2U);
    EXPECT_LE(decompose_all(kPlus).pieces.size(), 5U);
    const Ring trough = {{0, 0}, {8, 0}, {8, 4}, {7, 4}, {7, 1}, {1, 1}, {1, 4}, {0, 4}};
    EXPECT_EQ(decompose_all(trough).pieces.size(), 3U);
    for (const Ring& ring : {dart, ell, kPlus, trough}) {
        expect_sound(ring);
    }
}

TEST(Decompose, EveryStartingVertex) {
    Ring ring = {{0, 0}, {8, 0}, {8, 4}, {7, 4}, {7, 1}, {4, 1}, {4, 3}, {3, 3}, {1, 1}, {0, 4}};
    for (std::size_t k = 0; k < ring.size(); ++k) {
        expect_sound(ring);
        std::rotate(ring.begin(), ring.begin() + 1, ring.end());
    }
}

TEST(Decompose, StarCombAndSpiral) {
    for (const int points : {3, 5, 8, 60}) {
        Ring star = regular(2 * points, 5.0);
        for (std::size_t k = 1; k < star.size(); k += 2) {
            star[k] = 0.3F * star[k];
        }
        ASSERT_TRUE(acceptable(star));
        expect_sound(star);
    }
    Ring comb = {{0, -1}, {100, -1}};
    for (int tooth = 49; tooth >= 0; --tooth) {
        const auto x = static_cast<float>(2 * tooth);
        comb.push_back({x + 1.5F, 9});
        comb.push_back({x + 1, 0});
        comb.push_back({x + 0.5F, 0});
    }
    ASSERT_TRUE(acceptable(comb));
    expect_sound(comb);
    Ring spiral;
    const auto on_arm = [](int k, double r) {
        const double angle = 0.35 * k;
        return Vec2f{static_cast<float>((r + angle) * std::cos(angle)),
                     static_cast<float>((r + angle) * std::sin(angle))};
    };
    for (int k = 0; k < 120; ++k) {
        spiral.push_back(on_arm(k, 3.0));
    }
    for (int k = 119; k >= 0; --k) {
        spiral.push_back(on_arm(k, 0.5));
    }
    ASSERT_TRUE(acceptable(spiral));
    expect_sound(spiral);
}

TEST(Decompose, ThousandRandomStars) {
    std::mt19937 random(2);
    std::uniform_real_distribution<float> radius(0.05F, 1.0F);
    for (int trial = 0; trial < 1000; ++trial) {
        Ring ring = regular(3 + static_cast<int>(random() % 60), 20.0);
        for (Vec2f& v : ring) {
            v = radius(random) * v + Vec2f{40.0F, 30.0F};
        }
        if (acceptable(ring)) {  // but for slivers
            SCOPED_TRACE(trial);
            expect_sound(ring);
        }
    }
}

TEST(Decompose, RandomTwistedPolygons) {
    std::mt19937 random(3);
    for (int trial = 0; trial < 300; ++trial) {
        Ring ring = noise_polygon(random, 4 + static_cast<int>(random() % 40));
        ASSERT_TRUE(acceptable(ring));
        SCOPED_TRACE(trial);
        expect_sound(ring);
    }
}

TEST(Decompose, RandomPolygonsOnALatticeAreFullOfStraightLines) {
    std::mt19937 random(4);
    int tried = 0;
    for (int trial = 0; trial < 3000; ++trial) {
        Ring ring = regular(6 + static_cast<int>(random() % 20), 8.0);
        for (Vec2f& v : ring) {
            const float r = 0.2F + 0.8F * static_cast<float>(random() % 1000) / 1000.0F;
            v = {std::round(r * v.x), std::round(r * v.y)};
        }
        if (acceptable(ring)) {
            ++tried;
            expect_sound(ring);
        }
    }
    EXPECT_GT(tried, 100);
}

TEST(Decompose, SameInFloatAndDouble) {
    std::mt19937 random(5);
    for (int trial = 0; trial < 50; ++trial) {
        const Ring ring = noise_polygon(random, 30);
        const auto exact = in_double(ring);
        EXPECT_EQ(decompose_all(ring).flat, decompose_all(exact).flat);
    }
}

TEST(Decompose, LargestRing) {
    Ring comb = {{0, -1}, {8191, -1}};
    for (int i = kMaxBodyVertices - 2; i > 0; --i) {
        comb.push_back({0.5F * static_cast<float>(i), i % 2 == 0 ? 0.0F : 5.0F});
    }
    const Decomposition result = decompose_all(comb);
    const auto exact = in_double(comb);
    EXPECT_NEAR(twice_area(exact, result.pieces), twice_area(exact), 1e-6);
}

TEST(Decompose, RingThatTouchesItselfStillEnds) {
    // Slits that rounding has closed, doubled vertices, a spike: not what check_polygon lets pass.
    const Ring slit = {{0, 0}, {8, 0}, {8, 4}, {4, 4}, {4, 1}, {4, 4}, {0, 4}};
    const Ring doubled = {{0, 0}, {8, 0}, {8, 4}, {8, 4}, {3, 2}, {3, 2}, {0, 4}};
    const Ring spike = {{0, 0}, {8, 0}, {8, 2}, {12, 2}, {8, 2}, {8, 4}, {2, 3}, {0, 4}};
    for (const Ring& ring : {slit, doubled, spike}) {
        const Decomposition result = decompose_all(ring);
        const auto exact = in_double(ring);
        EXPECT_NEAR(twice_area(exact, result.pieces), twice_area(exact), 1e-9);
    }
}

TEST(Decompose, RingThatCrossesItselfEndsToo) {
    std::mt19937 random(6);
    std::uniform_int_distribution<int> place(0, 6);
    for (int trial = 0; trial < 3000; ++trial) {
        Ring ring(3 + random() % 12);
        for (Vec2f& v : ring) {
            v = {static_cast<float>(place(random)), static_cast<float>(place(random))};
        }
        const Decomposition result = decompose_all(ring);
        EXPECT_TRUE(result.used == -1 || result.used >= 4);
    }
}

TEST(Decompose, NothingOnTheLeft) {
    EXPECT_EQ(decompose_all(Ring{{0, 0}, {0, 1}, {1, 0}}).used, -1);
    EXPECT_EQ(decompose_all(Ring{{0, 0}, {0, 4}, {4, 4}, {1, 1}, {4, 0}}).used, -1);
    EXPECT_EQ(decompose_all(Ring{{0, 0}, {1, 0}, {2, 0}, {3, 0}}).used, -1);
}

TEST(Decompose, NoCracksAlongDiagonalsAfterTurning) {
    // Points on and next to every diagonal of a turned polygon, in float: no piece may disown them.
    std::mt19937 random(8);
    std::uniform_real_distribution<float> part(0.0F, 1.0F);
    const Ring comb = {{0, 0}, {9, 0}, {9, 5}, {8, 5}, {8, 1}, {6, 1}, {6, 5}, {5, 5},
                       {5, 1}, {3, 1}, {3, 5}, {2, 5}, {2, 1}, {0, 1}};
    for (int trial = 0; trial < 60; ++trial) {
        const Ring twisted = noise_polygon(random, 25);
        const Ring& local = trial % 3 == 0 ? kPlus : (trial % 3 == 1 ? comb : twisted);
        const Decomposition result = decompose_all(local);
        const Rotation<float> turned = rotation(0.1F * static_cast<float>(trial));
        Ring placed;
        for (const Vec2f v : local) {
            placed.push_back(Vec2f{37.3F, 21.7F} + turned.apply(v));
        }
        const auto count = static_cast<std::int32_t>(placed.size());
        for (const Piece& piece : result.pieces) {
            for (int sample = 0; sample < 400; ++sample) {
                const std::size_t k = random() % piece.size();
                const Vec2f a = placed[piece[k]];
                const Vec2f b = placed[piece[(k + 1) % piece.size()]];
                const Vec2f p = a + part(random) * (b - a);
                const Outline<float> outline{placed.data(), count};
                if (distance_to_outline(outline, p, 4.0F) > 0.05F) {
                    EXPECT_TRUE(in_any(result.pieces, placed, p))
                        << trial << ": " << p.x << ' ' << p.y;
                }
            }
        }
    }
}

}  // namespace
}  // namespace weir
