// Rows and columns of a field: how ghosts are filled and folded back.
#pragma once

#include "grid/staggered_grid.hpp"

namespace weir {

/// A row or a column of a field: `count` entries from `first`, `step` apart.
struct Line {
    std::int32_t first;
    std::int32_t step;
    std::int32_t count;
};

inline Line column(const GridShape& s, std::int32_t i) {
    return {s.index(i, -1), s.stride, s.ny + 2};
}
inline Line row(const GridShape& s, std::int32_t j) { return {s.index(-1, j), 1, s.nx + 2}; }

/// Of numbers of any kind, of 1, 2, 4 or 8 bytes.
void copy_line(void* field, std::size_t size, const Line& to, const Line& from);

template <class Field>
inline void copy(Field* field, const Line& to, const Line& from) {
    copy_line(field, sizeof(Field), to, from);
}

/// Ghost cells repeat the cell before them, or, across a seam, the tank's other side.
void fill_ghosts(void* field, std::size_t size, const GridShape& shape, bool seam_x, bool seam_y,
                 bool seams_only);

template <class Field>
void add(Field* field, const Line& to, const Line& from) {
    for (std::int32_t k = 0; k < to.count; ++k) {
        field[to.first + k * to.step] += field[from.first + k * from.step];
    }
}

template <class Field>
void set_zero(Field* field, const Line& line) {
    for (std::int32_t k = 0; k < line.count; ++k) {
        field[line.first + k * line.step] = Field(0);
    }
}

template <class Field>
void move(Field* field, const Line& to, const Line& from) {
    add(field, to, from);
    set_zero(field, from);
}

}  // namespace weir
