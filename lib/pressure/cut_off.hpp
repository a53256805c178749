// Patches that walls part. A coarse cell has one unknown, which can be that of one side of a wall
// alone: of the side with the most cells. The others are cut off, and go with the coarse cell that
// they reach on their own side.
#pragma once

#include "pressure/patches.hpp"
#include "solid/walls.hpp"

namespace weir {

/// What `residual` holds during the set-up: 0 for an empty patch, 1 for a full one, and this.
template <class Real>
constexpr Real kPartly = Real(0.5);

/// So many cells of a patch, the sums of their columns and rows: its centre.
template <class Real>
void put_centre(std::int32_t q, std::int32_t count, std::int32_t columns, std::int32_t rows,
                CoarseGrid<Real>& coarse) {
    coarse.centre_x[q] = part_of(static_cast<Real>(columns), count);
    coarse.centre_y[q] = part_of(static_cast<Real>(rows), count);
}

inline bool has_bit(std::uint32_t bits, std::int32_t bit) {
    return (bits >> static_cast<std::uint32_t>(bit) & 1U) != 0;
}

/// visit(bit, column, row) for some cells of a patch, a bit each.
template <class Visit>
WEIR_ALWAYS_INLINE void for_each_of_patch(std::uint32_t cells, const Visit& visit) {
    for (; cells != 0; cells &= cells - 1) {
        const std::int32_t bit = WEIR_TRAILING_ZEROS(cells);
        visit(bit, bit % kCoarseEdge, bit / kCoarseEdge);
    }
}

template <class Real>
bool any_cut_off(const CoarseGrid<Real>& coarse) {
    std::uint32_t all = 0;
    const std::int32_t end = coarse.shape.index(0, coarse.shape.ny);
    for (std::int32_t q = coarse.shape.index(0, 0); q < end; ++q) {
        all |= coarse.cut_off[q].cells;
    }
    return all != 0;
}

template <class Real>
bool is_parted(const CoarseGrid<Real>& coarse, std::int32_t q) {
    return coarse.parted && coarse.cut_off[q].cells != 0;
}

/// visit(patch) for those of some rows of which something is cut off.
template <class Real, class Visit>
void for_each_parted(const GridShape& s, const CoarseGrid<Real>& coarse, const Part& rows,
                     const Visit& visit) {
    for (std::int32_t row = rows.first; row < rows.end; ++row) {
        const CutOff* const cut = coarse.cut_off + coarse.shape.index(0, row);
        for (std::int32_t column = 0; column < coarse.shape.nx; ++column) {
            if (WEIR_SELDOM(cut[column].cells != 0)) {
                visit(patch_of(s, coarse.shape, column, row));
            }
        }
    }
}

/// Faces before the cells of a patch that cells lie at which are cut off, in it or in the patches
/// before it, a bit each.
struct CutFaces {
    std::uint32_t u = 0;
    std::uint32_t v = 0;
};
template <class Real>
CutFaces cut_faces(const CoarseGrid<Real>& coarse, std::int32_t q) {
    const std::uint32_t own = coarse.cut_off[q].cells;
    const std::uint32_t left = coarse.cut_off[q - 1].cells;
    const std::uint32_t lower = coarse.cut_off[q - coarse.shape.stride].cells;
    if (WEIR_SELDOM((own | left | lower) != 0)) {
        return {own | ((own & 0x7777U) << 1U) | ((left & 0x8888U) >> 3U),
                own | ((own << 4U) & 0xFFFFU) | (lower >> 12U)};
    }
    return {};
}

/// What of a patch is cut off, of one that a wall touches. Its centre becomes that of the rest.
template <class Real>
void cut_patch(const Walls<Real>& walls, const GridShape& s, const PressureFields<Real>& fields,
               const Patch& patch, CoarseGrid<Real>& coarse);

/// With which coarse cells that goes, once it is known of all patches what is cut off.
template <class Real>
void join_cut_off(const Walls<Real>& walls, const PressureFields<Real>& fields, const GridShape& s,
                  const Patch& patch);

/// The residual of a cell that is cut off: from the patch's coarse cell and those around it, as
/// `CoarseShares` has it, to the one that the cell goes with.
template <class Real>
void move_residual(std::int32_t patch, std::int32_t bit, Real residual, const Targets& targets,
                   CoarseGrid<Real>& coarse);

/// Takes the corrections of these coarse cells from the pressures of cells that are cut off, in
/// some rows of patches, and adds those of the ones that they go with.
template <class Real>
void correct_cut_off(const GridShape& s, const Part& rows, PressureFields<Real>& fields);

}  // namespace weir
