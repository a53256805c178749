#include "step/bend_paths.hpp"

#include "step/bend_lanes.hpp"
#include "step/depth_bits.hpp"

namespace weir {

namespace {

/// One component: `back` leads from a face to the one before it across its own cells.
template <class Real>
struct Bending {
    const GridShape& s;
    const Borders<Real>& borders;
    const Walls<Real>& walls;
    const PressureFields<Real>& fields;
    Seconds<Real> bend_s;  ///< ½ dt or less: by how much paths bend
    std::int32_t back;
    const VelocityOf<Real>* along;   ///< ũ of this component
    const VelocityOf<Real>* across;  ///< of the other
    VelocityOf<Real>* out;

    bool on_u() const { return back == 1; }

    /// Whether the velocity is liquid's.
    bool wet(std::int32_t face) const {
        return fields.level[face] > Real(0) || fields.level[face - back] > Real(0);
    }

    /// No particle reads it.
    bool empty(std::int32_t face) const {
        return fields.level[face] <= kEmptyLevel<Real> ||
               fields.level[face - back] <= kEmptyLevel<Real>;
    }

    /// It is beside a wall, or those that read it look for themselves.
    bool beside_wall(std::int32_t face) const {
        return (walls.active && !(untouched(walls, face, face + s.stride) &&
                                  untouched(walls, face - back, face - back + s.stride))) ||
               (walls.thin != nullptr &&
                ((walls.thin->mark[face] | walls.thin->mark[face - back]) & kTouching) != 0);
    }

    /// ∂ũ along an axis, from liquid faces, `step` entries apart: the one before, the one behind.
    Real slope(std::int32_t face, std::int32_t step, bool low, bool high) const {
        const Real below = low ? Real(along[face] - along[face - step]) : Real(0);
        const Real above = high ? Real(along[face + step] - along[face]) : Real(0);
        return low && high ? Real(0.5) * (below + above) : below + above;
    }

    /// `share`: all of the bend, or a half of it between the two kinds of cells.
    void bend(std::int32_t face, Seconds<Real> share, Real slope_along, Real slope_across) const {
        const std::int32_t side = on_u() ? s.stride : 1;
        const Real mean = Real(0.25) * ((across[face] + across[face - back]) +
                                        (across[face + side] + across[face + side - back]));
        const Real turned = along[face] * slope_along + mean * slope_across;
        out[face] += share * turned;
    }

    void bend_one(std::int32_t face, bool on_seam, Seconds<Real> share) const {
        // The face before the one on the seam has a cell that lies two beyond it: its image not.
        const std::int32_t round = on_seam ? back * (on_u() ? s.nx : s.ny) : 0;
        const std::int32_t side = on_u() ? s.stride : 1;
        bend(face, share, slope(face, back, wet(face - back + round), wet(face + back)),
             slope(face, side, wet(face - side), wet(face + side)));
    }

    /// Faces of a row: those to bend, those of them by a half, and which faces around are liquid's,
    /// along and across: a bit each, the lowest one that of `place`.
    struct Bits {
        std::uint32_t bent;
        std::uint32_t half;
        std::uint32_t low;
        std::uint32_t high;
        std::uint32_t side_low;
        std::uint32_t side_high;
    };

    /// Those of some faces that no wall is beside. Not inline: most tanks have none.
    [[gnu::noinline]] std::uint32_t without_walls(std::uint32_t faces, std::int32_t place) const {
        std::uint32_t left = 0;
        for_each_bit(faces, place, [&](std::int32_t face, std::uint32_t bit) {
            left |= beside_wall(face) ? 0U : bit;
        });
        return left;
    }

    template <bool OnU>
    [[gnu::noinline]] void bend_bits(const Bits& bits, std::int32_t place) const {
        const std::int32_t stride = s.stride;
        const std::int32_t behind = OnU ? 1 : stride;
        const std::int32_t beside = OnU ? stride : 1;
        const VelocityOf<Real>* const own = along;
        const VelocityOf<Real>* const other = across;
        const Seconds<Real> all = bend_s;
        // As `slope`, of the number at `at`.
        const auto rise = [](const VelocityOf<Real>* at, std::int32_t step, bool low, bool high) {
            const Real here = *at;
            if (low && high) {
                return Real(0.5) * ((here - *(at - step)) + (*(at + step) - here));
            }
            return low ? here - *(at - step) : (high ? *(at + step) - here : Real(0));
        };
        const bool walled = walls.active || walls.thin != nullptr;
        const std::uint32_t bent = walled ? without_walls(bits.bent, place) : bits.bent;
        for_each_bit(bent, place, [&](std::int32_t face, std::uint32_t bit) {
            const VelocityOf<Real>* at = whole(own + face);
            const Real slope_along =
                rise(at, behind, (bits.low & bit) != 0, (bits.high & bit) != 0);
            const Real slope_across =
                rise(at, beside, (bits.side_low & bit) != 0, (bits.side_high & bit) != 0);
            const VelocityOf<Real>* near = whole(other + face);
            const VelocityOf<Real>* far = whole(OnU ? near + stride : near - stride);
            const Real mean =
                Real(0.25) * (OnU ? (near[0] + near[-1]) + (far[0] + far[-1])
                                  : (near[0] + far[0]) + (near[1] + far[1]));
            const Seconds<Real> share = (bits.half & bit) != 0 ? Seconds<Real>(0.5) * all : all;
            out[face] += share * (Real(*at) * slope_along + mean * slope_across);
        });
    }

