// Grid-to-particle in lanes: runs of particles go through its three parts one after the other.
#include "step/stencil_lanes.hpp"
#include "step/tank_walls.hpp"
#include "step/transfer_lanes.hpp"

namespace weir {

#if WEIR_HAS_LANES

namespace {

/// Bilinear value and slopes of velocity and change on both kinds of faces: lanes u, change of u,
/// v, change of v.
struct SampleLanes {
    Lanes value;
    Lanes slope_x;
    Lanes slope_y;
};

/// `pairs_u`, `pairs_v`: where bases count from.
inline SampleLanes sample(const float* pairs_u, const float* pairs_v, const Strides& strides,
                          const StencilPair& at) {
    const float* u = pairs_u + 2 * static_cast<std::size_t>(at.u);
    const float* v = pairs_v + 2 * static_cast<std::size_t>(at.v);
    const Lanes low_u = load_lanes(u);
    const Lanes low_v = load_lanes(v);
    const Lanes high_u = load_lanes(u + strides.up);
    const Lanes high_v = load_lanes(v + strides.up);
    const Lanes low_left = shuffle<0, 1, 4, 5>(low_u, low_v);
    const Lanes high_left = shuffle<0, 1, 4, 5>(high_u, high_v);
    const Lanes low_slope = shuffle<2, 3, 6, 7>(low_u, low_v) - low_left;
    const Lanes high_slope = shuffle<2, 3, 6, 7>(high_u, high_v) - high_left;
    const Lanes low = low_left + at.fx * low_slope;
    const Lanes high = high_left + at.fx * high_slope;
    const Lanes slope_y = high - low;
    return {low + at.fy * slope_y, low_slope + at.fy * (high_slope - low_slope), slope_y};
}

/// So many particles go through the parts of a gather together. One particle alone takes ninety
/// cycles from its place to its next one, which is more than a processor looks ahead.
constexpr std::int32_t kRun = 64;

/// Between the parts, for each particle of a run.
struct Run {
    alignas(16) std::uint32_t u[kRun];     ///< bases, as in StencilPair
    alignas(16) std::uint32_t v[kRun];
    alignas(16) float weight[kRun][4];     ///< fx and fy of u, of v
    alignas(16) float found[kRun][4];      ///< velocity along the way, change

    StencilPair stencil(std::int32_t k) const {
        const Lanes f = load_lanes(weight[k]);
        return {u[k], v[k], shuffle<0, 0, 2, 2>(f, f), shuffle<1, 1, 3, 3>(f, f)};
    }
};

/// The first part: both stencils, of two particles at a time.
void find_stencils(const Strides& strides, const Vec2<float>* position, std::int32_t count,
                   Run& run) {
    for (std::int32_t k = 0; k < count; k += 2) {
        const Lanes x = k + 1 < count ? load_lanes(&position[k].x) : load_pair(&position[k].x);
        const Lanes on_u = x + Lanes{0.0F, 0.5F, 0.0F, 0.5F};
        const Lanes on_v = x + Lanes{0.5F, 0.0F, 0.5F, 0.0F};
        const LaneMask node_u = __builtin_convertvector(on_u, LaneMask);
        const LaneMask node_v = __builtin_convertvector(on_v, LaneMask);
        const Lanes f_u = on_u - __builtin_convertvector(node_u, Lanes);
        const Lanes f_v = on_v - __builtin_convertvector(node_v, Lanes);
        const Lanes bases = reinterpret_cast<Lanes>(
            sums_of_products(node_u, node_v, strides.factors));
        __builtin_memcpy(run.u + k, &bases, 2 * sizeof run.u[0]);
        const Lanes high = shuffle<2, 3, 2, 3>(bases, bases);
        __builtin_memcpy(run.v + k, &high, 2 * sizeof run.v[0]);
        store_lanes(run.weight[k], shuffle<0, 1, 4, 5>(f_u, f_v));
        store_lanes(run.weight[k + 1], shuffle<2, 3, 6, 7>(f_u, f_v));
    }
}

/// The second part: what the grid says along the way, and by how much it changed.
void sample_run(const float* pairs_u, const float* pairs_v, const Strides& strides, float half_dt,
                std::int32_t count, Run& run) {
    for (std::int32_t k = 0; k < count; ++k) {
        const SampleLanes at = sample(pairs_u, pairs_v, strides, run.stencil(k));
        const Lanes turned = at.slope_x * shuffle<0, 0, 0, 0>(at.value, at.value) +
                             at.slope_y * shuffle<2, 2, 2, 2>(at.value, at.value);
        const Lanes along = at.value + all_lanes(half_dt) * turned;
        store_lanes(run.found[k], shuffle<0, 2, 5, 7>(along, at.value));
    }
}

/// The third part: the particles move, two at a time unless something is in their way.
class Mover {
public:
    Mover(const GridShape& shape, const Transfer<float>& transfer)
        : transfer_(transfer),
          size_{static_cast<float>(shape.nx), static_cast<float>(shape.ny)},
          near_(all_lanes(minimum(transfer.near, transfer.limit))),
          highest_(Lanes{size_.x, size_.y, size_.x, size_.y} - all_lanes(kWallGap<float>)) {}

