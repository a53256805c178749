// Head and checksum of a snapshot: what it is, and whether it fits the world.
#pragma once

#include "base/hash.hpp"
#include "world/snapshot_stream.hpp"
#include "world/world_state.hpp"

namespace weir {

inline constexpr std::uint32_t kSnapshotMagic = 0x52494557;  // "WEIR"
/// Raised with every change of what is written. A changed `layout` shows by itself.
inline constexpr std::uint32_t kSnapshotVersion = 15;
inline constexpr std::size_t kChecksumBytes = sizeof(std::uint64_t);

/// Which arithmetic wrote the numbers: how it writes 1.5.
template <class Real>
std::uint64_t scalar_code() {
    const Real sample = Real(1.5);
    std::uint64_t bits = 0;
    std::memcpy(&bits, &sample, sizeof sample);
    return bits;
}

inline void add_surface(Hash& hash, const Surface& surface) {
    const auto& [restitution, friction, no_slip, conveyor] = surface;
    hash.add(restitution);
    hash.add(friction);
    hash.add(static_cast<std::uint32_t>(no_slip));
    hash.add(conveyor);
}

/// All of the definition but capacity, which has a status of its own, and the counter.
inline std::uint64_t fingerprint(const WorldDef& def) {
    const auto& [capacity, cell_m, gravity, top_speed, particles_per_cell, pressure, contour,
                 sweeps, cfl, max_substeps, flip_ratio, volume_gain, sound_speed, viscosity,
                 surface_tension, second_density, walls, sleep, periodic_x, periodic_y,
                 keep_sorted, ticks, parallel_for] = def;
    const auto& [bottom, right, top, left] = walls;
    const auto& [still_speed, still_after, still_gravity] = sleep;
    Hash hash;
    const float numbers[] = {cell_m,      gravity.x,   gravity.y, cfl,             flip_ratio,
                             volume_gain, sound_speed, viscosity, surface_tension, second_density,
                             still_speed, still_after, still_gravity, top_speed};
    for (const float number : numbers) {
        hash.add(number);
    }
    const std::int32_t counts[] = {particles_per_cell, sweeps, max_substeps};
    for (const std::int32_t count : counts) {
        hash.add(count);
    }
    const Surface surfaces[] = {bottom, right, top, left};
    for (const Surface& surface : surfaces) {
        add_surface(hash, surface);
    }
    hash.add(static_cast<std::uint32_t>(pressure));
    hash.add(static_cast<std::uint32_t>(contour));
    hash.add(static_cast<std::uint32_t>(periodic_x));
    hash.add(static_cast<std::uint32_t>(periodic_y));
    hash.add(static_cast<std::uint32_t>(keep_sorted));
    return hash.value();
}

/// What the head of a snapshot says. Its length in words is the same for every world.
struct Head {
    std::uint64_t bytes = 0;
    std::uint64_t scalar = 0;
    std::uint64_t capacity = 0;
    std::uint64_t definition = 0;
};
inline constexpr std::size_t kHeadBytes = 2 * kWordBytes + sizeof(Head);

inline std::uint64_t capacity_code(const Capacity& of) {
    const auto& [particles, cells_x, cells_y, bodies, moving, vertices, wall_edges, contacts,
                 two_way, second_liquid, particle_tags, sleeping_regions, window_cells] = of;
    Hash hash;
    const std::int32_t numbers[] = {particles, cells_x, cells_y,
                                    bodies,    vertices, wall_edges, contacts};
    for (const std::int32_t number : numbers) {
        hash.add(number);
    }
    hash.add(static_cast<std::uint32_t>(two_way));
    hash.add(static_cast<std::uint32_t>(second_liquid));
    hash.add(static_cast<std::uint32_t>(moving));
    if (is_windowed(of)) {
        hash.add(window_cells);
    }
    if (sleeping_regions) {
        hash.add(std::uint32_t{1});
    }
    if (particle_tags) {
        hash.add(std::uint32_t{2});
    }
    return hash.value();
}

/// kSnapshotVersion, and how blocks are described, whatever the capacity.
template <class Real>
std::uint32_t format_code() {
    Hash hash;
    hash.add(kSnapshotVersion);
    for (const detail::BlockKind& kind : detail::kBlockKinds<Real>) {
        // Pointers make these two blocks longer on some machines; their members do not.
        hash.add(static_cast<std::uint32_t>(kind.kept));
        hash.add(kind.kept == Kept::members ? 0U : std::uint32_t{kind.element_bytes});
    }
    return static_cast<std::uint32_t>(hash.value());
}

/// Of the definition, and whether regions sleep.
template <class Real>
std::uint64_t definition_code(const detail::WorldState<Real>& state) {
    return fingerprint(state.def) + (state.simulation.regions != nullptr ? 1U : 0U);
}

template <class Real>
Head head_of(const detail::WorldState<Real>& state, std::size_t bytes) {
    return {bytes, scalar_code<Real>(), capacity_code(state.def.capacity),
            definition_code(state)};
}

template <class Real>
void write_head(SnapshotWriter& writer, const Head& head) {
    writer.word(kSnapshotMagic);
    writer.word(format_code<Real>());
    writer.word64(head.bytes);
    writer.word64(head.scalar);
    writer.word64(head.capacity);
    writer.word64(head.definition);
}

/// Whether frame and checksum are those of a snapshot, and of a snapshot of this world.
template <class Real>
Status check_frame(const void* data, std::size_t size, const detail::WorldState<Real>& state) {
    SnapshotReader reader(data, size);
    const std::uint32_t magic = reader.word();
    const std::uint32_t format = reader.word();
    const Head head{reader.word64(), reader.word64(), reader.word64(), reader.word64()};
    if (!reader.sound()) {
        return Status::snapshot_truncated;
    }
    if (magic != kSnapshotMagic) {
        return Status::snapshot_not_recognised;
    }
    const std::uint64_t scalar = scalar_code<Real>();
    if (format != format_code<Real>() && head.scalar == scalar) {
        return Status::snapshot_of_other_version;
    }
    if (head.bytes > size) {
        return Status::snapshot_truncated;
    }
    if (head.bytes % kWordBytes != 0 || head.bytes < kHeadBytes + kChecksumBytes) {
        return Status::snapshot_damaged;
    }
    Checksum sum;
    SnapshotReader words(data, static_cast<std::size_t>(head.bytes));
    for (std::uint64_t at = 0; at < head.bytes - kChecksumBytes; at += kWordBytes) {
        sum.add(words.word());
    }
    if (words.word64() != sum.value()) {
        return Status::snapshot_damaged;
    }
    if (head.scalar != scalar) {
        return Status::snapshot_of_other_scalar;
    }
    if (head.capacity != capacity_code(state.def.capacity)) {
        return Status::snapshot_of_other_capacity;
    }
    return head.definition == definition_code(state) ? Status::ok
                                                     : Status::snapshot_of_other_definition;
}

}  // namespace weir
