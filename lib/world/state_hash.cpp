// The hash of all that decides the future.
#include "base/hash.hpp"
#include "world/settings_of.hpp"
#include "world/sleep.hpp"

namespace weir {

namespace {

/// Of all cells of the tank: those that are not stored are empty, those that sleep are kept apart.
template <class Real>
void hash_pressure(Hash& hash, const Simulation<Real>& simulation) {
    const GridShape& tank = simulation.layers.shape;
    const GridShape window = stored_part(simulation);
    const Regions<Real>* regions = simulation.regions;
    const std::int32_t first = maximum(0, window.i0 - 1);
    const std::int32_t end = minimum(tank.nx, window.i0 + window.nx + 1);
    const auto pass_empty = [&](std::int32_t cells) {
        constexpr auto kWords = static_cast<std::uint32_t>(sizeof(Real) / sizeof(std::uint32_t));
        if constexpr (kHasWindow<Real>) {
            hash.add_zeros(kWords * static_cast<std::uint32_t>(cells));
        }
    };
    for (std::int32_t j = 0; j < tank.ny; ++j) {
        if (j < window.j0 - 1 || j > window.j0 + window.ny) {
            pass_empty(tank.nx);
            continue;
        }
        pass_empty(first);
        for (std::int32_t i = first; i < end; ++i) {
            const bool asleep = regions != nullptr && regions->sleeps(regions->tile_at(i, j));
            const Real* field = asleep ? regions->pressure : simulation.pressure.pressure;
            hash.add(field[tank.index(i, j)]);
        }
        pass_empty(tank.nx - end);
    }
}

template <class Real>
void hash_regions(Hash& hash, const Regions<Real>& regions) {
    hash.add(regions.asleep);
    hash.add(regions.watched_s);
    hash.add(regions.dt_s);
    const bool flags[] = {regions.all_woken, regions.any_woken, regions.restless};
    for (const bool flag : flags) {
        hash.add(static_cast<std::uint32_t>(flag));
    }
    hash.add(static_cast<std::uint32_t>(regions.phase));
    for (std::int32_t k = 0; k < kRegionWords; ++k) {
        hash.add(regions.used.bits[k]);
        hash.add(regions.woken.bits[k]);
    }
    for (std::int32_t tile = 0; tile < regions.tiles(); ++tile) {
        hash.add(static_cast<std::uint32_t>(regions.tile[tile]));
    }
}

/// Where particles last met a thin wall: from there on it sweeps them along in the next step.
template <class Real>
void hash_way(Hash& hash, const Body<Real>& body) {
    hash.add(body.met_position.x);
    hash.add(body.met_position.y);
    hash.add(body.met_angle);
}

template <class Real>
void hash_bodies(Hash& hash, const BodyTable<Real>& table, bool thin_walls) {
    for (std::int32_t slot = 0; slot < table.capacity; ++slot) {
        const Body<Real>& body = table.body[slot];
        hash.add(static_cast<std::uint32_t>(body.generation));
        hash.add(static_cast<std::uint32_t>(body.kind));
        if (body.kind == BodyKind::free) {
            continue;
        }
        const Real numbers[] = {body.position.x, body.position.y, body.velocity.x, body.velocity.y,
                                body.angle,      body.spin,       body.surface.restitution,
                                body.surface.friction, body.surface.conveyor};
        for (const Real number : numbers) {
            hash.add(number);
        }
        hash.add(static_cast<std::uint32_t>(body.surface.no_slip));
        if (thin_walls && body.kind == BodyKind::moving) {
            hash_way(hash, body);
        }
        if (body.open) {
            hash.add(std::uint32_t{1});
        }
        if (body.led != Lead::none) {
            hash.add(std::uint32_t{body.led == Lead::now ? 2U : 4U});
        }
        if (body.leapt) {
            hash.add(std::uint32_t{3});
        }
        for (std::int32_t ring = 0; body.rings > 1 && ring < body.rings; ++ring) {
            hash.add(table.outline(body).end_of(ring));
        }
        if (table.load != nullptr && table.load[slot].is_free_or_led()) {
            const BodyLoad<Real>& load = table.load[slot];
            const Face<Real> weights[] = {load.inverse_mass, load.inverse_inertia, load.ease,
                                          load.blows.linear.x, load.blows.linear.y,
                                          load.blows.angular, load.blow_mass};
            for (const Face<Real> weight : weights) {
                hash.add(weight);
            }
            if (load.slides.x * load.slides.y != Face<Real>(1)) {
                hash.add(load.slides.x);
                hash.add(load.slides.y);
            }
        }
        for (std::int32_t k = 0; k < body.vertex_count; ++k) {
            hash.add(table.local[body.first_vertex + k].x);
            hash.add(table.local[body.first_vertex + k].y);
        }
    }
}

/// Two worlds of a definition differ by what calls made of it. What is as defined is no state.
template <class Real>
void hash_settings(Hash& hash, const detail::WorldState<Real>& state) {
    const Settings<Real>& now = state.simulation.settings;
    const WorldDef& def = state.def;
    Borders<Real> defined;
    set_laws(def.walls, pace_of(state), defined);
    const Borders<Real>& b = now.borders;
    if (now.viscosity == viscosity_of(state, def.viscosity_m2ps) &&
        now.surface_tension == surface_tension_of(state, def.surface_tension_m3ps2) &&
        alike(b.bottom, defined.bottom) && alike(b.right, defined.right) &&
        alike(b.top, defined.top) && alike(b.left, defined.left)) {
        return;
    }
    hash.add(now.viscosity);
    hash.add(now.surface_tension);
    const SurfaceLaw<Real>* const laws[] = {&b.bottom, &b.right, &b.top, &b.left};
    for (const SurfaceLaw<Real>* law : laws) {
        const Real numbers[] = {law->restitution, law->friction, law->conveyor};
        for (const Real number : numbers) {
            hash.add(number);
        }
        hash.add(static_cast<std::uint32_t>(law->no_slip));
    }
}

}  // namespace

template <class Real>
std::uint64_t World<Real>::state_hash() const {
    if (state_ == nullptr) {
        return 0;
    }
    const Simulation<Real>& simulation = state_->simulation;
    Hash hash;
    const Particles<Real>& particles = simulation.particles;
    hash.add(particles.count);
    for (std::int32_t k = 0; k < particles.count; ++k) {
        hash.add(particles.position[k].x);
        hash.add(particles.position[k].y);
        hash.add(particles.velocity[k].x);
        hash.add(particles.velocity[k].y);
        if (particles.kind != nullptr) {
            hash.add(static_cast<std::uint32_t>(particles.kind[k]));
        }
    }
    hash_pressure(hash, simulation);
    hash.add(simulation.pressure.last_dt);
    const Real numbers[] = {simulation.pressure.change, simulation.max_speed,
                            simulation.settings.gravity.x, simulation.settings.gravity.y};
    for (const Real number : numbers) {
        hash.add(number);
    }
    hash_settings(hash, *state_);
    if (simulation.walls_behind_s > Seconds<Real>{}) {
        hash.add(simulation.walls_behind_s);
    }
    if (simulation.pressure.sound_speed > Real(0)) {
        hash.add(simulation.pressure.sound_speed);
    }
    if constexpr (Stored<Real>::coarse) {
        const Vec2<Real> owed = simulation.fall.owed;
        if (owed.x != Real(0) || owed.y != Real(0)) {
            hash.add(owed.x);
            hash.add(owed.y);
        }
        if (simulation.look.substeps_left > 0) {
            hash.add(simulation.look.substeps_left);
        }
    }
    if (simulation.pressure.room_turns > 0) {
        hash.add(static_cast<std::int32_t>(simulation.pressure.room_turns));
    }
    if constexpr (kHasInlets<Real>) {
        const Inlets<Real>& inlets = simulation.pressure.inlets;
        for (std::int32_t k = 0; k < inlets.count; ++k) {
            const auto& [i, j, owed] = inlets.at[k];
            hash.add(static_cast<std::int32_t>(i));
            hash.add(static_cast<std::int32_t>(j));
            hash.add(owed);
        }
    }
    if (may_sleep(*state_)) {
        hash.add(state_->still_s);
        hash.add(state_->still_gravity_mps2.x);
        hash.add(state_->still_gravity_mps2.y);
    }
    if (simulation.regions != nullptr) {
        hash_regions(hash, *simulation.regions);
    }
    hash_bodies(hash, simulation.bodies, simulation.layers.thin.capacity > 0);
    return hash.value();
}

#define WEIR_INSTANTIATE(Real) \
    template std::uint64_t World<Real>::state_hash() const;
WEIR_FOR_EACH_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
