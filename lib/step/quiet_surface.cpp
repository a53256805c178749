#include "step/quiet_surface.hpp"

#include "step/quiet_lanes.hpp"
#include "step/quiet_packed.hpp"

namespace weir {

namespace {

/// Of PIC, where all is at rest.
template <class Real>
constexpr Real kMostShare = Real(0.5);

/// Nothing gets faster than by this factor: what pulls at few alone may give energy.
template <class Real>
constexpr Real kFaster = Real(1.25);

/// A surface leans from a slope of one in so many on: one that will be level again, which a wave
/// passes, and one that gravity holds a little aslant.
constexpr std::int32_t kPassingRun = 8;
constexpr std::int32_t kLastingRun = 64;

/// What gravity leans by less is a sensor's noise, and where it leans by a quarter the surface
/// leans by an eighth anyway.
template <class Real>
std::int32_t least_run(const Vec2<Real>& gravity) {
    const Real x = absolute(gravity.x);
    const Real y = absolute(gravity.y);
    const Real low = minimum(x, y);
    const Real high = maximum(x, y);
    const bool lasts = low > Real(1.0F / kLastingRun) * high && low < Real(0.25) * high;
    return lasts ? kLastingRun : kPassingRun;
}

/// Cells whose centre is nearer to the surface are asked, cells.
template <class Real>
constexpr Real kNearest = Real(1);

/// Pieces for threads are whole multiples of so many particles.
constexpr std::int32_t kGrain = 64;

/// How much of PIC cells get, and which rows have such cells.
template <class Real>
struct Shares {
    const GridShape& shape;
    VelocityOf<Real>* of;  ///< each cell, in rows that are marked

    /// A row's mark stands before its cells.
    VelocityOf<Real>& mark(std::int32_t j) const { return of[shape.index(-1, j)]; }

    bool marked(std::int32_t j) const { return is_positive(Real(mark(j))); }

    /// With the mark.
    void clear(std::int32_t j) const { clear_rows(shape, {j + 1, j + 2}, of); }

    void set(std::int32_t c, std::int32_t j, VelocityOf<Real> its) const {
        if (!marked(j)) {
            clear(j);
            mark(j) = Real(1);
        }
        of[c] = its;
    }

    /// From the first row with a mark to the end of the last one all cells have a share, if of 0.
    /// Kept where no cell is.
    VelocityOf<Real>& first_row() const { return mark(-1); }
    VelocityOf<Real>& end_row() const { return mark(shape.ny); }

    /// Whether there are any.
    bool find_rows() const {
        Part rows{0, shape.ny};
        while (!rows.empty() && !marked(rows.first)) {
            ++rows.first;
        }
        while (!rows.empty() && !marked(rows.end - 1)) {
            --rows.end;
        }
        first_row() = static_cast<Real>(shape.j0 + rows.first);
        end_row() = static_cast<Real>(shape.j0 + rows.end);
        return !rows.empty();
    }

    /// A row between them that has no mark has no shares.
    void clear_unmarked(std::int32_t j) const {
        const auto row = static_cast<Real>(shape.j0 + j);
        if (!marked(j) && row >= Real(first_row()) && row < Real(end_row())) {
            clear(j);
        }
    }
};

/// What a cell's share is, and what it does to particles.
template <class Real>
struct Quieting {
    const StaggeredGrid<Real>& grid;
    const LevelOf<Real>* level;
    Real most;         ///< what gravity gives in the step
    Real least_slope;  ///< of what leans

    Quieting(const StaggeredGrid<Real>& faces, const PressureFields<Real>& fields,
             std::int32_t run)
        : grid(faces),
          level(fields.level),
          most(fields.cell_weight),
          least_slope(run == kLastingRun ? Real(1.0F / kLastingRun) : Real(1.0F / kPassingRun)) {}

    bool leans(std::int32_t c) const {
        const auto rise = [&](std::int32_t step) {
            return absolute(Real(level[c + step]) - Real(level[c - step]));
        };
        const Real along_x = rise(1);
        const Real along_y = rise(grid.shape.stride);
        return minimum(along_x, along_y) > least_slope * maximum(along_x, along_y);
    }