    /// Whether the cells of a line along this component lie inside the tank, but for its ends.
    bool line_inside(std::int32_t i, std::int32_t j) const {
        return on_u() ? borders.wrap_y || (j > 0 && j + 1 < s.ny)
                      : borders.wrap_x || (i > 0 && i + 1 < s.nx);
    }

    /// Faces from one on, `count` one behind the other. Each face's cell is looked at once.
    void run(std::int32_t i, std::int32_t j, std::int32_t count) const {
        const LevelOf<Real>* level = fields.level;
        const std::int32_t side = on_u() ? s.stride : 1;
        const std::int32_t cells = on_u() ? s.nx : s.ny;
        const bool wrap = on_u() ? borders.wrap_x : borders.wrap_y;
        const bool leaps = fields.leaps && line_inside(i, j);
        // As `goes_straight`; faces beside solids are left out.
        const auto straight = [&](std::int32_t at, std::int32_t c, bool liquid) {
            return liquid && leaps && (wrap || (at > 0 && at + 1 < cells)) &&
                   level[c - side] > Real(0) && level[c + side] > Real(0);
        };
        std::int32_t at = on_u() ? i : j;
        std::int32_t face = s.index(i, j);
        // The cell before the one on the seam has a neighbour two beyond it: its image not.
        const std::int32_t last = at > 0 ? at - 1 : cells - 1;
        const std::int32_t image = face + (last - at) * back;
        bool wet = level[face] > Real(0);
        bool wet_before = level[face - back] > Real(0);
        bool before = straight(last, image, wet && wet_before && level[image - back] > Real(0));
        for (std::int32_t k = 0; k < count; ++k) {
            const bool wet_after = level[face + back] > Real(0);
            const bool here = straight(at, face, wet_before && wet && wet_after);
            if (!(here && before) && !empty(face) && !beside_wall(face)) {
                bend_one(face, at == 0, here || before ? Seconds<Real>(0.5) * bend_s : bend_s);
            }
            wet_before = wet;
            wet = wet_after;
            before = here;
            face += back;
            at += 1;
        }
    }

    /// Faces i … of a row that are bent in lanes. Returns the next one to do.
    std::int32_t in_lanes([[maybe_unused]] std::int32_t i, [[maybe_unused]] std::int32_t end,
                          [[maybe_unused]] std::int32_t j) const {
#if WEIR_HAS_LANES
        if constexpr (kHasLanes<Real>) {
            if ((i > 0 || !on_u()) && (j > 0 || on_u())) {
                const auto inside = [&](std::int32_t y) {
                    return fields.leaps && (borders.wrap_y || (y > 0 && y + 1 < s.ny));
                };
                const std::int32_t row = s.index(0, j);
                const std::int32_t side = borders.wrap_x ? -1 : 1;  // beyond a seam it goes on
                const BendTask task{fields.level,
                                    walls.active ? walls.open_u : nullptr,
                                    walls.open_v,
                                    along,
                                    across,
                                    out,
                                    bend_s,
                                    back,
                                    s.stride,
                                    inside(j),
                                    inside(on_u() ? j : j - 1),
                                    row + side,
                                    row + s.nx - 1 - side,
                                    on_u() ? 0 : s.stride};
                return bend_lanes(task, row, row + i, row + end) - row;
            }
        }
#endif
        return i;
    }

    void row_in_lanes(std::int32_t first_i, std::int32_t j) const {
        const Part columns = s.columns(j);
        std::int32_t wall = -2;  // a cell beside one; faces before and behind it go one by one
        for (std::int32_t i = maximum(first_i, columns.first); i < columns.end;) {
            if (wall < i - 1) {
                wall = next_marked<Real>(walls.thin, s, j - 1, j, maximum(i - 1, 0), columns.end,
                                         kTouching);
            }
            i = wall > i ? in_lanes(i, wall, j) : i;
            const std::int32_t end = minimum(on_u() && i == 0 ? 1 : i + 4, columns.end);
            for (; i < end; ++i) {
                run(i, j, 1);
            }
        }
    }

