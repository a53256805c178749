// The pressure of the paper's liquid, which is known to its particles only, as a field of cells.
#pragma once

#include <vector>

#include "paper_fluid.hpp"

namespace accuracy {

/// Each particle's density is a cubic through mass and its gradient at the four nodes around it
/// (paper_fluid.cpp, density_at), its pressure = stiffness × (density / rest − 1), clamped. A
/// cell's pressure is the mean over the particles in it, times their share of its room: what its
/// stress exerts on the liquid.
class ReferencePressure {
public:
    void compute(const paper::Fluid& fluid);
    /// cells² / step².
    double at(int i, int j) const;

private:
    struct Node {
        double mass = 0.0;
        double slope_x = 0.0;
        double slope_y = 0.0;
    };
    void scatter(const paper::Fluid& fluid);
    double density_at(double x, double y) const;

    int columns_ = 0;
    int cells_x_ = 0;
    std::vector<Node> nodes_;
    std::vector<double> pressure_;
};

}  // namespace accuracy