    void move(const Run& run, Particles<float> some) {
        const Lanes flip_ratio = all_lanes(transfer_.flip_ratio);
        const Lanes dt = all_lanes(transfer_.dt_s);
        const Lanes limit = all_lanes(transfer_.limit);
        const Lanes lowest = all_lanes(kWallGap<float>);
        std::int32_t k = 0;
        for (; k + 2 <= some.count; k += 2) {
            const Lanes first = load_lanes(run.found[k]);
            const Lanes second = load_lanes(run.found[k + 1]);
            const Lanes along = shuffle<0, 1, 4, 5>(first, second);
            const Lanes change = shuffle<2, 3, 6, 7>(first, second);
            const Lanes faster = flip_ratio * load_lanes(&some.velocity[k].x) + change;
            const Lanes speed = absolute(faster);
            const Lanes moved = load_lanes(&some.position[k].x) + dt * along;
            if (all_true((speed <= limit) & (absolute(along) <= near_) & (moved >= lowest) &
                         (moved <= highest_))) {
                fastest_ = maximum(fastest_, speed);
                store_lanes(&some.position[k].x, moved);
                store_lanes(&some.velocity[k].x, faster);
                continue;
            }
            move_one(run.found[k], k, some);
            move_one(run.found[k + 1], k + 1, some);
        }
        for (; k < some.count; ++k) {
            move_one(run.found[k], k, some);
        }
    }

    TransferResult<float> result() const {
        TransferResult<float> all = result_;
        for (std::int32_t lane = 0; lane < 4; ++lane) {
            all.max_speed = maximum(all.max_speed, fastest_[lane]);
        }
        return all;
    }

private:
    void move_one(const float* found, std::int32_t k, Particles<float>& some) {
        const Vec2<float> v = some.velocity[k];
        const Vec2<float> faster{transfer_.flip_ratio * v.x + found[2],
                                 transfer_.flip_ratio * v.y + found[3]};
        some.velocity[k] = faster;
        advect(size_, {transfer_, some.kind_at(k)}, {found[0], found[1]}, some.position[k],
               some.velocity[k], result_);
    }

    const Transfer<float>& transfer_;
    Vec2<float> size_;
    Lanes near_;
    Lanes highest_;
    Lanes fastest_ = {};
    TransferResult<float> result_;
};

}  // namespace

TransferResult<float> gather_in_lanes(const StaggeredGrid<float>& grid,
                                      const Transfer<float>& transfer,
                                      Particles<float>& particles) {
    const Strides strides(grid.shape.stride);
    const float* pairs_u = strides.of_u(static_cast<const float*>(grid.pairs));
    const float* pairs_v = strides.of_v(static_cast<const float*>(grid.u));
    Mover mover(grid.shape, transfer);
    for (std::int32_t first = 0; first < particles.count; first += kRun) {
        Run run;
        const Particles<float> some =
            particles.part(first, minimum(kRun, particles.count - first));
        find_stencils(strides, some.position, some.count, run);
        sample_run(pairs_u, pairs_v, strides, 0.5F * transfer.dt_s, some.count, run);
        mover.move(run, some);
    }
    return mover.result();
}

#endif

}  // namespace weir
