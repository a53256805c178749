#include "solid/picture_beyond.hpp"

#include "contour/marching_squares.hpp"
#include "solid/touching.hpp"

namespace weir {

namespace {

/// Where an array would begin whose entry of that number is `first`. By integers: that may lie
/// outside of any array.
template <class T>
T* numbered_from(T* first, std::int32_t number) {
    const auto bytes = static_cast<std::intptr_t>(number) * static_cast<std::intptr_t>(sizeof(T));
    return reinterpret_cast<T*>(reinterpret_cast<std::uintptr_t>(first) -
                                static_cast<std::uintptr_t>(bytes));
}

}  // namespace

template <class Real>
NodeBox all_drawn(const BodyTable<Real>& bodies) {
    NodeBox all;
    for (std::int32_t slot = 0; slot < bodies.capacity; ++slot) {
        const Body<Real>& body = bodies.body[slot];
        if (body.kind != BodyKind::free && !body.drawn.empty()) {
            const NodeBox& one = body.drawn;
            all = all.empty() ? one
                              : NodeBox{minimum(all.i0, one.i0), minimum(all.j0, one.j0),
                                        maximum(all.i1, one.i1), maximum(all.j1, one.j1)};
        }
    }
    return all;
}

template <class Real>
bool any_drawn(const BodyTable<Real>& bodies, const NodeBox& nodes) {
    for (std::int32_t slot = 0; slot < bodies.capacity; ++slot) {
        const Body<Real>& body = bodies.body[slot];
        if (body.kind != BodyKind::free && overlap(body.drawn, nodes)) {
            return true;
        }
    }
    return false;
}

template <class Real>
PictureBeyond<Real>::PictureBeyond(const GridShape& tank, const Walls<Real>& walls,
                                   std::int32_t i, std::int32_t j, std::int32_t around)
    : shape_(tank), walls_(walls) {
    shape_.stride = kEdge;
    const NodeBox nodes{maximum(0, i - around), maximum(0, j - around),
                        minimum(tank.nx, i + 1 + around), minimum(tank.ny, j + 1 + around)};
    const std::int32_t first = shape_.index(nodes.i0, nodes.j0);
    walls_.distance = numbered_from(distance_, first);
    walls_.nearest = numbered_from(nearest_, first);
    walls_.stored = {};
    for (std::int32_t k = 0; k < kEdge * kEdge; ++k) {
        distance_[k] = kBand<Real>;
        nearest_[k] = kNoBody;
    }
    draw(*walls.stored.bodies, nodes);
    const DistanceOf<Real>* low = walls_.distance + shape_.index(i, j);
    const Real corners[4] = {low[0], low[1], low[kEdge + 1], low[kEdge]};
    case_ = contour_case(corners);
    walls_.cell_case = numbered_from(&case_, shape_.index(i, j));
}

template <class Real>
void PictureBeyond<Real>::draw(const BodyTable<Real>& bodies, const NodeBox& nodes) {
    const Vec2<Real> size{static_cast<Real>(shape_.nx), static_cast<Real>(shape_.ny)};
    Real scratch[kEdge * kEdge];
    Real* const numbered = numbered_from(scratch, shape_.index(nodes.i0, nodes.j0));
    const NodeField<Real> field{walls_.distance, walls_.nearest, shape_.index(0, 0),
                                shape_.stride};
    const auto draw_all = [&](BodyKind kind) {
        for (std::int32_t slot = 0; slot < bodies.capacity; ++slot) {
            const Body<Real>& body = bodies.body[slot];
            const NodeBox part = common(body.drawn, nodes);
            if (body.kind == kind && !body.hollow && !part.empty()) {
                const RasterPolygon<Real> polygon{bodies.outline(body),
                                                  static_cast<std::uint16_t>(slot), {{}, size}};
                rasterize(polygon, part, walls_.binary, kBand<Real>, numbered, field);
            }
        }
    };
    draw_all(BodyKind::fixed);
    if (!walls_.binary) {
        deepen_where_bodies_touch<Real>(shape_, bodies, nodes, field);
    }
    draw_all(BodyKind::moving);
}

#define WEIR_INSTANTIATE(Real)                               \
    template NodeBox all_drawn(const BodyTable<Real>&);      \
    template bool any_drawn(const BodyTable<Real>&, const NodeBox&); \
    template class PictureBeyond<Real>;
WEIR_FOR_EACH_ROOMY_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