    void rows_in_lanes(const Part& part) const {
        const std::int32_t first_i = on_u() && !borders.wrap_x ? 1 : 0;
        const std::int32_t first_j = maximum(!on_u() && !borders.wrap_y ? 1 : 0, part.first);
        for (std::int32_t j = first_j; j < part.end; ++j) {
            row_in_lanes(first_i, j);
        }
    }
};

/// Some rows of both components without lanes.
template <class Real>
void bend_rows(const Bending<Real>& of_u, const Bending<Real>& of_v, const Part& rows) {
    const GridShape& s = of_u.s;
    const Borders<Real>& b = of_u.borders;
    for (std::int32_t j = rows.first; b.wrap_x && j < rows.end; ++j) {
        of_u.run(0, j, 1);
    }
    for (std::int32_t i = 0; b.wrap_y && rows.first == 0 && i < s.nx; ++i) {
        of_v.run(i, 0, 1);
    }
    const bool leaps = of_u.fields.leaps;
    const auto row_inside = [&](std::int32_t j) {
        return leaps && (b.wrap_y || (j > 0 && j + 1 < s.ny));
    };
    for_each_depth<Real>(s, of_u.fields.level, rows, [&](const DepthBits<Real>& at) {
        // As `goes_straight`; faces beside solids are left out.
        const std::uint32_t inside = b.wrap_x ? ~0U : at.inside;
        const auto straight = [&](std::int32_t j, std::uint32_t below, std::uint32_t row,
                                  std::uint32_t above) {
            return row_inside(j) ? inside & below & row & (row << 1U) & (row >> 1U) & above : 0U;
        };
        const auto left = [](const CellBits& row) { return row.wet | (row.wet << 1U); };
        const std::uint32_t here = straight(at.j, at.below.wet, at.here.wet, at.above.wet);
        const std::uint32_t before = straight(at.j - 1, at.under.wet, at.below.wet, at.here.wet);
        const std::uint32_t u = left(at.here);
        const std::uint32_t v = at.here.wet | at.below.wet;
        const std::uint32_t held_u = at.here.held & (at.here.held << 1U);
        const std::uint32_t held_v = at.here.held & at.below.held;
        of_u.template bend_bits<true>({at.of_u & held_u & ~(here & (here << 1U)),
                                       here | (here << 1U), u << 1U, u >> 1U, left(at.below),
                                       left(at.above)},
                                      at.place);
        of_v.template bend_bits<false>({at.of_v() & held_v & ~(here & before), here | before,
                                        at.below.wet | at.under.wet, at.above.wet | at.here.wet,
                                        v << 1U, v >> 1U},
                                       at.place);
    });
}

}  // namespace

template <class Real>
void bend_paths([[maybe_unused]] const Domain<Real>& domain,
                [[maybe_unused]] Seconds<Real> dt_s, [[maybe_unused]] Work work) {
    if constexpr (!Stored<Real>::coarse) {
        const Borders<Real>& borders = domain.borders;
        const Walls<Real>& walls = domain.walls;
        const PressureFields<Real>& fields = domain.fields;
        StaggeredGrid<Real>& grid = domain.grid;
        const GridShape& s = grid.shape;
        const VelocityOf<Real>* u = fields.divergence;
        const VelocityOf<Real>* v = fields.inverse_diagonal;
        // Where liquid leaps, bends of a half keep what sways: half of that keeps areas as well.
        // Drops need it all.
        const bool some = fields.leaps && !fields.on_surface;
        const Seconds<Real> bend_s = Seconds<Real>(some ? 0.25 : 0.5) * dt_s;
        const Bending<Real> of_u{s, borders, walls, fields, bend_s, 1, u, v, grid.u};
        const Bending<Real> of_v{s, borders, walls, fields, bend_s, s.stride, v, u, grid.v};
        work.share(work.take(s.ny, 2 * s.nx), 2 * s.nx, 1, [&](const Part& rows, std::int32_t) {
            if constexpr (kHasLanes<Real>) {
                of_u.rows_in_lanes(rows);
                of_v.rows_in_lanes(rows);
            } else {
                bend_rows(of_u, of_v, rows);
            }
        });
        if (work.once(s.border())) {
            extend_velocity(borders, s, grid.u, grid.v);
        }
    }
}

#define WEIR_INSTANTIATE(Real) \
    template void bend_paths(const Domain<Real>&, Seconds<Real>, Work);
WEIR_FOR_EACH_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
