// Where a point stands to the contour of its cell: the inside test of particles.
#pragma once

#include "contour/gradient.hpp"
#include "contour/marching_squares.hpp"
#include "solid/line_side_packed.hpp"
#include "solid/picture_beyond.hpp"

namespace weir {

inline constexpr std::uint8_t kCellOutside = 0;
inline constexpr std::uint8_t kCellInside = 15;

template <class Real>
struct CellView {
    std::int32_t node = 0;  ///< lower left
    Vec2<Real> local;       ///< 0 … 1 within the cell
    Real corner[4] = {};
};

template <class Real>
CellView<Real> cell_of(const GridShape& s, const Walls<Real>& walls, Vec2<Real> x) {
    const auto i = static_cast<std::int32_t>(x.x);
    const auto j = static_cast<std::int32_t>(x.y);
    CellView<Real> cell;
    cell.node = s.index(i, j);
    cell.local = {x.x - static_cast<Real>(i), x.y - static_cast<Real>(j)};
    const DistanceOf<Real>* low = walls.distance + cell.node;
    const DistanceOf<Real>* high = low + s.stride;
    cell.corner[0] = low[0];
    cell.corner[1] = low[1];
    cell.corner[2] = high[1];
    cell.corner[3] = high[0];
    return cell;
}

/// On a ridge, where two ways out are equally long, either will do, but one has to be taken.
template <class Real>
Vec2<Real> away_from_centre(Vec2<Real> local) {
    const Vec2<Real> offset{local.x - Real(0.5), local.y - Real(0.5)};
    const Real size = length(offset);
    return size > Real(0) ? (Real(1) / size) * offset : Vec2<Real>{Real(0), Real(1)};
}

/// Distance and its direction of growth from the bilinear interpolant, for cells without a line.
template <class Real>
ContourHit<Real> interpolated_distance(const CellView<Real>& cell) {
    const Real* d = cell.corner;
    const Vec2<Real> f = cell.local;
    const Real low = d[0] + f.x * (d[1] - d[0]);
    const Real high = d[3] + f.x * (d[2] - d[3]);
    const Vec2<Real> gradient{(d[1] - d[0]) + f.y * ((d[2] - d[3]) - (d[1] - d[0])), high - low};
    const Real steepness = length(gradient);
    ContourHit<Real> hit;
    hit.distance = low + f.y * (high - low);
    hit.normal = steepness > Real(0) ? (Real(1) / steepness) * gradient : away_from_centre(f);
    return hit;
}

template <class Real>
ContourHit<Real> hit_in(const CellView<Real>& cell, std::uint8_t which) {
    return which == kCellInside ? interpolated_distance(cell)
                                : contour_hit(cell.corner, cell.local);
}

/// Whether a look at the contours need not ask where they are stored: in nearly all worlds.
template <class Real>
bool all_stored([[maybe_unused]] const Walls<Real>& walls) {
    if constexpr (kHasWindow<Real>) {
        return walls.stored.bodies == nullptr;
    } else {
        return true;
    }
}

/// ask(picture) of a cell that is not stored.
template <class Real, class Ask>
auto ask_beyond(const GridShape& s, const Walls<Real>& walls, std::int32_t i, std::int32_t j,
                const Ask& ask) {
    const auto show = [&](PictureBeyond<Real>& picture) {
        picture.show(i, j);
        return ask(picture);
    };
    if (walls.stored.picture != nullptr) {
        return show(*walls.stored.picture);
    }
    PictureBeyond<Real> picture(s, walls, *walls.stored.bodies);
    return show(picture);
}

/// In a world of which a part is stored. Not inline: others are not to pay for it.
template <class Real>
[[gnu::noinline, gnu::cold]] std::uint8_t case_in_window(const GridShape& s,
                                                         const Walls<Real>& walls,
                                                         std::int32_t i, std::int32_t j) {
    if constexpr (kHasWindow<Real>) {
        if (!is_stored(walls, s, i, j)) {
            return ask_beyond(s, walls, i, j,
                              [](const PictureBeyond<Real>& drawn) { return drawn.which(); });
        }
    }
    return walls.cell_case[s.index(i, j)];
}

template <class Real>
std::uint8_t case_of(const GridShape& s, const Walls<Real>& walls, std::int32_t i,
                     std::int32_t j) {
    return all_stored(walls) ? walls.cell_case[s.index(i, j)] : case_in_window(s, walls, i, j);
}

template <class Real>
std::uint8_t case_at(const GridShape& s, const Walls<Real>& walls, Vec2<Real> x) {
    return case_of(s, walls, static_cast<std::int32_t>(x.x), static_cast<std::int32_t>(x.y));
}

/// The last of `count` particles whose cell has solid in it, or −1.
template <class Real>
std::int32_t last_near_wall(const GridShape& shape, const std::uint8_t* cell_case,
                            const Vec2<Real>* position, std::int32_t count) {
    const std::uint8_t* origin = cell_case + shape.index(0, 0);
    while (--count >= 0) {
        const Vec2<Real> x = position[count];
        if (origin[static_cast<std::int32_t>(x.y) * shape.stride +
                   static_cast<std::int32_t>(x.x)] != kCellOutside) {
            break;
        }
    }
    return count;
}

/// The body at the node of the cell that is deepest inside.
template <class Real>
std::uint16_t touched_body(const GridShape& s, const Walls<Real>& walls, std::int32_t node) {
    const std::int32_t corner[4] = {node, node + 1, node + s.stride + 1, node + s.stride};
    std::int32_t deepest = corner[0];
    for (const std::int32_t candidate : corner) {
        deepest = walls.distance[candidate] < walls.distance[deepest] ? candidate : deepest;
    }
    return nearest_at(walls, deepest);
}

/// By so much more than rounding, cells.
template <class Real>
inline constexpr Real kClear = Real(1.0 / 128.0);

/// Whether a point is in front of the contour of its cell by more than rounding, where the contour
/// is one line: nearly all that are asked for are. Across a corner the line is where the distance,
/// linear from the corner's node on, is 0. False: the contour must be found.
template <class Real>
bool clearly_outside(std::uint8_t which, const Real (&d)[4], Vec2<Real> f) {
    const auto corner = [&](std::int32_t node, std::int32_t beside, std::int32_t over, Real x,
                            Real y) {
        const Vec2<Real> slope{d[beside] - d[node], d[over] - d[node]};
        return d[node] + (slope.x * x + slope.y * y) >
               kClear<Real> * (absolute(slope.x) + absolute(slope.y));
    };
    // Height over the line between the crossings of two opposite edges.
    const auto height = [&](std::int32_t low, std::int32_t high, std::int32_t low_end,
                            std::int32_t high_end, Real along, Real up) {
        const Real first = d[low] / (d[low] - d[high]);
        const Real last = d[low_end] / (d[low_end] - d[high_end]);
        return up - (first + (last - first) * along);
    };
    switch (which) {
        case 1:
        case 14: return corner(0, 1, 3, f.x, f.y);
        case 2:
        case 13: return corner(1, 0, 2, Real(1) - f.x, f.y);
        case 4:
        case 11: return corner(2, 3, 1, Real(1) - f.x, Real(1) - f.y);
        case 8:
        case 7: return corner(3, 2, 0, f.x, Real(1) - f.y);
        case 3: return height(0, 3, 1, 2, f.x, f.y) > kClear<Real>;
        case 12: return height(0, 3, 1, 2, f.x, f.y) < -kClear<Real>;
        case 9: return height(0, 1, 3, 2, f.y, f.x) > kClear<Real>;
        case 6: return height(0, 1, 3, 2, f.y, f.x) < -kClear<Real>;
        default: return false;
    }
}

inline bool clearly_outside(std::uint8_t which, const SmallFixed (&d)[4], Vec2<SmallFixed> f) {
    return packed::side_of_line(which, d, f) > 0;
}

/// Where a particle stands: in the open, or behind the contour of its cell.
template <class Real>
struct Standing {
    ContourHit<Real> hit{};
    std::uint16_t slot = kNoBody;  ///< the body that it is in
    std::uint8_t which = kCellOutside;
    bool inside = false;
};

/// Normal where a particle is behind the line of its cell.
template <class Real>
Vec2<Real> normal_behind(const GridShape& s, const Walls<Real>& walls, const CellView<Real>& cell,
                         Vec2<Real> x, Vec2<Real> line_normal) {
    const auto i = static_cast<std::int32_t>(x.x);
    const auto j = static_cast<std::int32_t>(x.y);
    const Neighbours has{i > 0, i + 1 < s.nx, j > 0, j + 1 < s.ny};
    return wall_normal(walls.distance + cell.node, s.stride, cell.local, has, kBand<Real>,
                       line_normal);
}

/// Whether a point is behind the contour, without the way out.
template <class Real>
bool is_inside_in(const GridShape& shape, const Walls<Real>& walls, Vec2<Real> x) {
    const std::uint8_t which = walls.cell_case[shape.index(static_cast<std::int32_t>(x.x),
                                                           static_cast<std::int32_t>(x.y))];
    if (which == kCellOutside || (which == kCellInside && !walls.binary)) {
        return which == kCellInside;
    }
    const CellView<Real> cell = cell_of(shape, walls, x);
    if constexpr (Stored<Real>::coarse) {
        const std::int32_t side = packed::side_of_line(which, cell.corner, cell.local);
        if (side != 0) {
            return side < 0;
        }
    } else if (clearly_outside(which, cell.corner, cell.local)) {
        return false;
    }
    return hit_in(cell, which).distance < Real(0);
}

/// Of a point that is not clearly outside, in a cell of a case that is known. One that is solid all
/// over holds no open point, also where all its nodes lie on the outline.
template <class Real>
WEIR_ALWAYS_INLINE void stand_near(const GridShape& shape, const Walls<Real>& walls,
                                   const CellView<Real>& cell, Vec2<Real> x,
                                   Standing<Real>& at) {
    at.hit = hit_in(cell, at.which);
    at.inside = at.hit.distance < Real(0) || (at.which == kCellInside && !walls.binary);
    if (at.inside && at.which != kCellInside && !walls.binary) {
        at.hit.normal = normal_behind(shape, walls, cell, x, at.hit.normal);
    }
    at.slot = at.inside ? touched_body(shape, walls, cell.node) : kNoBody;
}

template <class Real>
Standing<Real> standing_near(const GridShape& shape, const Walls<Real>& walls, Vec2<Real> x) {
    const CellView<Real> cell = cell_of(shape, walls, x);
    Standing<Real> at;
    at.which = walls.cell_case[cell.node];
    stand_near(shape, walls, cell, x, at);
    return at;
}

/// Where all that is asked for is stored.
template <class Real>
Standing<Real> standing_in(const GridShape& shape, const Walls<Real>& walls, Vec2<Real> x) {
    Standing<Real> at;
    at.which = walls.cell_case[shape.index(static_cast<std::int32_t>(x.x),
                                           static_cast<std::int32_t>(x.y))];
    if (at.which == kCellOutside) {
        return at;
    }
    const CellView<Real> cell = cell_of(shape, walls, x);
    if (!clearly_outside(at.which, cell.corner, cell.local)) {
        stand_near(shape, walls, cell, x, at);
    }
    return at;
}

/// ask(shape, walls) where all that is asked for is stored, or drawn for it.
template <class Real, class Ask>
[[gnu::noinline, gnu::cold]] auto in_window(const GridShape& shape, const Walls<Real>& walls,
                                            Vec2<Real> x, const Ask& ask) {
    if constexpr (kHasWindow<Real>) {
        const auto i = static_cast<std::int32_t>(x.x);
        const auto j = static_cast<std::int32_t>(x.y);
        if (!is_stored(walls, shape, i, j)) {
            return ask_beyond(shape, walls, i, j, [&](const PictureBeyond<Real>& drawn) {
                return ask(drawn.shape(), drawn.walls());
            });
        }
    }
    return ask(shape, walls);
}

template <class Real>
Standing<Real> standing(const GridShape& shape, const Walls<Real>& walls, Vec2<Real> x) {
    const auto ask = [x](const GridShape& s, const Walls<Real>& w) { return standing_in(s, w, x); };
    return all_stored(walls) ? ask(shape, walls) : in_window(shape, walls, x, ask);
}

template <class Real>
bool is_inside(const GridShape& shape, const Walls<Real>& walls, Vec2<Real> x) {
    const auto ask = [x](const GridShape& s, const Walls<Real>& w) {
        return is_inside_in(s, w, x);
    };
    return all_stored(walls) ? ask(shape, walls) : in_window(shape, walls, x, ask);
}

}  // namespace weir
