#include "step/quiet_surface.hpp"

namespace weir {

namespace {

/// Of PIC, where all is at rest.
template <class Real>
constexpr Real kMostShare = Real(0.5);

/// Nothing gets faster than by this factor: what pulls at few alone may give energy.
template <class Real>
constexpr Real kFaster = Real(1.25);

/// Least slope of a surface that leans.
template <class Real>
constexpr Real kLeastSlope = Real(0.125);

/// Cells whose centre is nearer to the surface are asked, cells.
template <class Real>
constexpr Real kNearest = Real(1);

/// Pieces for threads are whole multiples of so many particles.
constexpr std::int32_t kGrain = 64;

template <class Real>
struct Quieting {
    const StaggeredGrid<Real>& grid;
    const PressureFields<Real>& fields;
    VelocityOf<Real>* share;  ///< of each cell, in rows that are marked

    std::int32_t mark_of(std::int32_t j) const { return grid.shape.index(-1, j); }

    bool marked(std::int32_t j) const { return Real(share[mark_of(j)]) > Real(0); }

    bool leans(std::int32_t c) const {
        const LevelOf<Real>* level = fields.level;
        const auto rise = [&](std::int32_t step) {
            return absolute(Real(level[c + step]) - Real(level[c - step]));
        };
        const Real along_x = rise(1);
        const Real along_y = rise(grid.shape.stride);
        return minimum(along_x, along_y) > kLeastSlope<Real> * maximum(along_x, along_y);
    }

    /// Less for what is faster, 0 from what gravity gives in the step on.
    Real share_of(std::int32_t c) const {
        const Real most = fields.cell_weight;
        const auto mean = [&](const VelocityOf<Real>* before, std::int32_t step) {
            return Real(0.5) * (Real(before[c]) + Real(before[c + step]));
        };
        const Real u = mean(grid.mass_u, 1);
        const Real v = mean(grid.mass_v, grid.shape.stride);
        if (!(absolute(u) < most) || !(absolute(v) < most)) {
            return Real(0);
        }
        const Real x = u / most;
        const Real y = v / most;
        return maximum(Real(0), kMostShare<Real> * (Real(1) - (x * x + y * y)));
    }

    /// The next cell of the surface, or `end`. In a loop of its own: few cells are.
    static const LevelOf<Real>* next_near(const LevelOf<Real>* at, const LevelOf<Real>* end) {
        while (at < end && !(magnitude_key(Real(*at)) < magnitude_key(kNearest<Real>))) {
            ++at;
        }
        return at;
    }

    /// Shares of a row's cells, if any has one.
    void weigh_row(std::int32_t j) const {
        const GridShape& s = grid.shape;
        const LevelOf<Real>* const first = fields.level + s.index(0, j);
        const LevelOf<Real>* const end = first + s.nx;
        share[mark_of(j)] = Real(0);
        for (const auto* at = next_near(first, end); at < end; at = next_near(at + 1, end)) {
            weigh(static_cast<std::int32_t>(at - fields.level), j);
        }
    }

    /// With the row's mark, which stands before its cells.
    void clear(std::int32_t j) const { clear_rows(grid.shape, {j + 1, j + 2}, share); }

    [[gnu::noinline]] void weigh(std::int32_t c, std::int32_t j) const {
        const Real its = leans(c) ? share_of(c) : Real(0);
        if (its > Real(0)) {
            if (!marked(j)) {
                clear(j);
                share[mark_of(j)] = Real(1);
            }
            share[c] = its;
        }
    }

    /// From the first row with a mark to the end of the last one all cells have a share, if of 0.
    /// Kept where no cell is.
    VelocityOf<Real>& first_row() const { return share[grid.shape.index(-1, -1)]; }
    VelocityOf<Real>& end_row() const { return share[grid.shape.index(-1, grid.shape.ny)]; }

