#include "step/regions.hpp"

namespace weir {

namespace {

template <class Real>
void touch_box(Regions<Real>& regions, const NodeBox& box) {
    for_each_tile_near(regions, box, [&](std::int32_t tile) { regions.touch(tile); });
}

template <class Real>
void touch_at(Regions<Real>& regions, Vec2<PositionOf<Real>> at) {
    regions.touch(regions.tile_of(at));
}

template <class Real>
std::int32_t part_with(Simulation<Real>& simulation, std::int32_t index) {
    Regions<Real>& regions = *simulation.regions;
    touch_at(regions, simulation.particles.position[index]);
    if (index >= regions.asleep) {
        return index;
    }
    simulation.particles.swap(index, --regions.asleep);
    return regions.asleep;
}

/// What moves wakes who sleeps around it. Where it came from was marked when it came there, or was
/// told to move.
template <class Real>
void touch_moving_bodies(Simulation<Real>& simulation) {
    const BodyTable<Real>& bodies = simulation.bodies;
    for (std::int32_t slot = 0; slot < bodies.capacity; ++slot) {
        const Body<Real>& body = bodies.body[slot];
        if (body.kind == BodyKind::moving && body.has_speed()) {
            touch_box(*simulation.regions, body.drawn);
        }
    }
}

/// Gives a tile that slept back to the grid.
template <class Real>
void restore_pressure(Simulation<Real>& simulation, std::int32_t i, std::int32_t j) {
    const Regions<Real>& regions = *simulation.regions;
    PressureFields<Real>& fields = simulation.pressure;
    const bool same = !(regions.dt_s > Seconds<Real>{}) || fields.last_dt == regions.dt_s;
    const Real scale = same ? Real(1) : fields.last_dt / regions.dt_s;
    for_each_cell_of_tile(simulation.layers.shape, i, j, [&](std::int32_t cell) {
        fields.pressure[cell] = scale * regions.pressure[cell];
    });
}

template <class Real>
std::int32_t cost_of_waking(const Simulation<Real>& simulation) {
    return simulation.particles.count + kTileEdge * kTileEdge * simulation.regions->tiles();
}

/// Those who were touched take part again. Returns the cost.
template <class Real>
std::int32_t wake_regions(Simulation<Real>& simulation) {
    Regions<Real>& regions = *simulation.regions;
    Particles<Real>& pool = simulation.particles;
    const auto wakes = [&](std::uint8_t number) {
        return regions.all_woken || regions.woken.has(number);
    };
    for (std::int32_t k = regions.asleep - 1; k >= 0; --k) {
        if (wakes(regions.tile[regions.tile_of(pool.position[k])])) {
            simulation.max_speed = maximum(simulation.max_speed,
                                           fastest_part<Real>(pool.velocity[k]));
            pool.swap(k, --regions.asleep);
        }
    }
    for (std::int32_t j = 0, tile = 0; j < regions.tiles_y; ++j) {
        for (std::int32_t i = 0; i < regions.tiles_x; ++i, ++tile) {
            const std::uint8_t number = regions.tile[tile];
            if (Regions<Real>::is_number(number) && wakes(number)) {
                restore_pressure(simulation, i, j);
                regions.tile[tile] = kRestless;
            }
        }
    }
    for (std::int32_t k = 0; k < kRegionWords; ++k) {
        regions.used.bits[k] &= regions.all_woken ? 0U : ~regions.woken.bits[k];
        regions.woken.bits[k] = 0U;
    }
    regions.all_woken = regions.any_woken = false;
    simulation.occupied = simulation.layers.shape;  // who slept there may be gone: it is emptied
    return cost_of_waking(simulation);
}

/// Marks the tiles of fast particles.
template <class Real>
void mark_fast(const Particles<Real>& awake, const Part& part, Regions<Real>& regions) {
    for (std::int32_t n = part.first; n < part.end; ++n) {
        const std::int32_t k = kSampled * n + regions.phase;
        if (k < awake.count && fastest_part<Real>(awake.velocity[k]) > regions.speed) {
            regions.touch(regions.tile_of(awake.position[k]));
        }
    }
}

template <class Real>
void begin(Simulation<Real>& simulation, const SubstepPlan<Real>& plan, Work work) {
    Regions<Real>& regions = *simulation.regions;
    Particles<Real>& pool = simulation.particles;
    // A body's rectangle of nodes has cost more by the time that its tiles are looked at.
    if (work.once(simulation.bodies.capacity + 1)) {
        touch_moving_bodies(simulation);
        if (regions.any_woken) {
            work.spend(wake_regions(simulation));
        }
    }
    const std::int32_t sleepers = work.foreseeing() ? 0 : regions.asleep - regions.hidden;
    const std::int32_t awake = pool.count - sleepers;
    const bool fast = simulation.max_speed > regions.speed || work.foreseeing();
    mark_fast(pool.part(sleepers, awake),
              work.take(fast ? (awake + kSampled - 1) / kSampled : 0, 1), regions);
    if (work.once(1)) {
        regions.phase = static_cast<std::uint8_t>((regions.phase + 1) % kSampled);
        regions.watched_s += static_cast<float>(plan.dt_s);
        if (regions.watched_s >= regions.after_s) {
            regions.watched_s = 0.0F;
            work.spend(settle_regions(simulation));
        }
        hide_sleepers(regions.asleep, simulation);
    }
    if (work.foreseeing()) {
        work.expect(1, cost_with(simulation.bodies.capacity + 1, cost_of_waking(simulation)));
        work.expect(1, cost_with(1, cost_of_settling(simulation)));
    }
}

/// Whether particles that were awake reach into that tile.
template <class Real>
bool is_wet(const Simulation<Real>& simulation, std::int32_t i, std::int32_t j) {
    bool wet = false;
    for_each_cell_of_tile(simulation.layers.shape, i, j, [&](std::int32_t cell) {
        wet = wet || simulation.pressure.density[cell] > Real(0);
    });
    return wet;
}

/// Looks at the empty tiles around sleepers, as far as the substep wrote what is in them.
template <class Real>
void watch_borders(Simulation<Real>& simulation) {
    Regions<Real>& regions = *simulation.regions;
    const GridShape part = simulation.occupied;
    static_assert(kWindowColumns % kTileEdge == 0 && kWindowRows % kTileEdge == 0,
                  "the part begins with a tile");
    const std::int32_t i1 = (part.i0 + part.nx - 1) / kTileEdge;
    const std::int32_t j1 = (part.j0 + part.ny - 1) / kTileEdge;
    for (std::int32_t j = part.j0 / kTileEdge; j <= j1; ++j) {
        for (std::int32_t i = part.i0 / kTileEdge; i <= i1; ++i) {
            if (regions.sleeps(j * regions.tiles_x + i)) {
                continue;
            }
            bool beside = false;
            for_each_tile_around(regions, i, j, [&](std::int32_t tile) {
                beside = beside || regions.sleeps(tile);
            });
            if (beside && is_wet(simulation, i, j)) {
                for_each_tile_around(regions, i, j, [&](std::int32_t tile) {
                    if (regions.sleeps(tile)) {
                        regions.wake(regions.tile[tile]);
                    }
                });
            }
        }
    }
}

template <class Real>
void end(Simulation<Real>& simulation, Work work, const StepReport& report) {
    Regions<Real>& regions = *simulation.regions;
    if (work.once(regions.tiles())) {
        // What is on its way out of a solid moves without a speed of its own.
        regions.restless = regions.restless || report.particles_stuck > 0;
        regions.stale = true;
        if (regions.asleep > 0) {
            watch_borders(simulation);
        }
        hide_sleepers(0, simulation);
    }
}

template <class Real>
void show_fields(Simulation<Real>& simulation) {
    Regions<Real>& regions = *simulation.regions;
    for (std::int32_t j = 0, tile = 0; regions.stale && j < regions.tiles_y; ++j) {
        for (std::int32_t i = 0; i < regions.tiles_x; ++i, ++tile) {
            if (regions.sleeps(tile)) {
                restore_pressure(simulation, i, j);
                for_each_cell_of_tile(simulation.layers.shape, i, j, [&](std::int32_t cell) {
                    simulation.pressure.density[cell] = regions.density[cell];
                });
            }
        }
    }
    regions.stale = false;
}

}  // namespace

template <class Real>
const RegionStages<Real>& region_stages() {
    static constexpr RegionStages<Real> kStages{begin<Real>,    end<Real>,       touch_box<Real>,
                                                touch_at<Real>, part_with<Real>, show_fields<Real>};
    return kStages;
}

#define WEIR_INSTANTIATE(Real) template const RegionStages<Real>& region_stages<Real>();
WEIR_FOR_EACH_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
