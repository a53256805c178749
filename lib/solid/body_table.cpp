#include "solid/body_table.hpp"

#include <cstring>

#include "geometry/convex_decomposition.hpp"
#include "geometry/polygon.hpp"
#include "geometry/ring_copy.hpp"
#include "solid/body_load.hpp"

namespace weir {

namespace {

template <class T>
void close_gap(T* pool, std::int32_t first, std::int32_t count, std::int32_t used) {
    std::memmove(pool + first, pool + first + count,
                 static_cast<std::size_t>(used - first - count) * sizeof(T));
}

/// Returns how many vertices stay; where each ring ends is noted in `ends`.
template <class Real>
std::int32_t copy_rings(BodyTable<Real>& table, const BodyDef& def, Face<Real> cells_per_m,
                        const Body<Real>& body, std::uint16_t* ends) {
    Vec2<Real>* to = table.local + body.first_vertex;
    const RingsOnGrid rings({def.polygon, def.holes});
    std::int32_t count = 0;
    for (std::int32_t ring = 0; ring < body.rings; ++ring) {
        copy_ring(rings, ring, [&](Vec2f vertex) {
            to[count++] = convert<Real>(cells_per_m * convert<Face<Real>>(vertex));
        });
        ends[ring] = static_cast<std::uint16_t>(count);
    }
    return count;
}

/// What an earlier body left there is none of this one's state, and a snapshot keeps the room.
template <class Real>
void clear_pieces(const BodyTable<Real>& table, const Body<Real>& body) {
    std::uint16_t* list = table.piece_list(body);
    std::memset(list, 0, static_cast<std::size_t>(table.ring_ends(body) - list) * sizeof *list);
}

}  // namespace

template <class Real>
std::int32_t find_free_slot(const BodyTable<Real>& table) {
    for (std::int32_t slot = 0; slot < table.capacity; ++slot) {
        if (table.body[slot].kind == BodyKind::free) {
            return slot;
        }
    }
    return -1;
}

template <class Real>
bool exists(const BodyTable<Real>& table, BodyId id) {
    return id.slot < table.capacity && table.body[id.slot].kind != BodyKind::free &&
           table.body[id.slot].generation == id.generation;
}

template <class Real>
bool add_polygon(BodyTable<Real>& table, const BodyDef& def, Face<Real> cells_per_m,
                 Decompose<Real> cut, Body<Real>& body) {
    body.first_vertex = table.vertices_used;
    body.rings = 1 + def.holes.size;
    // The ends' place is known when all vertices are.
    std::uint16_t* list = table.piece_list(body);
    body.vertex_count = copy_rings(table, def, cells_per_m, body, list);
    body.room = places_for(body.vertex_count, def.holes.size);
    std::uint16_t* ends = table.ring_ends(body);
    std::memmove(ends, list, static_cast<std::size_t>(body.rings) * sizeof *ends);
    clear_pieces(table, body);
    Outline<Real> outline = table.outline(body);
    outline.vertex = table.local + body.first_vertex;
    if (cut != nullptr) {
        body.piece_length =
            cut(outline, table.scratch, {list, static_cast<std::int32_t>(ends - list)});
    }
    if (body.piece_length < 0 ||
        !(twice_signed_area(outline.vertex, outline.end_of(0)) > Real(0))) {
        return false;
    }
    table.vertices_used += body.room;
    return true;
}

template <class Real>
void add_polyline(BodyTable<Real>& table, const BodyDef& def, Face<Real> cells_per_m,
                  Body<Real>& body) {
    body.first_vertex = table.vertices_used;
    body.open = true;
    Vec2f last;
    for (const Vec2f& vertex : def.polygon) {
        if (body.vertex_count > 0 && vertex.x == last.x && vertex.y == last.y) {
            continue;
        }
        last = vertex;
        table.local[body.first_vertex + body.vertex_count++] =
            convert<Real>(cells_per_m * convert<Face<Real>>(vertex));
    }
    body.room = body.vertex_count;
    body.rings = 1;
    clear_pieces(table, body);
    *table.ring_ends(body) = static_cast<std::uint16_t>(body.vertex_count);
    table.vertices_used += body.room;
}

template <class Real>
void note_movable(BodyTable<Real>& table) {
    table.movable = {};
    for (std::int32_t slot = 0; slot < table.capacity; ++slot) {
        if (table.body[slot].kind == BodyKind::moving) {
            const auto at = static_cast<std::int16_t>(slot);
            table.movable.first = table.movable.end == 0 ? at : table.movable.first;
            table.movable.end = static_cast<std::int16_t>(at + 1);
        }
    }
}

template <class Real>
bool any_without_slip(const BodyTable<Real>& table) {
    for (std::int32_t slot = 0; slot < table.capacity; ++slot) {
        if (table.body[slot].kind != BodyKind::free && table.body[slot].surface.no_slip) {
            return true;
        }
    }
    return false;
}

template <class Real>
bool any_free(const BodyTable<Real>& table) {
    for (std::int32_t slot = 0; table.load != nullptr && slot < table.capacity; ++slot) {
        if (table.body[slot].kind != BodyKind::free && table.load[slot].is_free_or_led()) {
            return true;
        }
    }
    return false;
}

template <class Real>
void place(BodyTable<Real>& table, const Body<Real>& body) {
    const Rotation<Real> turn = rotation(body.angle);
    for (std::int32_t k = 0; k < body.vertex_count; ++k) {
        const std::int32_t vertex = body.first_vertex + k;
        table.placed[vertex] = body.position + turn.apply(table.local[vertex]);
    }
}

template <class Real>
void lead(BodyTable<Real>& table, std::int32_t slot, bool led) {
    table.body[slot].led = led ? Lead::now : Lead::none;
    if (table.load == nullptr || table.load[slot].is_free() != led) {
        return;
    }
    BodyLoad<Real>& load = table.load[slot];
    load.inverse_mass = -load.inverse_mass;
    load.forget_blows();  // of who hit it meanwhile
}

template <class Real>
void end_leads(BodyTable<Real>& table, bool held) {
    for (std::int32_t slot = table.movable.first; slot < table.movable.end; ++slot) {
        Body<Real>& body = table.body[slot];
        if (body.led == Lead::none) {
            continue;
        }
        if (held) {
            body.led = Lead::held;
            continue;
        }
        lead(table, slot, false);
        if (table.load == nullptr || !table.load[slot].is_free()) {
            body.velocity = Vec2<Real>{};
            body.spin = Real(0);
        }
    }
}

template <class Real>
void slow_leads(BodyTable<Real>& table, Face<Real> share) {
    for (std::int32_t slot = table.movable.first; slot < table.movable.end; ++slot) {
        Body<Real>& body = table.body[slot];
        if (body.led == Lead::held) {
            body.velocity = convert<Real>(share * convert<Face<Real>>(body.velocity));
            body.spin = static_cast<Real>(share * static_cast<Face<Real>>(body.spin));
        }
    }
}

template <class Real>
void remove(BodyTable<Real>& table, std::int32_t slot) {
    Body<Real>& gone = table.body[slot];
    const std::int32_t first = gone.first_vertex;
    const std::int32_t count = gone.room;
    close_gap(table.local, first, count, table.vertices_used);
    close_gap(table.placed, first, count, table.vertices_used);
    const std::int32_t places = table.per_vertex();
    close_gap(table.pieces, places * first, places * count, places * table.vertices_used);
    for (std::int32_t k = 0; k < table.capacity; ++k) {
        if (table.body[k].kind != BodyKind::free && table.body[k].first_vertex > first) {
            table.body[k].first_vertex -= count;
        }
    }
    const auto next = static_cast<std::uint16_t>(gone.generation + 1U);
    gone = Body<Real>{};
    gone.generation = next;
    table.vertices_used -= count;
    --table.used;
    note_movable(table);
}

#define WEIR_INSTANTIATE(Real)                                                             \
    template std::int32_t find_free_slot(const BodyTable<Real>&);                          \
    template bool exists(const BodyTable<Real>&, BodyId);                                  \
    template bool add_polygon(BodyTable<Real>&, const BodyDef&, Face<Real>,                 \
                              Decompose<Real>, Body<Real>&);                               \
    template void add_polyline(BodyTable<Real>&, const BodyDef&, Face<Real>, Body<Real>&); \
    template void note_movable(BodyTable<Real>&);                                          \
    template bool any_without_slip(const BodyTable<Real>&);                                \
    template bool any_free(const BodyTable<Real>&);                                        \
    template void place(BodyTable<Real>&, const Body<Real>&);                              \
    template void lead(BodyTable<Real>&, std::int32_t, bool);                              \
    template void end_leads(BodyTable<Real>&, bool);                                       \
    template void slow_leads(BodyTable<Real>&, Face<Real>);                                \
    template void remove(BodyTable<Real>&, std::int32_t);
WEIR_FOR_EACH_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
