// The liquid step that the paper builds on: explicit MPM on a collocated grid.
//
// One step: scatter mass, its gradient and momentum; gather density and velocity gradient;
// scatter forces; gather acceleration; scatter the new velocity; gather it. Quadratic B-spline
// weights, computed once per particle and step and kept. Density comes from the four nodes around
// a particle, by a cubic through their mass and mass gradient; pressure =
// stiffness (density / rest - 1), clamped. This is the family of the real-time 2D fluids after
// Grant Kot (2012). Adding the acceleration to the node's velocity instead (`Velocity::from_grid`)
// saves a scatter and a gather, about an eighth of the time, but not the smoothing that they do:
// at solids, nodes with little mass then throw particles about and energy grows many times over.
//
// Units are cells and steps (one step is one unit of time, paper_scaling.hpp), a particle's mass
// is 1. Positions are in the tank: the walls stand at 0 and at `cells`; the grid has kMargin more
// cells on each side, in which a soft force pushes back and, near its end, a clamp holds.
#pragma once

#include <vector>

#include "paper_solids.hpp"

namespace paper {

inline constexpr int kMargin = 3;

enum class Velocity {
    scattered_again,  ///< from the particles once more, as programs of this family do
    from_grid,        ///< the node's own plus its acceleration: two scatters, two gathers
};

struct FluidConfig {
    int cells_x = 64;  ///< the tank, without the margin
    int cells_y = 64;
    Point gravity{0.0F, -0.0005F};  ///< cells / step²
    float stiffness = 0.25F;        ///< (sound speed)², (cells / step)²; unruly from about 0.5 on
    float rest_density = 4.0F;      ///< particles per cell
    float max_compression = 2.0F;   ///< pressure is at most this times stiffness
    float max_tension = 0.0F;       ///< and at least minus this times stiffness
    float viscosity = 0.01F;        ///< shear, cells² / step
    float bulk_viscosity = 0.1F;    ///< of compression, cells² / step
    float smoothing = 0.02F;        ///< share of the grid's velocity in the particle's (1 - FLIP)
    Velocity velocity = Velocity::scattered_again;
    bool interaction = true;  ///< off: solids are neither rasterized nor tested against
};

class Fluid {
public:
    explicit Fluid(const FluidConfig& config);

    void add_particle(Point position, Point velocity = {});
    /// Polygons in the tank's cells, as the particles.
    void add_static(const Polygon& polygon);
    void add_dynamic(const Polygon& local, Point position, float angle_rad, float spin_rad);

    /// One step. With interaction but no solids the solid part costs nothing.
    void step();

    int size() const { return static_cast<int>(particles_.size()); }
    Point position(int index) const;
    Point velocity(int index) const;
    const FluidConfig& config() const { return config_; }
    const Solids& solids() const { return solids_; }
    /// Mass on the grid after the last step's first scatter: equals the number of particles.
    double grid_mass() const;

private:
    struct Particle {
        Point x;      // in the grid: tank + kMargin
        Point v;
        int base;     // node of the lower left weight
        float wx[3];  // weights of the three columns and rows
        float wy[3];
        float dx[3];  // their derivatives with respect to the particle's position
        float dy[3];
    };
    struct Node {
        float mass;
        Point gradient;      // of the mass field
        Point velocity;      // momentum first, then velocity
        Point acceleration;  // force first, then acceleration
    };

    void set_weights(Particle& particle) const;
    void clear_nodes();
    void scatter_mass();
    void momentum_to_velocity();
    float density_at(const Particle& particle) const;
    Point wall_force(const Particle& particle) const;
    void scatter_forces();
    void force_to_acceleration();
    void scatter_velocity_again();
    void gather_velocity();
    void move(Particle& particle, Point step) const;

    FluidConfig config_;
    int nodes_x_;
    int nodes_y_;
    std::vector<Particle> particles_;
    std::vector<Node> nodes_;
    int first_node_ = 0;  // only nodes between these two are touched by particles
    int last_node_ = 0;
    Solids solids_;
};

}  // namespace paper
