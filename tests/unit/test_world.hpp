// What unit tests share: a world with its own memory, and shapes.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <string>
#include <type_traits>
#include <vector>

#include "measure/tank_def.hpp"
#include "measure/world_memory.hpp"
#include "weir/weir.hpp"

extern template class std::vector<weir::Vec2f>;  // in test_world.cpp

namespace weir {

using measure::tank_def;

/// Sanitizers look at what memory is touched and how, in ten times the time: where lives are compared
/// to the bit, which others do, they get fewer, and nothing in double, whose loops are those of the
/// other arithmetics.
#if defined(__SANITIZE_ADDRESS__)
#define WEIR_SANITIZED 1
#elif defined(__has_feature)
#define WEIR_SANITIZED __has_feature(address_sanitizer)
#endif
#if WEIR_SANITIZED
constexpr bool kSanitized = true;
using EveryScalar = testing::Types<float, Fixed, SmallFixed>;
using RoomyScalars = testing::Types<float, Fixed>;
#else
constexpr bool kSanitized = false;
using EveryScalar = testing::Types<float, double, Fixed, SmallFixed>;
using RoomyScalars = testing::Types<float, double, Fixed>;
#endif

/// Numbers typed tests after their arithmetic, whatever list it stands in: bits of a float and of a
/// double, and behind the point of a place. CMake's names for tests know no words there.
struct ScalarNumber {
    template <class Real>
    static std::string GetName(int) {
        return std::is_same<Real, float>::value    ? "32"
               : std::is_same<Real, double>::value ? "64"
               : std::is_same<Real, Fixed>::value  ? "16"
                                                   : "8";
    }
};

/// Tests that are run in each arithmetic of a list.
#define WEIR_SUITE(Suite, Scalars)         \
    template <class Real>                  \
    class Suite : public testing::Test {}; \
    TYPED_TEST_SUITE(Suite, Scalars, ScalarNumber)

/// All of these cases; under sanitizers the first.
template <class T>
std::vector<T> some_of(std::initializer_list<T> all) {
    return {all.begin(), kSanitized ? all.begin() + 1 : all.end()};
}

/// A world in aligned memory of exactly the size that it asks for.
template <class Real>
class TestWorld {
public:
    explicit TestWorld(const WorldDef& def) : def_(def), memory_(measure::memory_for<Real>(def)) {
        const Status ready = init_again();
        EXPECT_EQ(ready, Status::ok) << status_text(ready);
    }

