// Liquid in vessels made of polygons, upright or tilted: the scene's own frame, in cells, turned as a
// whole about the middle of the tank. A cell's edge is a power of two of a metre, so that nothing
// is rounded between the two.
#pragma once

#include <functional>
#include <vector>

#include "node_field.hpp"
#include "tank.hpp"
#include "weir/weir.hpp"

namespace solids {

using Vec = weir::Vec2<double>;

inline constexpr float kCell_m = 1.0F / 64.0F;
inline constexpr double kGravity = 9.81 * 64.0;  ///< cells/s²
inline constexpr float kFrame_s = 1.0F / 60.0F;

struct Vessel {
    int cells_x = 0;
    int cells_y = 0;
    double tilt = 0.0;                ///< of the vessel, rad
    bool gravity_tilts = true;        ///< with it; else it points down
    std::vector<Points> walls;        ///< solids, in the vessel's frame
    int wall_edges = 0;               ///< room for walls thinner than a cell and a half
    Vec lattice;                      ///< a corner of the particles' lattice, in the tank
    std::function<bool(Vec)> liquid;  ///< where it stands at the start, in the vessel's frame

    Vec middle() const { return {0.5 * cells_x, 0.5 * cells_y}; }
    Vec to_tank(Vec p) const;
    Vec to_frame(Vec p) const;
    Vec turned(Vec v) const;        ///< a direction, to the tank
    Vec turned_back(Vec v) const;   ///< and to the vessel
};

template <class Real>
class Pool {
public:
    /// Throws if the library refuses. Particles stand on a lattice, 2 × 2 a cell.
    explicit Pool(const Vessel& vessel);

    void step(float dt_s = kFrame_s);
    void run(int steps);
    int particles() const { return world().particle_positions().size; }
    Vec position(int k) const;  ///< in the vessel's frame, cells
    Vec velocity(int k) const;  ///< cells/s
    /// Gives every particle the velocity of its place.
    void stir(const std::function<Vec(Vec)>& velocity);
    double rms_speed() const;
    double mean_height() const;  ///< in the vessel's frame, cells
    /// Pressure over density at the centre of a cell of the tank, cells²/s².
    double pressure(int i, int j) const;
    const weir::World<Real>& world() const { return *tank_; }
    const weir::StepReport& report() const { return report_; }

private:
    Pool(const Vessel& vessel, const std::vector<Vec>& places);

    Vessel vessel_;
    Tank<Real> tank_;
    weir::StepReport report_{};
};

extern template class Pool<float>;
extern template class Pool<double>;
extern template class Pool<weir::Fixed>;
extern template class Pool<weir::SmallFixed>;

/// Mean height of liquid of that area at rest in a region, its surface level; the frame's own y.
struct AtRest {
    double surface = 0.0;
    double mean_height = 0.0;
};
AtRest at_rest(const std::function<bool(Vec)>& region, double area, Vec low, Vec high, Vec up);

}  // namespace solids
