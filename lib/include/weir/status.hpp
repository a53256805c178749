// What a set-up call answers. Every way to be refused has a name of its own, and the name's text
// says the remedy.
#pragma once

#include <cstdint>

namespace weir {

enum class [[nodiscard]] Status : std::uint8_t {
    ok = 0,
    // init
    cells_out_of_range,
    particle_capacity_out_of_range,
    body_capacity_out_of_range,
    vertex_capacity_out_of_range,
    contact_capacity_out_of_range,
    wall_edge_capacity_out_of_range,
    cell_size_out_of_range,
    gravity_not_finite,
    gravity_out_of_range,
    particles_per_cell_out_of_range,
    sweeps_out_of_range,
    substeps_out_of_range,
    cfl_out_of_range,
    flip_ratio_out_of_range,
    volume_gain_out_of_range,
    sound_speed_out_of_range,
    restitution_out_of_range,
    friction_out_of_range,
    body_density_out_of_range,
    viscosity_out_of_range,
    surface_tension_out_of_range,
    surface_tension_needs_projection,
    density_ratio_out_of_range,
    second_liquid_needs_projection,
    conveyor_out_of_range,
    sleep_out_of_range,
    periodic_with_bodies,
    periodic_needs_even_cells,
    unknown_option,
    small_fixed_has_one_liquid,
    small_fixed_has_no_tension,
    small_fixed_has_no_thin_walls,
    small_fixed_has_no_window,
    window_out_of_range,
    window_too_small,
    window_without_bodies,
    memory_missing,
    memory_misaligned,
    memory_too_small,
    not_initialised,
    step_in_progress,
    // bodies
    no_free_body,
    no_free_vertex,
    stale_body,
    body_is_static,
    no_moving_bodies,
    polygon_missing,
    polygon_too_few_vertices,
    polygon_too_many_vertices,
    polygon_not_finite,
    polygon_zero_area,
    polygon_crosses_itself,
    polygon_hole_crosses,
    polygon_hole_outside,
    polyline_has_holes,
    no_free_wall_edge,
    polygon_outside_domain,
    position_out_of_range,
    motion_not_finite,
    motion_out_of_range,
    output_missing,
    two_way_missing,
    free_body_in_small_world,
    // particles
    no_free_particle,
    no_such_particle,
    no_second_liquid,
    particle_not_finite,
    particle_outside_domain,
    particle_inside_solid,
    velocity_out_of_range,
    box_not_finite,
    box_is_empty,
    box_outside_domain,
    // snapshots
    snapshot_missing,
    snapshot_room_too_small,
    snapshot_truncated,
    snapshot_not_recognised,
    snapshot_of_other_version,
    snapshot_of_other_scalar,
    snapshot_of_other_capacity,
    snapshot_of_other_definition,
    snapshot_damaged,
    count
};

/// One sentence for people: what was wrong and what to do. Never null.
const char* status_text(Status status);

}  // namespace weir
