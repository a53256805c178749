// Nodes of a rectangle in groups: the plain loops' sums, and so their bits.
#pragma once

#include "math/four_lanes.hpp"
#include "math/wide_lanes.hpp"

namespace weir {

#if WEIR_HAS_LANES

/// Some edges of an outline, one after the other, and the nodes that are asked for them.
struct RasterEdges {
    static constexpr std::int32_t kMost = 16;

    std::int32_t count = 0;  ///< and then so many as fill a group of eight
    float x[kMost + 1];      ///< corners: edge k leads from k to k + 1
    float y[kMost + 1];
    std::uint32_t measured = 0;  ///< a bit for each from which nodes are measured
    float edge_x[kMost];
    float edge_y[kMost];
    float along_x[kMost];  ///< unit
    float along_y[kMost];
    float size[kMost];
    float run[kMost];    ///< to the right, for a row more
    float reach[kMost];  ///< to the left and to the right of where the edge is in a row
    float left[kMost];   ///< of all rows
    float right[kMost];
    std::int32_t first_row[kMost];
    std::int32_t last_row[kMost];
    /// Rows in which nodes to the right may be on the other side than those to the left.
    std::int32_t first_turn[kMost];
    std::int32_t last_turn[kMost];
};

/// The rectangle, and the fields that it is in. Rows of groups may reach beyond it.
struct RasterTask {
    std::int32_t i0, j0, i1, j1;
    std::int32_t first, end;  ///< columns in groups, as wide as one at least
    float low_x, low_y;       ///< nodes count as that far from the tank's border
    float high_x, high_y;
    float wall_left, wall_below;  ///< an edge there or beyond is none
    float wall_right, wall_above;
    float far;
    float flat;  ///< edges flatter than this meet a row everywhere at once
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

/// As `whole_numbers`.
template <class L>
inline void rows_between(typename L::Floats from, typename L::Floats to, const RasterTask& task,
                         std::int32_t* first, std::int32_t* last) {
    using Floats = typename L::Floats;
    using Ints = typename L::Ints;
    const auto floor = [](Floats value) {
        const Ints whole = L::whole(value);
        return whole + (L::floats(whole) > value);  // a mask is −1
    };
    const Floats low = L::all(static_cast<float>(task.j0));
    const Floats high = L::all(static_cast<float>(task.j1));
    const Floats one = L::all(1.0F);
    L::store_whole(first, from > low ? -floor(-L::minimum(from, high + one)) : Ints{} + task.j0);
    L::store_whole(last, to < high ? floor(L::maximum(to, low - one)) : Ints{} + task.j1);
}

/// What is asked of edges k, k + 1 …, whose corners are there.
template <class L>
inline std::uint32_t prepare_group(const RasterTask& task, std::int32_t k, RasterEdges& e) {
    using Floats = typename L::Floats;
    const Floats zero = L::all(0.0F);
    const Floats far = L::all(task.far);
    const Floats from_x = L::load(e.x + k);
    const Floats from_y = L::load(e.y + k);
    const Floats to_x = L::load(e.x + k + 1);
    const Floats to_y = L::load(e.y + k + 1);
    const Floats edge_x = to_x - from_x;
    const Floats edge_y = to_y - from_y;
    const Floats size = L::square_root(edge_x * edge_x + edge_y * edge_y);
    const auto long_enough = size > zero;
    const Floats divisor = long_enough ? size : L::all(1.0F);
    const Floats along_x = edge_x / divisor;
    const Floats along_y = edge_y / divisor;
    const Floats rise = L::absolute(along_y);
    const auto steep = rise > L::all(task.flat);
    const Floats steepness = steep ? along_y : L::all(1.0F);
    L::store(e.edge_x + k, edge_x);
    L::store(e.edge_y + k, edge_y);
    L::store(e.along_x + k, along_x);
    L::store(e.along_y + k, along_y);
    L::store(e.size + k, size);
    L::store(e.run + k, steep ? along_x / steepness : zero);
    L::store(e.reach + k, steep ? far / L::absolute(steepness) : L::all(1.0e9F));
    const Floats left = L::minimum(from_x, to_x);
    const Floats right = L::maximum(from_x, to_x);
    const Floats below = L::minimum(from_y, to_y);
    const Floats above = L::maximum(from_y, to_y);
    L::store(e.left + k, left - far);
    L::store(e.right + k, right + far);
    rows_between<L>(below - far, above + far, task, e.first_row + k, e.last_row + k);
    const Floats more = L::all(1.0F / 512.0F);  // the border moves a node by less
    rows_between<L>(below - more, above + more, task, e.first_turn + k, e.last_turn + k);
    // As `beyond`.
    const auto no_wall = (right <= L::all(task.wall_left)) | (left >= L::all(task.wall_right)) |
                         (above <= L::all(task.wall_below)) | (below >= L::all(task.wall_above));
    return L::bits_of(long_enough & ~no_wall);
}

/// Distances from one edge, where they are the least so far.
template <class L>
inline void measure_group(const RasterTask& task, const RasterEdges& e, std::int32_t k,
                          std::int32_t i, typename L::Floats x) {
    using Floats = typename L::Floats;
    const Floats zero = L::all(0.0F);
    const Floats size = L::all(e.size[k]);
    const Floats from_x = L::all(e.x[k]);
    const Floats from_y = L::all(e.y[k]);
    const Floats edge_y = L::all(e.edge_y[k]);
    const Floats along_x = L::all(e.along_x[k]);
    const Floats along_y = L::all(e.along_y[k]);
    const Floats run = L::all(e.run[k]);
    const Floats reach = L::all(e.reach[k]);
    const Floats dx = x - from_x;
    const Floats along_dx = along_x * dx;
    const Floats across_dx = along_y * dx;
    const Floats to_end = dx - L::all(e.edge_x[k]);
    const Floats square = dx * dx;
    const Floats end_square = to_end * to_end;
    const auto within = (x >= L::all(e.left[k])) & (x <= L::all(e.right[k]));
    float* row = task.value + e.first_row[k] * task.stride + i;
    Floats y = L::all(static_cast<float>(e.first_row[k]));
    for (std::int32_t j = e.first_row[k]; j <= e.last_row[k]; ++j, row += task.stride) {
        const Floats dy = y - from_y;
        const Floats end_dy = dy - edge_y;
        const Floats middle = from_x + dy * run;
        const auto asked = within & (x >= middle - reach) & (x <= middle + reach);
        const Floats at = along_dx + along_y * dy;
        const auto before = at < zero;
        const auto beside = before | (at > size);
        const Floats of_corner = before ? square + dy * dy : end_square + end_dy * end_dy;
        const Floats across = L::absolute(along_x * dy - across_dx);
        const Floats nearest = L::load(row);
        const auto nearer = beside ? of_corner < nearest * nearest : across < nearest;
        const Floats found = beside ? L::square_root(of_corner) : across;
        L::store(row, (nearer & asked) ? found : nearest);
        y = y + L::all(1.0F);
    }
}

/// Turns the sign of what is to the right of an edge.
template <class L>
inline void turn_group(const RasterTask& task, const RasterEdges& e, std::int32_t k,
                       std::int32_t i, typename L::Floats x, typename L::Ints own) {
    using Floats = typename L::Floats;
    const float from_x = e.x[k];
    const float from_y = e.y[k];
    const float to_y = e.y[k + 1];
    float* row = task.value + e.first_turn[k] * task.stride + i;
    for (std::int32_t j = e.first_turn[k]; j <= e.last_turn[k]; ++j, row += task.stride) {
        const float whole = static_cast<float>(j);
        const float y = whole < task.low_y ? task.low_y
                                           : (task.high_y < whole ? task.high_y : whole);
        if ((from_y <= y) == (to_y <= y)) {
            continue;
        }
        const float crossing =
            from_x + ((y - from_y) / (to_y - from_y)) * (e.x[k + 1] - from_x);
        const Floats value = L::load(row);
        // Not -value: no negative zero.
        L::store(row, ((x >= L::all(crossing)) & own) ? L::all(0.0F) - value : value);
    }
}

template <class L>
inline void prepare_edges(const RasterTask& task, RasterEdges& edges) {
    edges.measured = 0;
    for (std::int32_t k = 0; k < edges.count; k += L::kLanes) {
        edges.measured |= prepare_group<L>(task, k, edges) << static_cast<std::uint32_t>(k);
    }
    edges.measured &= (1U << static_cast<std::uint32_t>(edges.count)) - 1U;
}

/// The polygon's own distances from so many of its edges. `anew`: these are the first ones.
template <class L>
inline void measure_nodes(const RasterTask& task, const RasterEdges& edges, bool anew) {
    each_group_of<L>(task, [&](std::int32_t i, std::int32_t) {
        for (std::int32_t j = task.j0; anew && j <= task.j1; ++j) {
            L::store(task.value + j * task.stride + i, L::all(task.far));
        }
        const auto x = columns_from<L>(i);
        const float left = static_cast<float>(i);
        const float right = static_cast<float>(i + L::kLanes - 1);
        for (std::uint32_t these = edges.measured; these != 0; these &= these - 1U) {
            const std::int32_t k = __builtin_ctz(these);
            if (edges.left[k] <= right && edges.right[k] >= left) {
                measure_group<L>(task, edges, k, i, x);
            }
        }
    });
}

template <class L>
inline void turn_nodes(const RasterTask& task, const RasterEdges& edges) {
    each_group_of<L>(task, [&](std::int32_t i, std::int32_t from) {
        const auto column = columns_from<L>(i);
        const auto own = column >= L::all(static_cast<float>(from));
        const auto x = L::clamp(column, L::all(task.low_x), L::all(task.high_x));
        for (std::int32_t k = 0; k < edges.count; ++k) {
            turn_group<L>(task, edges, k, i, x, own);
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
    void (*prepare)(const RasterTask& task, RasterEdges& edges);
    void (*measure)(const RasterTask& task, const RasterEdges& edges, bool anew);
    void (*turn)(const RasterTask& task, const RasterEdges& edges);
    bool (*merge)(const RasterTask& task, RasterPlace& at);
};
#if WEIR_HAS_WIDE_LANES
extern const RasterLoops raster_by_eight;
#endif

#endif

}  // namespace weir