    /// Less for what is faster, 0 from what gravity gives in the step on.
    Real by_speed(std::int32_t c) const {
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

    Real share_of(std::int32_t c) const { return leans(c) ? by_speed(c) : Real(0); }

    /// Towards the grid's velocity before, or as near as allowed.
    static Real drawn(Real velocity, Real mean, Real its) {
        const Real limit = kFaster<Real> * absolute(velocity);
        return velocity + its * (maximum(Real(0) - limit, minimum(mean, limit)) - velocity);
    }

    [[gnu::noinline]] void quiet(Real its, const Vec2<Real>& x,
                                 Vec2<VelocityOf<Real>>& velocity) const {
        const std::int32_t stride = grid.shape.stride;
        velocity.x = drawn(velocity.x, interpolate(grid.mass_u, stride, stencil_u(grid.shape, x)),
                           its);
        velocity.y = drawn(velocity.y, interpolate(grid.mass_v, stride, stencil_v(grid.shape, x)),
                           its);
    }

#if WEIR_HAS_LANES
    /// Few particles have a share, and many are looked at in one.
    void quiet_in_lanes(const Shares<float>& shares, const Particles<float>& particles) const {
        const std::int32_t stride = grid.shape.stride;
        const SharedCells cells{shares.of + stride + 1, stride, shares.first_row(),
                                shares.end_row(), grid.shape.index(0, 0) - (stride + 1)};
        std::int32_t number[kMostLooked];
        for (std::int32_t k = 0; k < particles.count; k += kMostLooked) {
            const std::int32_t count = minimum(kMostLooked, particles.count - k);
            const Vec2<float>* position = particles.position + k;
            const std::int32_t found = find_all_sharing(cells, &position->x, count, number);
            for (std::int32_t n = 0; n < found; ++n) {
                const Vec2<float>& x = position[number[n]];
                const float its = cells.share[static_cast<std::int32_t>(x.y) * stride +
                                              static_cast<std::int32_t>(x.x)];
                quiet(its, x, particles.velocity[k + number[n]]);
            }
        }
    }
#endif

    void quiet_all(const Shares<Real>& shares, const Particles<Real>& particles) const {
#if WEIR_HAS_LANES
        if constexpr (kHasLanes<Real>) {
            quiet_in_lanes(shares, particles);
            return;
        }
#endif
        const auto first = bound_key(Real(shares.first_row()));
        const auto end = bound_key(Real(shares.end_row()));
        const VelocityOf<Real>* const first_share = shares.of + grid.shape.stride + 1;
        for (std::int32_t k = 0; k < particles.count; ++k) {
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

#if !defined(WEIR_WITHOUT_PACKED)
template <>
struct Quieting<SmallFixed> {
    const StaggeredGrid<SmallFixed>& grid;
    const LevelOf<SmallFixed>* level;
    packed::SlowShare by_speed;
    std::int32_t run;  ///< of the least slope of what leans

    Quieting(const StaggeredGrid<SmallFixed>& faces, const PressureFields<SmallFixed>& fields,
             std::int32_t of_slope)
        : grid(faces), level(fields.level), by_speed(fields.cell_weight), run(of_slope) {}

    VelocityOf<SmallFixed> share_of(std::int32_t c) const {
        const std::int32_t stride = grid.shape.stride;
        return VelocityOf<SmallFixed>::of_raw(static_cast<std::int16_t>(
            packed::leans(level + c, stride, run)
                ? by_speed.of(grid.mass_u + c, grid.mass_v + c, stride)
                : 0));
    }

    void quiet_all(const Shares<SmallFixed>& shares, const Particles<SmallFixed>& particles) const {
        const Part rows{static_cast<std::int32_t>(SmallFixed(shares.first_row())),
                        static_cast<std::int32_t>(SmallFixed(shares.end_row()))};
        packed::quiet(grid, shares.of, rows, particles);
    }
};
#endif

/// The next cell of the surface, or `end`. In a loop of its own: few cells are.
template <class Real>
const LevelOf<Real>* next_near(const LevelOf<Real>* at, const LevelOf<Real>* end) {
    while (at < end && !(magnitude_key(Real(*at)) < magnitude_key(kNearest<Real>))) {
        ++at;
    }
    return at;
}

/// Shares of a row's cells, if any has one.
template <class Real>
void weigh_row(const Quieting<Real>& quieting, std::int32_t j, const Shares<Real>& shares) {
    const GridShape& s = shares.shape;
    const Part columns = s.columns(j);
    const LevelOf<Real>* const first = quieting.level + s.index(columns.first, j);
    const LevelOf<Real>* const end = first + (columns.end - columns.first);
    shares.mark(j) = Real(0);
    for (const auto* at = next_near<Real>(first, end); at < end;
         at = next_near<Real>(at + 1, end)) {
        const auto c = static_cast<std::int32_t>(at - quieting.level);
        const VelocityOf<Real> its = quieting.share_of(c);
        if (is_positive(Real(its))) {
            shares.set(c, j, its);
        }
    }
}

}  // namespace

template <class Real>
void quiet_surface(const StaggeredGrid<Real>& grid, PressureFields<Real>& fields,
                   const Vec2<Real>& gravity, Particles<Real>& particles, Work work) {
    const bool asked =
        fields.cell_weight > Real(0) && !fields.on_surface && !(fields.sound_speed > Real(0));
    std::uint8_t& turn = fields.quiet_turn;
    if (work.once(1)) {
        next_turn(turn);
    }
    if (!(asked && turn % kQuietEvery == 0) && !work.foreseeing()) {
        return;
    }
    const GridShape& s = grid.shape;
    const Quieting<Real> quieting(grid, fields, least_run(gravity));
    const Shares<Real> shares{s, fields.divergence};
    work.share(work.take(s.ny, s.nx), s.nx, 1, [&](const Part& rows, std::int32_t) {
        for (std::int32_t j = rows.first; j < rows.end; ++j) {
            weigh_row(quieting, j, shares);
        }
    });
    if (work.once(s.ny)) {
        turn = shares.find_rows() ? 0 : kQuietEvery;
    }
    const bool some = work.foreseeing() || turn == 0;
    work.share(work.take(some ? s.ny : 0, s.nx), s.nx, 1, [&](const Part& rows, std::int32_t) {
        for (std::int32_t j = rows.first; j < rows.end; ++j) {
            shares.clear_unmarked(j);
        }
    });
    work.share(work.take(some ? particles.count : 0, 1), 1, kGrain,
               [&](const Part& part, std::int32_t) {
                   if (!part.empty()) {
                       quieting.quiet_all(shares,
                                          particles.part(part.first, part.end - part.first));
                   }
               });
}

#define WEIR_INSTANTIATE(Real)                                                     \
    template void quiet_surface(const StaggeredGrid<Real>&, PressureFields<Real>&, \
                                const Vec2<Real>&, Particles<Real>&, Work);
WEIR_FOR_EACH_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
