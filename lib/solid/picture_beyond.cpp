#include "solid/picture_beyond.hpp"

#include "contour/marching_squares.hpp"
#include "solid/touching.hpp"

namespace weir {

template <class Real>
PictureBeyond<Real>::PictureBeyond(const GridShape& tank, const Walls<Real>& walls,
                                   const BodyTable<Real>& bodies)
    : shape_(tank), walls_(walls), bodies_(bodies), near_(DrawnBodies<Real>(bodies), room_) {
    shape_.stride = kEdge;
    walls_.stored = {};
}

template <class Real>
bool PictureBeyond<Real>::any_at(const NodeBox& nodes) {
    constexpr std::int32_t kAround = 16;
    if (!near_.is_about(nodes)) {
        const NodeBox box{nodes.i0 - kAround, nodes.j0 - kAround, nodes.i1 + kAround,
                          nodes.j1 + kAround};
        near_.narrow(DrawnBodies<Real>(bodies_), box, [](const Body<Real>&) { return true; });
    }
    return near_.any_at(nodes);
}

template <class Real>
void PictureBeyond<Real>::show(std::int32_t i, std::int32_t j) {
    const NodeBox nodes{maximum(0, i - 1), maximum(0, j - 1), minimum(shape_.nx, i + 2),
                        minimum(shape_.ny, j + 2)};
    if (nodes == nodes_) {
        return;
    }
    nodes_ = nodes;
    const std::int32_t first = shape_.index(nodes.i0, nodes.j0);
    walls_.distance = numbered_from(distance_, first);
    walls_.nearest = numbered_from(nearest_, first);
    for (std::int32_t k = 0; k < kEdge * kEdge; ++k) {
        distance_[k] = kBand<Real>;
        nearest_[k] = kNoBody;
    }
    draw(near_.is_about(nodes) ? near_ : DrawnBodies<Real>(bodies_), nodes);
    const DistanceOf<Real>* low = walls_.distance + shape_.index(i, j);
    const Real corners[4] = {low[0], low[1], low[kEdge + 1], low[kEdge]};
    case_ = contour_case(corners);
    walls_.cell_case = numbered_from(&case_, shape_.index(i, j));
}

template <class Real>
void PictureBeyond<Real>::draw(const DrawnBodies<Real>& bodies, const NodeBox& nodes) {
    const Vec2<Real> size{static_cast<Real>(shape_.nx), static_cast<Real>(shape_.ny)};
    Real scratch[kEdge * kEdge];
    Real* const numbered = numbered_from(scratch, shape_.index(nodes.i0, nodes.j0));
    const NodeField<Real> field{walls_.distance, walls_.nearest, shape_.index(0, 0),
                                shape_.stride};
    const auto draw_all = [&](BodyKind kind) {
        bodies.for_each_at(nodes, [&](std::uint16_t slot, const Body<Real>& body) {
            if (body.kind == kind && !body.hollow) {
                const RasterPolygon<Real> polygon{bodies.outline(body), slot, {{}, size}};
                rasterize(polygon, common(body.drawn, nodes), walls_.binary, kBand<Real>,
                          numbered, field);
            }
        });
    };
    draw_all(BodyKind::fixed);
    if (!walls_.binary) {
        deepen_where_bodies_touch<Real>(shape_, bodies, nodes, field);
    }
    draw_all(BodyKind::moving);
}

#define WEIR_INSTANTIATE(Real) template class PictureBeyond<Real>;
WEIR_FOR_EACH_ROOMY_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
