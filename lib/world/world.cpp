// The world's life: memory. Liquid is in world_liquid.cpp, bodies in world_bodies.cpp, views of the
// grid in world_views.cpp, the step in world_step.cpp.
#include "weir/world.hpp"

#include <cstring>
#include <new>

#include "math/lanes.hpp"
#include "step/substep.hpp"
#include "step/window.hpp"
#include "world/settings_of.hpp"

namespace weir {

namespace {

using detail::WorldState;

class Carver {
public:
    Carver(void* memory, const Layout& plan)
        : memory_(static_cast<std::byte*>(memory)), plan_(plan) {}

    template <class T>
    void take(Block block, T*& pointer) const {
        pointer = reinterpret_cast<T*>(memory_ + plan_.offset[static_cast<std::int32_t>(block)]);
    }

    std::int32_t elements(Block block) const {
        const auto slot = static_cast<std::int32_t>(block);
        return static_cast<std::int32_t>(plan_.bytes[slot] / plan_.element_bytes[slot]);
    }

private:
    std::byte* memory_;
    const Layout& plan_;
};

template <class Real>
void carve_solids(const Carver& carver, const Capacity& capacity, Simulation<Real>& simulation) {
    BodyTable<Real>& bodies = simulation.bodies;
    carver.take(Block::body_table, bodies.body);
    carver.take(Block::vertex_local, bodies.local);
    carver.take(Block::vertex_placed, bodies.placed);
    carver.take(Block::piece_index, bodies.pieces);
    carver.take(Block::decomposition_scratch, bodies.scratch.data);
    bodies.scratch.size = keeps_pieces<Real>(capacity)
                              ? static_cast<std::int32_t>(kScratchPerVertex) * capacity.vertices
                              : 0;
    bodies.capacity = static_cast<std::int16_t>(capacity.bodies);
    bodies.vertex_capacity = capacity.vertices;

    Layers<Real>& layers = simulation.layers;
    carver.take(Block::static_distance, layers.static_distance);
    carver.take(Block::static_body, layers.static_nearest);
    carver.take(Block::merged_distance, layers.walls.distance);
    carver.take(Block::merged_body, layers.walls.nearest);
    if (!keeps_names<Real>(capacity)) {
        layers.static_nearest = layers.walls.nearest = nullptr;
    }
    if (!capacity.moving_bodies) {  // nothing is ever drawn onto the static layer: it is the merged
        layers.static_distance = layers.walls.distance;
        layers.static_nearest = layers.walls.nearest;
    }
    carver.take(Block::contour_case, layers.walls.cell_case);
    carver.take(Block::near_wall, layers.walls.near);
    carver.take(Block::open_u, layers.walls.open_u);
    carver.take(Block::open_v, layers.walls.open_v);
    carver.take(Block::full_density, layers.walls.full_density);
    layers.scratch = simulation.pressure.inverse_diagonal;  // rebuilt by every pressure solve
    if constexpr (Stored<Real>::shares_momentum) {
        layers.nodes = simulation.grid.momentum_u();
    } else {
        layers.nodes = layers.scratch;
    }
    if constexpr (kHasWindow<Real>) {
        layers.walls.stored.bodies = is_windowed(capacity) ? &bodies : nullptr;
    }
    layers.walls.body = bodies.body;
    if (kHasThinWalls<Real> && capacity.bodies > 0 && capacity.wall_edges > 0) {
        ThinWalls<Real>& thin = layers.thin;
        carver.take(Block::wall_edge, thin.edge);
        carver.take(Block::wall_edge_of_cell, thin.first);
        carver.take(Block::wall_mark, thin.mark);
        carver.take(Block::wall_span, thin.span);
        carver.take(Block::wall_body, thin.body);
        thin.vertex = bodies.placed;
        thin.capacity = static_cast<std::uint16_t>(capacity.wall_edges);
    }
}

template <class Real>
void carve_coarse(const Carver& carver, const Capacity& capacity, PressureFields<Real>& pressure) {
    CoarseGrid<Real>& coarse = pressure.coarse;
    if constexpr (Stored<Real>::shares_momentum) {  // only the volume asks, after the pressure
        coarse.correction = pressure.inverse_diagonal;
        coarse.residual = pressure.inverse_diagonal + coarse_entries<Real>(capacity);
    } else {
        const std::int32_t count = coarse_fields_of<Real>(capacity);
        const std::int32_t entries = carver.elements(Block::coarse_cells) / count;
        Real* next = nullptr;
        carver.take(Block::coarse_cells, next);
        if (capacity.bodies > 0) {
            carver.take(Block::coarse_cut, coarse.cut_off);
        }
        Real** const fields[] = {&coarse.correction, &coarse.residual, &coarse.inverse_diagonal,
                                 &coarse.weight_u,   &coarse.weight_v, &coarse.centre_x,
                                 &coarse.centre_y,   &coarse.reach_u,  &coarse.reach_v};
        for (std::int32_t k = 0; k < count; ++k) {
            *fields[k] = next;
            next += entries;
        }
        if (!capacity.second_liquid) {
            coarse.reach_u = coarse.weight_u;
            coarse.reach_v = coarse.weight_v;
        }
    }
}

template <class Real>
void carve(const Carver& carver, const Capacity& capacity, const Borders<Real>& borders,
           Simulation<Real>& simulation) {
    simulation.layers.shape = {capacity.cells_x, capacity.cells_y};
    if constexpr (kHasWindow<Real>) {
        simulation.window.cells = is_windowed(capacity) ? capacity.window_cells : 0;
    }
    carver.take(Block::particle_position, simulation.particles.position);
    carver.take(Block::particle_velocity, simulation.particles.velocity);
    simulation.particles.capacity = capacity.particles;
    if (capacity.particle_tags) {
        carver.take(Block::particle_tag, simulation.particles.tag);
    }
    if (capacity.second_liquid) {
        carver.take(Block::particle_kind, simulation.particles.kind);
        carver.take(Block::inverse_density_u, simulation.grid.inverse_density_u);
        carver.take(Block::inverse_density_v, simulation.grid.inverse_density_v);
    }
    if (capacity.two_way) {
        carver.take(Block::body_load, simulation.bodies.load);
        if constexpr (kHasFreeBodies<Real>) {
            carver.take(Block::body_diagonal, simulation.body_diagonal);
        }
        simulation.layers.walls.load = simulation.bodies.load;
    }
#if WEIR_PARALLEL
    if (row_spans<Real>(capacity) > 0) {
        carver.take(Block::row_span, simulation.grid.row_spans);
    }
#endif
    carver.take(Block::velocity_u, simulation.grid.u);
    carver.take(Block::velocity_v, simulation.grid.v);
    carver.take(Block::mass_u, simulation.grid.mass_u);
    carver.take(Block::mass_v, simulation.grid.mass_v);
    carver.take(Block::pressure, simulation.pressure.pressure);
    carver.take(Block::divergence, simulation.pressure.divergence);
    carver.take(Block::inverse_diagonal, simulation.pressure.inverse_diagonal);
    if constexpr (Stored<Real>::shares_momentum) {
        simulation.pressure.divergence = simulation.grid.u + cell_entries<Real>(capacity);
        simulation.pressure.inverse_diagonal = simulation.grid.v + cell_entries<Real>(capacity);
    } else {
        simulation.grid.pairs = simulation.pressure.divergence;  // and the inverse diagonal behind
    }
    carver.take(Block::density, simulation.pressure.density);
    carver.take(Block::level, simulation.pressure.level);
    carve_coarse(carver, capacity, simulation.pressure);
#if WEIR_PARALLEL
    if constexpr (kHasLanes<Real>) {
        simulation.grid.spans = {simulation.pressure.coarse.correction,
                                 carver.elements(Block::coarse_cells)};
    }
#endif
    carve_solids(carver, capacity, simulation);
    carver.take(Block::contact, simulation.contacts.entry);
    simulation.contacts.capacity = static_cast<std::uint16_t>(capacity.contacts);
    const GridShape tank{capacity.cells_x, capacity.cells_y, capacity.cells_x + 2};
    number_cells(is_windowed(capacity) ? least_window(capacity, borders.wrap_x, borders.wrap_y)
                                       : tank,
                 simulation);
    simulation.grid.shape = simulation.layers.shape;
    simulation.occupied = stored_part(simulation);
}

/// After fewer a coarse correction may leave more energy; in its place packed worlds add two.
template <class Real>
constexpr std::int32_t kLeastSweeps = Stored<Real>::coarse ? 2 : 4;

/// With an equation of state a blow stores much where the liquid is thin: some share of PIC keeps
/// that from tearing it apart.
template <class Real>
constexpr Real kElasticFlip = Real(0.97);

template <class Real>
Settings<Real> settings_of(const WorldState<Real>& state) {
    Settings<Real> settings;
    const WorldDef& def = state.def;
    const Face<Real> pace = pace_of(state);
    const Vec2<Face<Real>> gravity = pull_of(state) * convert<Face<Real>>(def.gravity_mps2);
    settings.gravity = convert<Real>(gravity);
    settings.rest_count = static_cast<Real>(def.particles_per_cell);
    const bool elastic = def.pressure == Pressure::equation_of_state;
    settings.flip_ratio =
        minimum(static_cast<Real>(def.flip_ratio), elastic ? kElasticFlip<Real> : Real(1));
    settings.volume_gain = static_cast<Real>(def.volume_gain);
    settings.viscosity = viscosity_of(state, def.viscosity_m2ps);
    settings.surface_tension = surface_tension_of(state, def.surface_tension_m3ps2);
    settings.second_density = static_cast<Real>(def.second_density_ratio);
    Borders<Real>& borders = settings.borders;
    borders.wrap_x = def.periodic_x;
    borders.wrap_y = def.periodic_y;
    borders.viscous = settings.viscosity > Real(0);
    set_laws(def.walls, pace, borders);
    settings.cfl = static_cast<Real>(def.cfl);
    settings.sweeps = static_cast<std::int16_t>(maximum(def.pressure_sweeps, kLeastSweeps<Real>));
    settings.max_substeps = static_cast<std::int16_t>(def.max_substeps);
    Face<Real> sound_speed = pace * static_cast<Face<Real>>(def.sound_speed_mps);
    if (def.sound_speed_mps == 0.0F) {
        // Liquid without weight is thrown about all the same, and may get its weight later.
        constexpr Vec2f kUsual = WorldDef{}.gravity_mps2;
        const bool weightless = def.gravity_mps2.x == 0.0F && def.gravity_mps2.y == 0.0F;
        const Vec2<Face<Real>> pull =
            weightless ? pull_of(state) * convert<Face<Real>>(kUsual) : gravity;
        const Face<Real> drop =
            static_cast<Face<Real>>(def.capacity.cells_x) * absolute(pull.x) +
            static_cast<Face<Real>>(def.capacity.cells_y) * absolute(pull.y);
        sound_speed = Face<Real>(10) * square_root(Face<Real>(2) * drop);
    }
    settings.sound_speed = static_cast<Real>(sound_speed);
    return settings;
}

/// What a blow counts, in the units of the public face.
template <class Real>
void name_units(WorldState<Real>& state) {
    Contacts<Real>& contacts = state.simulation.contacts;
    const WorldDef& def = state.def;
    contacts.cell_m = def.cell_m;
    contacts.particle_m2 =
        def.cell_m * def.cell_m / static_cast<float>(def.particles_per_cell) * units_per_s(state);
    contacts.second_density = def.second_density_ratio;
    contacts.world = state.tag;
}

/// Hardly ever the same for two worlds that live at the same time, and never within 700 KB (of
/// Fibonacci hashing, Knuth 1973). Part of names only, never of the state.
std::uint16_t tag_of(const void* memory) {
    const auto address = static_cast<std::uint64_t>(reinterpret_cast<std::uintptr_t>(memory));
    return static_cast<std::uint16_t>((address / world_alignment * 0x9E3779B97F4A7C15ULL) >> 48U);
}

}  // namespace

template <class Real>
Status World<Real>::init_with(const detail::Features<Real>& features, const WorldDef& def,
                              void* memory, std::size_t bytes) {
    const std::int32_t unit = unit_exponent_of<Real>(def);
    const Status valid = check_world(def, reach_of<Real>(unit));
    if (valid != Status::ok) {
        return valid;
    }
    const Layout plan = layout<Real>(def.capacity);
    const Status fits = check_memory(memory, bytes, plan.total_bytes);
    if (fits != Status::ok) {
        return fits;
    }
    std::memset(memory, 0, plan.total_bytes);
    state_ = new (memory) State(def);
    state_->tag = tag_of(memory);
    state_->still_gravity_mps2 = def.gravity_mps2;
    state_->cells_per_m = Face<Real>(1) / static_cast<Face<Real>>(def.cell_m);
    state_->unit_exponent = static_cast<std::int8_t>(unit);
    Simulation<Real>& simulation = state_->simulation;
    simulation.settings = settings_of(*state_);
    simulation.settings.borders.odd = features.odd_borders;
    carve(Carver(memory, plan), def.capacity, simulation.settings.borders, simulation);
    simulation.pressure.leaps =
        simulation.grid.inverse_density_u == nullptr || def.second_density_ratio == 1.0F;
    state_->rest = features.rest;
    simulation.mass_matrix = features.mass_matrix;
    simulation.row_order = features.row_order;
    simulation.tension = features.tension;
    simulation.two_way = features.two_way;
    simulation.viscosity = features.viscosity;
    simulation.pressure.elasticity = features.elasticity;
    simulation.pressure.second_liquid = features.second_liquid;
    simulation.ticks = def.ticks;
#if WEIR_PARALLEL
    state_->progress.parallel_for = def.parallel_for;
#endif
    simulation.stages = features.stages;
    simulation.layers.touching = features.touching;
    simulation.contacts.blows = features.blows;
    simulation.layers.walls.binary = def.contour == Contour::mid_edge;
    name_units(*state_);
    for (std::int32_t slot = 0; slot < def.capacity.bodies; ++slot) {
        new (simulation.bodies.body + slot) Body<Real>();
    }
    if constexpr (kHasThinWalls<Real>) {
        clear_thin_walls(simulation.layers.thin, simulation.grid.shape, def.capacity.bodies);
    }
    if (def.capacity.two_way) {
        for (std::int32_t slot = 0; slot < load_records<Real>(def.capacity.bodies); ++slot) {
            new (simulation.bodies.load + slot) BodyLoad<Real>();
        }
        const auto share = Face<Real>(1) / static_cast<Face<Real>>(def.particles_per_cell);
        simulation.layers.walls.particle_mass[0] = share;
        simulation.layers.walls.particle_mass[1] =
            share * static_cast<Face<Real>>(def.second_density_ratio);
    }
    simulation.stages->draw_stored(simulation.layers, simulation.bodies);
    return Status::ok;
}

template <class Real>
float World<Real>::cell_m() const {
    return state_ == nullptr ? 0.0F : state_->def.cell_m;
}

template <class Real>
std::int32_t World<Real>::cells_x() const {
    return state_ == nullptr ? 0 : state_->def.capacity.cells_x;
}

template <class Real>
std::int32_t World<Real>::cells_y() const {
    return state_ == nullptr ? 0 : state_->def.capacity.cells_y;
}

#define WEIR_INSTANTIATE(Real)                                            \
    template Status World<Real>::init_with(const detail::Features<Real>&, \
                                           const WorldDef&, void*,        \
                                           std::size_t);                  \
    template float World<Real>::cell_m() const;                           \
    template std::int32_t World<Real>::cells_x() const;                   \
    template std::int32_t World<Real>::cells_y() const;
WEIR_FOR_EACH_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
