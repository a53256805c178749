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
    TransferResult<float> result;
    auto* const left = transfer.keeps_places ? static_cast<float*>(transfer.ways) : nullptr;
    const auto gather = [&](std::int32_t first, std::int32_t end, [[maybe_unused]] bool wide) {
        Particles<float> some = particles.part(first, end - first);
        OneByOne rest{transfer, size, some};
        const GatherTask task{{grid.pairs, grid.as_pairs(grid.u), s.stride},
                              &some.position->x,
                              &some.velocity->x,
                              some.count,
                              {size.x, size.y},
                              kWallGap<float>,
                              transfer.limit,
                              transfer.flip_ratio,
                              transfer.dt_s,
                              OneByOne::move,
                              &rest,
                              left != nullptr ? left + 2 * first : nullptr};
#if WEIR_HAS_WIDE_LANES
        const Gathered fastest = wide ? gather_wide(task) : gather_all<FourLanes>(task);
#else
        const Gathered fastest = gather_all<FourLanes>(task);
#endif
        result.add(rest.result);
        result.far += fastest.along > transfer.near ? 1 : 0;
        result.max_speed = maximum(result.max_speed, fastest.speed);
    };
#if WEIR_HAS_WIDE_LANES
    // Of the last two one may be missing, and is looked up where the tank begins: that must exist.
    const std::int32_t paired =
        grid.origin != 0 && has_wide_lanes() ? particles.count & ~1 : particles.count;
    gather(0, paired, has_wide_lanes());
#else
    const std::int32_t paired = 0;
#endif
    if (paired < particles.count) {
        gather(paired, particles.count, false);
    }
    return result;
}

#endif

}  // namespace weir
