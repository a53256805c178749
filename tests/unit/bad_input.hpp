// What the tables of bad input share: the world on which a call is tried, a row, and its check.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <vector>

#include "test_world.hpp"
#include "weir/weir.hpp"

namespace weir {

inline constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
inline constexpr float kInf = std::numeric_limits<float>::infinity();

/// A world with liquid, a static and a moving body, one removed body and a little room left.
struct Fixture {
    TestWorld<float> world{small_def()};
    TestWorld<float> other{small_def()};
    BodyId fixed;
    BodyId moving;
    BodyId stale;
    BodyId foreign;

    Fixture() {
        const auto expect_ok = [](Status status) {
            ASSERT_EQ(status, Status::ok) << status_text(status);
        };
        // The same calls in both worlds, so that a name differs in nothing but its world.
        for (TestWorld<float>* each : {&other, &world}) {
            TestWorld<float>& here = *each;
            fixed = put_static(*here, body_of(kTriangle, {0.2F, 0.02F}));
            stale = put_static(*here, body_of(kTriangle, {0.2F, 0.2F}));
            expect_ok(here->remove_body(stale));
            foreign = moving;
            moving = put_moving(*here, body_of(kSquare4cm, {0.1F, 0.2F}));
        }
        EXPECT_EQ(foreign.slot, moving.slot);
        EXPECT_EQ(foreign.generation, moving.generation);
        expect_ok(world->fill({{0, 0}, {0.1F, 0.1F}}));
    }
    World<float>& operator*() { return *world; }
};

struct Row {
    const char* name;
    Status (*call)(Fixture&);
    Status expected;
};

/// Tables of bad_input_init_test.cpp.
const std::vector<Row>& init_rows();
const std::vector<Row>& uninitialised_rows();
/// Table of snapshot_test.cpp.
const std::vector<Row>& snapshot_rows();
/// Table of fixed_limits_test.cpp.
const std::vector<Row>& fixed_rows();

/// Makes the call, and three steps beside a twin that never got it.
inline void check(const Row& row) {
    SCOPED_TRACE(row.name);
    Fixture world;
    Fixture twin;
    const std::uint64_t hash = (*world).state_hash();
    const std::int32_t particles = (*world).particle_positions().size;
    ASSERT_EQ(hash, (*twin).state_hash());

    const Status answer = row.call(world);
    EXPECT_EQ(answer, row.expected) << status_text(answer);
    // no_free_body adds and removes a body on its way, which leaves a generation behind.
    if (row.expected != Status::no_free_body) {
        EXPECT_EQ((*world).state_hash(), hash);
    } else {
        EXPECT_EQ(row.call(twin), row.expected);
    }
    EXPECT_EQ((*world).particle_positions().size, particles);
    for (int step = 0; step < 3; ++step) {
        (*world).step(1.0F / 60.0F);
        (*twin).step(1.0F / 60.0F);
        EXPECT_EQ((*world).state_hash(), (*twin).state_hash()) << "step " << step;
    }
}

inline void check_all(const std::vector<Row>& rows) {
    for (const Row& row : rows) {
        check(row);
    }
}

}  // namespace weir
