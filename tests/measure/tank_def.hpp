// The definition of a tank, as most tests want it.
#pragma once

#include "weir/config.hpp"

namespace measure {

/// So many cells, and room for so much.
constexpr weir::WorldDef tank_def(std::int32_t cells_x, std::int32_t cells_y,
                                  std::int32_t particles, std::int32_t bodies = 0,
                                  std::int32_t vertices = 0) {
    weir::WorldDef def;
    def.capacity.cells_x = cells_x;
    def.capacity.cells_y = cells_y;
    def.capacity.particles = particles;
    def.capacity.bodies = bodies;
    def.capacity.vertices = vertices;
    return def;
}

}  // namespace measure
