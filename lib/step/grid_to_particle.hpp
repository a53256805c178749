// Stage: grid-to-particle. Reads velocities on the faces; writes particles.
#pragma once

#include "fluid/particles.hpp"
#include "grid/borders.hpp"
#include "pressure/pressure_fields.hpp"
#include "solid/body_load.hpp"
#include "solid/thin_walls.hpp"

namespace weir {

template <class Real>
struct TransferResult {
    std::int32_t reset = 0;     ///< particles with a non-finite state, put to rest
    std::int32_t slowed = 0;    ///< particles limited to `limit`
    std::int32_t far = 0;       ///< above 0: some moved faster than `near` along an axis
    Real max_speed = Real(0);   ///< along an axis, cells/s

    void add(const TransferResult& other) {
        reset += other.reset;
        slowed += other.slowed;
        far += other.far;
        max_speed = maximum(max_speed, other.max_speed);
    }
};

template <class Real>
struct Transfer {
    Seconds<Real> dt_s;
    Real flip_ratio;
    Real limit;             ///< cells/s; nothing moves faster
    Borders<Real> borders = {};
    Real near = Real(1.0e30);  ///< cells/s: who moves faster along an axis is told as far
    Impulse<Real>* tank = nullptr;  ///< takes what hits the tank's walls; null: nobody asks
    const Face<Real>* particle_mass = nullptr;  ///< then: of either liquid, cells²
    bool settling = false;     ///< packed velocities lose a unit, slow ones of Fixed half
    // In packed worlds:
    Real max_speed = Real(0);  ///< of particles before these: a root only for who is faster
    void* ways = nullptr;      ///< words of scratch, one for each of some particles; null: none
    std::int32_t room = 0;     ///< so many
    bool keeps_places = false; ///< the places where particles come from are left there
};

/// Gathers both fields with the weights of particle-to-grid, moves the particle straight on,
/// x += dt u, and keeps it in the tank. Any part of the pool can be gathered at a time, after one
/// call of `prepare_gather`. Order: by particle. Cost: 16 loads, about 50 operations a particle.
template <class Real>
TransferResult<Real> grid_to_particle(const StaggeredGrid<Real>& grid,
                                      const Transfer<Real>& transfer,
                                      Particles<Real>& particles);

/// Lays the fields that are gathered side by side, where the grid has room for pairs: velocity_u
/// to mass_v are gone then.
template <class Real>
void prepare_gather(StaggeredGrid<Real>& grid, Work work = {});

}  // namespace weir
