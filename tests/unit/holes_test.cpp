// Polygons with holes: pieces cover what is between the rings, holes are open to liquid, and the
// table of bodies keeps them apart.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <vector>

#include "geometry/bridges.hpp"
#include "geometry/convex_decomposition.hpp"
#include "geometry/ring_copy.hpp"
#include "test_world.hpp"
#include "weir/weir.hpp"

namespace weir {
namespace {

using Rings = std::vector<Ring>;
using Piece = std::vector<std::uint16_t>;

struct Holed {
    explicit Holed(const Rings& rings) {
        for (const Ring& ring : rings) {
            views.push_back({ring.data(), static_cast<std::int32_t>(ring.size())});
        }
    }
    View<Vec2f> outer() const { return views[0]; }
    View<View<Vec2f>> holes() const {
        return {views.data() + 1, static_cast<std::int32_t>(views.size()) - 1};
    }
    Status check(PolygonFault* fault = nullptr) const {
        return check_polygon(outer(), holes(), fault);
    }
    std::vector<View<Vec2f>> views;
};

/// Rings as a body keeps them, in double, and their pieces; canaries behind all memory.
struct Cut {
    std::vector<Vec2<double>> vertex;
    std::vector<std::uint16_t> ring_end;
    std::vector<Piece> pieces;
    std::int32_t used = 0;
};

Cut cut(const Rings& rings) {
    Cut result;
    const Holed holed(rings);
    const RingsOnGrid on_grid({holed.outer(), holed.holes()});
    for (std::int32_t k = 0; k < on_grid.count(); ++k) {
        copy_ring(on_grid, k, [&](Vec2f v) { result.vertex.push_back(convert<double>(v)); });
        result.ring_end.push_back(static_cast<std::uint16_t>(result.vertex.size()));
    }
    const Outline<double> outline{result.vertex.data(),
                                  static_cast<std::int32_t>(result.vertex.size()),
                                  static_cast<std::int32_t>(rings.size()), result.ring_end.data()};
    constexpr std::uint16_t kCanary = 0xA5A5;
    const std::int32_t corners = corner_count(outline);
    const std::int32_t room = 4 * (corners - 2);
    std::vector<std::uint16_t> scratch(static_cast<std::size_t>(5 * corners) + 1, kCanary);
    std::vector<std::uint16_t> flat(static_cast<std::size_t>(room) + 1, kCanary);
    result.used = decompose(outline, {scratch.data(), 5 * corners}, {flat.data(), room});
    EXPECT_EQ(scratch.back(), kCanary);
    EXPECT_EQ(flat.back(), kCanary);
    for (std::int32_t at = 0; at < result.used;) {
        const std::uint16_t size = flat[static_cast<std::size_t>(at)];
        const auto first = flat.begin() + at + 1;
        result.pieces.emplace_back(first, first + size);
        at += 1 + size;
    }
    return result;
}

double twice_area(const std::vector<Vec2<double>>& vertex, const Piece& piece) {
    double sum = 0.0;
    for (std::size_t k = 0; k < piece.size(); ++k) {
        sum += cross(vertex[piece[k]], vertex[piece[(k + 1) % piece.size()]]);
    }
    return sum;
}

/// Pieces are convex, have the rings' area, and share every edge that is none of the rings'.
void expect_sound(const Rings& rings) {
    const Cut result = cut(rings);
    ASSERT_GT(result.used, 0);
    double whole = 0.0;
    std::map<std::pair<int, int>, int> edges;
    int first = 0;
    std::size_t outline_edges = 0;
    for (const std::uint16_t end : result.ring_end) {
        Piece ring;
        for (int k = first; k < end; ++k) {
            ring.push_back(static_cast<std::uint16_t>(k));
            edges[{k + 1 < end ? k + 1 : first, k}] = 1;  // what lies on the other side
            ++outline_edges;
        }
        whole += twice_area(result.vertex, ring);
        first = end;
    }
    double covered = 0.0;
    for (const Piece& piece : result.pieces) {
        ASSERT_GE(piece.size(), 3U);
        covered += twice_area(result.vertex, piece);
        for (std::size_t k = 0; k < piece.size(); ++k) {
            const std::uint16_t a = piece[k];
            const std::uint16_t b = piece[(k + 1) % piece.size()];
            const std::uint16_t c = piece[(k + 2) % piece.size()];
            const Vec2<double> in = result.vertex[b] - result.vertex[a];
            const Vec2<double> out = result.vertex[c] - result.vertex[b];
            EXPECT_GE(cross(in, out), -1.0000001e-6 * length(in) * length(out));
            const std::pair<int, int> edge{a, b};
            EXPECT_EQ(++edges[edge], 1);
        }
    }
    const double rounding = 1e-12 * static_cast<double>(result.vertex.size());
    EXPECT_NEAR(covered, whole, rounding * std::fabs(whole));
    for (const auto& [edge, times] : edges) {
        const std::pair<int, int> back{edge.second, edge.first};
        EXPECT_EQ(edges.count(back), 1U);
    }
}

Ring box_ring(float x0, float y0, float x1, float y1) {
    return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

Ring star(std::mt19937& random, Vec2f centre, float radius, int count, float depth) {
    std::uniform_real_distribution<float> share(depth, 1.0F);
    Ring ring;
    for (int k = 0; k < count; ++k) {
        const double angle = 2.0 * M_PI * k / count;
        const float r = radius * share(random);
        ring.push_back({centre.x + r * static_cast<float>(std::cos(angle)),
                        centre.y + r * static_cast<float>(std::sin(angle))});
    }
    return ring;
}

TEST(Holes, SquareInASquareEitherWayRound) {
    const Ring outer = box_ring(0, 0, 4, 4);
    const Ring hole = box_ring(1, 1, 3, 3);
    for (int turned = 0; turned < 4; ++turned) {
        Rings rings = {outer, hole};
        if ((turned & 1) != 0) {
            std::reverse(rings[0].begin(), rings[0].end());
        }
        if ((turned & 2) != 0) {
            std::reverse(rings[1].begin(), rings[1].end());
        }
        EXPECT_EQ(Holed(rings).check(), Status::ok);
        expect_sound(rings);
        EXPECT_LE(cut(rings).pieces.size(), 6U);
    }
}

TEST(Holes, RowsColumnsAndLatticesOfHoles) {
    for (const int columns : {1, 2, 5, 12}) {
        for (const int rows : {1, 2, 5, 12}) {
            Rings rings = {box_ring(0, 0, 2.0F * static_cast<float>(columns) + 1,
                                    2.0F * static_cast<float>(rows) + 1)};
            for (int i = 0; i < columns; ++i) {
                for (int j = 0; j < rows; ++j) {
                    const auto x = 2.0F * static_cast<float>(i) + 1;
                    const auto y = 2.0F * static_cast<float>(j) + 1;
                    if ((i + j) % 3 != 2) {
                        rings.push_back(box_ring(x, y, x + 1, y + 1));
                    } else {
                        rings.push_back({{x, y + 0.5F}, {x + 0.5F, y}, {x + 1, y + 0.5F},
                                         {x + 0.5F, y + 1}});
                    }
                }
            }
            ASSERT_EQ(Holed(rings).check(), Status::ok);
            expect_sound(rings);
        }
    }
}

TEST(Holes, RandomStarsFullOfRandomStars) {
    std::mt19937 random(17);
    std::uniform_real_distribution<float> place(-50.0F, 50.0F);
    int most = 0;
    for (int trial = 0; trial < 300; ++trial) {
        Rings rings = {star(random, {0, 0}, 50, 4 + static_cast<int>(random() % 60), 0.4F)};
        if (Holed(rings).check() != Status::ok) {
            continue;
        }
        for (int attempt = 0; attempt < 40; ++attempt) {
            rings.push_back(star(random, {place(random), place(random)},
                                 1.0F + static_cast<float>(random() % 12),
                                 3 + static_cast<int>(random() % 9), 0.2F));
            if (Holed(rings).check() != Status::ok) {
                rings.pop_back();
            }
        }
        most = std::max(most, static_cast<int>(rings.size()));
        SCOPED_TRACE(trial);
        expect_sound(rings);
    }
    EXPECT_GT(most, 10);
}

TEST(Holes, OnALatticeManyCornersAreInLine) {
    std::mt19937 random(18);
    int tried = 0;
    for (int trial = 0; trial < 400; ++trial) {
        Rings rings = {box_ring(0, 0, 12, 12)};
        for (int attempt = 0; attempt < 60; ++attempt) {
            Ring ring;
            for (int k = 3 + static_cast<int>(random() % 4); k > 0; --k) {
                ring.push_back({static_cast<float>(1 + random() % 11),
                                static_cast<float>(1 + random() % 11)});
            }
            rings.push_back(ring);
            if (Holed(rings).check() != Status::ok) {
                rings.pop_back();
            }
        }
        tried += rings.size() > 2 ? 1 : 0;
        SCOPED_TRACE(trial);
        expect_sound(rings);
    }
    EXPECT_GT(tried, 300);
}

TEST(Holes, AsManyAsThereIsRoomFor) {
    Rings rings = {box_ring(0, 0, 200, 200)};
    for (int k = 0; static_cast<int>(rings.size()) < (kMaxBodyVertices - 4) / 6; ++k) {
        const auto x = 1.0F + 3.5F * static_cast<float>(k % 56);
        const auto y = 1.0F + 3.5F * static_cast<float>(k / 56);
        rings.push_back({{x, y}, {x + 2, y + 1}, {x + 1, y + 2}});
    }
    PolygonFault fault;
    ASSERT_EQ(Holed(rings).check(&fault), Status::ok);
    EXPECT_EQ(fault.vertices_needed, 4 + 6 * static_cast<int>(rings.size() - 1));
    expect_sound(rings);
    for (int k = 0; k < 2; ++k) {
        rings.push_back({{199, 199}, {199.5F, 199}, {199, 199.5F}});
    }
    EXPECT_EQ(Holed(rings).check(&fault), Status::polygon_too_many_vertices);
    EXPECT_GT(fault.vertices_needed, kMaxBodyVertices);
}

WorldDef ring_def() {
    WorldDef def = small_def();
    def.capacity.vertices = 23;
    def.capacity.particles = 1000;
    return def;
}

const Ring kFrame = rectangle(0.24F, 0.24F);
const Ring kWindow = rectangle(0.16F, 0.16F);

BodyDef framed(const View<Vec2f>* window, Vec2f at_m, float angle_rad = 0.0F) {
    BodyDef def = body_of(kFrame, at_m, angle_rad);
    def.holes = {window, 1};
    return def;
}

TEST(Holes, LiquidFillsAHoleAndStaysThere) {
    const View<Vec2f> window{kWindow.data(), 4};
    for (const float angle : {0.0F, 0.3F}) {
        TestWorld<float> world(ring_def());
        put_moving(*world, framed(&window, {0.16F, 0.16F}, angle));
        EXPECT_GT(distance_at(*world, Vec2<float>{8, 8}), 1.0);
        EXPECT_LT(distance_at(*world, Vec2<float>{3, 8}), 0.0);
        std::int32_t added = 0;
        ASSERT_EQ(world->fill({{0.10F, 0.10F}, {0.22F, 0.16F}}, &added), Status::ok);
        EXPECT_EQ(added, 6 * 3 * 4);
        for (int step = 0; step < 300; ++step) {
            world->step(1.0F / 60.0F);
        }
        for (const Vec2<float>& x : world->particle_positions()) {
            EXPECT_LT(std::fabs(x.x - 8.0F), 6.0F);
            EXPECT_LT(std::fabs(x.y - 8.0F), 6.0F);
            EXPECT_GT(distance_at(*world, x), -0.1);
        }
    }
}

TEST(Holes, RemovingABodyLeavesTheOthersAsTheyWere) {
    const View<Vec2f> window{kWindow.data(), 4};
    TestWorld<float> world(ring_def());
    TestWorld<float> twin(ring_def());
    BodyId last;
    const BodyId square = put_static(*world, body_of(kSquare4cm, {0.03F, 0.29F}));
    BodyId frame = put_static(*world, framed(&window, {0.16F, 0.16F}));
    ASSERT_EQ(world->remove_body(square), Status::ok);
    frame = put_static(*twin, framed(&window, {0.16F, 0.16F}));
    // 11 places for the frame, 11 again: one is left.
    for (TestWorld<float>* each : {&world, &twin}) {
        ASSERT_EQ((*each)->add_moving_body(framed(&window, {0.2F, 0.2F}, 0.7F), &last), Status::ok);
        EXPECT_EQ((*each)->add_static_body(body_of(kTriangle, {0.1F, 0.1F}), &last),
                  Status::no_free_vertex);
        (*each)->step(0.01F);
    }
    const FieldView<float> a = world->signed_distance();
    const FieldView<float> b = twin->signed_distance();
    for (std::int32_t j = 0; j < a.rows; ++j) {
        for (std::int32_t i = 0; i < a.columns; ++i) {
            ASSERT_EQ(a.at(i, j), b.at(i, j)) << i << ' ' << j;
        }
    }
}

TEST(Holes, RepeatedVerticesAndStraightCornersAreNotKept) {
    const Ring busy = {{-0.02F, -0.02F}, {-0.02F, -0.02F}, {0.0F, -0.02F}, {0.01F, -0.02F},
                       {0.02F, -0.02F},  {0.02F, 0.02F},   {0.02F, 0.02F}, {-0.02F, 0.02F},
                       {-0.02F, 0.0F},   {-0.02F, -0.02F}};
    Ring backwards(busy.rbegin(), busy.rend());
    TestWorld<float> plain(small_def());
    put_static(*plain, body_of(kSquare4cm, {0.1F, 0.1F}));
    for (const Ring& ring : {busy, backwards}) {
        TestWorld<float> world(small_def());
        put_static(*world, body_of(ring, {0.1F, 0.1F}));
        put_static(*world, body_of(kSquare4cm, {0.2F, 0.1F}));
        put_static(*world, body_of(kSquare4cm, {0.2F, 0.2F}));
        for (std::int32_t i = 0; i < 8; ++i) {
            for (std::int32_t j = 0; j < 16; ++j) {
                ASSERT_EQ(world->signed_distance().at(i, j), plain->signed_distance().at(i, j));
            }
        }
    }
}

}  // namespace
}  // namespace weir
