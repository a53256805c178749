// A drawn scene as a Weir world. Freestanding: firmware uses it too.
#pragma once

#include "scene.hpp"
#include "scene_motion.hpp"
#include "weir/weir.hpp"

namespace scene {

constexpr weir::Capacity capacity_of(const Scene& s) {
    weir::Capacity capacity;
    capacity.particles = s.max_particles > 0 ? s.max_particles : 1;
    capacity.cells_x = s.cells_x;
    capacity.cells_y = s.cells_y;
    capacity.bodies = body_count(s);
    capacity.vertices = s.total_vertices;
    capacity.wall_edges = s.wall_edges;
    return capacity;
}

constexpr weir::WorldDef world_def_of(const Scene& s) {
    weir::WorldDef def;
    def.capacity = capacity_of(s);
    def.cell_m = s.cell_m;
    def.gravity_mps2 = {s.gravity_mps2.x_m, s.gravity_mps2.y_m};
    def.particles_per_cell = s.particles_per_cell;
    return def;
}

inline weir::Motion world_motion(const Moving& body, std::int32_t step, float dt_s) {
    const Motion m = motion_at(body, static_cast<std::uint32_t>(step), dt_s);
    return {{m.position_m.x_m, m.position_m.y_m},
            m.angle_rad,
            {m.velocity_mps.x_m, m.velocity_mps.y_m},
            m.spin_radps};
}

/// Even-odd rule: how often a ray to the right crosses the outline.
inline bool contains(const Shape& shape, Point p) {
    bool inside = false;
    for (std::int32_t ring = 0; ring < shape.rings; ++ring) {
        const std::int32_t end = ring_end(shape, ring);
        std::int32_t last = end - 1;
        for (std::int32_t k = ring_begin(shape, ring); k < end; last = k++) {
            const Point a = shape.points[k];
            const Point b = shape.points[last];
            if ((a.y_m > p.y_m) != (b.y_m > p.y_m) &&
                p.x_m < a.x_m + (b.x_m - a.x_m) * (p.y_m - a.y_m) / (b.y_m - a.y_m)) {
                inside = !inside;
            }
        }
    }
    return inside;
}

/// Particles on the lattice within a drawn shape; lattice points inside solids are left out.
template <class World>
weir::Status fill_shape(World& world, const Scene& s, const Shape& shape) {
    std::int32_t per_axis = 1;
    while (per_axis * per_axis < s.particles_per_cell) {
        ++per_axis;
    }
    const float spacing = s.cell_m / static_cast<float>(per_axis);
    for (std::int32_t b = 0; b < s.cells_y * per_axis; ++b) {
        for (std::int32_t a = 0; a < s.cells_x * per_axis; ++a) {
            const Point at{(static_cast<float>(a) + 0.5F) * spacing,
                           (static_cast<float>(b) + 0.5F) * spacing};
            if (!contains(shape, at)) {
                continue;
            }
            const weir::Status status = world.add_particle({at.x_m, at.y_m}, {});
            if (status != weir::Status::ok && status != weir::Status::particle_inside_solid) {
                return status;
            }
        }
    }
    return weir::Status::ok;
}

/// Scratch for one polygon: max_vertices points and max_holes views.
struct Scratch {
    weir::Vec2f* vertices;
    weir::View<weir::Vec2f>* holes;
};

/// The rings of a shape for the library.
inline void describe(const Shape& shape, const Scratch& scratch, weir::BodyDef& def) {
    for (std::int32_t k = 0; k < shape.count; ++k) {
        scratch.vertices[k] = {shape.points[k].x_m, shape.points[k].y_m};
    }
    const auto ring = [&](std::int32_t number) {
        const std::int32_t begin = ring_begin(shape, number);
        return weir::View<weir::Vec2f>{scratch.vertices + begin, ring_end(shape, number) - begin};
    };
    for (std::int32_t hole = 1; hole < shape.rings; ++hole) {
        scratch.holes[hole - 1] = ring(hole);
    }
    def.polygon = ring(0);
    def.holes = {scratch.holes, shape.rings - 1};
}

/// Solids first, then moving bodies, then the liquid around them. `ids` takes the moving bodies'
/// names. The world has been initialised.
template <class World>
weir::Status set_up(World& world, const Scene& s, const Scratch& scratch, weir::BodyId* ids) {
    for (std::int32_t k = 0; k < s.solid_count; ++k) {
        weir::BodyDef def;
        weir::BodyId id;
        describe(s.solids[k], scratch, def);
        const weir::Status status = world.add_static_body(def, &id);
        if (status != weir::Status::ok) {
            return status;
        }
    }
    for (std::int32_t k = 0; k < s.moving_count; ++k) {
        weir::BodyDef def;
        describe(s.moving[k].shape, scratch, def);
        def.motion = world_motion(s.moving[k], 0, s.dt_s);
        const weir::Status status = world.add_moving_body(def, ids + k);
        if (status != weir::Status::ok) {
            return status;
        }
    }
    for (std::int32_t k = 0; k < s.liquid_count; ++k) {
        const weir::Status status = fill_shape(world, s, s.liquid[k]);
        if (status != weir::Status::ok) {
            return status;
        }
    }
    return weir::Status::ok;
}

/// Tells bodies on a path where to go during the coming step; the others keep their motion.
template <class World>
weir::Status steer(World& world, const Scene& s, const weir::BodyId* ids, std::int32_t step) {
    for (std::int32_t k = 0; k < s.moving_count; ++k) {
        if (s.moving[k].path_count >= 2) {
            const weir::Status status =
                world.set_motion(ids[k], world_motion(s.moving[k], step, s.dt_s));
            if (status != weir::Status::ok) {
                return status;
            }
        }
    }
    return weir::Status::ok;
}

}  // namespace scene
