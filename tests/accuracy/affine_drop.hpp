// The exact incompressible solution for a free drop that starts as a disc with an affine velocity:
// x = F X, F'' = λ F^{-T} − B² F, λ = (tr A² + 2 B²) / tr (F F^T)^{-1}, A = F' F^{-1};
// p / ρ = (λ/2) (1 − x^T (F F^T)^{-1} x). With B = 0 and A diagonal it is the elliptical drop of
// Monaghan 1994 (J. Comput. Phys. 110:399). Lengths are the disc's radius.
#pragma once

#include "scheme.hpp"

namespace accuracy {

struct Matrix {
    double xx = 0.0;
    double xy = 0.0;
    double yx = 0.0;
    double yy = 0.0;
};

class AffineDrop {
public:
    /// @param velocity_gradient A at the start, without trace.
    AffineDrop(const Matrix& velocity_gradient, double central_force)
        : f_{1.0, 0.0, 0.0, 1.0}, rate_(velocity_gradient), b_(central_force) {}

    /// Runge & Kutta, fourth order, in steps of at most 1/1000.
    void advance_to(double t);
    double semi_major() const;
    double semi_minor() const;
    double major_angle_degrees() const;
    double pressure(Vector x) const;

private:
    double lambda(const Matrix& f, const Matrix& rate) const;
    Matrix acceleration(const Matrix& f, const Matrix& rate) const;
    void step(double dt);

    Matrix f_;
    Matrix rate_;
    double b_;
    double t_ = 0.0;
};

}  // namespace accuracy
