// R6a as formats are measured by: a standing wave, half of it as long as the tank is wide, in liquid
// half as deep as that, a twentieth of the depth high. Steps are a sixtieth of a second; how many
// cells √(gh) goes in one says how fast the flow is. The liquid rests for a while first, then it gets
// the velocity of linear theory, as particles that are added: what anybody could do.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include "measure/world_memory.hpp"
#include "weir/weir.hpp"

namespace measure {

struct WaveCase {
    std::int32_t cells = 32;
    double cells_per_step = 1.0;
    std::int32_t sweeps = 8;
    bool known_speed = true;  ///< √(gh) is promised as the top speed: 15 times the particles'
    double periods = 5.0;
};

struct Wave {
    double period = 0.0;  ///< over that of linear theory
    double height = 0.0;  ///< that is left after `periods`, a whole number, over the first
};

namespace detail {

inline constexpr double kPi = 3.14159265358979323846;
inline constexpr double kCell = 0.01;
inline constexpr double kStep = 1.0 / 60.0;
inline constexpr double kHeight = 0.05;
inline constexpr std::int32_t kRestingSteps = 200;
/// √(h/g) ω of linear theory: √(kh tanh kh) for kh = π/2.
inline constexpr double kOmega = 1.20027477;

inline void check(weir::Status status) {
    if (status != weir::Status::ok) {
        throw std::runtime_error(weir::status_text(status));
    }
}

template <class Real>
class WaveTank {
public:
    explicit WaveTank(const WaveCase& of)
        : cells_(of.cells), depth_(0.5 * of.cells), pace_(of.cells_per_step / kStep) {
        def_.capacity.cells_x = of.cells;
        def_.capacity.cells_y = 3 * of.cells / 4;
        def_.capacity.particles = 2 * of.cells * of.cells;
        def_.cell_m = static_cast<float>(kCell);
        def_.gravity_mps2 = {0.0F, static_cast<float>(-pace_ * pace_ / depth_ * kCell)};
        def_.top_speed_mps = of.known_speed ? static_cast<float>(pace_ * kCell) : 0.0F;
        def_.pressure_sweeps = of.sweeps;
        memory_ = memory_for<Real>(def_);
    }

    double omega() const { return kOmega * pace_ / depth_; }

    void start() {
        const auto metres = [](double cells) { return static_cast<float>(cells * kCell); };
        check(world_.init(def_, memory_.data(), memory_.size()));
        check(world_.fill({{0.0F, 0.0F}, {metres(cells_), metres(depth_)}}));
        for (std::int32_t step = 0; step < kRestingSteps; ++step) {
            advance();
        }
        std::vector<weir::Vec2f> place;
        std::vector<weir::Vec2f> velocity;
        each([&](double x, double y, double u, double v) {
            const Mode mode = mode_at(x, y);
            place.push_back({metres(x), metres(y)});
            velocity.push_back({metres(u + scale() * mode.u), metres(v + scale() * mode.v)});
        });
        check(world_.init(def_, memory_.data(), memory_.size()));
        for (std::size_t k = 0; k < place.size(); ++k) {
            check(world_.add_particle(place[k], velocity[k]));
        }
    }

    void advance() {
        const weir::StepReport report = world_.step(static_cast<float>(kStep));
        if (report.clamped != 0) {
            throw std::runtime_error("a wave's step was clamped");
        }
    }

    /// The velocities' projection on the mode, over what it was.
    double amplitude() const {
        double sum = 0.0;
        double norm = 0.0;
        each([&](double x, double y, double u, double v) {
            const Mode mode = mode_at(x, y);
            sum += u * mode.u + v * mode.v;
            norm += mode.u * mode.u + mode.v * mode.v;
        });
        return sum / norm / scale();
    }

private:
    struct Mode {
        double u;
        double v;
    };

    Mode mode_at(double x, double y) const {
        const double k = kPi / cells_;
        const double one = 1.0 / std::sinh(k * depth_);
        return {-one * std::cosh(k * y) * std::sin(k * x),
                one * std::sinh(k * y) * std::cos(k * x)};
    }
    double scale() const { return kHeight * depth_ * omega(); }

    /// Places in cells, velocities in cells a second.
    template <class Visit>
    void each(Visit visit) const {
        const auto x = world_.particle_positions();
        const auto v = world_.particle_velocities();
        const double per_s = static_cast<double>(world_.velocity_scale()) /
                             static_cast<double>(world_.cell_m());
        for (std::int32_t k = 0; k < x.size; ++k) {
            visit(static_cast<double>(x[k].x), static_cast<double>(x[k].y),
                  per_s * static_cast<double>(v[k].x), per_s * static_cast<double>(v[k].y));
        }
    }

    double cells_;
    double depth_;
    double pace_;  ///< √(gh), cells/s
    weir::WorldDef def_;
    WorldMemory memory_;
    weir::World<Real> world_{};
};

/// Slope of the line of least squares through values at 0, 1, 2 …
inline double slope(const std::vector<double>& values) {
    const double middle = 0.5 * (static_cast<double>(values.size()) - 1.0);
    double sum = 0.0;
    double norm = 0.0;
    for (std::size_t k = 0; k < values.size(); ++k) {
        const double off = static_cast<double>(k) - middle;
        sum += off * values[k];
        norm += off * off;
    }
    return sum / norm;
}

}  // namespace detail

template <class Real>
Wave run_wave(const WaveCase& of) {
    detail::WaveTank<Real> tank(of);
    tank.start();
    const double period = 2.0 * detail::kPi / tank.omega();
    const auto steps = static_cast<std::int32_t>((of.periods + 0.2) * period / detail::kStep);
    std::vector<double> crossing;
    double top = 0.0;  // of what is near the last crest
    double before = tank.amplitude();
    for (std::int32_t step = 1; step <= steps; ++step) {
        tank.advance();
        const double now = tank.amplitude();
        const double at = (step - now / (now - before)) * detail::kStep;
        // Slow flow in few bits trembles.
        if ((before < 0.0) != (now < 0.0) &&
            (crossing.empty() || at > crossing.back() + 0.25 * period)) {
            crossing.push_back(at);
        }
        if (step * detail::kStep > (of.periods - 0.2) * period) {
            top = std::max(top, now);
        }
        before = now;
    }
    // A wave that is gone has no period.
    if (crossing.size() != static_cast<std::size_t>(2.0 * of.periods)) {
        return {};
    }
    return {2.0 * detail::slope(crossing) / period, top};
}

}  // namespace measure
