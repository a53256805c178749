// Bodies: adding, changing, removing.
#include "world/world_bodies.hpp"

#include "geometry/convex_decomposition.hpp"
#include "pressure/make_room.hpp"
#include "step/regions.hpp"
#include "step/substep.hpp"
#include "step/two_way.hpp"
#include "world/sleep.hpp"

namespace weir {

namespace {

using detail::WorldState;

std::int32_t places_needed(const BodyDef& def) {
    std::int32_t vertices = def.polygon.size;
    for (const View<Vec2f>& hole : def.holes) {
        vertices += hole.size;
    }
    return places_for(vertices, def.holes.size);
}

template <class Real>
Status check_room(const WorldState<Real>& state, const BodyDef& def, BodyKind kind,
                  const BodyId* id) {
    if (id == nullptr) {
        return Status::output_missing;
    }
    if (kind == BodyKind::moving && !state.def.capacity.moving_bodies) {
        return Status::no_moving_bodies;
    }
    const Status valid =
        check_body(def, state.def.cell_m, reach_of<Real>(state.unit_exponent));
    if (valid != Status::ok) {
        return valid;
    }
    const BodyTable<Real>& table = state.simulation.bodies;
    if (find_free_slot(table) < 0) {
        return Status::no_free_body;
    }
    if (!kHasThinWalls<Real> && def.open) {
        return Status::small_fixed_has_no_thin_walls;
    }
    return places_needed(def) > table.vertex_capacity - table.vertices_used
               ? Status::no_free_vertex
               : Status::ok;
}

/// Distance of the furthest vertex from the body's origin: spin × this is its fastest point.
template <class Real>
Real radius_of(const BodyTable<Real>& table, const Body<Real>& body) {
    Real furthest = Real(0);
    for (std::int32_t k = 0; k < body.vertex_count; ++k) {
        const Vec2<Real> vertex = table.local[body.first_vertex + k];
        furthest = maximum(furthest, length(vertex));
    }
    return furthest;
}

/// Takes in a body for which there is room.
/// Not in one frame with the check, which goes deeper than anything else that is done with a body.
template <class Real>
[[gnu::noinline]] Status enter(WorldState<Real>& state, const BodyDef& def, BodyKind kind,
                               SetFree<Real> set_free, BodyId* id) {
    BodyTable<Real>& table = state.simulation.bodies;
    Layers<Real>& layers = state.simulation.layers;
    const detail::TwoWay<Real>* two_way = state.simulation.two_way;
    const std::int32_t slot = find_free_slot(table);
    Body<Real> body;
    body.generation = table.body[slot].generation;
    body.kind = kind;
    body.surface = surface_law<Real>(def.surface, pace_of(state));
    set_pose(state, def.motion, body);
    if (kHasThinWalls<Real> && def.open) {
        add_polyline(table, def, state.cells_per_m, body);
    } else {
        const Decompose<Real> cut = two_way != nullptr ? two_way->decompose : nullptr;
        if (!add_polygon(table, def, state.cells_per_m, cut, body)) {
            return Status::polygon_crosses_itself;
        }
    }
    place(table, body);
    link_make_room(state.simulation.pressure);
    const bool comes_in = kind != BodyKind::fixed && set_free == nullptr;  // as it is told to
    if (!comes_in && box_of(state.simulation, body).empty()) {
        table.vertices_used -= body.room;
        return Status::polygon_outside_domain;
    }
    BodyLoad<Real> load;
    if (two_way != nullptr) {
        if (!two_way->weigh(def, table, body, load)) {
            table.vertices_used -= body.room;
            return Status::polygon_zero_area;
        }
        if (set_free != nullptr) {
            set_free(def.hold, load);
        }
        table.load[slot] = load;
    }
    body.radius = radius_of(table, body);
    body.met_position = body.position;
    body.met_angle = body.angle;
    table.body[slot] = body;
    if (!keep_thin_edges(layers, table, slot)) {
        table.vertices_used -= body.room;
        table.body[slot] = Body<Real>{};
        table.body[slot].generation = body.generation;
        if (table.load != nullptr) {
            table.load[slot] = BodyLoad<Real>{};
        }
        return Status::no_free_wall_edge;
    }
    ++table.used;
    note_movable(table);
    layers.show(true);
    layers.walls.any_sticking = any_without_slip(table);
    if (kind == BodyKind::fixed) {
        draw_static(layers, table, slot);
    } else {
        set_velocity(state, def.motion, table.body[slot]);
        table.body[slot].moved = true;
        state.simulation.stages->draw_moved(layers, table);
    }
    *id = {static_cast<std::uint16_t>(slot), body.generation, state.tag};
    touch_regions(state.simulation.regions, table.body[slot].drawn);
    wake(state);
    return Status::ok;
}

}  // namespace

template <class Real>
Status add_body(WorldState<Real>& state, const BodyDef& def, BodyKind kind, BodyId* id,
                SetFree<Real> set_free) {
    const Status room = check_room(state, def, kind, id);
    return room == Status::ok ? enter(state, def, kind, set_free, id) : room;
}

template <class Real>
Status check_id(const WorldState<Real>& state, BodyId id) {
    return id.world == state.tag && exists(state.simulation.bodies, id) ? Status::ok
                                                                        : Status::stale_body;
}

template <class Real>
Status World<Real>::add_static_body(const BodyDef& def, BodyId* id) {
    const Status free = ready(state_);
    return free != Status::ok ? free : add_body(*state_, def, BodyKind::fixed, id);
}

template <class Real>
Status World<Real>::add_moving_body(const BodyDef& def, BodyId* id) {
    const Status free = ready(state_);
    return free != Status::ok ? free : add_body(*state_, def, BodyKind::moving, id);
}

template <class Real>
Status World<Real>::set_surface(BodyId id, const Surface& surface) {
    Status valid = check_known(state_, id);
    if (valid == Status::ok) {
        valid = check_surface(surface, state_->def.cell_m, reach_of<Real>(state_->unit_exponent));
    }
    if (valid != Status::ok) {
        return valid;
    }
    BodyTable<Real>& table = state_->simulation.bodies;
    Layers<Real>& layers = state_->simulation.layers;
    Body<Real>& body = table.body[id.slot];
    const bool stuck = body.surface.no_slip;
    body.surface = surface_law<Real>(surface, pace_of(*state_));
    if (surface.no_slip != stuck) {  // that is felt further away
        look_again(layers, table, id.slot);
    }
    touch_regions(state_->simulation.regions, body.drawn);
    wake(*state_);
    return Status::ok;
}

template <class Real>
Status World<Real>::remove_body(BodyId id) {
    const Status known = check_known(state_, id);
    if (known != Status::ok) {
        return known;
    }
    BodyTable<Real>& table = state_->simulation.bodies;
    touch_regions(state_->simulation.regions, table.body[id.slot].drawn);
    remove_drawn(state_->simulation.layers, table, id.slot);
    if (table.load != nullptr) {
        table.load[id.slot] = BodyLoad<Real>{};
    }
    if (!any_free(table)) {
        state_->simulation.free_bodies = nullptr;
    }
    wake(*state_);
    return Status::ok;
}

#define WEIR_INSTANTIATE(Real)                                                      \
    template Status add_body(WorldState<Real>&, const BodyDef&, BodyKind, BodyId*,  \
                             SetFree<Real>);                                        \
    template Status check_id(const WorldState<Real>&, BodyId);                      \
    template Status World<Real>::add_static_body(const BodyDef&, BodyId*);          \
    template Status World<Real>::add_moving_body(const BodyDef&, BodyId*);          \
    template Status World<Real>::set_surface(BodyId, const Surface&);               \
    template Status World<Real>::remove_body(BodyId);
WEIR_FOR_EACH_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
