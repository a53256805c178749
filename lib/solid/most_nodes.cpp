// How many nodes a substep can draw at most.
#include "solid/layers.hpp"

namespace weir {

namespace {

/// The most nodes of a body that moves, wherever it is, and the window in the substep to come.
template <class Real>
std::int64_t nodes_of_moving(const Layers<Real>& layers, const Body<Real>& body) {
    const GridShape& tank = layers.shape;
    // Floor and 1: that many nodes come upon an interval. A hundredth for rounding.
    const Real reach = body.radius + kBand<Real> + Real(0.01);
    const std::int64_t width = floor_to_int(reach + reach) + 1;
    return minimum<std::int64_t>(width, tank.nx + 1) * minimum<std::int64_t>(width, tank.ny + 1);
}

}  // namespace

template <class Real>
std::int32_t most_nodes(const Layers<Real>& layers, const BodyTable<Real>& table) {
    std::int64_t nodes = 0;
    for (std::int32_t slot = table.movable.first; slot < table.movable.end; ++slot) {
        const Body<Real>& body = table.body[slot];
        if (body.kind == BodyKind::moving) {
            const std::int64_t box = nodes_of_moving(layers, body);
            nodes += table.load != nullptr ? 2 * box : box;
        }
    }
    return static_cast<std::int32_t>(minimum<std::int64_t>(nodes, 0x7FFFFFFF));
}

template <class Real>
std::int32_t most_stored_nodes(const Layers<Real>& layers, const BodyTable<Real>& table) {
    std::int64_t nodes = 0;
    for (std::int32_t slot = 0; slot < table.capacity; ++slot) {
        const Body<Real>& body = table.body[slot];
        if (body.kind == BodyKind::moving) {
            nodes += nodes_of_moving(layers, body);
        } else if (body.kind == BodyKind::fixed && !body.drawn.empty()) {
            const NodeBox& box = body.drawn;
            nodes += static_cast<std::int64_t>(box.i1 - box.i0 + 1) * (box.j1 - box.j0 + 1);
        }
    }
    return static_cast<std::int32_t>(minimum<std::int64_t>(nodes, 0x3FFFFFFF));
}

#define WEIR_INSTANTIATE(Real)                                                            \
    template std::int32_t most_nodes(const Layers<Real>&, const BodyTable<Real>&);        \
    template std::int32_t most_stored_nodes(const Layers<Real>&, const BodyTable<Real>&);
WEIR_FOR_EACH_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
