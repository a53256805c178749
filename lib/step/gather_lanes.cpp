// Grid-to-particle in lanes, but for the particles that something is in the way of.
#include "math/four_lanes.hpp"
#include "step/tank_walls.hpp"
#include "step/transfer_lanes.hpp"
#include "step/transfer_wide.hpp"

namespace weir {

#if WEIR_HAS_LANES

namespace {

/// Moves single particles as the plain loop does.
struct OneByOne {
    const Transfer<float>& transfer;
    Vec2<float> size;
    Particles<float>& particles;
    TransferResult<float> result = {};

    static void move(void* context, std::int32_t k, const float* found) {
        auto& self = *static_cast<OneByOne*>(context);
        Vec2<float>& v = self.particles.velocity[k];
        v = {self.transfer.flip_ratio * v.x + found[2], self.transfer.flip_ratio * v.y + found[3]};
        advect(self.size, {self.transfer, self.particles.kind_at(k)}, {found[0], found[1]},
               self.particles.position[k], v, self.result);
    }
};

}  // namespace

TransferResult<float> gather_in_lanes(const StaggeredGrid<float>& grid,
                                      const Transfer<float>& transfer,
                                      Particles<float>& particles) {
    const GridShape& s = grid.shape;
    const Vec2<float> size{static_cast<float>(s.nx), static_cast<float>(s.ny)};
    OneByOne rest{transfer, size, particles};
    const GatherTask task{{grid.pairs, grid.u, s.stride},
                          &particles.position->x,
                          &particles.velocity->x,
                          particles.count,
                          {size.x, size.y},
                          kWallGap<float>,
                          minimum(transfer.near, transfer.limit),
                          transfer.limit,
                          transfer.flip_ratio,
                          transfer.dt_s,
                          OneByOne::move,
                          &rest};
#if WEIR_HAS_WIDE_LANES
    const float fastest = has_wide_lanes() ? gather_wide(task) : gather_all<FourLanes>(task);
#else
    const float fastest = gather_all<FourLanes>(task);
#endif
    rest.result.max_speed = maximum(rest.result.max_speed, fastest);
    return rest.result;
}

#endif

}  // namespace weir