    Status init_again() { return world_.init(def_, memory_.data(), memory_.size()); }
    std::byte* memory() { return memory_.data(); }
    void run(std::int32_t steps, float dt_s = 1.0F / 60.0F) {
        for (std::int32_t k = 0; k < steps; ++k) {
            world_.step(dt_s);
        }
    }
    Diagnostics sums() {
        Diagnostics now;
        const Status asked = world_.diagnose(&now);
        EXPECT_EQ(asked, Status::ok) << status_text(asked);
        return now;
    }
    World<Real>* operator->() { return &world_; }
    const World<Real>* operator->() const { return &world_; }
    World<Real>& operator*() { return world_; }
    const World<Real>& operator*() const { return world_; }

private:
    WorldDef def_;
    measure::WorldMemory memory_;
    World<Real> world_;
};

using Ring = std::vector<Vec2f>;

// In `test_world.cpp`: else each file of tests, which are not optimised, compiles them anew.
#define WEIR_ELSEWHERE(Real)                                \
    extern template Layout layout<Real>(const Capacity&);   \
    extern template class TestWorld<Real>
WEIR_ELSEWHERE(float);
WEIR_ELSEWHERE(double);
WEIR_ELSEWHERE(Fixed);
WEIR_ELSEWHERE(SmallFixed);
#undef WEIR_ELSEWHERE

/// In metres: legs of 8 cm, right angle at the origin.
inline const Ring kTriangle = {{0, 0}, {0.08F, 0}, {0, 0.08F}};
/// In metres: a square of 4 cm about the origin.
inline const Ring kSquare4cm = {{-0.02F, -0.02F}, {0.02F, -0.02F}, {0.02F, 0.02F}, {-0.02F, 0.02F}};

BodyDef body_of(const Ring& ring, Vec2f at_m, float angle_rad = 0.0F);

Ring rectangle(float width, float height);

/// About the origin, with all corners so far from it.
Ring regular_polygon(int corners, float radius, float first_rad = 0.0F);

/// 16 × 16 cells of 2 cm, 200 particles, 3 bodies with 12 vertices.
WorldDef small_def();

void expect_ok(Status status);

template <class Real>
BodyId put_static(World<Real>& world, const BodyDef& def) {
    BodyId id;
    expect_ok(world.add_static_body(def, &id));
    return id;
}
template <class Real>
BodyId put_moving(World<Real>& world, const BodyDef& def) {
    BodyId id;
    expect_ok(world.add_moving_body(def, &id));
    return id;
}
template <class Real>
BodyId put_free(World<Real>& world, const BodyDef& def) {
    BodyId id;
    expect_ok(world.add_free_body(def, &id));
    return id;
}

/// A snapshot, no longer than it has to be.
template <class Real>
std::vector<std::byte> saved(const World<Real>& world, const Capacity& capacity) {
    std::vector<std::byte> bytes(snapshot_bytes<Real>(capacity));
    std::size_t written = 0;
    EXPECT_EQ(world.save(bytes.data(), bytes.size(), &written), Status::ok);
    EXPECT_LE(written, bytes.size());
    bytes.resize(written);
    return bytes;
}

template <class Real>
Motion motion_of(const World<Real>& world, BodyId id) {
    Motion motion;
    expect_ok(world.motion(id, &motion));
    return motion;
}

/// Of what the liquid's mass would fill.
template <class Real>
double volume_left(World<Real>& world) {
    Diagnostics now;
    expect_ok(world.diagnose(&now));
    return now.volume_m2 / now.mass_m2;
}

/// Of what is on the right of a place; both in cells.
template <class Real>
double mean_height(const World<Real>& world, double from = 0) {
    double sum = 0;
    int count = 0;
    for (const auto at : world.particle_positions()) {
        if (static_cast<double>(at.x) >= from) {
            sum += static_cast<double>(at.y);
            ++count;
        }
    }
    return sum / count;
}

/// Of all stages of a step.
std::int64_t work_of(const StepReport& report);

/// All that is told of two steps but ticks, and work if it is not asked for.
void expect_same_report(const StepReport& a, const StepReport& b, bool work = true);

/// Saves one world and goes on in another.
template <class Real>
void change_worlds(TestWorld<Real>& from, TestWorld<Real>& to, const WorldDef& def) {
    const std::vector<std::byte> bytes = saved(*from, def.capacity);
    ASSERT_EQ(to->restore(bytes.data(), bytes.size()), Status::ok);
}

/// Whether every particle has finite numbers and lies in the tank.
template <class Real>
testing::AssertionResult all_inside(const World<Real>& world) {
    const auto positions = world.particle_positions();
    const auto velocities = world.particle_velocities();
    for (std::int32_t k = 0; k < positions.size; ++k) {
        const auto x = static_cast<double>(positions[k].x);
        const auto y = static_cast<double>(positions[k].y);
        const auto u = static_cast<double>(velocities[k].x);
        const auto v = static_cast<double>(velocities[k].y);
        // 0 is where a periodic tank begins.
        const bool inside = x >= 0 && x < world.cells_x() && y >= 0 && y < world.cells_y();
        if (!inside || u - u != 0 || v - v != 0) {
            return testing::AssertionFailure() << "particle " << k << " at (" << x << ", " << y
                                               << ") with (" << u << ", " << v << ")";
        }
    }
    return testing::AssertionSuccess();
}

/// Bilinear value of the signed distance at a point of the tank, cells.
template <class Real>
double distance_at(const World<Real>& world, Vec2<Real> point) {
    const FieldView<Real> field = world.signed_distance();
    const auto i = static_cast<std::int32_t>(point.x);
    const auto j = static_cast<std::int32_t>(point.y);
    const double fx = static_cast<double>(point.x) - i;
    const double fy = static_cast<double>(point.y) - j;
    const auto at = [&](std::int32_t a, std::int32_t b) {
        return static_cast<double>(field.at(i + a, j + b));
    };
    return (1 - fy) * ((1 - fx) * at(0, 0) + fx * at(1, 0)) +
           fy * ((1 - fx) * at(0, 1) + fx * at(1, 1));
}

}  // namespace weir
