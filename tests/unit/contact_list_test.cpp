// Where free bodies have more points of contact than the list has room for.
#include <gtest/gtest.h>

#include "solid/obstacles.hpp"
#include "world_inside.hpp"

namespace weir {
namespace {

/// Eight teeth of a cell on a bar of 32 cells.
Ring comb() {
    constexpr float kCell = 0.02F;
    Ring ring = {{16 * kCell, kCell}, {-16 * kCell, kCell}};
    for (int tooth = 0; tooth < 8; ++tooth) {
        const float left = (static_cast<float>(4 * tooth) - 16.0F) * kCell;
        ring.push_back({left, -kCell});
        ring.push_back({left + kCell, -kCell});
        ring.push_back({left + kCell, 0.0F});
        ring.push_back({left + 4 * kCell, 0.0F});
    }
    return ring;
}

/// The nearest points are kept, and the list is in the order of the bodies, as its readers take it.
TEST(ContactList, IsInOrderWhenItIsFull) {
    WorldDef def = tank_def(80, 20, 100, 2, 100);  // room for twelve
    def.capacity.two_way = true;
    TestWorld<float> world{def};
    const Ring ring = comb();
    const Ring box = rectangle(0.1F, 0.04F);
    put_free(*world, body_of(ring, {0.4F, 0.025F}));
    put_free(*world, body_of(box, {1.1F, 0.021F}));
    world->step(1.0F / 240.0F);
    const Meetings<float> list(state_of(world).simulation.bodies);
    ASSERT_EQ(*list.used, list.room);
    int of_second = 0;
    for (std::int32_t k = 1; k < *list.used; ++k) {
        EXPECT_LE(list.entry[k - 1].slot, list.entry[k].slot) << k;
        of_second += list.entry[k].slot == 1 ? 1 : 0;
    }
    EXPECT_EQ(of_second, 2);
}

}  // namespace
}  // namespace weir
