#include "world/validate.hpp"

#include "geometry/polygon.hpp"
#include "math/vec2.hpp"
#include "step/window.hpp"

namespace weir {

namespace {

bool perfect_square_up_to_16(std::int32_t value) {
    return value == 1 || value == 4 || value == 9 || value == 16;
}

Status check_gravity(Vec2f gravity) {
    if (!is_finite(gravity)) {
        return Status::gravity_not_finite;
    }
    return within(gravity, kMaxGravity) ? Status::ok : Status::gravity_out_of_range;
}

Status check_numerics(const WorldDef& def) {
    if (!within(def.pressure_sweeps, 1, 1000)) {
        return Status::sweeps_out_of_range;
    }
    if (!within(def.max_substeps, 1, 1000)) {
        return Status::substeps_out_of_range;
    }
    if (!within(def.cfl, 0.1F, 2.0F)) {
        return Status::cfl_out_of_range;
    }
    if (!within(def.flip_ratio, 0.0F, 1.0F)) {
        return Status::flip_ratio_out_of_range;
    }
    if (!within(def.volume_gain, 0.0F, 1.0F)) {
        return Status::volume_gain_out_of_range;
    }
    return within(def.sound_speed_mps, 0.0F, kMaxSpeed * def.cell_m)
               ? Status::ok
               : Status::sound_speed_out_of_range;
}

Status check_liquids(const WorldDef& def, const Reach& reach) {
    const Status viscosity = check_viscosity(def.viscosity_m2ps, def.cell_m);
    if (viscosity != Status::ok) {
        return viscosity;
    }
    const Status tension =
        check_surface_tension(def.surface_tension_m3ps2, def.pressure, def.cell_m, reach);
    if (tension != Status::ok) {
        return tension;
    }
    if (!within(def.second_density_ratio, 0.01F, 100.0F)) {
        return Status::density_ratio_out_of_range;
    }
    if (def.capacity.second_liquid && def.pressure != Pressure::projection) {
        return Status::second_liquid_needs_projection;
    }
    return Status::ok;
}

Status check_borders(const WorldDef& def, const Reach& reach) {
    const Status walls = check_walls(def.walls, def.cell_m, reach);
    if (walls != Status::ok) {
        return walls;
    }
    if ((def.periodic_x || def.periodic_y) && def.capacity.bodies > 0) {
        return Status::periodic_with_bodies;
    }
    const bool odd = (def.periodic_x && def.capacity.cells_x % 2 != 0) ||
                     (def.periodic_y && def.capacity.cells_y % 2 != 0);
    return odd ? Status::periodic_needs_even_cells : Status::ok;
}

Status check_window(const WorldDef& def, const Reach& reach) {
    const Capacity& capacity = def.capacity;
    if (!within(capacity.window_cells, 0, entries_of(kMaxCells, kMaxCells))) {
        return Status::window_out_of_range;
    }
    if (!is_windowed(capacity)) {
        return Status::ok;
    }
    if (!reach.everything) {
        return Status::small_fixed_has_no_window;
    }
    if (capacity.wall_edges > 0) {
        return Status::window_without_thin_walls;
    }
    if (capacity.two_way) {
        return Status::window_without_forces;
    }
    // In narrow tanks, too: counts of particles along the sides stand in it.
    const std::int32_t least =
        maximum(entries_of(2 * kWindowColumns, (capacity.bodies > 0 ? 3 : 2) * kWindowRows),
                least_window(capacity, def.periodic_x, def.periodic_y).size());
    return capacity.window_cells < least ? Status::window_too_small : Status::ok;
}

Status check_sleep(const WorldDef& def) {
    const Capacity& capacity = def.capacity;
    if (capacity.sleeping_regions && (capacity.two_way || is_windowed(capacity) ||
                                      def.periodic_x || def.periodic_y)) {
        return Status::regions_out_of_place;
    }
    const bool in_range = within(def.sleep.speed_mps, 0.0F, kMaxSpeed * def.cell_m) &&
                          within(def.sleep.after_s, 0.1F, 1000.0F) &&
                          within(def.sleep.gravity_mps2, 0.0F, kMaxGravity);
    return in_range ? Status::ok : Status::sleep_out_of_range;
}

/// What the arithmetic does not bear.
Status check_reach(const WorldDef& def, const Reach& reach) {
    if (def.capacity.cells_x > reach.cells || def.capacity.cells_y > reach.cells) {
        return Status::cells_out_of_range;
    }
    if (!reach.everything && def.capacity.bodies > kMaxBodiesSmallFixed) {
        return Status::body_capacity_out_of_range;
    }
    if (!within(def.top_speed_mps, 0.0F, reach.top_speed * def.cell_m)) {
        return Status::top_speed_out_of_range;
    }
    if (!within(def.gravity_mps2, reach.gravity * def.cell_m)) {
        return Status::gravity_out_of_range;
    }
    if (!reach.everything && def.capacity.second_liquid) {
        return Status::small_fixed_has_one_liquid;
    }
    return !reach.everything && def.capacity.wall_edges > 0 ? Status::small_fixed_has_no_thin_walls
                                                            : Status::ok;
}

/// Names the first defect of an open polyline.
Status check_polyline(const BodyDef& def) {
    if (def.holes.size != 0) {
        return Status::polyline_has_holes;
    }
    if (def.polygon.data == nullptr) {
        return Status::polygon_missing;
    }
    if (def.polygon.size < 2) {
        return Status::polygon_too_few_vertices;
    }
    if (def.polygon.size > kMaxBodyVertices) {
        return Status::polygon_too_many_vertices;
    }
    bool has_length = false;
    for (const Vec2f& vertex : def.polygon) {
        if (!is_finite(vertex)) {
            return Status::polygon_not_finite;
        }
        has_length = has_length || vertex.x != def.polygon[0].x || vertex.y != def.polygon[0].y;
    }
    return has_length ? Status::ok : Status::polygon_zero_area;
}

}  // namespace

bool within(float value, float low, float high) { return low <= value && value <= high; }
bool within(Vec2f value, float most) {
    return within(value.x, -most, most) && within(value.y, -most, most);
}

Status check_capacity(const Capacity& capacity) {
    if (!within(capacity.cells_x, kMinCells, kMaxCells) ||
        !within(capacity.cells_y, kMinCells, kMaxCells)) {
        return Status::cells_out_of_range;
    }
    if (!within(capacity.particles, 1, kMaxParticles)) {
        return Status::particle_capacity_out_of_range;
    }
    if (!within(capacity.bodies, 0, kMaxBodies)) {
        return Status::body_capacity_out_of_range;
    }
    if (!within(capacity.vertices, 0, kMaxVertices)) {
        return Status::vertex_capacity_out_of_range;
    }
    if (!within(capacity.wall_edges, 0, kMaxWallEdges)) {
        return Status::wall_edge_capacity_out_of_range;
    }
    return within(capacity.contacts, 0, kMaxBodies) ? Status::ok
                                                    : Status::contact_capacity_out_of_range;
}

Status check_world(const WorldDef& def, const Reach& reach) {
    const Status capacity = check_capacity(def.capacity);
    if (capacity != Status::ok) {
        return capacity;
    }
    if (!within(def.cell_m, 1.0e-6F, 1.0e3F)) {
        return Status::cell_size_out_of_range;
    }
    const Status gravity = check_gravity(def.gravity_mps2);
    if (gravity != Status::ok) {
        return gravity;
    }
    if (!perfect_square_up_to_16(def.particles_per_cell)) {
        return Status::particles_per_cell_out_of_range;
    }
    if ((def.pressure != Pressure::projection && def.pressure != Pressure::equation_of_state) ||
        (def.contour != Contour::interpolated && def.contour != Contour::mid_edge)) {
        return Status::unknown_option;
    }
    const Status liquids = check_liquids(def, reach);
    if (liquids != Status::ok) {
        return liquids;
    }
    const Status borders = check_borders(def, reach);
    if (borders != Status::ok) {
        return borders;
    }
    const Status window = check_window(def, reach);
    if (window != Status::ok) {
        return window;
    }
    const Status sleep = check_sleep(def);
    if (sleep != Status::ok) {
        return sleep;
    }
    const Status numerics = check_numerics(def);
    return numerics != Status::ok ? numerics : check_reach(def, reach);
}

Status check_viscosity(float viscosity_m2ps, float cell_m) {
    return within(viscosity_m2ps, 0.0F, 1.0e6F * cell_m * cell_m) ? Status::ok
                                                                  : Status::viscosity_out_of_range;
}

Status check_surface_tension(float tension_m3ps2, Pressure pressure, float cell_m,
                             const Reach& reach) {
    const float cell_volume = cell_m * cell_m * cell_m;
    if (!within(tension_m3ps2, 0.0F, 1.0e12F * cell_volume)) {
        return Status::surface_tension_out_of_range;
    }
    if (tension_m3ps2 > 0.0F && pressure != Pressure::projection) {
        return Status::surface_tension_needs_projection;
    }
    if (tension_m3ps2 > 0.0F && !reach.everything) {
        return Status::small_fixed_has_no_tension;
    }
    return tension_m3ps2 > reach.surface_tension * cell_volume
               ? Status::surface_tension_out_of_range
               : Status::ok;
}

Status check_walls(const TankWalls& walls, float cell_m, const Reach& reach) {
    const Surface* const all[] = {&walls.bottom, &walls.right, &walls.top, &walls.left};
    for (const Surface* wall : all) {
        const Status surface = check_surface(*wall, cell_m, reach);
        if (surface != Status::ok) {
            return surface;
        }
    }
    return Status::ok;
}

Status check_memory(const void* memory, std::size_t bytes, std::size_t needed) {
    if (memory == nullptr) {
        return Status::memory_missing;
    }
    if (reinterpret_cast<std::uintptr_t>(memory) % world_alignment != 0) {
        return Status::memory_misaligned;
    }
    return bytes < needed ? Status::memory_too_small : Status::ok;
}

Status check_motion(const Motion& motion, float cell_m, const Reach& reach) {
    if (!is_finite(motion.position_m) || !is_finite(motion.velocity_mps) ||
        !is_finite(motion.angle_rad) || !is_finite(motion.spin_radps)) {
        return Status::motion_not_finite;
    }
    if (!within(motion.position_m, reach.furthest * cell_m)) {
        return Status::position_out_of_range;
    }
    const bool in_range = within(motion.velocity_mps, reach.speed * cell_m) &&
                          within(motion.angle_rad, -kMaxAngle, kMaxAngle) &&
                          within(motion.spin_radps, -reach.spin, reach.spin);
    return in_range ? Status::ok : Status::motion_out_of_range;
}

Status check_body(const BodyDef& def, float cell_m, const Reach& reach) {
    const Status polygon =
        def.open ? check_polyline(def) : check_polygon(def.polygon, def.holes);
    if (polygon != Status::ok) {
        return polygon;
    }
    const float furthest = reach.furthest * cell_m;
    for (const Vec2f& vertex : def.polygon) {
        if (!within(vertex, furthest)) {
            return Status::position_out_of_range;
        }
    }
    const Status motion = check_motion(def.motion, cell_m, reach);
    if (motion != Status::ok) {
        return motion;
    }
    const Status surface = check_surface(def.surface, cell_m, reach);
    if (surface != Status::ok) {
        return surface;
    }
    if (def.hold > Hold::upright) {
        return Status::unknown_option;
    }
    return within(def.density_ratio, 1.0e-3F, 1.0e3F) ? Status::ok
                                                      : Status::body_density_out_of_range;
}

Status check_surface(const Surface& surface, float cell_m, const Reach& reach) {
    if (!within(surface.restitution, 0.0F, 1.0F)) {
        return Status::restitution_out_of_range;
    }
    if (!within(surface.friction, 0.0F, 1000.0F)) {
        return Status::friction_out_of_range;
    }
    const float fastest = reach.speed * cell_m;
    return within(surface.conveyor_mps, -fastest, fastest) ? Status::ok
                                                           : Status::conveyor_out_of_range;
}

Status check_box(const Box& box) {
    if (!is_finite(box.min_m) || !is_finite(box.max_m)) {
        return Status::box_not_finite;
    }
    const bool has_area = box.min_m.x < box.max_m.x && box.min_m.y < box.max_m.y;
    return has_area ? Status::ok : Status::box_is_empty;
}

}  // namespace weir
