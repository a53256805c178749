// Where two convex pieces face each other: corners, sides that are as good, and cuts that are none.
#include "solid/piece_contact.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "test_world.hpp"

namespace weir {
namespace {

using Corners = std::vector<Vec2f>;

ConvexPiece<float> piece_of(const Corners& corners, const std::uint16_t* vertex,
                            std::int32_t count) {
    ConvexPiece<float> piece;
    piece.outline = {corners.data(), static_cast<std::int32_t>(corners.size())};
    piece.vertex = vertex;
    piece.count = count;
    return piece;
}

constexpr std::uint16_t kAll[] = {0, 1, 2, 3};
const Corners kUnit = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};

Corners moved(const Corners& corners, Vec2f by, float angle_rad = 0.0F) {
    Corners out;
    const float c = std::cos(angle_rad);
    const float s = std::sin(angle_rad);
    for (const Vec2f p : corners) {
        out.push_back({by.x + (c * p.x - s * p.y), by.y + (s * p.x + c * p.y)});
    }
    return out;
}

/// A box beside another one touches it with two corners, diagonally off with one.
TEST(PieceContact, CornersBeforeSidesAndBeforeCorners) {
    const Corners beside = moved(kUnit, {1.05F, 0.25F});
    PieceContact<float> contact = contact_of(piece_of(kUnit, kAll, 4), piece_of(beside, kAll, 4),
                                             Vec2f{0.5F, 0.5F}, 0.1F);
    ASSERT_EQ(contact.count, 2);
    EXPECT_FLOAT_EQ(contact.normal.x, -1.0F);
    EXPECT_NEAR(contact.point[0].gap, 0.05F, 1e-6F);
    EXPECT_NEAR(contact.point[1].gap, 0.05F, 1e-6F);
    EXPECT_NEAR(std::fabs(contact.point[0].at.y - contact.point[1].at.y), 0.75F, 0.01F);

    const Corners off = moved(kUnit, {1.03F, 1.04F});
    contact = contact_of(piece_of(kUnit, kAll, 4), piece_of(off, kAll, 4), Vec2f{0.5F, 0.5F},
                         0.1F);
    ASSERT_EQ(contact.count, 1);
    EXPECT_NEAR(contact.point[0].gap, 0.05F, 1e-6F);
    EXPECT_NEAR(contact.normal.x, -0.6F, 1e-4F);
    EXPECT_NEAR(contact.normal.y, -0.8F, 1e-4F);
    contact = contact_of(piece_of(kUnit, kAll, 4), piece_of(off, kAll, 4), Vec2f{0.5F, 0.5F},
                         0.045F);
    EXPECT_EQ(contact.count, 0) << "each face is near enough, the corner is not";
}

/// Of two faces that are all but as good it is always the first one's.
TEST(PieceContact, KeepsToTheFirstOnesFace) {
    for (const float angle : {-1e-3F, 1e-3F}) {
        const Corners other = moved(kUnit, {1.05F, -0.5F}, angle);
        const PieceContact<float> contact = contact_of(
            piece_of(kUnit, kAll, 4), piece_of(other, kAll, 4), Vec2f{0.5F, 0.5F}, 0.1F);
        ASSERT_EQ(contact.count, 2);
        EXPECT_EQ(contact.normal.y, 0.0F) << angle;
    }
}

/// Half of a square, cut along its diagonal: what comes from beyond the cut meets a side.
TEST(PieceContact, CutsAreNoFaces) {
    constexpr std::uint16_t kLower[] = {0, 1, 2};
    const ConvexPiece<float> lower = piece_of(kUnit, kLower, 3);
    EXPECT_TRUE(lower.is_outer(0));
    EXPECT_TRUE(lower.is_outer(1));
    EXPECT_FALSE(lower.is_outer(2));
    const Corners other = moved(kUnit, {-0.45F, 0.5F});
    const PieceContact<float> contact =
        contact_of(piece_of(other, kAll, 4), lower, Vec2f{0.5F, 0.5F}, 0.1F);
    ASSERT_GT(contact.count, 0);
    EXPECT_NEAR(std::fabs(contact.normal.x) + std::fabs(contact.normal.y), 1.0F, 1e-6F)
        << "along an axis";
}

}  // namespace
}  // namespace weir
