// A simple polygon as a few convex pieces: ear clipping (Eberly 2002, "Triangulation by ear
// clipping"), then dropping the diagonals that no reflex corner needs (Hertel & Mehlhorn 1983,
// "Fast triangulation of simple polygons").
#pragma once

#include <cstdint>

#include "base/array_view.hpp"
#include "math/vec2.hpp"
#include "weir/memory.hpp"

namespace weir {

inline constexpr std::int32_t kLinksPerVertex = 2;

/// Set-up: writes the ring's convex pieces, each as its number of vertices, then those vertices'
/// numbers counter-clockwise. A convex ring gives one piece; vertices on a straight edge are fine.
/// Cost: of the order of count² orientation tests; count³ for a ring that touches itself.
/// @param ring simple and counter-clockwise (`check_polygon`), 3 … kMaxBodyVertices vertices.
///             Where rounding has made it touch itself, its flattest corners are cut off.
/// @param links scratch, kLinksPerVertex a vertex.
/// @param pieces at least kPieceIndicesPerVertex · (count - 2).
/// @return how much of `pieces` is used, or -1 if the ring encloses nothing on its left.
template <class Real>
std::int32_t decompose(const Vec2<Real>* ring, std::int32_t count,
                       ArrayView<std::uint16_t> links, ArrayView<std::uint16_t> pieces);

extern template std::int32_t decompose(const Vec2<float>*, std::int32_t,
                                       ArrayView<std::uint16_t>, ArrayView<std::uint16_t>);
extern template std::int32_t decompose(const Vec2<double>*, std::int32_t,
                                       ArrayView<std::uint16_t>, ArrayView<std::uint16_t>);
extern template std::int32_t decompose(const Vec2<Fixed>*, std::int32_t,
                                       ArrayView<std::uint16_t>, ArrayView<std::uint16_t>);

}  // namespace weir
