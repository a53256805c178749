// What a snapshot keeps of each record, and within which limits it is believed. Every record that
// holds state is taken apart here: a member that is added to one of them does not compile until
// somebody has decided whether it belongs to the state.
#pragma once

#include "step/part_met.hpp"
#include "step/regions.hpp"
#include "world/world_state.hpp"

namespace weir {

/// Numbers outside are no state of a world, in cells and seconds. Products of two are finite.
template <class Real>
struct Believed {
    static constexpr Real low = Real(-1.0e15);
    static constexpr Real high = Real(1.0e15);
    static constexpr Real furthest_vertex = Real(1.0e6);  ///< from its body's origin
};
/// Fixed-point numbers saturate: none is absurd.
template <int F, class S>
struct Believed<FixedPoint<F, S>> {
    static constexpr FixedPoint<F, S> low = FixedPoint<F, S>::of_raw(kLeastRaw);
    static constexpr FixedPoint<F, S> high = FixedPoint<F, S>::of_raw(kMostRaw);
    static constexpr FixedPoint<F, S> furthest_vertex = high;
};

/// Belts faster than twice what a definition may ask for are none: numbers of packed faces, to
/// which they are written, are rounded without asking whether they saturate.
template <class Real>
inline constexpr float kFastestBelt =
    2.0F * (Stored<Real>::coarse ? kMaxSpeedSmallFixed
                                 : (std::is_floating_point_v<Real> ? kMaxSpeed : kMaxSpeedFixed));

/// How much of the blocks there is.
struct Extents {
    std::int32_t particles = 0;
    std::int32_t vertices = 0;
    GridShape window = {};  ///< where the cells are, if not all of the tank is stored
};

template <class Real, class Stream>
void any_member(Stream& stream, Real& value) {
    stream.member(value, Believed<Real>::low, Believed<Real>::high);
}
template <class Real, class Stream>
void positive_member(Stream& stream, Real& value) {
    stream.member(value, Real{}, Believed<Real>::high);
}
/// An angle or a spin.
template <class Real, class Stream>
void angle_member(Stream& stream, Real& value) {
    stream.member(value, Real(-kMaxAngle), Real(kMaxAngle));
}
template <class Real, class Stream>
void any_member(Stream& stream, Vec2<Real>& vector) {
    any_member(stream, vector.x);
    any_member(stream, vector.y);
}

template <class Real, class Stream>
void law_members(Stream& stream, SurfaceLaw<Real>& law) {
    auto& [restitution, friction, conveyor, no_slip] = law;
    stream.member(restitution, Real(0), Real(1));
    positive_member(stream, friction);
    stream.member(conveyor, Real(-kFastestBelt<Real>), Real(kFastestBelt<Real>));
    stream.member(no_slip, false, true);
}

/// What calls change; the rest comes from the definition, which has to be the same. What a world is
/// not linked for it has none of.
template <class Real, class Stream>
void settings_members(Stream& stream, bool viscous, bool tense, Settings<Real>& settings) {
    [[maybe_unused]] auto& [gravity, rest_count, flip_ratio, volume_gain, full_sound, viscosity,
                            surface_tension, second_density, borders, cfl, sweeps,
                            max_substeps] = settings;
    [[maybe_unused]] auto& [wrap_x, wrap_y, is_viscous, bottom, right, top, left, odd] = borders;
    any_member(stream, gravity);
    stream.member(viscosity, Real(0), viscous ? Believed<Real>::high : Real(0));
    stream.member(surface_tension, Real(0), tense ? Believed<Real>::high : Real(0));
    law_members(stream, bottom);
    law_members(stream, right);
    law_members(stream, top);
    law_members(stream, left);
}

/// Whoever sleeps, but for tiles and what is kept of the grid, which are blocks.
template <class Real, class Stream>
void region_members(Stream& stream, std::int32_t particles, Regions<Real>& record) {
    [[maybe_unused]] auto& [stages, tiles_x, tiles_y, tile, kept_pressure, kept_density, speed,
                            after_s, asleep, hidden, watched_s, dt_s, used, woken, all_woken,
                            any_woken, restless, stale, phase] = record;
    stream.member(asleep, 0, particles);
    stream.member(watched_s, 0.0F, after_s);
    positive_member(stream, dt_s);
    for (std::int32_t k = 0; k < kRegionWords; ++k) {
        stream.member(used.bits[k], 0U, 0xFFFFFFFFU);
        stream.member(woken.bits[k], 0U, 0xFFFFFFFFU);
    }
    stream.member(all_woken, false, true);
    stream.member(any_woken, false, true);
    stream.member(restless, false, true);
    stream.member(phase, 0, kSampled - 1);
}

/// Room that liquid waits for which was added beneath the surface.
template <class Real, class Stream>
void inlet_members(Stream& stream, const GridShape& tank, Inlets<Real>& inlets) {
    const auto last = [](std::int32_t cells) { return static_cast<std::int16_t>(cells - 1); };
    [[maybe_unused]] auto& [make_room, make_room_around, noted, at] = inlets;
    const std::int32_t count = stream.member(noted, 0, kMostInlets);
    for (std::int32_t k = 0; k < count && k < kMostInlets; ++k) {
        auto& [i, j, owed] = at[k];
        stream.member(i, std::int16_t{0}, last(tank.nx));
        stream.member(j, std::int16_t{0}, last(tank.ny));
        stream.member(owed, Real(0), kMostOwed<Real>);
    }
}

/// Members of the world. Walls are drawn again from the bodies.
template <class Real, class Stream>
Extents world_members(Stream& stream, detail::WorldState<Real>& state) {
    auto& [simulation, def, cells_per_m, stepped_s, tag, stepping, density_stale, unit_exponent,
           still_s, still_gravity, pending, substeps_left, plan, progress, report,
           rest] = state;
    [[maybe_unused]] auto& [settings, particles, grid, occupied, window, pressure_fields,
                            bodies, layers, walls_behind, walls_moved, free_bodies, body_diagonal,
                            contacts, gathered, fall, look, extent, max_speed, ticks, stages,
                            regions, mass_matrix, row_order, tension, two_way, viscosity] =
        simulation;
    [[maybe_unused]] auto& [pressure, divergence, inverse_diagonal, density, level, coarse,
                            on_surface, leaps, drift_turn, quiet_turn, room_turns, crowded,
                            settling, inlets, last_dt, change, sound_speed, cell_weight,
                            solve, elasticity, second_liquid] = pressure_fields;
    auto& [position, velocity, count, capacity, kind, tag_of] = particles;
    [[maybe_unused]] auto& [body, body_capacity, used, movable, local, placed, pieces,
                            scratch_list, load, vertex_capacity, vertices_used] = bodies;
    auto& [shape, static_distance, static_nearest, walls, thin, touching, nodes,
           scratch] = layers;
    [[maybe_unused]] auto& [active, binary, any_sticking, sticking, moving,
                            distance, nearest, cell_case, open_u, open_v, full_density, near,
                            wall_body, thin_walls, wall_load, particle_mass, stored] = walls;
    settings_members(stream, viscosity != nullptr, tension != nullptr, settings);
    positive_member(stream, max_speed);
    positive_member(stream, last_dt);
    if constexpr (Stored<Real>::coarse) {
        const Real unit(1.0 / 128.0);
        stream.member(fall.owed.x, -unit, unit);
        stream.member(fall.owed.y, -unit, unit);
        stream.member(look.substeps_left, 0U, most_looking(shape));
    }
    stream.member(walls_behind, Seconds<Real>{}, Seconds<Real>(1));
    stream.member(change, Real(0), kMostRescale<Real>);
    stream.member(sound_speed, Real(0), elasticity != nullptr ? settings.sound_speed : Real(0));
    stream.member(on_surface, kNoTension, kPools);
    stream.member(drift_turn, 0, 0xFFFF);
    stream.member(quiet_turn, 0, kQuietEvery);
    stream.member(crowded, false, true);
    stream.member(room_turns, 0, kRoomTurns);
    stream.member(still_s, 0.0F, def.sleep.after_s);
    stream.member(stepped_s, 0.0F, 1.0e9F);
    any_member(stream, still_gravity);
    stream.member(pending, 0U, 0xFFFFFFFFU);
    if constexpr (kHasInlets<Real>) {
        inlet_members(stream, shape, inlets);
    }
    Extents extents;
    extents.particles = stream.member(count, 0, capacity);
    extents.vertices = stream.member(vertices_used, 0, vertex_capacity);
    if (regions != nullptr) {
        region_members(stream, extents.particles, *regions);
    }
    if constexpr (kHasWindow<Real>) {
        if (window.cells > 0) {
            GridShape& at = extents.window = stored.at;
            at.i0 = stream.member(at.i0, 0, shape.nx);
            at.j0 = stream.member(at.j0, 0, shape.ny);
            at.nx = stream.member(at.nx, 1, shape.nx);
            at.ny = stream.member(at.ny, 1, shape.ny);
            at.stride = at.nx + 2;
        }
    }
    return extents;
}

/// Members of a body. Its vertices are kept by slot, whatever their order in the pool was. Where it
/// is drawn follows from its pose: whether that has been done yet is no state.
template <class Real, class Stream>
void body_members(Stream& stream, std::int32_t most_places, const BodyTable<Real>& table,
                  Body<Real>& record) {
    [[maybe_unused]] auto& [position, velocity, angle, spin, surface, radius, first_vertex,
                            vertex_count, room, rings, piece_length, drawn, left, met_position,
                            met_angle, generation, kind, moved, open, hollow, led, leapt] = record;
    stream.member(kind, BodyKind::free, BodyKind::moving);
    stream.member(generation, 0, 0xFFFF);
    any_member(stream, position);
    any_member(stream, velocity);
    angle_member(stream, angle);
    angle_member(stream, spin);
    law_members(stream, surface);
    positive_member(stream, radius);
    stream.member(open, false, true);
    stream.member(led, Lead::none, Lead::held);
    stream.member(leapt, false, true);
    any_member(stream, met_position);
    angle_member(stream, met_angle);
    const std::int32_t places = stream.member(room, 0, most_places);
    const std::int32_t count = stream.member(vertex_count, 0, places);
    const std::int32_t ends = stream.member(rings, 1, maximum(count, 1));
    const std::int32_t most = maximum(table.per_vertex() * places - ends, 0);
    stream.member(piece_length, 0, table.scratch.empty() ? 0 : most);
}

}  // namespace weir
