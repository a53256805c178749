// Stage: contour. Polygons → signed distance at nodes → contour matrix and open fractions.
//
// Two layers: static bodies are rasterized once into the static layer; the merged layer is a copy
// of it into which the moving bodies are drawn. Where nothing moved, nothing is done.
#pragma once

#include "solid/walls.hpp"
#include "weir/config.hpp"
#include "weir/features.hpp"

namespace weir {

template <class Real>
struct Layers {
    GridShape shape;
    DistanceOf<Real>* static_distance = nullptr;
    SlotOf<Real>* static_nearest = nullptr;
    Walls<Real> walls;        ///< the merged layer
    ThinWalls<Real> thin;     ///< what its nodes cannot show
    const detail::Touching<Real>* touching = nullptr;  ///< null: room for one body at most
    Real* nodes = nullptr;                ///< a node field that is free before a substep
    VelocityOf<Real>* scratch = nullptr;  ///< a cell field that is free between steps

    bool any_thin() const { return kHasThinWalls<Real> && thin.used > 0; }

    /// Whether those who look at walls see any.
    void show(bool any) {
        walls.active = any;
        walls.sticking = any ? walls.sticking : nullptr;
        walls.thin = any && any_thin() ? &thin : nullptr;
    }
};

/// Finds what of a new body is thinner than a cell. False: there is no room for it. Of a free body
/// nothing is kept: the liquid would not push such walls back.
template <class Real>
bool keep_thin_edges(Layers<Real>& layers, BodyTable<Real>& table, std::int32_t slot);

/// Draws one more static body, and others as far as they reach into its rectangle. Returns the
/// number of nodes that were computed.
template <class Real>
std::int32_t draw_static(Layers<Real>& layers, BodyTable<Real>& table, std::int32_t slot);

/// What was drawn and is no more: static bodies, and moving ones.
struct Stale {
    NodeBox fixed;
    NodeBox moving;

    template <class Real>
    void add(const Body<Real>& body) {
        NodeBox& box = body.kind == BodyKind::fixed ? fixed : moving;
        box = unite(box, body.drawn);
    }
};

/// Empties both layers, and forgets where bodies were drawn.
template <class Real>
void forget_drawn(Layers<Real>& layers, BodyTable<Real>& table);

/// Draws anew what is stale, and all bodies of which nothing is drawn: what drawing and merging
/// them one by one would have led to.
template <class Real>
void draw_missing(Layers<Real>& layers, BodyTable<Real>& table, Stale stale);

/// Looks again at what is open around a body, since its surface is another.
template <class Real>
void look_again(Layers<Real>& layers, const BodyTable<Real>& table, std::int32_t slot);

/// Merges the moving bodies that moved since the last call, each within the rectangle that it
/// left and the one that it entered. Returns the number of nodes that were computed: 0 if nothing
/// moved.
template <class Real>
std::int32_t merge_moving(Layers<Real>& layers, BodyTable<Real>& table);

/// Draws what is stored of the tank anew: another part of it than before. What stands still goes by
/// where it was drawn last. Returns the number of nodes that were computed.
template <class Real>
std::int32_t draw_stored(Layers<Real>& layers, const BodyTable<Real>& table);

/// The most nodes that `draw_stored` can compute, whichever part it is. Saturates.
template <class Real>
std::int32_t most_stored_nodes(const Layers<Real>& layers, const BodyTable<Real>& table);

/// The most nodes that merging can compute: all bodies that can move, each wherever it is, and free
/// ones twice a substep. Saturates.
template <class Real>
std::int32_t most_nodes(const Layers<Real>& layers, const BodyTable<Real>& table);

/// Removes a body from the table, and draws anew what reaches into its rectangle.
template <class Real>
void remove_drawn(Layers<Real>& layers, BodyTable<Real>& table, std::int32_t slot);

}  // namespace weir
