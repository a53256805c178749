// Snapshots: the world into a caller's buffer and back. A program that takes none does not link
// this file.
#include "weir/snapshot.hpp"

#include "base/assert.hpp"
#include "geometry/convex_decomposition.hpp"
#include "solid/layers.hpp"
#include "step/substep.hpp"
#include "step/window.hpp"
#include "weir/world.hpp"
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

/// One kind of element, and whether those that a snapshot brings may be let in.
template <class T>
T read(const std::byte* from, std::size_t index) {
    T value;
    std::memcpy(&value, from + index * sizeof value, sizeof value);
    return value;
}

template <class Real>
bool all_finite(const std::byte* from, std::size_t numbers) {
    for (std::size_t k = 0; k < numbers; ++k) {
        if (!is_finite(read<Real>(from, k))) {
            return false;
        }
    }
    return true;
}

/// Packed loops count on pressures of 29 bits, which all finite numbers of others are.
template <class Real>
bool all_pressures(const std::byte* from, std::size_t numbers) {
    if constexpr (!Stored<Real>::shares_momentum) {
        return all_finite<Real>(from, numbers);
    } else {
        for (std::size_t k = 0; k < numbers; ++k) {
            if (fixed::magnitude(read<Real>(from, k).raw) >= 1U << 28U) {
                return false;
            }
        }
        return true;
    }
}

template <class Real>
bool all_in_tank(const GridShape& s, const std::byte* from, std::size_t points) {
    for (std::size_t k = 0; k < points; ++k) {
        const Vec2<Real> x = read<Vec2<PositionOf<Real>>>(from, k);
        const bool inside = x.x >= Real(0) && x.x < static_cast<Real>(s.nx) && x.y >= Real(0) &&
                            x.y < static_cast<Real>(s.ny);
        if (!inside) {
            return false;
        }
    }
    return true;
}

bool all_kinds(const std::byte* from, std::size_t kinds) {
    for (std::size_t k = 0; k < kinds; ++k) {
        if (static_cast<std::uint8_t>(from[k]) > static_cast<std::uint8_t>(Liquid::second)) {
            return false;
        }
    }
    return true;
}

template <class Real>
bool all_vertices(const std::byte* from, std::size_t vertices) {
    for (std::size_t k = 0; k < 2 * vertices; ++k) {
        constexpr Real kFurthest = Believed<Real>::furthest_vertex;
        if (!(absolute(read<Real>(from, k)) <= kFurthest)) {
            return false;
        }
    }
    return true;
}

/// Whether all numbers in a body's room for pieces name vertices of it, and every ring has one.
template <class Real>
bool all_indices(const std::byte* from, std::int32_t per_vertex, const Body<Real>& body) {
    const auto at = [&](std::int32_t k) {
        return static_cast<std::int32_t>(
            read<std::uint16_t>(from, static_cast<std::size_t>(k)));
    };
    const std::int32_t end_of_room = per_vertex * body.room;
    std::int32_t end = 0;
    for (std::int32_t k = end_of_room - body.rings; k < end_of_room; ++k) {
        if (at(k) <= end) {
            return false;
        }
        end = at(k);
    }
    return end == body.vertex_count && pieces_fit(at, body.piece_length, body.vertex_count);
}

/// How many of a body's places in a block are kept. Ring ends stand at the end of its pieces.
template <class Real>
std::size_t elements_of(Block block, const Body<Real>& body) {
    return static_cast<std::size_t>(block == Block::piece_index ? body.room : body.vertex_count);
}

/// Whether elements of a block that come from outside can do no harm. No default: a block that is
/// added has to be thought of.
template <class Real>
bool harmless(Block block, const Simulation<Real>& world, const std::byte* from,
              std::size_t elements, const Body<Real>& of) {
    switch (block) {
        case Block::particle_position: return all_in_tank<Real>(world.layers.shape, from, elements);
        case Block::particle_velocity: return all_finite<VelocityOf<Real>>(from, 2 * elements);
        case Block::particle_kind: return all_kinds(from, elements);
        case Block::particle_tag: return true;
        case Block::vertex_local: return all_vertices<Real>(from, elements);
        case Block::piece_index: return all_indices(from, world.bodies.per_vertex(), of);
        case Block::pressure:
        case Block::kept_pressure: return all_pressures<Real>(from, elements);
        case Block::kept_density: return all_finite<DensityOf<Real>>(from, elements);
        case Block::region_tile: return true;  // any number names a region
        case Block::body_load:
            // Of the ledger's whole numbers any will do.
            return all_finite<Face<Real>>(from, (elements - kLedgerRecords<Real>) *
                                                    (sizeof(BodyLoad<Real>) / sizeof(Face<Real>)));
        case Block::body_push:  // guesses, of whatever
            return all_finite<Face<Real>>(from, elements * (sizeof(Push<Real>) /
                                                            sizeof(Face<Real>)));
        case Block::world_state:
        case Block::body_table:
        case Block::vertex_placed:
        case Block::contact:
        case Block::body_meeting:
        case Block::body_lever:
        case Block::body_diagonal:
        case Block::decomposition_scratch:
        case Block::static_distance:
        case Block::static_body:
        case Block::merged_distance:
        case Block::merged_body:
        case Block::contour_case:
        case Block::near_wall:
        case Block::open_u:
        case Block::open_v:
        case Block::full_density:
        case Block::wall_edge:
        case Block::wall_edge_of_cell:
        case Block::wall_mark:
        case Block::wall_span:
        case Block::wall_body:
        case Block::row_span:
        case Block::velocity_u:
        case Block::velocity_v:
        case Block::mass_u:
        case Block::mass_v:
        case Block::inverse_density_u:
        case Block::inverse_density_v:
        case Block::divergence:
        case Block::inverse_diagonal:
        case Block::density:
        case Block::level:
        case Block::coarse_cells:
        case Block::regions:
        case Block::count: break;
    }
    return false;
}

