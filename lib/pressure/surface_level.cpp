#include "pressure/surface_level.hpp"

#include "pressure/level_packed.hpp"
#include "pressure/surface_lanes.hpp"

namespace weir {

namespace {

/// Share of a cell's open faces that liquid must cover for an air cell to be taken as filled.
template <class Real>
constexpr Real kFilledShare = Real(0.8);
/// The same for a cell with a contour that shifts: what opens behind a body that draws back is as
/// thin as a film at first and holds no particle, but is not empty. (Where all cells with a contour
/// were taken so, surfaces that lean against a solid kept streams running.)
template <class Real>
constexpr Real kFilledShareOfShifting = Real(0.6);

template <class Real>
constexpr Real kFilledLevel = Real(0.5);
static_assert(LevelOf<SmallFixed>(kFilledLevel<SmallFixed>).raw == kFilledRaw, "the same in both");

/// Mass on those faces that a cell's centre sees past thin walls.
template <class Real>
Real seen_mass(const StaggeredGrid<Real>& grid, const ThinWalls<Real>& thin, std::int32_t c) {
    const SeenFaces sees = faces_seen(thin, grid.shape, c);
    return ((sees.left ? grid.mass_u[c] : Real(0)) +
            (sees.right ? grid.mass_u[c + 1] : Real(0))) +
           ((sees.lower ? grid.mass_v[c] : Real(0)) +
            (sees.upper ? grid.mass_v[c + grid.shape.stride] : Real(0)));
}

/// Density and level of a cell whose faces hold so much mass. `head`: `least_head`.
template <class Real>
inline void show_cell(Real mass, Real per_face, const CutDensity<Real>& cut, Real head,
                      std::int32_t c, Part& slivers, const PressureFields<Real>& fields) {
    if (!(mass > Real(0))) {
        fields.density[c] = Real(0);
        fields.level[c] = kEmptyLevel<Real>;
        return;
    }
    Real density = mass * per_face;
    if (cut.full != nullptr && bound_key(Real(cut.full[c])) < bound_key(Real(1))) {
        const Real full = cut.full[c];
        if (full < cut.sliver) {
            slivers = {slivers.empty() ? c : slivers.first, c + 1};
        }
        density = full < cut.least ? kNoRoom<Real> : density / full;
    }
    fields.density[c] = density;
    // Most cells are full, of which no more is to be told.
    const bool full = bound_key(density) >= bound_key(Real(1));
    fields.level[c] = (full ? Real(1.5) : level_of_density(density)) - head;
}

/// Cells c … end − 1 of a row.
template <class Real>
[[gnu::noinline]] void densities_of_row(const StaggeredGrid<Real>& grid, Real per_face,
                                        CutDensity<Real> cut, std::int32_t c, std::int32_t end,
                                        Part& slivers, PressureFields<Real> fields) {
    const VelocityOf<Real>* lower = grid.mass_v + c;
    const VelocityOf<Real>* upper = lower + grid.shape.stride;
    const VelocityOf<Real>* right = grid.mass_u + c + 1;
    const Real head = least_head(fields);
    Real left = right[-1];
    for (; c < end; ++c) {
        const Real next = *right++;
        const Real mass = (left + next) + (*lower++ + *upper++);
        left = next;
        show_cell(mass, per_face, cut, head, c, slivers, fields);
    }
}

template <class Real>
void density_from_faces(const Domain<Real>& domain, const CutDensity<Real>& cut, Real per_face,
                        EmptySlivers<Real> empty_slivers, const Part& rows) {
    const StaggeredGrid<Real>& grid = domain.grid;
    const ThinWalls<Real>* thin = domain.walls.thin;
    PressureFields<Real>& fields = domain.fields;
    const GridShape& s = grid.shape;
    for (std::int32_t j = rows.first; j < rows.end; ++j) {
        const Part columns = s.columns(j);
        std::int32_t c = s.index(columns.first, j);
        const std::int32_t end = s.index(columns.end, j);
        Part slivers;
        const std::int32_t row = s.index(0, j);
        while (c < end) {
            const std::int32_t wall =
                row + next_marked(thin, s, j, j, c - row, columns.end, kTouching);
            if constexpr (kHasLanes<Real>) {
                c = c < wall ? density_row(grid, cut, per_face, c, wall, slivers, fields) : c;
            }
            densities_of_row(grid, per_face, cut, c, wall, slivers, fields);
            c = wall;
            if (c < end) {
                show_cell(seen_mass(grid, *thin, c), per_face, cut, least_head(fields), c, slivers,
                          fields);
                ++c;
            }
        }
        if (!slivers.empty() && empty_slivers != nullptr) {
            empty_slivers(grid, domain.borders, cut, j, slivers, fields.level);
        }
    }
}

/// No surface opens where liquid is pressed: two cells side by side that thinned out there were a
/// sink that took the weight off a whole pool for a substep. Each is no evidence for the other.
template <class Real>
[[gnu::noinline, gnu::cold]] void keep_pressed(const GridShape& s, const Part& rows, Real held,
                                               PressureFields<Real>& fields) {
    for (std::int32_t j = rows.first; j < rows.end; ++j) {
        const Part columns = s.columns(j);
        const std::int32_t end = s.index(columns.end, j);
        for (std::int32_t c = s.index(columns.first, j); c < end; ++c) {
            LevelOf<Real>& level = fields.level[c];
            if (!(level > Real(0)) && level > kEmptyLevel<Real> && fields.pressure[c] > held) {
                level = kFilledLevel<Real>;
            }
        }
    }
}

template <class Real>
bool surrounded(const GridShape& s, const Borders<Real>& borders, const Walls<Real>& walls,
                const LevelOf<Real>* level, std::int32_t i, std::int32_t j) {
    if constexpr (Stored<Real>::coarse) {
        return packed_surrounded(s, borders, walls, level, i, j);
    }
    const std::int32_t c = s.index(i, j);
    Real open = Real(0);
    Real covered = Real(0);
    const auto face = [&](bool inside, Real fraction, std::int32_t neighbour) {
        if (inside) {
            open += fraction;
            // A level just set by this rule is no evidence for the next cell.
            const bool liquid =
                level[neighbour] > Real(0) && level[neighbour] != kFilledLevel<Real>;
            covered += liquid ? fraction : Real(0);
        }
    };
    const bool cut = walls.active;
    face(i > 0 || borders.wrap_x, cut ? Real(walls.open_u[c]) : Real(1), c - 1);
    face(i + 1 < s.nx || borders.wrap_x, cut ? Real(walls.open_u[c + 1]) : Real(1), c + 1);
    face(j > 0 || borders.wrap_y, cut ? Real(walls.open_v[c]) : Real(1), c - s.stride);
    face(j + 1 < s.ny || borders.wrap_y, cut ? Real(walls.open_v[c + s.stride]) : Real(1),
         c + s.stride);
    return open > Real(0) &&
           (covered >= kFilledShare<Real> * open ||
            (covered >= kFilledShareOfShifting<Real> * open &&
             walls.moving != nullptr && walls.moving->shifts(walls, c, c + s.stride)));
}

#if WEIR_HAS_LANES
/// As DimpleTask::shifting.
inline std::uint32_t shifting_of(const DimpleTask& task, std::int32_t c, std::uint32_t asked) {
    std::uint32_t found = 0;
    for (; task.walls.moving != nullptr && asked != 0; asked &= asked - 1U) {
        const std::int32_t k = WEIR_TRAILING_ZEROS(asked);
        if (task.walls.moving->shifts(task.walls, c + k, c + k + task.stride)) {
            found |= 1U << static_cast<std::uint32_t>(k);
        }
    }
    return found;
}

/// `fill_dimples` of a row, four or eight at a time. Returns the next cell to do.
inline std::int32_t fill_dimples_in_lanes(const GridShape& s, const Borders<float>& borders,
                                          const Walls<float>& walls, std::int32_t j,
                                          const Part& columns, float* level) {
    const std::int32_t row = s.index(0, j);
    const DimpleTask task{level,
                          walls.active ? walls.open_u : nullptr,
                          walls.open_v,
                          s.stride,
                          kFilledShare<float>,
                          kFilledShareOfShifting<float>,
                          kFilledLevel<float>,
                          j > 0 || borders.wrap_y,
                          j + 1 < s.ny || borders.wrap_y,
                          borders.wrap_x ? -1 : row,
                          borders.wrap_x ? kMostWork : row + s.nx - 1,
                          walls,
                          walls.active ? shifting_of : nullptr};
    return fill_lanes(task, row + columns.first, row + columns.end) - row;
}
#endif

/// Air cells that liquid surrounds are taken as filled.
template <class Real>
void fill_dimples(const GridShape& s, const Borders<Real>& borders, const Walls<Real>& walls,
                  const Part& rows, LevelOf<Real>* level) {
    for (std::int32_t j = rows.first; j < rows.end; ++j) {
        const Part columns = s.columns(j);
        std::int32_t i = columns.first;
        if constexpr (kHasLanes<Real>) {
            i = fill_dimples_in_lanes(s, borders, walls, j, columns, level);
        }
        const std::int32_t row = s.index(0, j);
        const LevelOf<Real>* const end = level + row + columns.end;
        for (const LevelOf<Real>* at = level + row + i; at < end; ++at) {
            if (!is_positive(Real(*at))) {
                const auto c = static_cast<std::int32_t>(at - level);
                if (beside_liquid(level, s.stride, c) &&
                    surrounded(s, borders, walls, level, c - row, j)) {
                    level[c] = kFilledLevel<Real>;
                }
            }
        }
    }
}

}  // namespace

// Seen from a flat surface at height s over the centre, the mean of the four face masses is
// g(s) = ½ C(s) + ¼ [C(s − ½) + C(s + ½)], C the integral of the hat function. Its three pieces
// are quadratic; g(−s) = 1 − g(s).
template <class Real>
Real level_of_density(Real density) {
    if (density >= Real(1)) {
        return Real(1.5);
    }
    const Real full = maximum(density, Real(0));
    const bool upper = full > Real(0.5);
    const Real g = upper ? Real(1) - full : full;
    Real depth;
    if (g >= Real(0.1875)) {
        depth = Real(1.5) - square_root(Real(0.25) + Real(4) * g);
    } else if (g >= Real(0.03125)) {
        depth = (Real(0.875) - square_root(Real(1.5) * g - Real(0.03125))) * Real(4.0 / 3.0);
    } else {
        depth = Real(1.5) - square_root(Real(8) * g);
    }
    return upper ? depth : -depth;
}

template <class Real>
void surface_level(const Domain<Real>& domain, Real rest_count, EmptySlivers<Real> empty_slivers,
                   Work work, Real held) {
    const Borders<Real>& borders = domain.borders;
    const Walls<Real>& walls = domain.walls;
    PressureFields<Real>& fields = domain.fields;
    const GridShape& s = domain.grid.shape;
    CutDensity<Real> cut;
    cut.full = walls.active ? walls.full_density : nullptr;
    cut.sliver = Real(1) / rest_count;
    const Real per_face = Real(1) / (Real(4 * Stored<Real>::particle_mass) * rest_count);
    // Compressible liquid stores what flows into a cell: one that holds little has no room for it.
    const bool fills = !(fields.sound_speed > Real(0));
    work.share(work.take(s.ny, s.nx), s.nx, 1, [&](const Part& rows, std::int32_t) {
        if constexpr (Stored<Real>::coarse) {
            packed_density(domain, cut, static_cast<std::int32_t>(rest_count), empty_slivers,
                           rows);
        } else {
            density_from_faces(domain, cut, per_face, empty_slivers, rows);
            if (fills && held > Real(0)) {
                keep_pressed(s, rows, held, fields);
            }
        }
    });
    if (work.once(s.border())) {
        extend_cells(borders, s, fields.level);
        if (borders.wrap_x || borders.wrap_y) {  // faces on the seam look at both sides
            extend_cells(borders, s, fields.density);
        }
    }
    work.share_in_turn(work.take(s.ny, s.nx), s.nx, 2, [&](const Part& rows, std::int32_t) {
        if (fills) {
            fill_dimples(s, borders, walls, rows, fields.level);
        }
    });
    if (work.once(s.border())) {
        mirror_cells(borders, s, fields.level);
    }
}

#define WEIR_INSTANTIATE(Real)            \
    template Real level_of_density(Real); \
    template void surface_level(const Domain<Real>&, Real, EmptySlivers<Real>, Work, Real);
WEIR_FOR_EACH_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
