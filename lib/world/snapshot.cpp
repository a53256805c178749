// Snapshots: the world into a caller's buffer and back. A program that takes none does not link
// this file.
#include "weir/snapshot.hpp"

#include "base/assert.hpp"
#include "solid/layers.hpp"
#include "step/substep.hpp"
#include "step/window.hpp"
#include "weir/world.hpp"
#include "world/snapshot_elements.hpp"
#include "world/snapshot_frame.hpp"
#include "world/snapshot_members.hpp"

namespace weir {

namespace {

using detail::WorldState;

template <class Real>
std::byte* memory_of(WorldState<Real>& state, const Layout& plan, std::int32_t block) {
    return reinterpret_cast<std::byte*>(&state) + plan.offset[block];
}

/// How many elements of a block are kept beside those that the bodies keep.
std::size_t elements_kept(const Layout& plan, std::int32_t block, const Extents& extents) {
    if (plan.bytes[block] == 0) {
        return 0;
    }
    switch (plan.kept[block]) {
        case Kept::whole: return plan.bytes[block] / plan.element_bytes[block];
        case Kept::particles: return static_cast<std::size_t>(extents.particles);
        default: return 0;
    }
}

bool by_vertex(const Layout& plan, std::int32_t block) {
    return plan.kept[block] == Kept::vertices;
}

template <class Real>
void write(SnapshotWriter& writer, const Layout& plan, const Head& head,
           WorldState<Real>& state) {
    write_head<Real>(writer, head);
    const Extents extents = world_members(writer, state);
    const BodyTable<Real>& table = state.simulation.bodies;
    for (std::int32_t slot = 0; slot < table.capacity; ++slot) {
        Body<Real>& body = table.body[slot];
        body_members(writer, table.vertex_capacity, table, body);
        for (std::int32_t block = 0; block < kBlockCount; ++block) {
            const std::size_t size = plan.element_bytes[block];
            if (by_vertex(plan, block)) {
                writer.array(memory_of(state, plan, block) +
                                 static_cast<std::size_t>(body.first_vertex) * size,
                             elements_of(static_cast<Block>(block), body) * size);
            }
        }
    }
    for (std::int32_t block = 0; block < kBlockCount; ++block) {
        writer.array(memory_of(state, plan, block),
                     elements_kept(plan, block, extents) * plan.element_bytes[block]);
    }
    writer.word64(writer.checksum());
}

/// Whether a body stands where another one is drawn, and looks like it, but for its vertices.
template <class Real>
bool looks_like(const Body<Real>& a, const Body<Real>& drawn) {
    return !drawn.moved && a.kind == drawn.kind && a.open == drawn.open &&
           a.position.x == drawn.position.x && a.position.y == drawn.position.y &&
           a.angle == drawn.angle && a.surface.no_slip == drawn.surface.no_slip &&
           a.room == drawn.room && a.rings == drawn.rings &&
           a.vertex_count == drawn.vertex_count;
}

/// In this order: what is read may be whatever, then is sound, then need not be drawn anew where
/// the same stands already.
enum class Pass : std::uint8_t { check, compare, take };

/// Goes through all that follows the head. Returns, when it compares, what was drawn and is not to
/// be found in the snapshot; those bodies are no longer drawn.
template <class Stream, class Real>
Stale go_through(SnapshotReader& reader, Pass pass, const Layout& plan, WorldState<Real>& state) {
    Stream stream{reader};
    BodyTable<Real>& table = state.simulation.bodies;
    Stale stale;
    bool same = false;
    const auto take = [&](std::int32_t block, std::int32_t first, std::size_t elements,
                          const Body<Real>& of) {
        const std::size_t size = plan.element_bytes[block];
        const std::byte* from = reader.array(elements * size);
        if (from == nullptr) {
            return;
        }
        std::byte* const at =
            memory_of(state, plan, block) + static_cast<std::size_t>(first) * size;
        if (pass == Pass::take) {
            std::memcpy(at, from, elements * size);
        } else if (pass == Pass::compare) {
            same = same && std::memcmp(at, from, elements * size) == 0;
        } else if (elements > 0 && !harmless<Real>(static_cast<Block>(block), state.simulation,
                                                   from, elements, of)) {
            reader.refuse();
        }
    };
    const Extents extents = world_members(stream, state);
    if constexpr (kHasWindow<Real>) {
        if (state.simulation.window.cells > 0) {
            if (pass == Pass::take) {
                number_cells(extents.window, state.simulation);
            } else if (pass == Pass::check && reader.sound() &&
                       !is_window(state.simulation, extents.window)) {
                reader.refuse();
            }
        }
    }
    std::int32_t places = 0;
    for (std::int32_t slot = 0; slot < table.capacity && reader.sound(); ++slot) {
        Body<Real> body;
        MemberRead members{reader};
        body_members(members, extents.vertices - places, table, body);
        const bool exists = body.kind != BodyKind::free;
        if (exists ? body.vertex_count < 2 || body.vertex_count > kMaxBodyVertices
                   : body.room > 0 || body.leapt) {
            reader.refuse();
        }
        if (body.kind == BodyKind::moving && !state.def.capacity.moving_bodies) {
            reader.refuse();
        }
        Body<Real>& known = table.body[slot];
        same = pass == Pass::compare && looks_like(body, known);
        body.first_vertex = same ? known.first_vertex : places;
        for (std::int32_t block = 0; block < kBlockCount && reader.sound(); ++block) {
            if (by_vertex(plan, block)) {
                take(block, body.first_vertex,
                     elements_of(static_cast<Block>(block), body), body);
            }
        }
        places += body.room;
        if (pass == Pass::take) {
            body.drawn = known.drawn;
            body.hollow = known.hollow;
            known = body;
        } else if (pass == Pass::compare && !same) {
            stale.add(known);
            known.drawn = NodeBox{};
        }
    }
    if (places != extents.vertices) {
        reader.refuse();
    }
    same = false;
    for (std::int32_t block = 0; block < kBlockCount && reader.sound(); ++block) {
        take(block, 0, elements_kept(plan, block, extents), {});
    }
    return stale;
}

bool is_same_part(const GridShape& a, const GridShape& b) {
    return a.i0 == b.i0 && a.j0 == b.j0 && a.nx == b.nx && a.ny == b.ny;
}

/// Computes again what follows from what was kept. `picture`: the solids', of what it is no more,
/// or null if it is of another part of the tank.
template <class Real>
void redraw(Simulation<Real>& simulation, const Stale* picture) {
    Settings<Real>& settings = simulation.settings;
    settings.borders.viscous = settings.viscosity > Real(0);
    BodyTable<Real>& table = simulation.bodies;
    table.used = 0;
    for (std::int32_t slot = 0; slot < table.capacity; ++slot) {
        if (table.body[slot].kind != BodyKind::free) {
            ++table.used;
            place(table, table.body[slot]);
        }
        if (table.load != nullptr && table.body[slot].kind == BodyKind::fixed) {
            table.load[slot].inverse_mass = Face<Real>(0);  // whatever a snapshot says
        }
    }
    if constexpr (kHasFreeBodies<Real>) {
        simulation.free_bodies = any_free(table) ? &free_body_stages<Real>() : nullptr;
    }
    link_inlets(simulation.pressure);
    note_movable(table);
    simulation.grid.shape = simulation.layers.shape;
    simulation.occupied = stored_part(simulation);  // what is not kept may stand anywhere
    clear(simulation.contacts);
    if (table.capacity > 0) {
        if (picture == nullptr) {
            forget_drawn(simulation.layers, table);
        }
        draw_missing(simulation.layers, table, picture != nullptr ? *picture : Stale{});
    }
}

}  // namespace

template <class Real>
Status World<Real>::save(void* memory, std::size_t bytes, std::size_t* written) const {
    const Status free = ready(state_);
    if (free != Status::ok) {
        return free;
    }
    if (memory == nullptr) {
        return Status::snapshot_missing;
    }
    if (state_->simulation.regions != nullptr) {
        static_cast<void>(pressure());  // shows who sleeps: the same whether anybody looked or not
    }
    const Layout plan = layout<Real>(state_->def.capacity);
    SnapshotWriter counter(nullptr);
    write(counter, plan, Head{}, *state_);
    WEIR_ASSERT(counter.bytes() <= snapshot_bytes<Real>(state_->def.capacity));
    if (counter.bytes() > bytes) {
        return Status::snapshot_room_too_small;
    }
    SnapshotWriter writer(memory);
    write(writer, plan, head_of(*state_, counter.bytes()), *state_);
    if (written != nullptr) {
        *written = writer.bytes();
    }
    return Status::ok;
}

template <class Real>
Status World<Real>::restore(const void* snapshot, std::size_t bytes) {
    if (state_ == nullptr) {
        return Status::not_initialised;
    }
    if (snapshot == nullptr) {
        return Status::snapshot_missing;
    }
    const Layout plan = layout<Real>(state_->def.capacity);
    const Status frame = check_frame(snapshot, bytes, *state_);
    if (frame != Status::ok) {
        return frame;
    }
    SnapshotReader head(snapshot, bytes);
    head.array(2 * kWordBytes);
    const auto end = static_cast<std::size_t>(head.word64());
    const auto* contents = static_cast<const std::byte*>(snapshot) + kHeadBytes;
    const std::size_t length = end - kHeadBytes - kChecksumBytes;
    SnapshotReader look(contents, length);
    go_through<MemberCheck>(look, Pass::check, plan, *state_);
    if (!look.sound() || !look.at_end()) {
        return Status::snapshot_damaged;
    }
    if constexpr (kHasWindow<Real>) {
        show_beyond(state_->simulation);
    }
    if (state_->simulation.regions != nullptr) {
        hide_sleepers(0, state_->simulation);
    }
    SnapshotReader compare(contents, length);
    const Stale stale = go_through<MemberCheck>(compare, Pass::compare, plan, *state_);
    const GridShape before = stored_part(state_->simulation);
    SnapshotReader take(contents, length);
    go_through<MemberRead>(take, Pass::take, plan, *state_);
    // Records of thin edges name places in the pool, which are others now.
    const bool keeps = state_->simulation.layers.thin.capacity == 0 &&
                       is_same_part(before, stored_part(state_->simulation));
    redraw(state_->simulation, keeps ? &stale : nullptr);
    state_->stepping = false;
    state_->density_stale = true;
    forget_rows(state_->simulation.grid);
    if (state_->simulation.regions != nullptr) {
        static_cast<void>(density());  // who falls asleep in the next substep keeps it
    }
    return Status::ok;
}

template <class Real>
Status World<Real>::body_in_slot(std::int32_t slot, BodyId* id) const {
    if (state_ == nullptr) {
        return Status::not_initialised;
    }
    if (id == nullptr) {
        return Status::output_missing;
    }
    const BodyTable<Real>& table = state_->simulation.bodies;
    if (slot < 0 || slot >= table.capacity || table.body[slot].kind == BodyKind::free) {
        return Status::stale_body;
    }
    *id = {static_cast<std::uint16_t>(slot), table.body[slot].generation, state_->tag};
    return Status::ok;
}

#define WEIR_INSTANTIATE(Real)                                                 \
    template Status World<Real>::save(void*, std::size_t, std::size_t*) const; \
    template Status World<Real>::restore(const void*, std::size_t);            \
    template Status World<Real>::body_in_slot(std::int32_t, BodyId*) const;
WEIR_FOR_EACH_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
