// What is no polygon, or hardly one: each row's status and the place of its fault; a world refuses
// it by the same name and goes on as if it had not been asked.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "test_world.hpp"
#include "weir/weir.hpp"

namespace weir {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr float kBig = std::numeric_limits<float>::max();
constexpr float kTiny = std::numeric_limits<float>::denorm_min();

using Rings = std::vector<Ring>;

struct Place {
    std::int32_t ring_a = -1;
    std::int32_t edge_a = -1;
    std::int32_t ring_b = -1;
    std::int32_t edge_b = -1;
    Vec2f at{};
};

struct HostileRow {
    const char* name;
    Rings rings;
    Status expected;
    Place place{};
};

const Ring kBox = {{0, 0}, {8, 0}, {8, 8}, {0, 8}};

Ring zigzag(int teeth, float gap) {  // teeth that all but touch the base
    Ring ring = {{0, 0}, {static_cast<float>(teeth), 0}};
    for (int k = teeth; k > 0; --k) {
        ring.push_back({static_cast<float>(k), 4});
        ring.push_back({static_cast<float>(k) - 0.5F, gap});
    }
    ring.push_back({0, 4});
    return ring;
}

Ring repeated(const Ring& ring, int times) {
    Ring all;
    for (const Vec2f& v : ring) {
        all.insert(all.end(), static_cast<std::size_t>(times), v);
    }
    return all;
}

/// Refused; where two edges meet the place is theirs.
const std::vector<HostileRow>& refused_rows() {
    static const std::vector<HostileRow> rows = {
        {"no vertex at all", {{}}, Status::polygon_missing, {0}},
        {"two vertices", {{{0, 0}, {1, 1}}}, Status::polygon_too_few_vertices, {0}},
        {"empty hole", {kBox, kBox, {}}, Status::polygon_missing, {2}},
        {"hole of two", {kBox, {{1, 1}, {2, 2}}}, Status::polygon_too_few_vertices, {1}},
        {"NaN", {{{0, 0}, {1, kNan}, {0, 1}}}, Status::polygon_not_finite, {0, 1}},
        {"infinite hole", {kBox, {{1, 1}, {2, 1}, {-kInf, 2}}}, Status::polygon_not_finite, {1, 2}},
        {"one point thrice", {{{3, 3}, {3, 3}, {3, 3}}}, Status::polygon_zero_area,
         {0, -1, -1, -1, {3, 3}}},
        {"a line", {{{0, 0}, {1, 1}, {2, 2}}}, Status::polygon_zero_area, {0}},
        {"there and back", {{{0, 0}, {4, 0}, {8, 0}, {4, 0}}}, Status::polygon_zero_area, {0}},
        {"two vertices in turn", {{{0, 0}, {4, 1}, {0, 0}, {4, 1}}}, Status::polygon_zero_area, {0}},
        {"sliver", {{{0, 0}, {1e6F, 0}, {1e6F, 0.5F}}}, Status::polygon_zero_area, {0}},
        {"three floats apart", {{{-kBig, 0}, {kBig, kTiny}, {0, 0}}}, Status::polygon_zero_area,
         {0, -1, -1, -1, {-kBig, 0}}},
        {"hole without area", {kBox, {{1, 1}, {2, 2}, {3, 3}}}, Status::polygon_zero_area,
         {1, -1, -1, -1, {1, 1}}},
        {"bow tie", {{{0, 0}, {4, 4}, {4, 0}, {0, 4}}}, Status::polygon_crosses_itself,
         {0, 0, 0, 2, {2, 2}}},
        {"unequal bow tie", {{{0, 0}, {4, 4}, {4, -2}, {0, 4}}}, Status::polygon_crosses_itself,
         {0, 0, 0, 2, {1.6F, 1.6F}}},
        {"pentagram", {{{0, 3}, {2, -3}, {-3, 1}, {3, 1}, {-2, -3}}},
         Status::polygon_crosses_itself, {0, 0, 0, 2, {2.0F / 3, 1}}},
        {"twice around", {{{0, 0}, {4, 0}, {0, 4}, {0, 0}, {4, 0}, {0, 4}}},
         Status::polygon_crosses_itself, {0, 0, 0, 2, {0, 0}}},
        {"spike", {{{0, 0}, {8, 0}, {8, 4}, {12, 4}, {8, 4}, {8, 8}, {0, 8}}},
         Status::polygon_crosses_itself, {0, 1, 0, 3, {8, 4}}},
        {"fold", {{{0, 0}, {9, 0}, {8, 0}, {8, 8}, {0, 8}}}, Status::polygon_crosses_itself,
         {0, 0, 0, 1, {9, 0}}},
        {"fold at the first vertex", {{{9, 0}, {8, 0}, {8, 8}, {0, 8}, {0, 0}}},
         Status::polygon_crosses_itself, {0, 0, 0, 4, {9, 0}}},
        {"fold over the first vertex", {{{8, 0}, {8, 8}, {0, 8}, {0, 0}, {9, 0}}},
         Status::polygon_crosses_itself, {0, 0, 0, 3, {8, 0}}},
        {"vertex on an edge", {{{0, 0}, {8, 0}, {8, 8}, {4, 0}, {0, 8}}},
         Status::polygon_crosses_itself, {0, 0, 0, 2, {4, 0}}},
        {"vertex on a vertex", {{{0, 0}, {4, 4}, {8, 0}, {8, 8}, {4, 4}, {0, 8}}},
         Status::polygon_crosses_itself, {0, 0, 0, 3, {4, 4}}},
        {"edge on an edge", {{{0, 0}, {8, 0}, {8, 4}, {6, 4}, {6, 0}, {2, 0}, {2, 4}, {0, 4}}},
         Status::polygon_crosses_itself, {0, 0, 0, 3, {6, 0}}},
        {"hole by a slit of no width",
         {{{0, 0}, {8, 0}, {8, 8}, {0, 8}, {0, 0}, {2, 2}, {2, 6}, {6, 6}, {6, 2}, {2, 2}}},
         Status::polygon_crosses_itself, {0, 0, 0, 3, {0, 0}}},
        {"teeth through the base", {zigzag(40, -1.0F)}, Status::polygon_crosses_itself,
         {0, 0, 0, 2, {39.6F, 0}}},
        {"hole crosses itself", {kBox, {{1, 1}, {5, 5}, {5, 1}, {1, 7}}},
         Status::polygon_crosses_itself, {1, 0, 1, 2, {3.4F, 3.4F}}},
        {"hole across the outline", {kBox, {{6, 3}, {10, 3}, {6, 5}}},
         Status::polygon_hole_crosses, {0, 1, 1, 0, {8, 3}}},
        {"hole touches the outline", {kBox, {{6, 3}, {8, 4}, {6, 5}}},
         Status::polygon_hole_crosses, {0, 1, 1, 0, {8, 4}}},
        {"hole shares an edge", {kBox, {{0, 0}, {8, 0}, {4, 4}}}, Status::polygon_hole_crosses,
         {0, 0, 1, 0, {0, 0}}},
        {"hole is the outline", {kBox, kBox}, Status::polygon_hole_crosses, {0, 0, 1, 0, {0, 0}}},
        {"holes cross", {kBox, {{1, 1}, {5, 1}, {3, 5}}, {{3, 2}, {7, 2}, {5, 6}}},
         Status::polygon_hole_crosses, {1, 1, 2, 0, {4.5F, 2}}},
        {"holes touch", {kBox, {{1, 1}, {4, 4}, {1, 6}}, {{4, 4}, {7, 1}, {7, 6}}},
         Status::polygon_hole_crosses, {1, 0, 2, 0, {4, 4}}},
        {"hole outside", {kBox, {{9, 1}, {10, 1}, {9, 2}}}, Status::polygon_hole_outside,
         {1, -1, 0, -1, {9, 1}}},
        {"hole around the outline", {kBox, {{-1, -1}, {9, -1}, {9, 9}, {-1, 9}}},
         Status::polygon_hole_outside, {1, -1, 0, -1, {-1, -1}}},
        {"hole in a notch", {{{0, 0}, {8, 0}, {8, 8}, {4, 1}, {0, 8}}, {{4, 5}, {5, 6}, {3, 6}}},
         Status::polygon_hole_outside, {1, -1, 0, -1, {4, 5}}},
        {"hole in a hole", {kBox, {{1, 1}, {7, 1}, {7, 7}, {1, 7}}, {{3, 3}, {4, 3}, {3, 4}}},
         Status::polygon_hole_outside, {2, -1, 1, -1, {3, 3}}},
    };
    return rows;
}

/// Ugly, but polygons.
const std::vector<HostileRow>& accepted_rows() {
    static const std::vector<HostileRow> rows = {
        {"clockwise", {{{0, 8}, {8, 8}, {8, 0}, {0, 0}}}, Status::ok},
        {"closed by its first vertex", {{{0, 0}, {8, 0}, {8, 8}, {0, 0}}}, Status::ok},
        {"each vertex fifty times", {repeated(kBox, 50)}, Status::ok},
        {"minus zero is zero", {{{0.0F, -0.0F}, {-0.0F, 0.0F}, {8, 0}, {0, 8}}}, Status::ok},
        {"straight corners", {{{0, 0}, {1, 0}, {2, 0}, {8, 0}, {8, 8}, {4, 8}, {0, 8}, {0, 1}}},
         Status::ok},
        {"a hair above an edge", {{{0, 0}, {8, 0}, {8, 8}, {4, 4e-8F}, {0, 8}}}, Status::ok},
        {"teeth that all but reach the base", {zigzag(40, 1e-6F)}, Status::ok},
        {"needle", {{{0, 0}, {8, 0}, {8, 0.001F}}}, Status::ok},
        {"hole all but as large", {kBox, {{1e-5F, 1e-5F}, {7.9999F, 1e-5F}, {4, 7.9999F}}},
         Status::ok},
        {"hole of repeated vertices", {kBox, repeated({{3, 3}, {5, 3}, {3, 5}}, 9)}, Status::ok},
        {"holes a float apart",
         {kBox, {{1, 1}, {4, 4}, {1, 6}}, {{std::nextafter(4.0F, 5.0F), 4}, {7, 1}, {7, 6}}},
         Status::ok},
        {"corner of a hole in line with others",
         {kBox, {{1, 1}, {2, 1}, {1, 2}}, {{3, 1}, {4, 1}, {3, 2}}, {{5, 1}, {6, 1}, {5, 2}}},
         Status::ok},
    };
    return rows;
}

BodyDef body_of(const Rings& rings, std::vector<View<Vec2f>>& views) {
    for (const Ring& ring : rings) {
        views.push_back({ring.data(), static_cast<std::int32_t>(ring.size())});
    }
    BodyDef def;
    def.polygon = views[0];
    def.holes = {views.data() + 1, static_cast<std::int32_t>(views.size()) - 1};
    def.motion.position_m = {4, 4};
    return def;
}

WorldDef roomy_def() {
    WorldDef def = small_def();
    def.cell_m = 1.0F;
    def.capacity.vertices = 600;
    return def;
}

void expect_place(const PolygonFault& fault, const Place& place) {
    EXPECT_EQ(fault.ring_a, place.ring_a);
    EXPECT_EQ(fault.edge_a, place.edge_a);
    EXPECT_EQ(fault.ring_b, place.ring_b);
    EXPECT_EQ(fault.edge_b, place.edge_b);
    EXPECT_FLOAT_EQ(fault.place_m.x, place.at.x);
    EXPECT_FLOAT_EQ(fault.place_m.y, place.at.y);
}

TEST(HostilePolygons, AreRefusedWithTheirFault) {
    EXPECT_GE(refused_rows().size(), 25U);
    for (const HostileRow& row : refused_rows()) {
        SCOPED_TRACE(row.name);
        std::vector<View<Vec2f>> views;
        const BodyDef def = body_of(row.rings, views);
        PolygonFault fault;
        EXPECT_EQ(check_polygon(def.polygon, def.holes, &fault), row.expected);
        expect_place(fault, row.place);
        TestWorld<float> world(roomy_def());
        const std::uint64_t hash = world->state_hash();
        BodyId id;
        EXPECT_EQ(world->add_static_body(def, &id), row.expected);
        EXPECT_EQ(world->add_moving_body(def, &id), row.expected);
        EXPECT_EQ(world->state_hash(), hash);
    }
}

TEST(HostilePolygons, UglyOnesBecomeBodies) {
    for (const HostileRow& row : accepted_rows()) {
        SCOPED_TRACE(row.name);
        std::vector<View<Vec2f>> views;
        const BodyDef def = body_of(row.rings, views);
        PolygonFault fault;
        EXPECT_EQ(check_polygon(def.polygon, def.holes, &fault), Status::ok);
        expect_place(fault, {});
        TestWorld<float> world(roomy_def());
        ASSERT_EQ(world->fill({{0, 10}, {16, 13}}), Status::ok);
        const BodyId id = put_static(*world, def);
        for (int step = 0; step < 60; ++step) {
            world->step(0.02F);
        }
        EXPECT_TRUE(all_inside(*world));
        EXPECT_EQ(world->remove_body(id), Status::ok);
    }
}

TEST(HostilePolygons, TooManyVerticesAreCounted) {
    const Ring ring(kMaxBodyVertices + 1, Vec2f{1, 2});
    PolygonFault fault;
    const View<Vec2f> all{ring.data(), kMaxBodyVertices + 1};
    EXPECT_EQ(check_polygon(all, {}, &fault), Status::polygon_too_many_vertices);
    EXPECT_EQ(fault.vertices_needed, kMaxBodyVertices + 1);
    const View<Vec2f> box{kBox.data(), 4};
    const std::vector<View<Vec2f>> holes(4000, box);
    EXPECT_EQ(check_polygon(box, {holes.data(), 2500}, &fault), Status::polygon_too_many_vertices);
    EXPECT_EQ(fault.vertices_needed, 4 + 2500 * 7);
    EXPECT_EQ(check_polygon(box, {holes.data(), 0x7FFFFFFF}, &fault),
              Status::polygon_too_many_vertices);
    EXPECT_EQ(fault.vertices_needed, 0x7FFFFFFF);
    const View<Vec2f> endless{ring.data(), 0x7FFFFFFF};
    const View<Vec2f> two[] = {endless, endless};
    EXPECT_EQ(check_polygon(endless, {two, 2}, &fault), Status::polygon_too_many_vertices);
    EXPECT_EQ(fault.vertices_needed, 0x7FFFFFFF);
    EXPECT_EQ(check_polygon(box, {holes.data(), -1}, &fault), Status::polygon_missing);
    EXPECT_EQ(check_polygon(box, {nullptr, 1}, &fault), Status::polygon_missing);
    EXPECT_EQ(check_polygon(box, {holes.data(), 1}, nullptr), Status::polygon_hole_crosses);
    EXPECT_EQ(check_polygon(box, {}, &fault), Status::ok);
    EXPECT_EQ(fault.vertices_needed, 4);
}

}  // namespace
}  // namespace weir
