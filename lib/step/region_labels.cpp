#include "step/regions.hpp"

namespace weir {

namespace {

/// Tiles that hold liquid, and who of them belongs together: each names another of its region, or
/// itself (Galler & Fischer 1964). Diagonal neighbours belong together, too.
struct Labels {
    std::int32_t* parent;  ///< −1: dry
    std::int32_t* verdict;  ///< of a tile that names itself: 0 at rest, −1 not, or its new number
    std::int32_t tiles_x;
    std::int32_t tiles_y;

    std::int32_t first_of(std::int32_t tile) const {
        while (parent[tile] != tile) {
            parent[tile] = parent[parent[tile]];
            tile = parent[tile];
        }
        return tile;
    }
    void join(std::int32_t a, std::int32_t b) const {
        const std::int32_t first = first_of(a);
        parent[first] = first_of(b);
    }
    template <class Visit>
    void for_each_wet(Visit visit) const {
        for (std::int32_t j = 0, tile = 0; j < tiles_y; ++j) {
            for (std::int32_t i = 0; i < tiles_x; ++i, ++tile) {
                if (parent[tile] >= 0) {
                    visit(tile, i, j);
                }
            }
        }
    }
};

/// Room for two numbers a tile: faces are not yet in use.
template <class Real>
Labels labels_of(const Simulation<Real>& simulation) {
    const Regions<Real>& regions = *simulation.regions;
    return {reinterpret_cast<std::int32_t*>(simulation.grid.u),
            reinterpret_cast<std::int32_t*>(simulation.grid.v), regions.tiles_x, regions.tiles_y};
}

template <class Real>
void find_regions(const Particles<Real>& awake, const Regions<Real>& regions,
                  const Labels& labels) {
    for (std::int32_t tile = 0; tile < regions.tiles(); ++tile) {
        labels.parent[tile] = -1;
        labels.verdict[tile] = 0;
    }
    for (std::int32_t k = 0; k < awake.count; ++k) {
        const std::int32_t tile = regions.tile_of(awake.position[k]);
        labels.parent[tile] = tile;
    }
    labels.for_each_wet([&](std::int32_t tile, std::int32_t i, std::int32_t j) {
        for_each_tile_around(regions, i, j, [&](std::int32_t other) {
            if (other < tile && labels.parent[other] >= 0) {
                labels.join(tile, other);
            }
        });
    });
}

/// A region in which something was fast, or beside which, does not sleep.
template <class Real>
void judge_regions(const Particles<Real>& awake, const Regions<Real>& regions,
                   const Labels& labels) {
    labels.for_each_wet([&](std::int32_t tile, std::int32_t i, std::int32_t j) {
        for_each_tile_around(regions, i, j, [&](std::int32_t other) {
            if (regions.tile[other] == kRestless) {
                labels.verdict[labels.first_of(tile)] = -1;
            }
        });
    });
    for (std::int32_t k = 0; k < awake.count; ++k) {
        if (fastest_part<Real>(awake.velocity[k]) > regions.speed) {
            labels.verdict[labels.first_of(regions.tile_of(awake.position[k]))] = -1;
        }
    }
}

std::uint8_t free_number(RegionSet& used) {
    std::uint8_t number = 1;
    while (number < kMostRegions && used.has(number)) {
        ++number;
    }
    used.add(number);
    return number;
}

/// Remembers what the next solve would start from.
template <class Real>
void keep_fields(const Simulation<Real>& simulation, std::int32_t i, std::int32_t j) {
    const PressureFields<Real>& fields = simulation.pressure;
    Regions<Real>& regions = *simulation.regions;
    if (regions.asleep == 0) {
        regions.dt_s = fields.last_dt;
    }
    const bool same = !(fields.last_dt > Seconds<Real>{}) || fields.last_dt == regions.dt_s;
    const Real scale = same ? Real(1) : regions.dt_s / fields.last_dt;
    for_each_cell_of_tile(simulation.layers.shape, i, j, [&](std::int32_t cell) {
        regions.pressure[cell] = scale * fields.pressure[cell];
        regions.density[cell] = fields.density[cell];
    });
}

/// Gives each region at rest a number, and all its tiles.
template <class Real>
void number_regions(Simulation<Real>& simulation, const Labels& labels) {
    Regions<Real>& regions = *simulation.regions;
    labels.for_each_wet([&](std::int32_t tile, std::int32_t i, std::int32_t j) {
        const std::int32_t first = labels.first_of(tile);
        if (labels.verdict[first] == 0) {
            labels.verdict[first] = free_number(regions.used);
        }
        if (labels.verdict[first] > 0) {
            regions.tile[tile] = static_cast<std::uint8_t>(labels.verdict[first]);
            keep_fields(simulation, i, j);
        }
    });
}

}  // namespace

template <class Real>
std::int32_t settle_regions(Simulation<Real>& simulation) {
    Regions<Real>& regions = *simulation.regions;
    Particles<Real>& pool = simulation.particles;
    const Particles<Real> awake = pool.part(regions.asleep, pool.count - regions.asleep);
    if (!regions.restless) {
        const Labels labels = labels_of(simulation);
        find_regions(awake, regions, labels);
        judge_regions(awake, regions, labels);
        number_regions(simulation, labels);
        for (std::int32_t k = regions.asleep; k < pool.count; ++k) {
            if (regions.sleeps(regions.tile_of(pool.position[k]))) {
                pool.swap(k, regions.asleep++);
            }
        }
    }
    for (std::int32_t tile = 0; tile < regions.tiles(); ++tile) {
        regions.tile[tile] = regions.tile[tile] == kRestless ? kNoRegion : regions.tile[tile];
    }
    regions.restless = false;
    return cost_of_settling(simulation);
}

template <class Real>
std::int32_t cost_of_settling(const Simulation<Real>& simulation) {
    return 3 * simulation.particles.count + 2 * kTileEdge * kTileEdge * simulation.regions->tiles();
}

#define WEIR_INSTANTIATE(Real)                                \
    template std::int32_t settle_regions(Simulation<Real>&); \
    template std::int32_t cost_of_settling(const Simulation<Real>&);
WEIR_FOR_EACH_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
