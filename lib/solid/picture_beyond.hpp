// The picture of the solids where none is stored: a few nodes around one cell, drawn when somebody
// asks for them. Nodes do not depend on what else is drawn, so the bits are those of the whole.
#pragma once

#include "solid/drawn_bodies.hpp"
#include "solid/walls.hpp"

namespace weir {

/// Of a cell of a tank of which a part is stored: its nodes, and those next to them. It remembers
/// what it drew last, and for whom: bodies are not to move meanwhile.
/// Cost: a comparison a body, or one that is listed, and of those that are near all edges.
template <class Real>
class PictureBeyond {
public:
    /// Nothing is drawn yet.
    PictureBeyond(const GridShape& tank, const Walls<Real>& walls,
                  const BodyTable<Real>& bodies);
    PictureBeyond(const PictureBeyond&) = delete;
    PictureBeyond& operator=(const PictureBeyond&) = delete;

    /// Whether a body is drawn at any of those nodes: where none is all is open, and there is no
    /// need for a picture. Bodies are listed for whoever asks near there next.
    bool any_at(const NodeBox& nodes);
    /// Draws the cell (i, j) and what is around it.
    void show(std::int32_t i, std::int32_t j);

    /// Case of that cell.
    std::uint8_t which() const { return case_; }
    /// The tank and its walls, as far as they are drawn.
    const GridShape& shape() const { return shape_; }
    const Walls<Real>& walls() const { return walls_; }

private:
    static constexpr std::int32_t kEdge = 4;

    void draw(const DrawnBodies<Real>& bodies, const NodeBox& nodes);

    GridShape shape_;
    Walls<Real> walls_;
    const BodyTable<Real>& bodies_;
    BodyRoom<Real> room_;
    DrawnBodies<Real> near_;
    NodeBox nodes_;
    std::uint8_t case_ = 0;
    DistanceOf<Real> distance_[kEdge * kEdge];
    SlotOf<Real> nearest_[kEdge * kEdge];
};

}  // namespace weir
