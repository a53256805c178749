// How much room a snapshot of a world needs. `World::save` and `World::restore` are in world.hpp.
//
// A snapshot holds what decides the future and nothing else: particles, last pressure, bodies with
// their generations, settings that calls can change. Scratch is left out; the solids' picture on
// the grid is drawn again. In order: magic, version, length, scalar, capacity, definition, members,
// blocks as `layout` marks them, 64-bit checksum; in 32-bit words, lowest byte first. Machines of
// either word size, with or without a floating-point unit, read each other's.
#pragma once

#include "weir/memory.hpp"

namespace weir {

/// Rooms for what is written member by member; snapshot.cpp checks that they suffice.
inline constexpr std::size_t kSnapshotFrameBytes = 192;
/// Viscosity, surface tension and the surfaces of the tank's walls.
template <class Real>
inline constexpr std::size_t kSnapshotSettingsBytes = 14 * sizeof(Real) + 16;
template <class Real>
inline constexpr std::size_t kSnapshotBodyBytes = sizeof(Real) == 4 ? 128 : 192;
inline constexpr std::size_t kSnapshotRegionsBytes = 96;
/// Places at which liquid was added beneath the surface.
template <class Real>
inline constexpr std::size_t kSnapshotInletsBytes =
    Stored<Real>::shares_momentum ? 0 : 4 + kMostInlets * (8 + sizeof(Real));

/// Bytes of the largest snapshot that a world of that capacity can have. A world that is not full
/// takes less: `World::save` tells how much.
template <class Real>
constexpr std::size_t snapshot_bytes(const Capacity& capacity) {
    const Layout plan = layout<Real>(capacity);
    std::size_t bytes = kSnapshotFrameBytes + kSnapshotSettingsBytes<Real> +
                        kSnapshotInletsBytes<Real> +
                        kSnapshotBodyBytes<Real> * static_cast<std::size_t>(capacity.bodies);
    bytes += capacity.sleeping_regions ? kSnapshotRegionsBytes : 0;
    for (std::int32_t block = 0; block < kBlockCount; ++block) {
        const Kept kept = plan.kept[block];
        if (kept == Kept::whole || kept == Kept::particles || kept == Kept::vertices) {
            bytes += plan.bytes[block];
        }
    }
    return bytes;
}

}  // namespace weir
