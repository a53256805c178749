// The equations of packed worlds in whole numbers, and the pressure to start from.
#pragma once

#include "pressure/leap_packed.hpp"
#include "pressure/relax_packed.hpp"
#include "solid/moving_walls.hpp"

namespace weir {

/// A pressure to start from. Below twice the last one no product of 64 bits is needed.
inline SmallFixed rescaled(SmallFixed last, SmallFixed rescale) {
    const auto share = static_cast<std::uint32_t>(rescale.raw);
    if (share >= 2U << 16U) {
        return bounded(last * rescale);
    }
    const std::uint32_t size = fixed::magnitude(last.raw);
    const std::uint32_t rest = share & 0xFFFFU;
    const std::uint32_t whole = share >> 16U != 0 ? size : 0;
    const auto scaled = static_cast<std::int32_t>(
        whole + (size >> 16U) * rest + (((size & 0xFFFFU) * rest + 0x8000U) >> 16U));
    return bounded(SmallFixed::of_raw(last.raw < 0 ? -scaled : scaled));
}

/// Those of a row. Not inline: most steps are as long as the last, which changes none.
[[gnu::noinline]] inline void rescale(SmallFixed* pressure, const SmallFixed* end,
                                      SmallFixed change) {
    for (; change != SmallFixed(1) && pressure < end; ++pressure) {
        *pressure = rescaled(*pressure, change);
    }
}

/// The equation of a liquid cell that has a wall beside it.
template <bool Solids, class Weights, class Fields>
[[gnu::noinline]] void build_rare(const Weights& weights, std::int32_t i, std::int32_t j,
                                  Fields& fields) {
    using Real = SmallFixed;
    const Walls<Real>& walls = weights.walls;
    const StaggeredGrid<Real>& grid = weights.grid;
    const GridShape& s = grid.shape;
    const std::int32_t c = s.index(i, j);
    const std::int32_t up = c + s.stride;
    const auto* const level = fields.level + c;
    std::int32_t diagonal = 0;
    std::int32_t outwards = 0;
    const auto look = [&](bool inside, const ShareOf<Real>* open, std::int32_t face,
                          std::int32_t velocity, std::int32_t step) {
        const std::int32_t weight = Solids ? static_cast<std::int32_t>(open[face].raw) : 128;
        outwards += weight * velocity;
        if (inside && weight != 0) {
            const std::int32_t there = level[step].raw;
            diagonal += there > 0 ? weight
                                  : packed_coefficient(weight, weight, level[0].raw, there);
        }
    };
    look(weights.has_left(i), walls.open_u, c, -grid.u[c].raw, -1);
    look(weights.has_right(i), walls.open_u, c + 1, grid.u[c + 1].raw, 1);
    look(weights.has_lower(j), walls.open_v, c, -grid.v[c].raw, -s.stride);
    look(weights.has_upper(j), walls.open_v, up, grid.v[up].raw, s.stride);
    if (diagonal == 0) {
        fields.inverse_diagonal[c].raw = 0;
        fields.divergence[c].raw = 0;  // whoever goes by levels reads it
        return;
    }
    const bool wide = !Solids || untouched(walls, c, up);
    std::int32_t flow = rounded_shift(outwards, 7);
    if (Solids && walls.moving != nullptr && (!wide || touches_wall(walls, c))) {
        constexpr std::int32_t kMost = 0x7FFFFE00;  // a fast spin's end saturates
        flow += rounded_shift(minimum(walls.moving->flow(grid, walls, i, j).raw, kMost), 9);
    }
    fields.divergence[c].raw = short_of(flow);
    fields.inverse_diagonal[c].raw = short_of(wide ? diagonal : -diagonal);
}

/// Sides on which a cell has another one.
inline constexpr std::int32_t kLeft = 1, kRight = 2, kLower = 4, kUpper = 8, kAllSides = 15;

/// The equation of a liquid cell with open faces that has air or the tank's end beside it.
template <class Fields>
[[gnu::noinline]] void build_wide(const StaggeredGrid<SmallFixed>& grid, std::int32_t c,
                                  std::int32_t sides, Fields& fields) {
    const std::int32_t stride = grid.shape.stride;
    const auto* const level = fields.level + c;
    const VelocityOf<SmallFixed>* const u = grid.u + c;
    const VelocityOf<SmallFixed>* const v = grid.v + c;
    std::int32_t diagonal = 0;
    std::int32_t flow = 0;
    const auto look = [&](std::int32_t side, std::int32_t step, std::int32_t velocity) {
        flow += velocity;
        if ((sides & side) != 0) {
            const std::int32_t there = level[step].raw;
            diagonal += there > 0 ? 128 : packed_coefficient(128, 128, level[0].raw, there);
        }
    };
    look(kLeft, -1, -u[0].raw);
    look(kRight, 1, u[1].raw);
    look(kLower, -stride, -v[0].raw);
    look(kUpper, stride, v[stride].raw);
    fields.divergence[c].raw = short_of(flow);
    fields.inverse_diagonal[c].raw = short_of(diagonal);
}

/// Of a row whose liquid ends there.
template <class Diagonal>
inline void note_length(const Diagonal* diagonal, std::int32_t end, Solve<SmallFixed>& solve) {
    if (solve.longest_row == solve.kNotAsked) {
        return;
    }
    std::int32_t first = 0;
    while (diagonal[first].raw == 0) {
        ++first;
    }
    solve.longest_row = maximum(solve.longest_row, static_cast<std::int16_t>(end - first));
}

/// Puts up the equations of some rows: flow out of each cell, its diagonal, pressure to start from.
template <bool Solids, class Weights, class Fields>
void build_packed(const Weights& weights, const Part& rows, Fields& fields) {
    const StaggeredGrid<SmallFixed>& grid = weights.grid;
    const GridShape& s = grid.shape;
    const std::int32_t stride = s.stride;
    const Walls<SmallFixed>& walls = weights.walls;
    const PackedLeap leap(fields.leaps, fields.last_dt);
    const bool wraps = weights.wraps_x();
    const auto open = [&](std::int32_t c) {
        return !Solids || (untouched(walls, c, c + stride) &&
                           !(walls.moving != nullptr && touches_wall(walls, c)));
    };
    for (std::int32_t j = rows.first; j < rows.end; ++j) {
        const std::int32_t across = (weights.has_lower(j) ? kLower : 0) |
                                    (weights.has_upper(j) ? kUpper : 0);
        const std::int32_t row = s.index(0, j);
        const std::int32_t behind = row + s.nx;
        std::int32_t end = row;  // of the row's liquid
        std::int32_t sides = across | kRight | (wraps ? kLeft : 0);
        for (std::int32_t c = row; c < behind; ++c, sides |= kLeft) {
            const auto* const level = fields.level + c;
            if (level->raw <= 0) {
                fields.inverse_diagonal[c].raw = 0;
                fields.pressure[c].raw = 0;
                continue;
            }
            if (c + 1 == behind && !wraps) {
                sides &= ~kRight;
            }
            if (!open(c)) {
                build_rare<Solids>(weights, c - row, j, fields);
            } else if (sides != kAllSides || level[-1].raw <= 0 || level[1].raw <= 0 ||
                       level[stride].raw <= 0 || level[-stride].raw <= 0) {
                build_wide(grid, c, sides, fields);
            } else {
                const std::int32_t flow = (grid.u[c + 1].raw - grid.u[c].raw) +
                                          (grid.v[c + stride].raw - grid.v[c].raw);
                fields.divergence[c].raw = short_of(flow + wanted_convergence(grid, c, leap));
                fields.inverse_diagonal[c].raw = 512;
            }
            if (fields.inverse_diagonal[c].raw != 0) {
                end = c + 1;
            } else {
                fields.pressure[c].raw = 0;
            }
        }
        rescale(fields.pressure + row, fields.pressure + end, fields.solve.rescale);
        fields.inverse_diagonal[end].raw = kRowEnd;
        fields.inverse_diagonal[end + 1].raw = kRowEnd;
        if (end != row) {
            fields.solve.first_row = minimum(fields.solve.first_row, j);
            fields.solve.last_row = j;
            note_length(fields.inverse_diagonal + row, end - row, fields.solve);
        }
    }
}

}  // namespace weir
