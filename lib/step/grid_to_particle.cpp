#include "step/grid_to_particle.hpp"

#include "step/tank_walls.hpp"
#include "step/transfer_fpu.hpp"
#include "step/transfer_lanes.hpp"
#include "step/transfer_packed.hpp"

namespace weir {

namespace {

/// What a particle moves within that meets nothing, as numbers to compare with.
template <class Real>
struct Clear {
    using Magnitude = decltype(magnitude_key(Real()));
    using Bound = decltype(bound_key(Real()));
    Magnitude limit;
    Magnitude near;
    Bound low;
    Bound right;
    Bound top;

    Clear(Vec2<Real> size, const Transfer<Real>& transfer)
        : limit(magnitude_key(transfer.limit)),
          near(magnitude_key(minimum(transfer.near, transfer.limit))),
          low(bound_key(kWallGap<Real>)),
          right(bound_key(size.x - kWallGap<Real>)),
          top(bound_key(size.y - kWallGap<Real>)) {}

    bool moves(Real along_x, Real along_y, Real x, Real y) const {
        return magnitude_key(along_x) <= near && magnitude_key(along_y) <= near &&
               is_between(bound_key(x), low, right) && is_between(bound_key(y), low, top);
    }
};

/// A particle that meets something, or is too fast. Not inline: few do, and the loop over all wants
/// the registers.
template <class Real>
[[gnu::noinline, gnu::cold]] void advect_rare(Vec2<Real> size, const Transfer<Real>& transfer,
                                               Vec2<Real> along, Vec2<Real> v, std::int32_t k,
                                               Particles<Real>& particles,
                                               TransferResult<Real>& result) {
    Vec2<Real> x = particles.position[k];
    advect(size, {transfer, particles.kind_at(k)}, along, x, v, result);
    particles.position[k] = x;
    particles.velocity[k] = v;
}

template <class Real>
TransferResult<Real> gather(const StaggeredGrid<Real>& grid, const Transfer<Real>& transfer,
                            Particles<Real>& particles) {
    const GridShape& s = grid.shape;
    const Vec2<Real> size{static_cast<Real>(s.nx), static_cast<Real>(s.ny)};
    const Clear<Real> clear(size, transfer);
    auto fastest = magnitude_key(Real(0));
    TransferResult<Real> result;
    Vec2<PositionOf<Real>>* position = particles.position;
    Vec2<VelocityOf<Real>>* velocity = particles.velocity;
    const Vec2<PositionOf<Real>>* const end = position + particles.count;
    for (; position != end; ++position, ++velocity) {
        const Vec2<Real> x{position->x, position->y};
        const Stencil<Real> at_u = stencil_u(s, x);
        const Stencil<Real> at_v = stencil_v(s, x);
        // By components: pairs of numbers would go by way of the stack.
        const Real along_x = interpolate(grid.u, s.stride, at_u);
        const Real along_y = interpolate(grid.v, s.stride, at_v);
        const Real change_x = interpolate(grid.mass_u, s.stride, at_u);
        const Real change_y = interpolate(grid.mass_v, s.stride, at_v);
        const Real new_x = transfer.flip_ratio * velocity->x + change_x;
        const Real new_y = transfer.flip_ratio * velocity->y + change_y;
        const Real to_x = x.x + transfer.dt_s * along_x;
        const Real to_y = x.y + transfer.dt_s * along_y;
        const auto speed_x = magnitude_key(new_x);
        const auto speed_y = magnitude_key(new_y);
        auto most = fastest;
        if (speed_x > most || speed_y > most) {  // seldom: a branch costs less than a choice
            most = speed_x > speed_y ? speed_x : speed_y;
        }
        if (most <= clear.limit && clear.moves(along_x, along_y, to_x, to_y)) {
            fastest = most;
            position->x = to_x;
            position->y = to_y;
            velocity->x = new_x;
            velocity->y = new_y;
        } else {
            const auto k = static_cast<std::int32_t>(position - particles.position);
            advect_rare(size, transfer, {along_x, along_y}, {new_x, new_y}, k, particles, result);
        }
    }
    result.max_speed = maximum(result.max_speed, Real(magnitude_of_key(fastest)));
    return result;
}

/// What is slow loses half, so that last digits come to rest: with a sixteenth they go round. What
/// falls is faster.
[[gnu::noinline, gnu::cold]] void settle(const Particles<Fixed>& particles) {
    const auto slower = [](Fixed v) {
        return absolute(v) <= kSettling<Fixed> ? Fixed::of_raw(v.raw / 2) : v;
    };
    for (std::int32_t k = 0; k < particles.count; ++k) {
        Vec2<Fixed>& v = particles.velocity[k];
        v = {slower(v.x), slower(v.y)};
    }
}

#if WEIR_HAS_FPU_LOOPS

TransferResult<float> gather_with_fpu(const StaggeredGrid<float>& grid,
                                      const Transfer<float>& transfer,
                                      Particles<float>& particles) {
    const GridShape& s = grid.shape;
    const Vec2<float> size{static_cast<float>(s.nx), static_cast<float>(s.ny)};
    const Clear<float> clear(size, transfer);
    const fpu::Faces faces(grid);
    const fpu::GatherTask task{transfer.dt_s, transfer.flip_ratio, clear.limit, clear.near,
                               clear.right - clear.low, clear.top - clear.low};
    std::uint32_t fastest = 0;
    TransferResult<float> result;
    const Vec2<float>* const end = particles.position + particles.count;
    for (std::int32_t k = 0; k < particles.count; ++k) {
        fpu::Found found;
        const Vec2<float>* stopped =
            fpu::gather(faces, task, particles.position + k, particles.velocity + k, end, fastest,
                        found);
        k = static_cast<std::int32_t>(stopped - particles.position);
        if (stopped != end) {
            advect_rare(size, transfer, found.along, found.velocity, k, particles, result);
        }
    }
    result.max_speed = maximum(result.max_speed, magnitude_of_key(fastest));
    return result;
}

#endif

}  // namespace

template <class Real>
void prepare_gather(StaggeredGrid<Real>& grid, Work work) {
    if constexpr (kHasLanes<Real>) {
        if (grid.pairs != nullptr) {
            pair_fields(grid, work);
        }
    }
}

template <class Real>
TransferResult<Real> grid_to_particle(const StaggeredGrid<Real>& grid,
                                      const Transfer<Real>& transfer,
                                      Particles<Real>& particles) {
    if constexpr (kHasLanes<Real>) {
        if (grid.pairs != nullptr) {
            return gather_in_lanes(grid, transfer, particles);
        }
    }
    if constexpr (Stored<Real>::coarse) {
        return gather_packed(grid, transfer, particles);
    } else if constexpr (kHasFpuLoops<Real>) {
        return gather_with_fpu(grid, transfer, particles);
    } else {
        const TransferResult<Real> result = gather(grid, transfer, particles);
        if constexpr (kSettles<Real>) {
            if (transfer.settling) {
                settle(particles);
            }
        }
        return result;
    }
}

#define WEIR_INSTANTIATE(Real)                                                      \
    template void prepare_gather(StaggeredGrid<Real>&, Work);                       \
    template TransferResult<Real> grid_to_particle(                                 \
        const StaggeredGrid<Real>&, const Transfer<Real>&, Particles<Real>&);
WEIR_FOR_EACH_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
