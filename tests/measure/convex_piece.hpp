// Whether a point is in a convex piece of a polygon, by the paper's test.
#pragma once

#include <cstdint>

#include "geometry/polygon.hpp"

namespace weir {

/// The point lies to the left of every edge, or on it. A piece without area holds no point.
/// @param piece vertex numbers, counter-clockwise.
template <class Real>
bool inside_convex(const Vec2<Real>* vertices, const std::uint16_t* piece, std::int32_t count,
                   Vec2<Real> point) {
    bool off_an_edge = false;
    std::uint16_t from = piece[count - 1];
    for (std::int32_t k = 0; k < count; ++k) {
        const std::uint16_t to = piece[k];
        // Two pieces walk their common edge in opposite ways. Both must compute the same number,
        // or rounding opens a crack along it that belongs to neither.
        const Product<Real> side = from < to ? turn(vertices[from], vertices[to], point)
                                    : -turn(vertices[to], vertices[from], point);
        if (side < Product<Real>(0)) {
            return false;
        }
        off_an_edge = off_an_edge || side > Product<Real>(0);
        from = to;
    }
    // Left of nothing: the piece is a line, and the point is somewhere along it.
    return off_an_edge;
}

}  // namespace weir
