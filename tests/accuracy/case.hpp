// A problem at one resolution, on one lattice, with one set of options; and what came of it.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "analysis.hpp"
#include "lattice.hpp"
#include "scheme.hpp"

namespace accuracy {

struct Case {
    int cells = 32;  ///< per reference length of the problem
    Lattice lattice = Lattice::aligned;
    Options options;
    const Particles* start = nullptr;  ///< instead of the lattice; null: none
};

/// Starts a scheme with a pool as wide as `c.cells` and half as deep, g being its depth, so that
/// √(gH) is one depth in a unit of time. @return the particles that it starts with.
Particles start_pool(const Case& c, Scheme& scheme, Setup& setup);

/// Figures by name, and curves by name for the plots.
struct Outcome {
    std::vector<std::pair<std::string, double>> values;
    std::vector<std::pair<std::string, Signal>> curves;
    std::string broken;  ///< empty, or why the run counts as broken

    void add(const std::string& name, double value) { values.emplace_back(name, value); }
    double value(const std::string& name) const {
        for (const auto& entry : values) {
            if (entry.first == name) {
                return entry.second;
            }
        }
        return 0.0;
    }
    const Signal* curve(const std::string& name) const {
        for (const auto& entry : curves) {
            if (entry.first == name) {
                return &entry.second;
            }
        }
        return nullptr;
    }
};

/// Notes NaN, particles put to rest and particles lost.
inline void check_particles(const Scheme& scheme, std::size_t expected, int nx, int ny,
                            double slack, Outcome& outcome) {
    const Particles particles = scheme.particles();
    if (particles.size() != expected || count_outside(particles, nx, ny, slack) > 0) {
        outcome.broken = "particles lost";
    }
    if (!all_finite(particles) || scheme.reset() > 0) {
        outcome.broken = "not finite";
    }
}

}  // namespace accuracy
