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

namespace weir {

using measure::tank_def;

using EveryScalar = testing::Types<float, double, Fixed, SmallFixed>;
using RoomyScalars = testing::Types<float, double, Fixed>;

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

/// Sanitizers look at what memory is touched and how, in ten times the time: where lives are compared
/// to the bit, which others do, they get fewer.
#if defined(__SANITIZE_ADDRESS__)
constexpr bool kSanitized = true;
#elif defined(__has_feature)
constexpr bool kSanitized = __has_feature(address_sanitizer);
#else
constexpr bool kSanitized = false;
#endif

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

/// In metres: legs of 8 cm, right angle at the origin.
inline const Ring kTriangle = {{0, 0}, {0.08F, 0}, {0, 0.08F}};
/// In metres: a square of 4 cm about the origin.
inline const Ring kSquare4cm = {{-0.02F, -0.02F}, {0.02F, -0.02F}, {0.02F, 0.02F}, {-0.02F, 0.02F}};

inline BodyDef body_of(const Ring& ring, Vec2f at_m, float angle_rad = 0.0F) {
    BodyDef def;
    def.polygon = {ring.data(), static_cast<std::int32_t>(ring.size())};
    def.motion.position_m = at_m;
    def.motion.angle_rad = angle_rad;
    return def;
}

inline Ring rectangle(float width, float height) {
    return {{-0.5F * width, -0.5F * height},
            {0.5F * width, -0.5F * height},
            {0.5F * width, 0.5F * height},
            {-0.5F * width, 0.5F * height}};
}

/// About the origin, with all corners so far from it.
inline Ring regular_polygon(int corners, float radius, float first_rad = 0.0F) {
    Ring ring;
    for (int k = 0; k < corners; ++k) {
        const float angle =
            first_rad + 6.2831853F * static_cast<float>(k) / static_cast<float>(corners);
        ring.push_back({radius * std::cos(angle), radius * std::sin(angle)});
    }
    return ring;
}

/// 16 × 16 cells of 2 cm, 200 particles, 3 bodies with 12 vertices.
inline WorldDef small_def() { return tank_def(16, 16, 200, 3, 12); }

inline void expect_ok(Status status) { EXPECT_EQ(status, Status::ok) << status_text(status); }

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

/// Of all stages of a step.
inline std::int64_t work_of(const StepReport& report) {
    std::int64_t all = 0;
    for (const std::uint32_t work : report.work) {
        all += work;
    }
    return all;
}

/// All that is told of two steps but ticks, and work if it is not asked for.
inline void expect_same_report(const StepReport& a, const StepReport& b, bool work = true) {
    for (std::int32_t stage = 0; work && stage < kStageCount; ++stage) {
        EXPECT_EQ(a.work[stage], b.work[stage]) << stage_name(static_cast<weir::Stage>(stage));
    }
    EXPECT_EQ(a.nodes_rasterized, work ? b.nodes_rasterized : a.nodes_rasterized);
    EXPECT_EQ(a.substeps, b.substeps);
    EXPECT_EQ(a.clamped, b.clamped);
    EXPECT_EQ(a.asleep, b.asleep);
    EXPECT_EQ(a.rung, b.rung);
    EXPECT_EQ(a.walls_held, b.walls_held);
    EXPECT_EQ(a.dt_s, b.dt_s);
    EXPECT_EQ(a.max_speed_mps, b.max_speed_mps);
    EXPECT_EQ(a.particles, b.particles);
    EXPECT_EQ(a.particles_asleep, b.particles_asleep);
    EXPECT_EQ(a.particles_tested, b.particles_tested);
    EXPECT_EQ(a.particles_reflected, b.particles_reflected);
    EXPECT_EQ(a.particles_stuck, b.particles_stuck);
    EXPECT_EQ(a.particles_removed_stuck, b.particles_removed_stuck);
    EXPECT_EQ(a.particles_beyond, b.particles_beyond);
    EXPECT_EQ(a.contacts_missed, b.contacts_missed);
    EXPECT_EQ(a.cells_overfull, b.cells_overfull);
    EXPECT_EQ(a.particles_crowded, b.particles_crowded);
    EXPECT_EQ(a.particles_reset, b.particles_reset);
    EXPECT_EQ(a.particles_slowed, b.particles_slowed);
    EXPECT_EQ(a.bodies_slowed, b.bodies_slowed);
}

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
