// Nodes of a rectangle in groups: the plain loops' sums, and so their bits.
#pragma once

#include "math/four_lanes.hpp"
#include "math/wide_lanes.hpp"

namespace weir {

#if WEIR_HAS_LANES

/// An edge, and the nodes that are asked for it.
struct RasterEdge {
    float from_x, from_y;
    float edge_x, edge_y;
    float along_x, along_y;  ///< unit
    float size;
    float run;          ///< to the right, for a row more
    float reach;        ///< to the left and to the right of where it is in a row
    float left, right;  ///< of all rows
    std::int32_t first_row, last_row;
};

/// An edge, of which the nodes to the right are on the other side than those to the left.
struct RasterTurn {
    float from_x, from_y;
    float to_x, to_y;
    std::int32_t first_row, last_row;
};

struct EdgesOfOutline {
    static constexpr std::int32_t kMost = 16;
    RasterEdge edge[kMost];
    RasterTurn turn[kMost];
    std::int32_t edges = 0;
    std::int32_t turns = 0;
};

/// The rectangle, and the fields that it is in. Rows of groups may reach beyond it.
struct RasterTask {
    std::int32_t i0, j0, i1, j1;
    std::int32_t first, end;  ///< columns in groups, as wide as one at least
    float low_x, low_y;       ///< nodes count as that far from the tank's border
    float high_x, high_y;
    float far;
    float on_the_outline;
    std::uint16_t name;
    float* value;  ///< the polygon's own distances; of node (0, 0)
    float* distance;
    std::uint16_t* nearest;
    std::int32_t stride;
};

/// visit(where a group of a row begins, its first column that the group before has not).
template <class L, class Visit>
inline void each_group_of(const RasterTask& task, const Visit& visit) {
    for (std::int32_t i = task.first; i < task.end; i += L::kLanes) {
        const std::int32_t last = task.end - L::kLanes;
        visit(i < last ? i : last, i);
    }
}

template <class L>
inline typename L::Floats columns_from(std::int32_t i) {
    constexpr std::int32_t kCount[] = {0, 1, 2, 3, 4, 5, 6, 7};
    static_assert(L::kLanes <= 8);
    return L::floats(L::load_whole(kCount) + i);
}

/// Distances from one edge, where they are the least so far.
template <class L>
inline void measure_group(const RasterEdge& e, float* first_row, std::int32_t stride,
                          typename L::Floats x) {
    using Floats = typename L::Floats;
    const Floats zero = L::all(0.0F);
    const Floats size = L::all(e.size);
    const Floats dx = x - L::all(e.from_x);
    const Floats along_dx = L::all(e.along_x) * dx;
    const Floats across_dx = L::all(e.along_y) * dx;
    const Floats to_end = dx - L::all(e.edge_x);
    const Floats square = dx * dx;
    const Floats end_square = to_end * to_end;
    float* row = first_row;
    for (std::int32_t j = e.first_row; j <= e.last_row; ++j, row += stride) {
        const float y = static_cast<float>(j);
        const float dy = y - e.from_y;
        const float end_dy = dy - e.edge_y;
        const float middle = e.from_x + dy * e.run;
        const float low = middle - e.reach;
        const float high = middle + e.reach;
        const auto asked = (x >= L::all(e.left < low ? low : e.left)) &
                           (x <= L::all(high < e.right ? high : e.right));
        const Floats at = along_dx + L::all(e.along_y * dy);
        const auto before = at < zero;
        const auto beside = before | (at > size);
        const Floats of_corner =
            before ? square + L::all(dy * dy) : end_square + L::all(end_dy * end_dy);
        const Floats across = L::absolute(L::all(e.along_x * dy) - across_dx);
        const Floats nearest = L::load(row);
        const auto nearer = beside ? of_corner < nearest * nearest : across < nearest;
        const Floats found = beside ? L::square_root(of_corner) : across;
        L::store(row, (nearer & asked) ? found : nearest);
    }
}

/// Turns the sign of what is to the right of an edge.
template <class L>
inline void turn_group(const RasterTask& task, const RasterTurn& e, std::int32_t i,
                       typename L::Floats x, typename L::Ints own) {
    using Floats = typename L::Floats;
    float* row = task.value + e.first_row * task.stride + i;
    for (std::int32_t j = e.first_row; j <= e.last_row; ++j, row += task.stride) {
        const float whole = static_cast<float>(j);
        const float y = whole < task.low_y ? task.low_y
                                           : (task.high_y < whole ? task.high_y : whole);
        if ((e.from_y <= y) == (e.to_y <= y)) {
            continue;
        }
        const float crossing =
            e.from_x + ((y - e.from_y) / (e.to_y - e.from_y)) * (e.to_x - e.from_x);
        const Floats value = L::load(row);
        // Not -value: no negative zero.
        L::store(row, ((x >= L::all(crossing)) & own) ? L::all(0.0F) - value : value);
    }
}

/// The polygon's own distances from so many of its edges. `anew`: these are the first ones.
template <class L>
inline void measure_nodes(const RasterTask& task, const EdgesOfOutline& edges, bool anew) {
    each_group_of<L>(task, [&](std::int32_t i, std::int32_t) {
        for (std::int32_t j = task.j0; anew && j <= task.j1; ++j) {
            L::store(task.value + j * task.stride + i, L::all(task.far));
        }
        const auto x = columns_from<L>(i);
        const float left = static_cast<float>(i);
        const float right = static_cast<float>(i + L::kLanes - 1);
        for (std::int32_t k = 0; k < edges.edges; ++k) {
            const RasterEdge& e = edges.edge[k];
            if (e.left <= right && e.right >= left) {
                measure_group<L>(e, task.value + e.first_row * task.stride + i, task.stride, x);
            }
        }
    });
}

template <class L>
inline void turn_nodes(const RasterTask& task, const EdgesOfOutline& edges) {
    each_group_of<L>(task, [&](std::int32_t i, std::int32_t from) {
        const auto column = columns_from<L>(i);
        const auto own = column >= L::all(static_cast<float>(from));
        const auto x = L::clamp(column, L::all(task.low_x), L::all(task.high_x));
        for (std::int32_t k = 0; k < edges.turns; ++k) {
            turn_group<L>(task, edges.turn[k], i, x, own);
        }
    });
}

/// Where a group of nodes begins.
struct RasterPlace {
    std::int32_t i, j;
};

/// Merges groups into the field, row by row, up to one with a node that is deep inside. False:
/// there is none left.
template <class L>
inline bool merge_nodes(const RasterTask& task, RasterPlace& at) {
    using Floats = typename L::Floats;
    using Ints = typename L::Ints;
    const Floats far = L::all(task.far);
    const Floats zero = L::all(0.0F);
    const Ints name = Ints{} + static_cast<std::int32_t>(task.name);
    for (; at.j <= task.j1; ++at.j, at.i = task.first) {
        for (; at.i < task.end; at.i += L::kLanes) {
            const std::int32_t last = task.end - L::kLanes;
            const std::int32_t i = at.i < last ? at.i : last;
            const std::int32_t node = at.j * task.stride + i;
            const Floats value = L::load(task.value + node);
            const Floats x = columns_from<L>(i);
            const auto within = (x >= L::all(static_cast<float>(task.i0))) &
                                (x <= L::all(static_cast<float>(task.i1)));
            if (L::any_true((value <= zero - far) & within)) {
                return true;
            }
            const auto inside = value < L::all(task.on_the_outline);
            const Floats own = inside ? L::minimum(value, zero) : value;
            const Ints named = L::shorts(task.nearest + node);
            const Floats stored = L::load(task.distance + node);
            const auto taken =
                within & ((own < stored) | ((own == stored) & (own < far) & (name < named)));
            L::store(task.distance + node, taken ? own : stored);
            L::store_shorts(task.nearest + node, taken ? name : named);
        }
    }
    return false;
}

/// The same with as many lanes as the processor has.
struct RasterLoops {
    std::int32_t lanes;
    void (*measure)(const RasterTask& task, const EdgesOfOutline& edges, bool anew);
    void (*turn)(const RasterTask& task, const EdgesOfOutline& edges);
    bool (*merge)(const RasterTask& task, RasterPlace& at);
};
#if WEIR_HAS_WIDE_LANES
extern const RasterLoops raster_by_eight;
#endif

#endif

}  // namespace weir
