// Texts for people: statuses with their remedies, stages, owners.
#include "weir/memory.hpp"
#include "weir/report.hpp"
#include "weir/status.hpp"

namespace weir {

namespace {

/// Answers of `init` about the capacity. Null for another.
const char* capacity_text(Status status) {
    switch (status) {
        case Status::cells_out_of_range:
            return "cells_x, cells_y: choose 4 … 8192, in Fixed 256, in SmallFixed 255";
        case Status::particle_capacity_out_of_range:
            return "capacity.particles: choose 1 … 16777216";
        case Status::body_capacity_out_of_range:
            return "capacity.bodies: choose 0 … 4096, in SmallFixed 255";
        case Status::vertex_capacity_out_of_range:
            return "capacity.vertices: choose 0 … 1048576";
        case Status::contact_capacity_out_of_range: return "capacity.contacts: choose 0 … 4096";
        case Status::wall_edge_capacity_out_of_range:
            return "capacity.wall_edges: choose 0 … 65000";
        case Status::window_out_of_range:
            return "capacity.window_cells: choose 0 … the cells of the largest tank";
        case Status::window_too_small:
            return "capacity.window_cells: at least 66 × 18, with bodies × 26, on a seam all";
        case Status::window_without_thin_walls:
            return "with capacity.window_cells no thin walls are kept: leave wall_edges at 0";
        case Status::window_without_forces:
            return "with capacity.window_cells no forces are counted: leave two_way off";
        case Status::regions_out_of_place:
            return "capacity.sleeping_regions: not with two_way, window_cells or periodic borders";
        default: return nullptr;
    }
}

/// Other answers of `init`, and what any call answers before it. Null for another.
const char* init_text(Status status) {
    switch (status) {
        case Status::ok: return "ok";
        case Status::cell_size_out_of_range: return "cell_m: choose 1e-6 … 1e3 m";
        case Status::gravity_not_finite: return "gravity is NaN or infinite: give a finite vector";
        case Status::gravity_out_of_range:
            return "gravity: at most 1000 m/s² along each axis, in fixed point 30000 cells/s², "
                   "less with a low top_speed_mps";
        case Status::top_speed_out_of_range: return "top_speed_mps: choose 0 … 2040 cells a second";
        case Status::particles_per_cell_out_of_range:
            return "particles_per_cell: choose 1, 4, 9 or 16";
        case Status::sweeps_out_of_range: return "pressure_sweeps: choose 1 … 1000";
        case Status::substeps_out_of_range: return "max_substeps: choose 1 … 1000";
        case Status::cfl_out_of_range: return "cfl: choose 0.1 … 2 cells";
        case Status::flip_ratio_out_of_range: return "flip_ratio: choose 0 … 1";
        case Status::volume_gain_out_of_range: return "volume_gain: choose 0 … 1";
        case Status::sound_speed_out_of_range:
            return "sound_speed_mps: choose 0 (automatic) or at most 1e6 cells a second";
        case Status::restitution_out_of_range: return "restitution: choose 0 (slide) … 1 (mirror)";
        case Status::body_density_out_of_range: return "density_ratio: choose 1e-3 … 1e3";
        case Status::friction_out_of_range: return "friction: choose 0 (none) … 1000";
        case Status::viscosity_out_of_range:
            return "viscosity_m2ps: choose 0 … 1e6 cells² a second";
        case Status::surface_tension_out_of_range:
            return "surface_tension_m3ps2: choose 0 … 1e12 cells³/s², in Fixed 30,000";
        case Status::surface_tension_needs_projection:
            return "surface tension: choose Pressure::projection, or set it to 0";
        case Status::density_ratio_out_of_range:
            return "second_density_ratio: choose 0.01 … 100";
        case Status::second_liquid_needs_projection:
            return "two liquids: choose Pressure::projection";
        case Status::conveyor_out_of_range:
            return "conveyor_mps: at most 1e6 cells a second, in Fixed 16000, in SmallFixed 255 or "
                   "what top_speed_mps asks for";
        case Status::sleep_out_of_range:
            return "sleep: choose speed_mps 0 … 1e6 cells a second, after_s 0.1 … 1000, "
                   "gravity_mps2 0 … 1000";
        case Status::periodic_with_bodies:
            return "periodic worlds hold no bodies: set capacity.bodies = 0";
        case Status::periodic_needs_even_cells:
            return "periodic: choose an even number of cells along that axis";
        case Status::unknown_option:
            return "pressure, contour, hold or liquid: pick an enumerator from config.hpp";
        case Status::small_fixed_has_one_liquid:
            return "two liquids: choose World<Fixed>, or float";
        case Status::small_fixed_has_no_thin_walls:
            return "thin walls: choose World<Fixed>, or float, or set capacity.wall_edges = 0";
        case Status::small_fixed_has_no_tension:
            return "surface tension: choose World<Fixed>, or float";
        case Status::small_fixed_has_no_window:
            return "SmallFixed: its tanks are small, leave capacity.window_cells at 0";
        case Status::memory_missing:
            return "memory is null: hand over world_bytes<Real>(capacity) bytes";
        case Status::memory_misaligned: return "memory: declare it alignas(weir::world_alignment)";
        case Status::memory_too_small:
            return "memory: world_bytes<Real>(capacity) bytes are needed";
        case Status::not_initialised: return "call init first, and check what it answers";
        case Status::step_in_progress:
            return "a step was begun: call advance until it answers true, then ask again";
        default: return nullptr;
    }
}

/// Answers of the calls that add, move and remove bodies and liquid. Null for another.
const char* content_text(Status status) {
    switch (status) {
        case Status::no_free_body:
            return "all bodies are in use: raise capacity.bodies or remove one";
        case Status::no_free_vertex: return "all vertices are in use: raise capacity.vertices";
        case Status::stale_body:
            return "no such body here: it was removed, or belongs to another world";
        case Status::body_is_static:
            return "a static body does not move: add it with add_moving_body";
        case Status::no_moving_bodies:
            return "this world holds static bodies only: set capacity.moving_bodies = true";
        case Status::polygon_missing: return "polygon is null: point it at the vertices";
        case Status::polygon_too_few_vertices: return "polygon: at least 3 vertices, an open one 2";
        case Status::polygon_too_many_vertices:
            return "polygon: at most 16384 vertices, check_polygon counts them; simplify it";
        case Status::polygon_not_finite: return "polygon has a NaN or infinite vertex";
        case Status::polygon_zero_area: return "polygon, or a hole in it, has no area";
        case Status::polygon_crosses_itself:
            return "polygon crosses or touches itself: check_polygon says where; split it";
        case Status::polygon_hole_crosses:
            return "a hole crosses or touches another ring: check_polygon says where";
        case Status::polygon_hole_outside:
            return "a hole lies outside the polygon or within another hole: leave it out";
        case Status::polyline_has_holes: return "an open polyline has no holes: leave them empty";
        case Status::no_free_wall_edge:
            return "open or thin walls want more room: raise capacity.wall_edges";
        case Status::polygon_outside_domain:
            return "polygon lies wholly outside the tank: move it in";
        case Status::position_out_of_range:
            return "position: at most 1e5 cells from the tank's origin, in fixed point 16000";
        case Status::motion_not_finite:
            return "motion has a NaN or infinite number, or no time to take";
        case Status::motion_out_of_range:
            return "motion: at most 1e6 cells/s (in Fixed 16000, in SmallFixed 255 or what "
                   "top_speed_mps asks for), 1e4 rad and rad/s";
        case Status::two_way_missing:
            return "the world was made without room for forces: set capacity.two_way";
        case Status::free_body_in_small_world:
            return "SmallFixed has no room to solve for bodies: use Fixed, or move it yourself";
        case Status::regions_missing:
            return "regions: set capacity.sleeping_regions, and sleep.speed_mps above 0";
        case Status::viscosity_missing:
            return "the world was defined without viscosity: set viscosity_m2ps above 0";
        case Status::surface_tension_missing:
            return "the world was defined without tension: set surface_tension_m3ps2 above 0";
        case Status::output_missing: return "the pointer for the result is null";
        case Status::no_free_particle:
            return "no room for that many particles: raise capacity.particles";
        case Status::no_such_particle: return "index: choose 0 … number of particles − 1";
        case Status::no_particle_tags:
            return "this world keeps no tags: set capacity.particle_tags";
        case Status::no_second_liquid:
            return "this world holds one liquid: set capacity.second_liquid";
        case Status::particle_not_finite:
            return "particle has a NaN or infinite position or velocity";
        case Status::particle_outside_domain: return "particle: place it within the tank";
        case Status::particle_inside_solid: return "particle: place it outside the solids";
        case Status::velocity_out_of_range:
            return "velocity: at most 1e6 cells a second, in Fixed 16000, in SmallFixed 255 or "
                   "what top_speed_mps asks for";
        case Status::box_not_finite: return "box has a NaN or infinite corner";
        case Status::box_is_empty: return "box: min must be below max along both axes";
        case Status::box_outside_domain: return "box: keep it within the tank";
        case Status::share_out_of_range: return "share: 0 to 1";
        default: return nullptr;
    }
}

/// Answers of `save` and `restore`. Null for another.
const char* snapshot_text(Status status) {
    switch (status) {
        case Status::snapshot_missing: return "the pointer to the snapshot is null";
        case Status::snapshot_room_too_small:
            return "snapshot: snapshot_bytes<Real>(capacity) bytes are always enough";
        case Status::snapshot_truncated: return "snapshot: its end is missing, hand over all of it";
        case Status::snapshot_not_recognised: return "these bytes are no snapshot of a world";
        case Status::snapshot_of_other_version:
            return "snapshot: it was saved by another version of the library";
        case Status::snapshot_of_other_scalar:
            return "snapshot: it was saved by a world of another Real";
        case Status::snapshot_of_other_capacity:
            return "snapshot: init the world with the capacity that it was saved with";
        case Status::snapshot_of_other_definition:
            return "snapshot: init the world with the definition that it was saved with, and let "
                   "regions sleep in both or in none";
        case Status::snapshot_damaged: return "snapshot: its contents were changed, use another";
        default: return nullptr;
    }
}

}  // namespace

const char* status_text(Status status) {
    const char* text = capacity_text(status);
    text = text != nullptr ? text : init_text(status);
    text = text != nullptr ? text : content_text(status);
    text = text != nullptr ? text : snapshot_text(status);
    return text != nullptr ? text : "not a status";
}

const char* stage_name(Stage stage) {
    switch (stage) {
        case Stage::contour: return "contour";
        case Stage::particle_to_grid: return "particle_to_grid";
        case Stage::grid_update: return "grid_update";
        case Stage::pressure: return "pressure";
        case Stage::volume: return "volume";
        case Stage::grid_to_particle: return "grid_to_particle";
        case Stage::collide: return "collide";
        case Stage::count: break;
    }
    return "not a stage";
}

const char* owner_name(Owner owner) {
    switch (owner) {
        case Owner::world: return "world";
        case Owner::particles: return "particles";
        case Owner::bodies: return "bodies";
        case Owner::vertices: return "vertices";
        case Owner::contour: return "contour";
        case Owner::cut_cells: return "cut_cells";
        case Owner::thin_walls: return "thin_walls";
        case Owner::grid: return "grid";
        case Owner::pressure: return "pressure";
        case Owner::count: break;
    }
    return "not an owner";
}

}  // namespace weir
