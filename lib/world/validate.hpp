// The checks of set-up calls. Each answers with the first rule that is broken; none changes
// anything.
#pragma once

#include "math/scalar.hpp"
#include "weir/config.hpp"
#include "weir/status.hpp"

namespace weir {

/// What an arithmetic bears; lengths in cells, times in seconds.
struct Reach {
    std::int32_t cells = kMaxCells;
    float speed = kMaxSpeed;
    float gravity = 1.0e9F;
    float furthest = 1.0e5F;
    float surface_tension = 1.0e12F;
    bool everything = true;  ///< two liquids and surface tension
    float spin = kMaxAngle;
    float top_speed = kMaxSpeed;
};
template <class Real>
inline constexpr Reach kReach{};
template <>
inline constexpr Reach kReach<Fixed>{kMaxCellsFixed,   kMaxSpeedFixed, kMaxGravityFixed,
                                     kFurthestFixed, kMaxTensionFixed, true};
template <>
inline constexpr Reach kReach<SmallFixed>{kMaxCellsSmallFixed, kMaxSpeedSmallFixed,
                                          kMaxGravityFixed,    kFurthestFixed,
                                          0.0F,                false,
                                          kMaxAngle,           kMaxTopSpeedSmallFixed};

Status check_capacity(const Capacity& capacity);
Status check_world(const WorldDef& def, const Reach& reach);
Status check_viscosity(float viscosity_m2ps, float cell_m);
Status check_surface_tension(float tension_m3ps2, Pressure pressure, float cell_m,
                             const Reach& reach);
Status check_walls(const TankWalls& walls, float cell_m, const Reach& reach);
Status check_memory(const void* memory, std::size_t bytes, std::size_t needed);
Status check_motion(const Motion& motion, float cell_m, const Reach& reach);
Status check_body(const BodyDef& def, float cell_m, const Reach& reach);
Status check_surface(const Surface& surface, float cell_m, const Reach& reach);
Status check_box(const Box& box);
/// False for NaN.
template <class T>
constexpr bool within(T value, SameAs<T> low, SameAs<T> high) {
    return low <= value && value <= high;
}
/// Without an FPU a comparison is a call: there is one place for both.
[[gnu::noinline]] bool within(float value, float low, float high);
/// Both parts, from −most to most.
bool within(Vec2f value, float most);

}  // namespace weir
