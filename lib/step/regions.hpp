// Regions: liquid that lies apart from all other falls asleep by itself. Its particles stand first
// in the pool, where a substep passes them over: to it the tank is empty there. What is asleep is
// known by tiles of 4 × 4 cells, each with the number of the region whose liquid is in it.
#pragma once

#include "step/simulation.hpp"
#include "step/time_step_limit.hpp"

namespace weir {

template <class Real>
struct RegionStages;

/// What a tile says.
inline constexpr std::uint8_t kNoRegion = 0;
inline constexpr std::uint8_t kMostRegions = 254;  ///< all further ones share the last number
inline constexpr std::uint8_t kRestless = 255;     ///< nobody sleeps: something has moved here

/// A set of region numbers.
inline constexpr std::int32_t kRegionWords = 8;
struct RegionSet {
    std::uint32_t bits[kRegionWords] = {};

    bool has(std::uint8_t number) const { return (bits[number / 32] >> (number % 32) & 1U) != 0; }
    void add(std::uint8_t number) { bits[number / 32] |= 1U << (number % 32); }
};

template <class Real>
struct Regions {
    const RegionStages<Real>* stages = nullptr;
    std::int32_t tiles_x = 0;
    std::int32_t tiles_y = 0;
    std::uint8_t* tile = nullptr;
    Real* pressure = nullptr;  ///< of sleeping cells: those of the grid may be overwritten
    DensityOf<Real>* density = nullptr;
    Real speed = Real(0);  ///< what is not faster rests, cells/s
    float after_s = 0.0F;
    std::int32_t asleep = 0;   ///< particles, the pool's first
    std::int32_t hidden = 0;   ///< of these, before the pool until the substep is done
    float watched_s = 0.0F;    ///< since marks of restlessness were wiped
    Seconds<Real> dt_s{};      ///< that kept pressures are for
    RegionSet used;
    RegionSet woken;           ///< to wake with the next substep
    bool all_woken = false;
    bool any_woken = false;
    bool restless = false;     ///< something moved, who knows where
    bool stale = false;        ///< the grid's sleeping cells do not show what is kept
    std::uint8_t phase = 0;    ///< which quarter of the particles is looked at next

