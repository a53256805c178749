#include "affine_drop.hpp"

#include <algorithm>
#include <cmath>

#include "analysis.hpp"

namespace accuracy {

namespace {

Matrix operator+(const Matrix& a, const Matrix& b) {
    return {a.xx + b.xx, a.xy + b.xy, a.yx + b.yx, a.yy + b.yy};
}

Matrix operator*(double s, const Matrix& a) {
    return {s * a.xx, s * a.xy, s * a.yx, s * a.yy};
}

Matrix operator*(const Matrix& a, const Matrix& b) {
    return {a.xx * b.xx + a.xy * b.yx, a.xx * b.xy + a.xy * b.yy,
            a.yx * b.xx + a.yy * b.yx, a.yx * b.xy + a.yy * b.yy};
}

Matrix transposed(const Matrix& a) {
    return {a.xx, a.yx, a.xy, a.yy};
}

Matrix inverse(const Matrix& a) {
    const double determinant = a.xx * a.yy - a.xy * a.yx;
    return (1.0 / determinant) * Matrix{a.yy, -a.xy, -a.yx, a.xx};
}

double trace(const Matrix& a) {
    return a.xx + a.yy;
}

}  // namespace

double AffineDrop::lambda(const Matrix& f, const Matrix& rate) const {
    const Matrix a = rate * inverse(f);
    return (trace(a * a) + 2.0 * b_ * b_) / trace(inverse(f * transposed(f)));
}

Matrix AffineDrop::acceleration(const Matrix& f, const Matrix& rate) const {
    return lambda(f, rate) * transposed(inverse(f)) + (-b_ * b_) * f;
}

void AffineDrop::step(double dt) {
    const Matrix k1 = rate_;
    const Matrix l1 = acceleration(f_, rate_);
    const Matrix k2 = rate_ + (0.5 * dt) * l1;
    const Matrix l2 = acceleration(f_ + (0.5 * dt) * k1, k2);
    const Matrix k3 = rate_ + (0.5 * dt) * l2;
    const Matrix l3 = acceleration(f_ + (0.5 * dt) * k2, k3);
    const Matrix k4 = rate_ + dt * l3;
    const Matrix l4 = acceleration(f_ + dt * k3, k4);
    f_ = f_ + (dt / 6.0) * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
    rate_ = rate_ + (dt / 6.0) * (l1 + 2.0 * l2 + 2.0 * l3 + l4);
}

void AffineDrop::advance_to(double t) {
    const int steps = std::max(1, static_cast<int>(std::ceil((t - t_) / 1e-3)));
    const double dt = (t - t_) / steps;
    for (int k = 0; k < steps; ++k) {
        step(dt);
    }
    t_ = t;
}

double AffineDrop::semi_major() const {
    const Matrix m = f_ * transposed(f_);
    return std::sqrt(0.5 * trace(m) + std::hypot(0.5 * (m.xx - m.yy), m.xy));
}

double AffineDrop::semi_minor() const {
    return 1.0 / semi_major();
}

double AffineDrop::major_angle_degrees() const {
    const Matrix m = f_ * transposed(f_);
    return 0.5 * std::atan2(2.0 * m.xy, m.xx - m.yy) * 180.0 / kPi;
}

double AffineDrop::pressure(Vector x) const {
    const Matrix m = inverse(f_ * transposed(f_));
    const double form = m.xx * x.x * x.x + (m.xy + m.yx) * x.x * x.y + m.yy * x.y * x.y;
    return 0.5 * lambda(f_, rate_) * (1.0 - form);
}

}  // namespace accuracy
