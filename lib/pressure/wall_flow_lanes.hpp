// What walls that move push into cells, some at a time: the plain loop's sums, and so its bits.
#pragma once

#include "pressure/plain_lanes.hpp"
#include "solid/bodies_lanes.hpp"

namespace weir {

#if WEIR_HAS_LANES

/// As `closed_u` and `closed_v` of `wall_flow`, where no wall is thin. `place`: of the faces, along
/// the other axis.
template <class L, bool OnU>
inline typename L::Floats flows_at_faces(const Walls<float>& walls, std::int32_t c,
                                         std::int32_t stride, typename L::Floats place) {
    const auto closed = L::all(1.0F) - L::load((OnU ? walls.open_u : walls.open_v) + c);
    const auto zero = L::all(0.0F);
    const auto pushes = closed > zero;
    if (!L::any_true(pushes)) {
        return zero;
    }
    const std::int32_t other = c + (OnU ? stride : 1);
    const auto nearer = L::load(walls.distance + c) < L::load(walls.distance + other);
    const NearestBodies<L> bodies(
        walls, nearer ? L::shorts(walls.nearest + c) : L::shorts(walls.nearest + other));
    constexpr std::size_t kY = sizeof(float);
    const auto spin = bodies.number(offsetof(Body<float>, spin));
    const auto velocity = bodies.number(offsetof(Body<float>, velocity) + (OnU ? 0 : kY));
    const auto arm = place - bodies.number(offsetof(Body<float>, position) + (OnU ? kY : 0));
    const auto speed = velocity + (OnU ? -spin * arm : spin * arm);
    return pushes ? closed * (bodies.any ? speed : zero) : zero;
}

/// As `wall_flow`.
template <class L>
inline typename L::Floats wall_flows(const RowTask& task, std::int32_t c) {
    constexpr std::int32_t kCount[] = {0, 1, 2, 3, 4, 5, 6, 7};
    static_assert(L::kLanes <= 8);
    const Walls<float>& walls = *task.walls;
    const GridShape& s = task.grid.shape;
    const std::int32_t up = c + s.stride;
    const auto half = L::all(0.5F);
    const auto x = L::floats(L::load_whole(kCount) + (s.i0 + c - s.index(0, task.j))) + half;
    const auto y = L::all(static_cast<float>(s.j0 + task.j)) + half;
    return (flows_at_faces<L, true>(walls, c + 1, s.stride, y) -
            flows_at_faces<L, true>(walls, c, s.stride, y)) +
           (flows_at_faces<L, false>(walls, up, s.stride, x) -
            flows_at_faces<L, false>(walls, c, s.stride, x));
}

/// As RowTask::add_flow, where no wall is thin.
template <class L>
inline void add_wall_flows(const RowTask& task, std::int32_t c, std::uint32_t asked,
                           std::uint32_t wide, float* divergence) {
    using H = typename L::UpToEight;
    for (std::int32_t k = 0; k < L::kLanes; k += H::kLanes) {
        const std::uint32_t touched =
            H::bits_of(H::bytes(task.walls->cell_case + c + k) != 0);
        const std::uint32_t these = asked >> k & (~(wide >> k) | touched) &
                                    ((1U << H::kLanes) - 1U);
        if (these != 0) {
            const auto without = H::load(divergence + k);
            H::store(divergence + k,
                     H::lanes_of(these) ? without + wall_flows<H>(task, c + k) : without);
        }
    }
}

#endif

}  // namespace weir
