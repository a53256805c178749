#include "step/bend_paths.hpp"

#include "pressure/leap.hpp"
#include "step/bend_lanes.hpp"

namespace weir {

namespace {

/// One component: `back` leads from a face to the one before it across its own cells.
template <class Real>
struct Bending {
    const GridShape& s;
    const Borders<Real>& borders;
    const Walls<Real>& walls;
    const PressureFields<Real>& fields;
    Seconds<Real> half_dt;
    std::int32_t back;
    const VelocityOf<Real>* along;   ///< ũ of this component
    const VelocityOf<Real>* across;  ///< of the other
    VelocityOf<Real>* out;

    bool on_u() const { return back == 1; }

    /// Whether the pressure sees to what straight paths do in a cell.
    bool straight(std::int32_t i, std::int32_t j) const {
        const std::int32_t x = i < 0 ? s.nx - 1 : i;
        const std::int32_t y = j < 0 ? s.ny - 1 : j;
        const std::int32_t c = s.index(x, y);
        return goes_straight(fields, s, borders, x, y) &&
               (!walls.active || untouched(walls, c, c + s.stride));
    }

    /// Whether the velocity is liquid's.
    bool wet(std::int32_t face) const {
        return fields.level[face] > Real(0) || fields.level[face - back] > Real(0);
    }

    /// No particle reads it, or those that read it look for themselves.
    bool left_out(std::int32_t face) const {
        return fields.level[face] <= kEmptyLevel<Real> ||
               fields.level[face - back] <= kEmptyLevel<Real> ||
               (walls.thin != nullptr &&
                ((walls.thin->mark[face] | walls.thin->mark[face - back]) & kTouching) != 0);
    }

    /// ∂ũ along an axis, from liquid faces, `step` entries apart. `before`: where the levels of
    /// the face before this one are.
    Real slope(std::int32_t face, std::int32_t step, std::int32_t before) const {
        const bool low = wet(before);
        const bool high = wet(face + step);
        const Real below = low ? Real(along[face] - along[face - step]) : Real(0);
        const Real above = high ? Real(along[face + step] - along[face]) : Real(0);
        return low && high ? Real(0.5) * (below + above) : below + above;
    }

    void one(std::int32_t i, std::int32_t j) const {
        const std::int32_t face = s.index(i, j);
        if (left_out(face)) {
            return;
        }
        const bool here = straight(i, j);
        const bool before = on_u() ? straight(i - 1, j) : straight(i, j - 1);
        if (here && before) {
            return;
        }
        // The face before the one on the seam has a cell that lies two beyond it: its image not.
        const std::int32_t round = (on_u() ? i : j) == 0 ? back * (on_u() ? s.nx : s.ny) : 0;
        const std::int32_t side = on_u() ? s.stride : 1;
        const Real mean = Real(0.25) * ((across[face] + across[face - back]) +
                                        (across[face + side] + across[face + side - back]));
        const Real turned = along[face] * slope(face, back, face - back + round) +
                            mean * slope(face, side, face - side);
        const Seconds<Real> share = here || before ? Seconds<Real>(0.5) * half_dt : half_dt;
        out[face] += share * turned;
    }

    /// Faces i … of a row that are bent in lanes. Returns the next one to do.
    std::int32_t in_lanes([[maybe_unused]] std::int32_t i, [[maybe_unused]] std::int32_t j) const {
#if WEIR_HAS_LANES
        if constexpr (kHasLanes<Real>) {
            if (walls.thin == nullptr && i > 1 && (j > 0 || on_u())) {
                const auto inside = [&](std::int32_t y) {
                    return fields.leaps && inside_tank(borders, s, 1, 1, y);
                };
                const BendTask task{fields.level,
                                    walls.active ? walls.open_u : nullptr,
                                    walls.open_v,
                                    along,
                                    across,
                                    out,
                                    half_dt,
                                    back,
                                    s.stride,
                                    inside(j),
                                    inside(on_u() ? j : j - 1)};
                const std::int32_t row = s.index(0, j);
                return bend_lanes(task, row + i, row + s.nx - 1) - row;
            }
        }
#endif
        return i;
    }

    void rows(const Part& part) const {
        const std::int32_t first_i = on_u() && !borders.wrap_x ? 1 : 0;
        const std::int32_t first_j = !on_u() && !borders.wrap_y ? 1 : 0;
        for (std::int32_t j = maximum(first_j, part.first); j < part.end; ++j) {
            for (std::int32_t i = first_i; i < s.nx;) {
                i = in_lanes(i, j);
                const std::int32_t end = minimum(i < 2 ? i + 1 : i + 4, s.nx);
                for (; i < end; ++i) {
                    one(i, j);
                }
            }
        }
    }
};

}  // namespace

template <class Real>
void bend_paths([[maybe_unused]] const Borders<Real>& borders,
                [[maybe_unused]] const Walls<Real>& walls, [[maybe_unused]] Seconds<Real> dt_s,
                [[maybe_unused]] const PressureFields<Real>& fields,
                [[maybe_unused]] StaggeredGrid<Real>& grid, [[maybe_unused]] Work work) {
    if constexpr (!Stored<Real>::coarse) {
        const GridShape& s = grid.shape;
        const VelocityOf<Real>* u = fields.divergence;
        const VelocityOf<Real>* v = fields.inverse_diagonal;
        const Seconds<Real> half_dt = Seconds<Real>(0.5) * dt_s;
        const Bending<Real> of_u{s, borders, walls, fields, half_dt, 1, u, v, grid.u};
        const Bending<Real> of_v{s, borders, walls, fields, half_dt, s.stride, v, u, grid.v};
        work.share(work.take(s.ny, 2 * s.nx), 2 * s.nx, 1, [&](const Part& rows, std::int32_t) {
            of_u.rows(rows);
            of_v.rows(rows);
        });
        if (work.once(s.border())) {
            extend_velocity(borders, s, grid.u, grid.v);
        }
    }
}

#define WEIR_INSTANTIATE(Real)                                                         \
    template void bend_paths(const Borders<Real>&, const Walls<Real>&, Seconds<Real>, \
                             const PressureFields<Real>&, StaggeredGrid<Real>&, Work);
WEIR_FOR_EACH_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
