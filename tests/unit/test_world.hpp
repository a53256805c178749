// What unit tests share: a world with its own memory, and shapes.
#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <memory>
#include <new>
#include <vector>

#include "weir/weir.hpp"

namespace weir {

/// A world in aligned memory of exactly the size that it asks for.
template <class Real>
class TestWorld {
public:
    explicit TestWorld(const WorldDef& def) : def_(def), bytes_(world_bytes<Real>(def.capacity)) {
        memory_.reset(static_cast<std::byte*>(
            ::operator new(bytes_, std::align_val_t{world_alignment})));
        const Status ready = init_again();
        EXPECT_EQ(ready, Status::ok) << status_text(ready);
    }

    Status init_again() { return world_.init(def_, memory_.get(), bytes_); }
    std::byte* memory() { return memory_.get(); }
    World<Real>* operator->() { return &world_; }
    const World<Real>* operator->() const { return &world_; }
    World<Real>& operator*() { return world_; }
    const World<Real>& operator*() const { return world_; }

private:
    struct Release {
        void operator()(std::byte* memory) const {
            ::operator delete(memory, std::align_val_t{world_alignment});
        }
    };
    WorldDef def_;
    std::size_t bytes_;
    std::unique_ptr<std::byte, Release> memory_;
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

/// 16 × 16 cells of 2 cm, 200 particles, 3 bodies with 12 vertices.
inline WorldDef small_def() {
    WorldDef def;
    def.capacity.particles = 200;
    def.capacity.cells_x = 16;
    def.capacity.cells_y = 16;
    def.capacity.bodies = 3;
    def.capacity.vertices = 12;
    return def;
}

/// Whether every particle has finite numbers and lies in the tank.
template <class Real>
bool all_inside(const World<Real>& world) {
    const View<Vec2<Real>> x = world.particle_positions();
    const View<Vec2<Real>> v = world.particle_velocities();
    for (std::int32_t k = 0; k < x.size; ++k) {
        const Vec2<double> at{static_cast<double>(x[k].x), static_cast<double>(x[k].y)};
        const double sum = static_cast<double>(v[k].x) + static_cast<double>(v[k].y);
        const bool inside = at.x >= 0 && at.x < world.cells_x() && at.y >= 0 &&
                            at.y < world.cells_y();
        const bool finite = sum - sum == 0;
        if (!inside || !finite) {
            return false;
        }
    }
    return true;
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
