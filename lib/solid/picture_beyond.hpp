// The picture of the solids where none is stored: a few nodes around one cell, drawn when somebody
// asks for them. Nodes do not depend on what else is drawn, so the bits are those of the whole.
#pragma once

#include "solid/walls.hpp"

namespace weir {

/// The nodes that any body may be drawn at.
template <class Real>
NodeBox all_drawn(const BodyTable<Real>& bodies);
/// Whether a body is drawn at any of those nodes. Where none is, all is open, and there is no need
/// for a picture.
template <class Real>
bool any_drawn(const BodyTable<Real>& bodies, const NodeBox& nodes);

/// Of the cell (i, j) of a tank of which a part is stored: its nodes and, if `around` is 1, those
/// next to them.
/// Cost: a comparison a body, and of those that are near all edges.
template <class Real>
class PictureBeyond {
public:
    PictureBeyond(const GridShape& tank, const Walls<Real>& walls, std::int32_t i, std::int32_t j,
                  std::int32_t around);
    PictureBeyond(const PictureBeyond&) = delete;
    PictureBeyond& operator=(const PictureBeyond&) = delete;

    /// Case of that cell.
    std::uint8_t which() const { return case_; }
    /// The tank and its walls, as far as they were drawn.
    const GridShape& shape() const { return shape_; }
    const Walls<Real>& walls() const { return walls_; }

private:
    static constexpr std::int32_t kEdge = 4;

    void draw(const BodyTable<Real>& bodies, const NodeBox& nodes);

    GridShape shape_;
    Walls<Real> walls_;
    std::uint8_t case_ = 0;
    DistanceOf<Real> distance_[kEdge * kEdge];
    SlotOf<Real> nearest_[kEdge * kEdge];
};

}  // namespace weir
