// Gradient of a field of distances within a cell, to second order.
#pragma once

#include "math/vec2.hpp"

namespace weir {

/// Whether a cell has neighbours on its sides.
struct Neighbours {
    bool left = true;
    bool right = true;
    bool below = true;
    bool above = true;
};

/// One component: differences stand in the middle of the edges between nodes, and are interpolated
/// between them. `along` is the step between nodes of a difference, `across` the other one.
template <class Real, class Field>
Real gradient_component(const Field* node, std::int32_t along, std::int32_t across, Real at,
                        Real at_across, bool has_before, bool has_after, Real far) {
    Real row[2];
    for (std::int32_t k = 0; k < 2; ++k) {
        const Field* p = node + k * across;
        const Real here = p[along] - p[0];
        row[k] = here;
        // A node that knows no wall says nothing of the slope.
        if (at < Real(0.5) && has_before && p[-along] < far) {
            row[k] = here + (Real(0.5) - at) * ((p[0] - p[-along]) - here);
        } else if (at > Real(0.5) && has_after && p[2 * along] < far) {
            row[k] = here + (at - Real(0.5)) * ((p[2 * along] - p[along]) - here);
        }
    }
    return row[0] + at_across * (row[1] - row[0]);
}

/// @param node lower left node of the cell.
/// @param at place in the cell, 0 … 1.
/// @param far value of nodes that know no wall.
template <class Real, class Field>
Vec2<Real> distance_gradient(const Field* node, std::int32_t stride, Vec2<Real> at,
                             const Neighbours& has, Real far) {
    return {gradient_component(node, 1, stride, at.x, at.y, has.left, has.right, far),
            gradient_component(node, stride, 1, at.y, at.x, has.below, has.above, far)};
}

/// Normal of a wall at a point of its contour line: the gradient's direction, or the line's own
/// where the two disagree by more than 20 degrees, as at corners and in thin solids. A line's own
/// normal is off by half the angle that a round wall turns within a cell.
template <class Real, class Field>
Vec2<Real> wall_normal(const Field* node, std::int32_t stride, Vec2<Real> at,
                       const Neighbours& has, Real far, Vec2<Real> line_normal) {
    const Vec2<Real> gradient = distance_gradient(node, stride, at, has, far);
    const Real steepness = length(gradient);
    const Real agreement = dot(gradient, line_normal);
    return steepness > Real(0.5) && agreement > Real(0.94) * steepness
               ? (Real(1) / steepness) * gradient
               : line_normal;
}

}  // namespace weir
