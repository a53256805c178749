#include "pressure/volume_correction.hpp"

#include "pressure/excess.hpp"
#include "pressure/patch_drift.hpp"
#include "pressure/smooth_excess.hpp"
#include "pressure/volume_packed.hpp"

namespace weir {

namespace {

/// What a single cell may say in the mean of its patch.
template <class Real>
constexpr Real kCellWindow = Real(0.2);

/// A patch with that many liquid cells that are too dense by this in the mean has not the room for
/// its liquid. (Of a cell no more than kCellWindow counts.)
template <class Real>
constexpr Real kOverfull = Real(0.15);
constexpr std::int32_t kLeastOverfull = 8;

/// Whether there is anything but solid in a patch.
template <class Real>
bool has_room(const GridShape& s, const Walls<Real>& walls, const Patch& patch) {
    for (std::int32_t y = 0; y < patch.height; ++y) {
        for (std::int32_t x = 0; x < patch.width; ++x) {
            if (walls.full_density[s.index(patch.i + x, patch.j + y)] > Real(0)) {
                return true;
            }
        }
    }
    return false;
}

/// Mean excess of a patch's liquid cells; 0 in air. `overfull` grows by the patch's liquid cells if
/// they have not the room for what is in them.
template <bool Solids, class Real>
[[gnu::noinline]] Real average(const GridShape& s, const Walls<Real>& walls,
                               const Patch& patch, const PressureFields<Real>& f,
                               std::int32_t& overfull) {
    Real sum = Real(0);
    bool any = false;
    std::int32_t count = 0;
    for (std::int32_t y = 0; y < patch.height; ++y) {
        const std::int32_t row = s.index(patch.i, patch.j + y);
        for (std::int32_t c = row; c < row + patch.width; ++c) {
            const Real e = f.divergence[c];
            const auto size = magnitude_key(e);
            if (is_positive(Real(f.level[c]))) {
                sum += size <= magnitude_key(kCellWindow<Real>)
                           ? e
                           : clamp<Real>(e, -kCellWindow<Real>, kCellWindow<Real>);
                count += 1;
            }
            any = any || size != magnitude_key(Real(0));
        }
    }
    f.coarse.residual[patch.q] = Real(any ? 1 : 0);  // until the drift
    if (count == 0) {
        return !Solids || has_room(s, walls, patch) ? Real(0) : kSolidPatch<Real>;
    }
    const Real mean = part_of(sum, count);
    overfull += count >= kLeastOverfull && mean >= kOverfull<Real> ? count : 0;
    return clamp(mean, -kPatchWindow<Real>, kPatchWindow<Real>);
}

/// The same of a row of patches, written to the coarse cells.
template <bool Solids, class Real>
void average_row(const GridShape& s, const Walls<Real>& walls, std::int32_t row,
                 const PressureFields<Real>& f, std::int32_t& overfull) {
    const GridShape& big = f.coarse.shape;
    const auto patch_at = [&](std::int32_t column) {
        return patch_of(s, big, column, row);
    };
    Real* const means = f.coarse.correction + big.index(0, row);
    const Part columns = patches_in(s, big, row);
    std::int32_t column = columns.first;
    if constexpr (kHasLanes<Real>) {
        const PatchLimits limits{kCellWindow<Real>, kPatchWindow<Real>, kOverfull<Real>,
                                 static_cast<Real>(kLeastOverfull)};
        const Patch first = patch_at(columns.first);
        const auto look_for_room = [&](std::int32_t k) {
            if (Solids && !has_room(s, walls, patch_at(columns.first + k))) {
                means[columns.first + k] = kSolidPatch<Real>;
            }
        };
        column += are_drops(f)
                      ? 0
                      : means_of_row(f, limits, s.stride, s.index(first.i, first.j), first.height,
                                     whole_patches(s, row), means + columns.first,
                                     f.coarse.residual + first.q, overfull, look_for_room);
    }
    for (; column < columns.end; ++column) {
        means[column] =
            are_drops(f) ? Real(0) : average<Solids>(s, walls, patch_at(column), f, overfull);
    }
}

template <bool Solids, class Real>
void correct(const Domain<Real>& domain, Real gain_per_s, Vec2<Real> fall, std::int32_t& overfull,
             Work work) {
    const Borders<Real>& borders = domain.borders;
    const Walls<Real>& walls = domain.walls;
    PressureFields<Real>& fields = domain.fields;
    StaggeredGrid<Real>& grid = domain.grid;
    const GridShape& s = grid.shape;
    const GridShape& big = fields.coarse.shape;
    const bool pays = fields.cell_weight > Real(0);
    const Vec2<Real> falling = share_of_falling(fall);
    const Held<Real> held = held_by(fields.cell_weight, fields, grid);
    work.share(work.take(s.ny, s.nx), s.nx, 1,
               [&](const Part& rows, std::int32_t) { find_excess(s, rows, held, fields); });
    if constexpr (Solids) {
        find_excess_beside_walls(s, walls, held, fields, work);
    }
    if (sticks_to_tank(borders)) {
        smooth_excess<Solids>(borders, walls, s, fields, work);
    }
    if (work.once(s.border())) {
        extend_cells(borders, s, fields.divergence);
    }
    // Tension keeps drops together without.
    std::int32_t found[kMostPieces] = {};
    const std::int32_t cost = kCoarseEdge * s.nx;
    work.share(work.take(big.ny, cost), cost, 1, [&](const Part& rows, std::int32_t piece) {
        for (std::int32_t row = rows.first; row < rows.end; ++row) {
            average_row<Solids>(s, walls, row, fields, found[piece]);
        }
    });
    for (const std::int32_t some : found) {
        overfull += some;
    }
    if (work.once(big.border())) {
        mirror_cells(borders, big, fields.coarse.correction);
        mirror_cells(borders, big, fields.coarse.residual);
    }
    share_patches(s, big, work, [&](const Patch& patch, std::int32_t) {
        static_assert(kCoarseEdge == 4, "rises() knows four faces");
        if (kHasLanes<Real> && is_still(fields, patch.q)) {
            return;
        }
        Drift<Solids, Real> drift{borders, walls, fields, s, patch, gain_per_s, fall, falling,
                                  {}, {}};
        rises(fields.coarse.correction, patch.q, 1, drift.along_x);
        rises(fields.coarse.correction, patch.q, big.stride, drift.along_y);
        drift_apart(drift, pays, grid);
    });
}

template <bool Solids, class Real>
void keep_volume(const Domain<Real>& domain, Real gain_per_s, Vec2<Real> fall,
                 std::int32_t& overfull, Work work) {
    if constexpr (Stored<Real>::coarse) {
        correct_packed<Solids>(domain, gain_per_s, fall, overfull, work);
    } else {
        if (work.once(1)) {
            overfull = 0;
        }
        correct<Solids>(domain, gain_per_s, fall, overfull, work);
    }
}

}  // namespace

template <bool Solids, class Real>
void volume_correction(const Domain<Real>& domain, Real gain_per_s, Vec2<Real> fall,
                       std::int32_t& overfull, Work work) {
    const auto stage = Stored<Real>::coarse || domain.walls.active ? keep_volume<Solids, Real>
                                                                   : keep_volume<false, Real>;
    stage(domain, gain_per_s, fall, overfull, work);
}

#define WEIR_INSTANTIATE_VOLUME(Solids, Real)                                      \
    template void volume_correction<Solids>(const Domain<Real>&, Real, Vec2<Real>, \
                                            std::int32_t&, Work);
#define WEIR_INSTANTIATE(Real) \
    WEIR_INSTANTIATE_VOLUME(false, Real) WEIR_INSTANTIATE_VOLUME(true, Real)
WEIR_FOR_EACH_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE
#undef WEIR_INSTANTIATE_VOLUME

}  // namespace weir
