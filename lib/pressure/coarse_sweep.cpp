// Rows of coarse cells as sweeps in lanes want them, and back.
#include "pressure/coarse_sweep_lanes.hpp"

#include <cstring>

namespace weir {

#if WEIR_HAS_LANES

namespace {

/// A row from column −1 on, its columns as sweeps want them. `room`: as much again.
void part_row(std::int32_t width, std::int32_t evens, float* row, float* room) {
    std::memcpy(room, row, static_cast<std::size_t>(width) * sizeof *row);
    row[evens] = room[0];
    row[evens - 1] = room[2 * evens - 1];
    for (std::int32_t k = 0; 2 * k + 2 < width; ++k) {
        row[k] = room[2 * k + 1];
        row[evens + 1 + k] = room[2 * k + 2];
    }
}

/// The same back.
void join_row(std::int32_t width, std::int32_t evens, float* row, float* room) {
    std::memcpy(room, row, static_cast<std::size_t>(width) * sizeof *row);
    row[0] = room[evens];
    row[2 * evens - 1] = room[evens - 1];
    for (std::int32_t k = 0; 2 * k + 2 < width; ++k) {
        row[2 * k + 1] = room[k];
        row[2 * k + 2] = room[evens + 1 + k];
    }
}

/// Of some rows all that sweeps read. Nobody reads what residual there is below the tank.
template <class Row>
void for_each_coarse_row(const CoarseGrid<float>& coarse, const Part& rows, const Row& row) {
    const GridShape& s = coarse.shape;
    float* const room = coarse.residual + s.index(-1, -1);
    const auto each = [&](float* field, std::int32_t end) {
        for (std::int32_t j = rows.first; j < end; ++j) {
            row(s.nx + 2, evens_of(s), field + s.index(-1, j), room);
        }
    };
    each(coarse.correction, rows.end);
    each(coarse.residual, rows.end);
    each(coarse.inverse_diagonal, rows.end);
    each(coarse.weight_u, rows.end);
    each(coarse.weight_v, rows.end + 1);
    clear_rows(s, {0, 1}, coarse.residual);
}

/// `extend_cells` while columns stand apart.
void extend_apart(const Borders<float>& borders, const GridShape& s, float* field) {
    if (borders.wrap_x) {
        const auto at = [&](std::int32_t i) {
            const std::int32_t place = (i & 1) == 0 ? i / 2 : evens_of(s) + (i + 1) / 2;
            return Line{s.index(-1, -1) + place, s.stride, s.ny + 2};
        };
        copy(field, at(-1), at(s.nx - 1));
        copy(field, at(s.nx), at(0));
    }
    if (borders.wrap_y) {
        copy(field, row(s, -1), row(s, s.ny - 1));
        copy(field, row(s, s.ny), row(s, 0));
    }
}

}  // namespace

void sweep_apart(const Borders<float>& borders, std::int32_t count, float omega,
                 CoarseGrid<float>& coarse) {
    const Part rows{coarse.first_row, coarse.last_row + 1};
    for_each_coarse_row(coarse, rows, part_row);
    for (std::int32_t colour = 0; colour < count; ++colour) {
        relax_apart_lanes(coarse, omega, (rows.first + colour) & 1, rows);
        extend_apart(borders, coarse.shape, coarse.correction);
    }
    for_each_coarse_row(coarse, rows, join_row);
    extend_cells(borders, coarse.shape, coarse.correction);
}

#endif

}  // namespace weir
