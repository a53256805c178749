// The volume correction four cells at a time: the plain loops' sums, and so their bits.
#pragma once

#include "math/four_lanes.hpp"
#include "pressure/wide_cells.hpp"

namespace weir {

/// What the excess of cells and of patches is cut to, and of what a patch is overfull.
struct PatchLimits {
    float cell_window;
    float patch_window;
    float overfull;
    float least_overfull;  ///< liquid cells
};

/// What decides what a patch pays, summed by column.
template <class Real>
struct Weights {
    Real raised[kCoarseEdge] = {};    ///< work of the drift against gravity
    Real moving[kCoarseEdge] = {};    ///< squares of the velocity along it
    Real disorder[kCoarseEdge] = {};  ///< squares of the excess
};

template <class Real>
inline Real in_turn(const Real (&column)[kCoarseEdge]) {
    return ((column[0] + column[1]) + column[2]) + column[3];
}

#if WEIR_HAS_LANES

/// Mean excess of as many patches as there are lanes, four cells wide, from cell c on; 0 in air.
/// `most` takes the largest excess of each, either way; `overfull` grows as that of `average`. A
/// bit for each patch without liquid.
template <class L>
inline std::uint32_t means_of_patches(const PressureFields<float>& f, const PatchLimits& limits,
                                      std::int32_t stride, std::int32_t c, std::int32_t rows,
                                      float* means, float* most, std::int32_t& overfull) {
    const auto zero = L::all(0.0F);
    auto sum = zero;
    typename L::Floats wet[4] = {zero, zero, zero, zero};
    typename L::Floats off[4] = {zero, zero, zero, zero};
    for (std::int32_t y = 0; y < rows; ++y, c += stride) {
        typename L::Floats said[4];
        for (std::int32_t k = 0; k < 4; ++k) {
            const std::int32_t at = c + k * L::kLanes;
            const auto liquid = L::load(f.level + at) > zero;
            const auto e = L::load(f.divergence + at);
            const auto cut = L::clamp(e, L::all(-limits.cell_window), L::all(limits.cell_window));
            off[k] = L::maximum(off[k], L::absolute(e));
            said[k] = liquid ? cut : zero;
            wet[k] += liquid ? L::all(1.0F) : zero;
        }
        transpose<L>(said);
        sum = (((sum + said[0]) + said[1]) + said[2]) + said[3];
    }
    transpose<L>(off);
    L::store(most, L::in_order(L::maximum(L::maximum(off[0], off[1]),
                                          L::maximum(off[2], off[3]))));
    transpose<L>(wet);
    const auto count = (wet[0] + wet[1]) + (wet[2] + wet[3]);
    const auto none = count == zero;
    const auto mean = none ? zero : sum / (none ? L::all(1.0F) : count);
    const auto crowded =
        (count >= L::all(limits.least_overfull)) & (mean >= L::all(limits.overfull));
    if (L::any_true(crowded)) {
        const auto many = crowded ? count : zero;
        for (std::int32_t k = 0; k < L::kLanes; ++k) {
            overfull += static_cast<std::int32_t>(many[k]);
        }
    }
    L::store(means, L::in_order(L::clamp(mean, L::all(-limits.patch_window),
                                         L::all(limits.patch_window))));
    return L::bits_of(L::in_order(count) == zero);
}

/// The same for the patches of a row, four cells wide, as long as there are so many; `empty`(k) is
/// called for each without liquid. Returns how many.
template <class Empty>
inline std::int32_t means_of_row(const PressureFields<float>& f, const PatchLimits& limits,
                                 std::int32_t stride, std::int32_t c, std::int32_t rows,
                                 std::int32_t patches, float* means, float* most,
                                 std::int32_t& overfull, const Empty& empty) {
    std::int32_t k = 0;
    const auto tell = [&](std::uint32_t bits) {
        for (; bits != 0; bits &= bits - 1) {
            empty(k + __builtin_ctz(bits));
        }
    };
    if (const WideCells* wide = wide_cells()) {
        for (; k + 8 <= patches; k += 8) {
            tell(wide->means_of_patches(f, limits, stride, c + 4 * k, rows, means + k, most + k,
                                        overfull));
        }
    }
    for (; k + 4 <= patches; k += 4) {
        tell(means_of_patches<FourLanes>(f, limits, stride, c + 4 * k, rows, means + k, most + k,
                                         overfull));
    }
    return k;
}

/// The drift of four faces, 0 where they are closed, and which of them are open.
struct DriftOfFour {
    Lanes way;
    LaneMask moves;
};

/// `open` null: no solids. `first`: the first face takes part.
inline DriftOfFour drift_lanes(const float* excess, std::int32_t back, float speed, Lanes along,
                               const float* open, bool first, std::int32_t face) {
    const Lanes rise = (load_lanes(excess + face) - load_lanes(excess + face - back)) + along;
    LaneMask moves{first ? -1 : 0, -1, -1, -1};
    if (open != nullptr) {
        moves &= load_lanes(open + face) > all_lanes(0.0F);
    }
    return {moves ? all_lanes(speed) * rise : all_lanes(0.0F), moves};
}

/// visit(face, its drift, on u) for a patch four cells wide: both kinds of faces, row by row.
template <class Drift, class Visit>
inline void for_each_four(const Drift& drift, const Visit& visit) {
    const float* e = drift.fields.divergence;
    const std::int32_t stride = drift.shape.stride;
    const auto* walls = drift.solids();
    const float* open_u = walls != nullptr ? walls->open_u : nullptr;
    const float* open_v = walls != nullptr ? walls->open_v : nullptr;
    const Lanes along_x = load_lanes(drift.along_x);
    for (std::int32_t y = 0; y < drift.patch.height; ++y) {
        const std::int32_t c = drift.shape.index(drift.patch.i, drift.patch.j + y);
        visit(c, drift_lanes(e, 1, drift.speed, along_x, open_u, drift.first_moves_x(), c), true);
        if (drift.moves_y(y)) {
            visit(c,
                  drift_lanes(e, stride, drift.speed, all_lanes(drift.along_y[y]), open_v, true, c),
                  false);
        }
    }
}

/// Work of a drift that is so much in a column.
template <class Drift>
inline Lanes raised_by(const Drift& drift, Lanes went_x, Lanes went_y) {
    return all_lanes(drift.weight.x) * went_x + all_lanes(drift.weight.y) * went_y;
}

template <class Drift>
inline void weigh_rows(const Drift& drift, const StaggeredGrid<float>& grid,
                       Weights<float>& sums) {
    const Lanes zero = all_lanes(0.0F);
    Lanes went_x = zero;
    Lanes went_y = zero;
    Lanes moving = zero;
    for_each_four(drift, [&](std::int32_t c, DriftOfFour of, bool on_u) {
        const Lanes now = load_lanes((on_u ? grid.u : grid.v) + c);
        const Lanes counts = all_lanes(on_u ? drift.falling.x : drift.falling.y);
        Lanes& went = on_u ? went_x : went_y;
        went = went + of.way;
        moving = moving + (of.moves ? now * (counts * now) : zero);
    });
    Lanes disorder = zero;
    for (std::int32_t y = 0; y < drift.patch.height; ++y) {
        const Lanes here = load_lanes(drift.fields.divergence +
                                      drift.shape.index(drift.patch.i, drift.patch.j + y));
        disorder = disorder + here * here;
    }
    store_lanes(sums.raised, raised_by(drift, went_x, went_y));
    store_lanes(sums.moving, moving);
    store_lanes(sums.disorder, disorder);
}

template <class Drift>
inline void drift_rows(const Drift& drift, float price, StaggeredGrid<float>& grid) {
    for_each_four(drift, [&](std::int32_t c, DriftOfFour of, bool on_u) {
        float* velocity = (on_u ? grid.u : grid.v) + c;
        float* change = (on_u ? grid.mass_u : grid.mass_v) + c;
        const Lanes now = load_lanes(velocity);
        if (price != 0.0F) {
            const Lanes before = load_lanes(change);
            const Lanes pays = all_lanes(on_u ? drift.falling.x : drift.falling.y);
            store_lanes(change, of.moves ? before - all_lanes(price) * (pays * now) : before);
        }
        store_lanes(velocity, of.moves ? now - of.way : now);
    });
}

/// Whether a patch is whole and none of its faces lies on the tank's walls.
template <class Drift>
inline bool is_inner(const Drift& drift) {
    return drift.patch.width == kCoarseEdge && drift.patch.height == kCoarseEdge &&
           drift.first_moves_x() && drift.moves_y(0);
}

/// Whether solids leave all faces of such a patch open.
template <class Drift>
inline bool all_open(const Drift& drift) {
    Lanes least = all_lanes(1.0F);
    std::int32_t c = drift.shape.index(drift.patch.i, drift.patch.j);
    for (std::int32_t y = 0; y < kCoarseEdge; ++y, c += drift.shape.stride) {
        least = minimum(least, minimum(load_lanes(drift.walls.open_u + c),
                                       load_lanes(drift.walls.open_v + c)));
    }
    return all_true(least > all_lanes(0.0F));
}

/// The drift of such a patch's faces, row by row.
struct DriftOfPatch {
    Lanes u[kCoarseEdge];
    Lanes v[kCoarseEdge];
};

/// What a face has if it is open, else 0.
template <bool Closed>
inline Lanes if_open([[maybe_unused]] const float* open, Lanes there) {
    if constexpr (Closed) {
        return load_lanes(open) > all_lanes(0.0F) ? there : all_lanes(0.0F);
    } else {
        return there;
    }
}

/// `Weighed`: also what it weighs; `Closed`: some of the faces are.
template <bool Weighed, bool Closed, class Drift, class Sums>
inline void find_drift(const Drift& drift, const StaggeredGrid<float>& grid, DriftOfPatch& way,
                       [[maybe_unused]] Sums&& sums) {
    const std::int32_t stride = drift.shape.stride;
    const std::int32_t first = drift.shape.index(drift.patch.i, drift.patch.j);
    const float* e = drift.fields.divergence + first;
    const Lanes along_x = load_lanes(drift.along_x);
    const Lanes speed = all_lanes(drift.speed);
    [[maybe_unused]] Lanes went_x = all_lanes(0.0F);
    [[maybe_unused]] Lanes went_y = went_x;
    [[maybe_unused]] Lanes moving = went_x;
    [[maybe_unused]] Lanes disorder = went_x;
    Lanes e_below = load_lanes(e - stride);
    std::int32_t c = first;
    for (std::int32_t y = 0; y < kCoarseEdge; ++y) {
        const Lanes here = load_lanes(e);
        const float* open_u = Closed ? drift.walls.open_u + c : nullptr;
        const float* open_v = Closed ? drift.walls.open_v + c : nullptr;
        way.u[y] = if_open<Closed>(open_u, speed * ((here - load_lanes(e - 1)) + along_x));
        way.v[y] = if_open<Closed>(open_v, speed * ((here - e_below) +
                                                    all_lanes(drift.along_y[y])));
        if constexpr (Weighed) {
            const Lanes u = if_open<Closed>(open_u, load_lanes(grid.u + c));
            const Lanes v = if_open<Closed>(open_v, load_lanes(grid.v + c));
            went_x = went_x + way.u[y];
            went_y = went_y + way.v[y];
            moving = (moving + u * (all_lanes(drift.falling.x) * u)) +
                     v * (all_lanes(drift.falling.y) * v);
            disorder = disorder + here * here;
        }
        e_below = here;
        e += stride;
        c += stride;
    }
    if constexpr (Weighed) {
        store_lanes(sums.raised, raised_by(drift, went_x, went_y));
        store_lanes(sums.moving, moving);
        store_lanes(sums.disorder, disorder);
    }
}

template <bool Closed, class Drift>
inline void apply_drift(const Drift& drift, const DriftOfPatch& way, float price,
                        StaggeredGrid<float>& grid) {
    std::int32_t c = drift.shape.index(drift.patch.i, drift.patch.j);
    for (std::int32_t y = 0; y < kCoarseEdge; ++y, c += drift.shape.stride) {
        const Lanes u = load_lanes(grid.u + c);
        const Lanes v = load_lanes(grid.v + c);
        if (price != 0.0F) {
            const float* open_u = Closed ? drift.walls.open_u + c : nullptr;
            const float* open_v = Closed ? drift.walls.open_v + c : nullptr;
            const Lanes pays_u = all_lanes(price) * (all_lanes(drift.falling.x) * u);
            const Lanes pays_v = all_lanes(price) * (all_lanes(drift.falling.y) * v);
            store_lanes(grid.mass_u + c,
                        load_lanes(grid.mass_u + c) - if_open<Closed>(open_u, pays_u));
            store_lanes(grid.mass_v + c,
                        load_lanes(grid.mass_v + c) - if_open<Closed>(open_v, pays_v));
        }
        store_lanes(grid.u + c, u - way.u[y]);
        store_lanes(grid.v + c, v - way.v[y]);
    }
}

#endif

}  // namespace weir
