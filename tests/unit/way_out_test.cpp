// Where a particle that is in a solid gets out of it.
#include <gtest/gtest.h>

#include <vector>

#include "solid/contour_hit.hpp"
#include "solid/way_out.hpp"

namespace weir {
namespace {

/// Cells lie in rings around the particle's own. A corner of one may be further away than the next
/// but one ring.
TEST(WayOut, IsTheNearestWhateverRingItIsIn) {
    const GridShape shape{12, 12, 14};
    std::vector<std::uint8_t> cell_case(static_cast<std::size_t>(shape.size()), kCellInside);
    Walls<float> walls;
    walls.active = true;
    walls.cell_case = cell_case.data();
    cell_case[static_cast<std::size_t>(shape.index(4, 4))] = kCellOutside;
    cell_case[static_cast<std::size_t>(shape.index(7, 5))] = kCellOutside;
    Vec2<float> place;
    ASSERT_TRUE(nearest_free_place(shape, walls, Vec2<float>{5.95F, 5.9F}, 4, place));
    EXPECT_EQ(static_cast<int>(place.x), 7);
    EXPECT_EQ(static_cast<int>(place.y), 5);
    EXPECT_FALSE(nearest_free_place(shape, walls, Vec2<float>{10.5F, 10.5F}, 2, place));
}

}  // namespace
}  // namespace weir