    static bool is_number(std::uint8_t of) { return of != kNoRegion && of != kRestless; }
    bool sleeps(std::int32_t at) const { return is_number(tile[at]); }
    std::int32_t tiles() const { return tiles_x * tiles_y; }
    std::int32_t tile_at(std::int32_t i, std::int32_t j) const {
        return j / kTileEdge * tiles_x + i / kTileEdge;
    }
    std::int32_t tile_of(const Vec2<PositionOf<Real>>& at) const {
        return tile_at(static_cast<std::int32_t>(Real(at.x)),
                       static_cast<std::int32_t>(Real(at.y)));
    }
    void wake(std::uint8_t number) {
        woken.add(number);
        any_woken = true;
    }
    void wake_all() { all_woken = any_woken = true; }
    /// Something happened there: who sleeps wakes, and others do not yet fall asleep.
    void touch(std::int32_t at) {
        if (sleeps(at)) {
            wake(tile[at]);
        } else {
            tile[at] = kRestless;
        }
    }
};
static_assert(sizeof(Regions<float>) <= kRegionsBytes<float>, "raise kRegionsBytes");
static_assert(sizeof(Regions<double>) <= kRegionsBytes<double>, "raise kRegionsBytes");

/// Reached through a table that only `World::let_regions_sleep` names: other programs link no code
/// for regions.
template <class Real>
struct RegionStages {
    /// Before a substep: wakes who has to, watches who moves, lets those fall asleep who did not
    /// for long enough, and has the pool begin behind all sleepers.
    void (*begin)(Simulation<Real>& simulation, const SubstepPlan<Real>& plan, Work work);
    /// After it: whoever others came near wakes with the next one. Shows the sleepers again.
    void (*end)(Simulation<Real>& simulation, Work work, const StepReport& report);
    /// Something happened around those nodes.
    void (*touch)(Regions<Real>& regions, const NodeBox& box);
    /// A particle was added there.
    void (*touch_at)(Regions<Real>& regions, Vec2<PositionOf<Real>> at);
    /// A particle is about to be removed: where it stands then, so that sleepers stay in front.
    std::int32_t (*part_with)(Simulation<Real>& simulation, std::int32_t index);
    /// Puts kept pressures and densities into the grid's cells, for whoever looks at them.
    void (*show_fields)(Simulation<Real>& simulation);
};
template <class Real>
const RegionStages<Real>& region_stages();

template <class Real>
void touch_regions(Regions<Real>* regions, const NodeBox& box) {
    if (regions != nullptr) {
        regions->stages->touch(*regions, box);
    }
}

/// How many particles stand before the pool.
template <class Real>
std::int32_t hidden_of(const Simulation<Real>& simulation) {
    const Regions<Real>* const regions = simulation.regions;
    return simulation.window.beyond + (regions != nullptr ? regions->hidden : 0);
}

/// Lets the pool begin so many sleepers later than with the first one.
template <class Real>
void hide_sleepers(std::int32_t count, Simulation<Real>& simulation) {
    simulation.particles.begin_later(count - simulation.regions->hidden);
    simulation.regions->hidden = count;
}

/// One particle of so many is looked at in a substep. In as many gravity moves nobody further than
/// a tile and leaves no trace.
inline constexpr std::int32_t kSampled = 4;

template <class Real>
Real fastest_part(const Vec2<VelocityOf<Real>>& velocity) {
    return larger_part(convert<Real>(velocity));
}

/// Calls visit(tile) for the tiles that a box of nodes reaches into, and one more on each side.
template <class Real, class Visit>
void for_each_tile_near(const Regions<Real>& regions, const NodeBox& box, Visit visit) {
    if (box.empty()) {
        return;
    }
    const std::int32_t i1 = minimum(regions.tiles_x - 1, box.i1 / kTileEdge + 1);
    const std::int32_t j1 = minimum(regions.tiles_y - 1, box.j1 / kTileEdge + 1);
    for (std::int32_t j = maximum(0, box.j0 / kTileEdge - 1); j <= j1; ++j) {
        for (std::int32_t i = maximum(0, box.i0 / kTileEdge - 1); i <= i1; ++i) {
            visit(j * regions.tiles_x + i);
        }
    }
}

/// The same for a tile and those around it.
template <class Real, class Visit>
void for_each_tile_around(const Regions<Real>& regions, std::int32_t tile_i, std::int32_t tile_j,
                          Visit visit) {
    const std::int32_t i = tile_i * kTileEdge;
    const std::int32_t j = tile_j * kTileEdge;
    for_each_tile_near(regions, NodeBox{i, j, i, j}, visit);
}

/// Calls visit(cell) for the cells of a tile.
template <class Visit>
void for_each_cell_of_tile(const GridShape& tank, std::int32_t tile_i, std::int32_t tile_j,
                           Visit visit) {
    const std::int32_t i1 = minimum(tank.nx, (tile_i + 1) * kTileEdge);
    const std::int32_t j1 = minimum(tank.ny, (tile_j + 1) * kTileEdge);
    for (std::int32_t j = tile_j * kTileEdge; j < j1; ++j) {
        for (std::int32_t i = tile_i * kTileEdge; i < i1; ++i) {
            visit(tank.index(i, j));
        }
    }
}

/// Finds what lies apart and has been at rest, gives it numbers, and puts its particles to those
/// that sleep. All marks of restlessness are wiped. Returns the cost.
template <class Real>
std::int32_t settle_regions(Simulation<Real>& simulation);
/// At most.
template <class Real>
std::int32_t cost_of_settling(const Simulation<Real>& simulation);

}  // namespace weir
