#include "solid/layers.hpp"

#include <cstring>

#include "contour/raster.hpp"
#include "solid/body_load.hpp"
#include "solid/cut_cells.hpp"
#include "solid/touching.hpp"

namespace weir {

namespace {

std::int32_t nodes_in(const NodeBox& box) {
    return box.empty() ? 0 : (box.i1 - box.i0 + 1) * (box.j1 - box.j0 + 1);
}

template <class Real>
GridShape stored_part(const Layers<Real>& layers) {
    return stored_part(layers.walls, layers.shape);
}

/// Ghost cells of what is stored that are cells of the tank, and of which all nodes are stored.
template <class Real>
Rim rim_of(const Layers<Real>& layers) {
    const GridShape part = stored_part(layers);
    return {part.i0 > 0 ? 1 : 0, part.j0 > 0 ? 1 : 0};
}

template <class Real>
NodeBox everywhere(const Layers<Real>& layers) {
    const GridShape part = stored_part(layers);
    const Rim rim = rim_of(layers);
    return {part.i0 - rim.left, part.j0 - rim.below, part.i0 + part.nx, part.j0 + part.ny};
}

/// As much of a box as is stored.
template <class Real>
NodeBox stored_of(const Layers<Real>& layers, const NodeBox& box) {
    return kHasWindow<Real> ? common(box, everywhere(layers)) : box;
}

template <class Real>
NodeBox reach(const GridShape& shape, const BodyTable<Real>& table, const Body<Real>& body) {
    return nodes_near(table.ring(body), body.vertex_count, kBand<Real>, shape.nx, shape.ny);
}

template <class Real>
NodeField<Real> field_of(const Layers<Real>& layers, DistanceOf<Real>* distance,
                         SlotOf<Real>* nearest) {
    const NodeBox all = everywhere(layers);
    return {distance, nearest, layers.shape.index(0, 0), layers.shape.stride, all.i0, all.i1};
}

/// As much of a body as is drawn in a box.
template <class Real>
std::int32_t draw(const Layers<Real>& layers, const BodyTable<Real>& table, std::int32_t slot,
                  const NodeBox& nodes, DistanceOf<Real>* distance, SlotOf<Real>* nearest) {
    const Body<Real>& body = table.body[slot];
    const NodeBox box = common(body.drawn, stored_of(layers, nodes));
    if (body.hollow || box.empty()) {
        return 0;
    }
    const Vec2<Real> size{static_cast<Real>(layers.shape.nx), static_cast<Real>(layers.shape.ny)};
    const RasterPolygon<Real> polygon{table.outline(body), static_cast<std::uint16_t>(slot),
                                      {{}, size}};
    return rasterize(polygon, box, layers.walls.binary, kBand<Real>,
                     layers.nodes, field_of(layers, distance, nearest));
}

/// Copies the static layer into the merged one.
template <class Real>
void restore(Layers<Real>& layers, const NodeBox& changed) {
    const NodeBox box = stored_of(layers, changed);
    if (box.empty()) {
        return;
    }
    const auto nodes = static_cast<std::size_t>(box.i1 - box.i0 + 1);
    for (std::int32_t j = box.j0; j <= box.j1; ++j) {
        const std::int32_t node = layers.shape.index(box.i0, j);
        std::memcpy(layers.walls.distance + node, layers.static_distance + node,
                    nodes * sizeof(DistanceOf<Real>));
        if (has_names<Real>(layers.static_nearest)) {
            std::memcpy(layers.walls.nearest + node, layers.static_nearest + node,
                        nodes * sizeof(SlotOf<Real>));
        }
    }
}

/// Whether a body's rectangle reaches into one that a body with `moved` set has left or entered.
/// `all` holds all of these: most bodies are answered by it alone.
template <class Real>
bool disturbed(const BodyTable<Real>& table, const NodeBox& drawn, const NodeBox& all) {
    if (!overlap(drawn, all)) {
        return false;
    }
    for (std::int32_t slot = table.movable.first; slot < table.movable.end; ++slot) {
        const Body<Real>& body = table.body[slot];
        if (body.moved && (overlap(drawn, body.left) || overlap(drawn, body.drawn))) {
            return true;
        }
    }
    return false;
}

template <class Real>
void forget_moves(BodyTable<Real>& table) {
    for (std::int32_t slot = table.movable.first; slot < table.movable.end; ++slot) {
        table.body[slot].moved = false;
    }
}

/// Open fractions around a box of nodes whose distances changed.
template <class Real>
void recut(Layers<Real>& layers, const NodeBox& changed) {
    Walls<Real>& walls = layers.walls;
    const NodeBox box = stored_of(layers, changed);
    if (box.empty()) {
        return;
    }
    GridShape part = stored_part(layers);
    const Rim rim = rim_of(layers);
    part = {part.nx + rim.left, part.ny + rim.below, part.stride, part.i0 - rim.left,
            part.j0 - rim.below};
    update_cut_cells(part, {box.i0 - part.i0, box.j0 - part.j0, box.i1 - part.i0, box.j1 - part.j0},
                     rim, layers.thin.capacity > 0, layers.scratch, walls);
    if (layers.any_thin() || walls.thin != nullptr) {  // or was, until now
        close_thin_faces(layers.shape, box, layers.thin, walls.open_u, walls.open_v,
                         walls.full_density);
    }
}

/// Draws all moving bodies that reach into a box onto the static layer there.
template <class Real>
std::int32_t refresh(Layers<Real>& layers, const BodyTable<Real>& table, const NodeBox& box) {
    if (box.empty()) {
        return 0;
    }
    restore(layers, box);
    std::int32_t nodes = 0;
    for (std::int32_t slot = table.movable.first; slot < table.movable.end; ++slot) {
        if (table.body[slot].kind == BodyKind::moving) {
            nodes += draw(layers, table, slot, box, layers.walls.distance, layers.walls.nearest);
        }
    }
    recut(layers, box);
    return nodes;
}

/// All that is stored, ghosts included.
template <class Real>
Part stored_entries(const Layers<Real>& layers) {
    const GridShape part = stored_part(layers);
    const std::int32_t first = part.index(-1, -1);
    return {first, first + part.size()};
}

template <class Real>
void empty(const Part& entries, DistanceOf<Real>* distance, SlotOf<Real>* nearest) {
    for (std::int32_t c = entries.first; c < entries.end; ++c) {
        distance[c] = kBand<Real>;
        if (has_names<Real>(nearest)) {
            nearest[c] = kNoBody;
        }
    }
}

/// Cut cells of all bodies that moved: rectangle by rectangle or, where these are so many that they
/// overlap, everywhere at once.
template <class Real>
void update_where_moved(Layers<Real>& layers, const BodyTable<Real>& table) {
    std::int32_t cells = 0;
    const auto each = [&](auto visit) {
        for (std::int32_t slot = table.movable.first; slot < table.movable.end; ++slot) {
            const Body<Real>& body = table.body[slot];
            const NodeBox changed = stored_of(layers, unite(body.left, body.drawn));
            if (body.moved && !changed.empty()) {
                visit(changed);
            }
        }
    };
    const GridShape part = stored_part(layers);
    const std::int32_t all_cells = part.nx * part.ny;
    each([&](const NodeBox& box) {
        const std::int32_t more = (box.i1 - box.i0 + 4) * (box.j1 - box.j0 + 4);
        cells = minimum(cells + more, all_cells);
    });
    if (cells == all_cells) {
        recut(layers, everywhere(layers));
        return;
    }
    each([&](const NodeBox& box) { recut(layers, box); });
}

/// Of the static layer in a box, once its bodies are drawn. A list of bodies takes stack, which is
/// deepest where they are drawn.
template <class Real>
[[gnu::noinline]] void deepen(const Layers<Real>& layers, const BodyTable<Real>& table,
                              const NodeBox& box) {
    if (layers.touching != nullptr && !layers.walls.binary) {
        layers.touching->deepen(layers.shape, DrawnBodies<Real>(table), box,
                                field_of(layers, layers.static_distance, layers.static_nearest));
    }
}

/// Draws all static bodies that reach into a box anew, and the moving ones onto them. What was
/// deepened is not drawn onto: the picture would depend on who came when.
template <class Real>
std::int32_t redraw_static(Layers<Real>& layers, const BodyTable<Real>& table,
                           const NodeBox& changed) {
    const NodeBox box = stored_of(layers, changed);
    if (box.empty()) {
        return 0;
    }
    for (std::int32_t j = box.j0; j <= box.j1; ++j) {
        empty<Real>({layers.shape.index(box.i0, j), layers.shape.index(box.i1, j) + 1},
                    layers.static_distance, layers.static_nearest);
    }
    std::int32_t nodes = 0;
    for (std::int32_t slot = 0; slot < table.capacity; ++slot) {
        const Body<Real>& body = table.body[slot];
        if (body.kind == BodyKind::fixed && overlap(body.drawn, box)) {
            nodes += draw(layers, table, slot, box, layers.static_distance,
                          layers.static_nearest);
        }
    }
    deepen(layers, table, box);
    return nodes + refresh(layers, table, box);
}

/// Empties both layers: no solid anywhere.
template <class Real>
void clear_layers(Layers<Real>& layers) {
    Walls<Real>& walls = layers.walls;
    const Part entries = stored_entries(layers);
    empty<Real>(entries, layers.static_distance, layers.static_nearest);
    empty<Real>(entries, walls.distance, walls.nearest);
    for (std::int32_t c = entries.first; c < entries.end; ++c) {
        walls.cell_case[c] = 0;
        walls.open_u[c] = Real(1);
        walls.open_v[c] = Real(1);
        walls.full_density[c] = Real(1);
    }
    const GridShape part = stored_part(layers);
    std::memset(walls.near + first_near_word(part), 0,
                static_cast<std::size_t>(near_words(part) * part.ny) * sizeof walls.near[0]);
}

}  // namespace

template <class Real>
bool keep_thin_edges(Layers<Real>& layers, BodyTable<Real>& table, std::int32_t slot) {
    Body<Real>& body = table.body[slot];
    body.hollow = body.open;
    const bool free = table.load != nullptr && table.load[slot].is_free_or_led();
    if (!kHasThinWalls<Real> || layers.thin.capacity == 0 || free) {
        return !body.open;
    }
    if (!add_thin_edges(layers.thin, layers.shape, table, slot)) {
        return false;
    }
    body.hollow = is_thin_all_over(layers.thin, table, slot);
    return true;
}

template <class Real>
std::int32_t draw_static(Layers<Real>& layers, BodyTable<Real>& table, std::int32_t slot) {
    Body<Real>& body = table.body[slot];
    body.drawn = reach(layers.shape, table, body);
    return redraw_static(layers, table, body.drawn);
}

template <class Real>
void forget_drawn(Layers<Real>& layers, BodyTable<Real>& table) {
    clear_layers(layers);
    clear_thin_walls(layers.thin, layers.shape, table.capacity);
    layers.show(false);
    for (std::int32_t slot = 0; slot < table.capacity; ++slot) {
        table.body[slot].drawn = NodeBox{};
    }
}

template <class Real>
void draw_missing(Layers<Real>& layers, BodyTable<Real>& table, Stale stale) {
    for (std::int32_t slot = 0; slot < table.capacity; ++slot) {
        Body<Real>& body = table.body[slot];
        if (body.kind != BodyKind::free && body.drawn.empty()) {
            keep_thin_edges(layers, table, slot);
            body.drawn = reach(layers.shape, table, body);
            stale.add(body);
        }
    }
    const bool sticking = any_without_slip(table);
    layers.walls.any_sticking = layers.walls.any_sticking || sticking;  // and was, until now
    redraw_static(layers, table, stale.fixed);
    refresh(layers, table, stale.moving);
    layers.walls.any_sticking = sticking;
    layers.show(table.used > 0);
}

template <class Real>
std::int32_t draw_stored(Layers<Real>& layers, const BodyTable<Real>& table) {
    clear_layers(layers);
    return redraw_static(layers, table, everywhere(layers));
}

template <class Real>
void look_again(Layers<Real>& layers, const BodyTable<Real>& table, std::int32_t slot) {
    const bool sticking = any_without_slip(table);
    layers.walls.any_sticking = true;  // or was, until now
    recut(layers, table.body[slot].drawn);
    layers.walls.any_sticking = sticking;
}

/// Every body that moved leaves a rectangle and enters one; both are wiped, then all bodies that
/// reach into any of them are drawn. Merging takes the smaller distance, so drawing a body again
/// where it stands already changes nothing.
template <class Real>
std::int32_t merge_moving(Layers<Real>& layers, BodyTable<Real>& table) {
    NodeBox all;
    for (std::int32_t slot = table.movable.first; slot < table.movable.end; ++slot) {
        Body<Real>& body = table.body[slot];
        if (body.moved) {
            body.left = body.drawn;
            body.drawn = reach(layers.shape, table, body);
            if (layers.any_thin()) {
                relink(layers.thin, layers.shape, table, slot);
            }
            const NodeBox both = unite(body.left, body.drawn);
            if (nodes_in(both) <= nodes_in(body.left) + nodes_in(body.drawn)) {
                body.left = both;  // in one go
            } else {
                restore(layers, body.drawn);
            }
            restore(layers, body.left);
            all = unite(all, both);
        }
    }
    if (all.empty()) {
        forget_moves(table);
        return 0;
    }
    std::int32_t nodes = 0;
    for (std::int32_t slot = table.movable.first; slot < table.movable.end; ++slot) {
        const Body<Real>& body = table.body[slot];
        const bool stale = body.moved || disturbed(table, body.drawn, all);
        if (body.kind == BodyKind::moving && stale) {
            nodes += draw(layers, table, slot, body.drawn, layers.walls.distance,
                          layers.walls.nearest);
        }
    }
    update_where_moved(layers, table);
    forget_moves(table);
    return nodes;
}

/// The vertices of the others close up: records of thin edges, which name them, are kept anew.
template <class Real>
void remove_drawn(Layers<Real>& layers, BodyTable<Real>& table, std::int32_t slot) {
    const bool fixed = table.body[slot].kind == BodyKind::fixed;
    const NodeBox drawn = table.body[slot].drawn;
    const bool thin = kHasThinWalls<Real> && layers.thin.capacity > 0;
    if (thin) {
        remove_thin_edges(layers.thin, table, slot);
    }
    remove(table, slot);
    if (thin) {
        relink_all(layers.thin, layers.shape, table);
    }
    if (fixed) {
        redraw_static(layers, table, drawn);
    } else {
        refresh(layers, table, drawn);
    }
    layers.walls.any_sticking = any_without_slip(table);
    layers.show(table.used > 0);
}

#define WEIR_INSTANTIATE(Real)                                                        \
    template bool keep_thin_edges(Layers<Real>&, BodyTable<Real>&, std::int32_t);     \
    template std::int32_t draw_static(Layers<Real>&, BodyTable<Real>&, std::int32_t); \
    template void forget_drawn(Layers<Real>&, BodyTable<Real>&);                      \
    template void draw_missing(Layers<Real>&, BodyTable<Real>&, Stale);               \
    template void look_again(Layers<Real>&, const BodyTable<Real>&, std::int32_t);    \
    template std::int32_t merge_moving(Layers<Real>&, BodyTable<Real>&);              \
    template std::int32_t draw_stored(Layers<Real>&, const BodyTable<Real>&);         \
    template void remove_drawn(Layers<Real>&, BodyTable<Real>&, std::int32_t);
WEIR_FOR_EACH_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
