// The cases. Names follow the stress suite of the reference problems: S1 … S17, R14.
#pragma once

#include <cstdint>

#include "report.hpp"

namespace stability {

struct Effort {
    bool full = false;
    Scalar scalar = Scalar::usual;
    std::uint64_t seed = 0;   ///< random scenes: replay this one alone; 0: all
    std::int32_t scenes = 0;  ///< random scenes: how many; 0: as the effort wants
    std::int32_t steps = 0;   ///< soak and rest: how many; 0: as the effort wants
};

void coincident_particles(Report& report, const Effort& effort);  // S1
void crowded_cell(Report& report, const Effort& effort);          // S2
void near_empty_faces(Report& report, const Effort& effort);      // S3
void fast_liquid(Report& report, const Effort& effort);           // S4
void high_drop(Report& report, const Effort& effort);             // S5
void jet_into_wedge(Report& report, const Effort& effort);        // S6
void hostile_polygons(Report& report, const Effort& effort);      // S7
void squeezing_body(Report& report, const Effort& effort);        // S8
void jittering_step(Report& report, const Effort& effort);        // S9
void step_sweep(Report& report, const Effort& effort);            // S10
void viscosity_sweep(Report& report, const Effort& effort);       // S11
void flipping_gravity(Report& report, const Effort& effort);      // S12
void moved_scene(Report& report, const Effort& effort);           // S13
void same_run(Report& report, const Effort& effort);              // S14
void save_and_restore(Report& report, const Effort& effort);      // S15
void bad_numbers(Report& report, const Effort& effort);           // S16
void highest_density(Report& report, const Effort& effort);       // S17
void random_scenes(Report& report, const Effort& effort);
void soak(Report& report, const Effort& effort);          // R14 i, v
void resting_pool(Report& report, const Effort& effort);  // R14: does it stop moving?
void stability_map(Report& report, const Effort& effort);

}  // namespace stability
