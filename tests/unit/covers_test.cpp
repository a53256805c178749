// An outline tells what is in a body as its convex pieces do, on edges and corners, too: pieces are
// kept only where free bodies meet by them.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "geometry/convex_decomposition.hpp"
#include "geometry/signed_distance.hpp"
#include "measure/convex_piece.hpp"
#include "test_world.hpp"

namespace weir {
namespace {

constexpr int kCells = 16;  // of the lattice that corners and points are on, along an axis

/// A ring about the middle, corners on the lattice at growing angles. Some are no polygons.
std::vector<Vec2f> lattice_ring(std::mt19937& random, int corners, double least, double most) {
    std::uniform_real_distribution<double> radius(least, most);
    std::vector<Vec2f> ring;
    for (int k = 0; k < corners; ++k) {
        const double angle = 6.283185 * k / corners;
        const double r = radius(random);
        ring.push_back({static_cast<float>(std::lround(0.5 * kCells + r * std::cos(angle))),
                        static_cast<float>(std::lround(0.5 * kCells + r * std::sin(angle)))});
    }
    return ring;
}

/// Points where the two disagree; −1: no polygon.
int disagreements(const std::vector<Vec2f>& outer, const std::vector<Vec2f>& hole) {
    const View<Vec2f> inner{hole.data(), static_cast<std::int32_t>(hole.size())};
    const View<View<Vec2f>> holes{&inner, hole.empty() ? 0 : 1};
    if (check_polygon({outer.data(), static_cast<std::int32_t>(outer.size())}, holes) !=
        Status::ok) {
        return -1;
    }
    std::vector<Vec2<Fixed>> vertex;
    for (const Vec2f v : outer) {
        vertex.push_back(convert<Fixed>(v));
    }
    for (std::size_t k = hole.size(); k > 0; --k) {  // clockwise
        vertex.push_back(convert<Fixed>(hole[k - 1]));
    }
    const std::uint16_t ends[] = {static_cast<std::uint16_t>(outer.size()),
                                  static_cast<std::uint16_t>(vertex.size())};
    const auto count = static_cast<std::int32_t>(vertex.size());
    const Outline<Fixed> outline{vertex.data(), count, hole.empty() ? 1 : 2, ends};
    const std::int32_t room = count + 2;
    std::vector<std::uint16_t> scratch(static_cast<std::size_t>(5 * room));
    std::vector<std::uint16_t> pieces(static_cast<std::size_t>(4 * room));
    const std::int32_t used = decompose(outline, {scratch.data(), 5 * room},
                                        {pieces.data(), 4 * room});
    int wrong = 0;
    for (int y = 0; y <= 2 * kCells; ++y) {
        for (int x = 0; x <= 2 * kCells; ++x) {
            const Vec2<Fixed> p{Fixed(0.5F * static_cast<float>(x)),
                                Fixed(0.5F * static_cast<float>(y))};
            bool in_piece = false;
            for (std::int32_t at = 0; at < used; at += 1 + pieces[static_cast<std::size_t>(at)]) {
                const std::uint16_t* piece = &pieces[static_cast<std::size_t>(at)];
                in_piece = in_piece || inside_convex(vertex.data(), piece + 1, *piece, p);
            }
            wrong += covers(outline, p) != in_piece ? 1 : 0;
        }
    }
    return wrong;
}

TEST(Covers, SaysWhatPiecesSay) {
    std::mt19937 random(7);
    int polygons = 0;
    int holed = 0;
    for (int k = 0; k < 600; ++k) {
        const auto outer = lattice_ring(random, 3 + static_cast<int>(random() % 12), 4.0, 8.0);
        const auto hole = k % 2 == 0 ? std::vector<Vec2f>()
                                     : lattice_ring(random, 3 + static_cast<int>(random() % 4),
                                                    1.0, 3.0);
        const int wrong = disagreements(outer, hole);
        EXPECT_LE(wrong, 0) << k;
        polygons += wrong < 0 ? 0 : 1;
        holed += wrong < 0 || hole.empty() ? 0 : 1;
    }
    EXPECT_GE(polygons, 200);
    EXPECT_GE(holed, 50);
}

TEST(Covers, PiecesAreKeptForFreeBodiesAlone) {
    Capacity with;
    with.bodies = 1;
    with.vertices = 100;
    const auto a_vertex = [&](auto real, bool two_way) {
        using Real = decltype(real);
        with.two_way = two_way;
        Capacity without = with;
        without.vertices = 0;
        return (world_bytes<Real>(with) - world_bytes<Real>(without)) / 100;
    };
    EXPECT_EQ(a_vertex(float{}, true), 34U);
    EXPECT_EQ(a_vertex(float{}, false), 18U);
    EXPECT_EQ(a_vertex(SmallFixed{}, true), 18U);
}

}  // namespace
}  // namespace weir
