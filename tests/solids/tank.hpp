// A world in memory of its own, for problems of whole worlds.
#pragma once

#include <cstddef>
#include <stdexcept>
#include <vector>

#include "measure/world_memory.hpp"
#include "weir/weir.hpp"

namespace solids {

inline void require(weir::Status status) {
    if (status != weir::Status::ok) {
        throw std::runtime_error(weir::status_text(status));
    }
}

template <class Real>
class Tank {
public:
    explicit Tank(const weir::WorldDef& def) : memory_(measure::memory_for<Real>(def)) {
        require(world_.init(def, memory_.data(), memory_.size()));
    }
    weir::World<Real>* operator->() { return &world_; }
    weir::World<Real>& operator*() { return world_; }
    const std::byte* memory() const { return memory_.data(); }

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
