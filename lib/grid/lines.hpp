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
[[gnu::noinline]] void add(Field* field, const Line& to, const Line& from) {
    for (std::int32_t k = 0; k < to.count; ++k) {
        field[to.first + k * to.step] += field[from.first + k * from.step];
    }
}

template <class Field>
void clear(Field* field, const Line& line) {
    for (std::int32_t k = 0; k < line.count; ++k) {
        field[line.first + k * line.step] = Field(0);
    }
}

/// Adds to the first line, and empties the other.
template <class Field>
void move(Field* field, const Line& to, const Line& from) {
    add(field, to, from);
    clear(field, from);
}

/// Moves ghosts onto the line before them or, across a seam, onto the tank's other side.
template <class Field>
[[gnu::noinline]] void move_ghosts(Field* field, const GridShape& s,
                                   Line (*line)(const GridShape&, std::int32_t),
                                   std::int32_t last, bool seam) {
    move(field, line(s, seam ? last : 0), line(s, -1));
    move(field, line(s, seam ? 0 : last), line(s, last + 1));
}

/// Faces on a wall or on the seam: their other half lies beyond.
template <class Field>
void fold_across(Field* field, const Line& low, const Line& high, bool wrap) {
    if (wrap) {
        add(field, low, high);
        copy(field, high, low);
    } else {
        add(field, low, low);
        add(field, high, high);
    }
}

}  // namespace weir
