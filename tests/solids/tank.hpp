// A world in memory of its own, for problems of whole worlds.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "math/vec2.hpp"
#include "measure/world_memory.hpp"
#include "scalar.hpp"
#include "weir/weir.hpp"

namespace solids {

/// Of a particle, cells/s.
template <class Real>
weir::Vec2<double> velocity_of(const weir::World<Real>& world, std::int32_t k) {
    const double per_s =
        static_cast<double>(world.velocity_scale()) / static_cast<double>(world.cell_m());
    return per_s * weir::convert<double>(world.particle_velocities()[k]);
}

template <class Real>
class Tank {
public:
    explicit Tank(const weir::WorldDef& def) : memory_(measure::memory_for<Real>(def)) {
        require(world_.init(def, memory_.data(), memory_.size()));
    }
    weir::World<Real>* operator->() { return &world_; }
    const weir::World<Real>* operator->() const { return &world_; }
    const weir::World<Real>& operator*() const { return world_; }
    const std::byte* memory() const { return memory_.data(); }

    /// Of a particle, cells and cells/s.
    weir::Vec2<double> position(std::int32_t k) const {
        return weir::convert<double>(world_.particle_positions()[k]);
    }
    weir::Vec2<double> velocity(std::int32_t k) const { return velocity_of(world_, k); }

private:
    measure::WorldMemory memory_;
    weir::World<Real> world_;
};

using Ring = std::vector<weir::Vec2f>;

/// A rectangle about the origin, m.
inline Ring rectangle(double width, double height) {
    const auto x = static_cast<float>(0.5 * width);
    const auto y = static_cast<float>(0.5 * height);
    return {{-x, -y}, {x, -y}, {x, y}, {-x, y}};
}

inline weir::BodyDef body_of(const Ring& ring, double x_m, double y_m, double angle_rad = 0.0) {
    weir::BodyDef def;
    def.polygon = {ring.data(), static_cast<std::int32_t>(ring.size())};
    def.motion.position_m = {static_cast<float>(x_m), static_cast<float>(y_m)};
    def.motion.angle_rad = static_cast<float>(angle_rad);
    return def;
}

}  // namespace solids