template <class Real>
void write(SnapshotWriter& writer, const Layout& plan, const Head& head,
           WorldState<Real>& state) {
    write_head(writer, plan, head);
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

/// Goes through all that follows the head. `apply` is false to look only, and true to take it over
/// after it was looked at.
template <class Stream, class Real>
void go_through(SnapshotReader& reader, bool apply, const Layout& plan, WorldState<Real>& state) {
    Stream stream{reader};
    BodyTable<Real>& table = state.simulation.bodies;
    const auto take = [&](std::int32_t block, std::size_t first, std::size_t elements,
                          const Body<Real>& of) {
        const std::size_t size = plan.element_bytes[block];
        const std::byte* from = reader.array(elements * size);
        if (from == nullptr) {
            return;
        }
        if (apply) {
            std::memcpy(memory_of(state, plan, block) + first * size, from, elements * size);
        } else if (elements > 0 && !harmless<Real>(static_cast<Block>(block), state.simulation,
                                                   from, elements, of)) {
            reader.refuse();
        }
    };
    const Extents extents = world_members(stream, state);
    if constexpr (kHasWindow<Real>) {
        if (state.simulation.window.cells > 0) {
            if (apply) {
                number_cells(extents.window, state.simulation);
            } else if (reader.sound() && !is_window(state.simulation, extents.window)) {
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
                   : body.room > 0 || body.moved || body.leapt) {
            reader.refuse();
        }
        body.first_vertex = places;
        for (std::int32_t block = 0; block < kBlockCount && reader.sound(); ++block) {
            if (by_vertex(plan, block)) {
                take(block, static_cast<std::size_t>(places),
                     elements_of(static_cast<Block>(block), body), body);
            }
        }
        places += body.room;
        if (apply) {
            table.body[slot] = body;
        }
    }
    if (places != extents.vertices) {
        reader.refuse();
    }
    for (std::int32_t block = 0; block < kBlockCount && reader.sound(); ++block) {
        take(block, 0, elements_kept(plan, block, extents), {});
    }
}

/// Computes again what follows from what was kept.
template <class Real>
void redraw(Simulation<Real>& simulation) {
    BodyTable<Real>& table = simulation.bodies;
    table.used = 0;
    for (std::int32_t slot = 0; slot < table.capacity; ++slot) {
        if (table.body[slot].kind != BodyKind::free) {
            ++table.used;
            place(table, table.body[slot]);
        }
    }
    if constexpr (!Stored<Real>::shares_momentum) {
        simulation.free_bodies = any_free(table) ? &free_body_stages<Real>() : nullptr;
    }
    note_movable(table);
    simulation.layers.walls.active = table.used > 0;
    simulation.layers.walls.any_sticking = any_without_slip(table);
    simulation.grid.shape = simulation.layers.shape;
    simulation.occupied = stored_part(simulation);  // what is not kept may stand anywhere
    if (simulation.regions != nullptr) {
        simulation.regions->stale = true;
    }
    clear(simulation.contacts);
    if (table.capacity > 0) {
        redraw_all(simulation.layers, table);
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
    const Status frame = check_frame(snapshot, bytes, plan, *state_);
    if (frame != Status::ok) {
        return frame;
    }
    SnapshotReader head(snapshot, bytes);
    head.array(2 * kWordBytes);
    const auto end = static_cast<std::size_t>(head.word64());
    const auto* contents = static_cast<const std::byte*>(snapshot) + kHeadBytes;
    const std::size_t length = end - kHeadBytes - kChecksumBytes;
    SnapshotReader look(contents, length);
    go_through<MemberCheck>(look, false, plan, *state_);
    if (!look.sound() || !look.at_end()) {
        return Status::snapshot_damaged;
    }
    if constexpr (kHasWindow<Real>) {
        show_beyond(state_->simulation);
    }
    if (state_->simulation.regions != nullptr) {
        hide_sleepers(0, state_->simulation);
    }
    SnapshotReader take(contents, length);
    go_through<MemberRead>(take, true, plan, *state_);
    redraw(state_->simulation);
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