    /// Whether there are any.
    bool find_rows() const {
        const GridShape& s = grid.shape;
        Part rows{0, s.ny};
        while (!rows.empty() && !marked(rows.first)) {
            ++rows.first;
        }
        while (!rows.empty() && !marked(rows.end - 1)) {
            --rows.end;
        }
        first_row() = static_cast<Real>(s.j0 + rows.first);
        end_row() = static_cast<Real>(s.j0 + rows.end);
        return !rows.empty();
    }

    /// A row between them that has no mark has no shares.
    void clear_unmarked(std::int32_t j) const {
        const auto row = static_cast<Real>(grid.shape.j0 + j);
        if (!marked(j) && row >= Real(first_row()) && row < Real(end_row())) {
            clear(j);
        }
    }

    /// Towards the grid's velocity before, or as near as allowed.
    static Real drawn(Real velocity, Real mean, Real its) {
        const Real most = kFaster<Real> * absolute(velocity);
        return velocity + its * (maximum(Real(0) - most, minimum(mean, most)) - velocity);
    }

    [[gnu::noinline]] void quiet(Real its, const Vec2<Real>& x,
                                 Vec2<VelocityOf<Real>>& velocity) const {
        const std::int32_t stride = grid.shape.stride;
        velocity.x = drawn(velocity.x, interpolate(grid.mass_u, stride, stencil_u(grid.shape, x)),
                           its);
        velocity.y = drawn(velocity.y, interpolate(grid.mass_v, stride, stencil_v(grid.shape, x)),
                           its);
    }

    void quiet_some(const Part& some, Particles<Real>& particles) const {
        if (some.empty()) {
            return;
        }
        const auto first = bound_key(Real(first_row()));
        const auto end = bound_key(Real(end_row()));
        const VelocityOf<Real>* const first_share = share + grid.shape.stride + 1;
        for (std::int32_t k = some.first; k < some.end; ++k) {
            const Vec2<PositionOf<Real>>& x = particles.position[k];
            const auto y = bound_key(Real(x.y));
            if (first <= y && y < end) {
                const Real its = first_share[static_cast<std::int32_t>(Real(x.y)) *
                                                 grid.shape.stride +
                                             static_cast<std::int32_t>(Real(x.x))];
                if (is_positive(its)) {
                    quiet(its, Vec2<Real>(x), particles.velocity[k]);
                }
            }
        }
    }
};

}  // namespace

template <class Real>
void quiet_surface(const StaggeredGrid<Real>& grid, PressureFields<Real>& fields,
                   Particles<Real>& particles, Work work) {
    const bool asked =
        fields.cell_weight > Real(0) && !fields.on_surface && !(fields.sound_speed > Real(0));
    if (!asked && !work.foreseeing()) {
        return;
    }
    if (work.once(1)) {
        fields.turn = static_cast<std::uint16_t>((fields.turn + 1) % kQuietEvery);
    }
    if (fields.turn % kQuietEvery != 0 && !work.foreseeing()) {
        return;
    }
    const GridShape& s = grid.shape;
    const Quieting<Real> quieting{grid, fields, fields.divergence};
    work.share(work.take(s.ny, s.nx), s.nx, 1, [&](const Part& rows, std::int32_t) {
        for (std::int32_t j = rows.first; j < rows.end; ++j) {
            quieting.weigh_row(j);
        }
    });
    if (work.once(s.ny)) {
        fields.turn = quieting.find_rows() ? 0 : kQuietEvery;
    }
    const bool some = work.foreseeing() || fields.turn == 0;
    work.share(work.take(some ? s.ny : 0, s.nx), s.nx, 1, [&](const Part& rows, std::int32_t) {
        for (std::int32_t j = rows.first; j < rows.end; ++j) {
            quieting.clear_unmarked(j);
        }
    });
    work.share(work.take(some ? particles.count : 0, 1), 1, kGrain,
               [&](const Part& part, std::int32_t) { quieting.quiet_some(part, particles); });
}

#define WEIR_INSTANTIATE(Real)                                                     \
    template void quiet_surface(const StaggeredGrid<Real>&, PressureFields<Real>&, \
                                Particles<Real>&, Work);
WEIR_FOR_EACH_ROOMY_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
