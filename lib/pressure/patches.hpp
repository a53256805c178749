// The cells of one coarse cell.
#pragma once

#include "pressure/pressure_fields.hpp"

namespace weir {

/// At the tank's far sides a patch may have fewer cells than kCoarseEdge along an axis.
struct Patch {
    std::int32_t q;  ///< the coarse cell
    std::int32_t i;  ///< the lower left cell
    std::int32_t j;
    std::int32_t width;
    std::int32_t height;
};

inline Patch patch_of(const GridShape& s, const GridShape& big, std::int32_t column,
                      std::int32_t row) {
    const std::int32_t i = kCoarseEdge * column;
    const std::int32_t j = kCoarseEdge * row;
    return {big.index(column, row), i, j, minimum(kCoarseEdge, s.nx - i),
            minimum(kCoarseEdge, s.ny - j)};
}

/// Those of a row of patches that are worked on.
inline Part patches_in(const GridShape& s, const GridShape& big, std::int32_t row) {
    if (!s.has_spans()) {
        return {0, big.nx};
    }
    const Part columns = s.columns(kCoarseEdge * row);
    return {columns.first / kCoarseEdge, coarse_cells(columns.end)};
}

/// How many of them are of full width.
inline std::int32_t whole_patches(const GridShape& s, std::int32_t row) {
    const Part columns = s.columns(kCoarseEdge * row);
    return columns.end / kCoarseEdge - columns.first / kCoarseEdge;
}

/// By row, from below.
template <class Visit>
void for_each_patch(const GridShape& s, const GridShape& big, const Part& rows, Visit visit) {
    for (std::int32_t row = rows.first; row < rows.end; ++row) {
        const Part columns = patches_in(s, big, row);
        for (std::int32_t column = columns.first; column < columns.end; ++column) {
            visit(patch_of(s, big, column, row));
        }
    }
}

/// As many rows as the work allows.
template <class Visit>
void for_each_patch(const GridShape& s, const GridShape& big, Work work, Visit visit) {
    for_each_patch(s, big, work.take(big.ny, kCoarseEdge * s.nx), visit);
}

/// The same where a patch changes nothing that another one reads, by several threads: visit(patch,
/// number of the piece).
template <class Visit>
void share_patches(const GridShape& s, const GridShape& big, Work work, const Visit& visit) {
    const std::int32_t cost = kCoarseEdge * s.nx;
    work.share(work.take(big.ny, cost), cost, 1, [&](const Part& rows, std::int32_t piece) {
        for_each_patch(s, big, rows, [&](const Patch& patch) { visit(patch, piece); });
    });
}

/// Coarse cells that a piece of a loop may add to.
struct Targets {
#if WEIR_PARALLEL
    std::int32_t low = 0;
    std::int32_t end = kMostWork;

    bool has(std::int32_t q) const { return low <= q && q < end; }
#else
    static constexpr bool has(std::int32_t) { return true; }
#endif
};

/// The same where a patch adds to its own coarse cell and those around it: visit(rows of patches,
/// what they may add to). Pieces go through the rows beside theirs, too, and take from them what is
/// added to theirs, so that every sum has the order that it has in one piece. No row adds anything
/// that is not among those `filled`.
template <class Visit>
void share_sums_of_patches(const GridShape& s, const GridShape& big,
                           [[maybe_unused]] const Part& filled, Work work, const Visit& visit) {
    constexpr std::int32_t kLeastRows = 12;  // two are done twice
    const std::int32_t cost = kCoarseEdge * s.nx;
    Part all = work.take(big.ny, cost);
#if WEIR_PARALLEL
    all.first = minimum(maximum(all.first, filled.first), all.end);
    all.end = maximum(minimum(all.end, filled.end), all.first);
#endif
    work.share(all, cost, kLeastRows, [&](const Part& piece, std::int32_t) {
        Part rows = piece;
        Targets targets;
#if WEIR_PARALLEL
        if (piece.first > all.first) {
            rows.first -= 1;
            targets.low = big.index(-1, piece.first);
        }
        if (piece.end < all.end) {
            rows.end += 1;
            targets.end = big.index(-1, piece.end);
        }
#endif
        visit(rows, targets);
    });
}

}  // namespace weir
