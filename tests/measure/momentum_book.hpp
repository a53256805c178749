// A fixed-point world's mass and momentum, read from inside in whole numbers: what the liquid has,
// what gravity gave it, what bodies and tank received.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include "step/momentum_ledger.hpp"
#include "weir/weir.hpp"
#include "world/find_levels.hpp"
#include "world/world_state.hpp"

namespace measure {

/// Along x and y.
using Units = std::array<std::int64_t, 2>;

inline std::int64_t largest(const Units& units) {
    return std::max(std::abs(units[0]), std::abs(units[1]));
}
inline Units in_units(weir::WholeMomentum momentum) {
    return {static_cast<std::int64_t>(momentum.x), static_cast<std::int64_t>(momentum.y)};
}

template <class Real>
class MomentumBook {
public:
    MomentumBook(weir::World<Real>& world, std::byte* memory)
        : world_(world), state_(*reinterpret_cast<weir::detail::WorldState<Real>*>(memory)),
          before_(liquid()), gravity_(given()) {}

    /// A step with its entry: received by all + gained by the liquid − given by gravity, which is
    /// 0 if nothing is lost.
    weir::StepReport step(float dt_s) {
        const weir::StepReport report = world_.step(dt_s);
        const weir::WholeMomentum after = liquid();
        const weir::WholeMomentum gravity = given();
        off_ = received() + (after - before_) - (gravity - gravity_);
        drift_ = drift_ + off_;
        before_ = after;
        gravity_ = gravity;
        const std::int64_t dt = std::int64_t{state_.plan.dt_s.raw} * state_.plan.substeps;
        const weir::Vec2<Real> g = simulation().settings.gravity;
        exact_x_ += Wide{g.x.raw} * dt;
        exact_y_ += Wide{g.y.raw} * dt;
        const weir::Vec2<double> settled = weir::convert<double>(weir::settled(bodies()));
        const double mass = static_cast<double>(weight()) / 65536.0 *
                            static_cast<double>(simulation().layers.walls.particle_mass[0]);
        const double impulse = mass * (static_cast<double>(dt) / kSecond) *
                               weir::length(weir::convert<double>(g));
        settled_square_ += weir::dot(settled, settled) / (impulse * impulse);
        ++steps_;
        return report;
    }

    Units off() const { return in_units(off_); }      ///< of the last step
    Units drift() const { return in_units(drift_); }  ///< of all
    /// Since the world began.
    Units gravity() const { return in_units(given()); }
    /// In the last step.
    Units tank() const {
        return in_units(weir::whole_received(simulation(), bodies().capacity));
    }
    /// What was not counted where it was exchanged, over the liquid's weight, rms.
    double settled_rms() const { return std::sqrt(settled_square_ / steps_); }

    /// What gravity gave less what n · g · dt rounds down to, for as many particles as there are.
    Units gravity_off() const {
        const std::uint64_t each = weight();
        return in_units(gravity_ - each * weir::WholeMomentum{rounded_down(exact_x_),
                                                              rounded_down(exact_y_)});
    }
    /// Whether the tank's record in floats is its whole numbers, rounded.
    bool tank_says_so() const {
        const float unit = simulation().layers.walls.particle_mass[0] / 4294967296.0F;
        const weir::Vec2<float> said = weir::tank_received(bodies()).linear;
        return said.x == unit * static_cast<float>(tank()[0]) &&
               said.y == unit * static_cast<float>(tank()[1]);
    }

    /// Raw numbers on faces of either component less those of as many particles, twice: faces on
    /// walls count for two. The grid's arrays are free between steps.
    Units mass_off() {
        weir::scatter_all(simulation());
        const std::int64_t all = 2 * kMassOnFaces * simulation().particles.count;
        const weir::StaggeredGrid<Real>& grid = simulation().grid;
        return {sum_of_faces(grid.mass_u, true) - all, sum_of_faces(grid.mass_v, false) - all};
    }
    /// The same of momentum, after `mass_off`.
    Units momentum_off() {
        const weir::StaggeredGrid<Real>& grid = simulation().grid;
        const Units all = in_units(liquid());
        const std::int64_t each = 65536 / (2 * weir::Stored<Real>::particle_mass);
        return {sum_of_faces(grid.momentum_u(), true) - all[0] / each,
                sum_of_faces(grid.momentum_v(), false) - all[1] / each};
    }

private:
    __extension__ using Wide = __int128;
    static constexpr double kSecond = 1 << 30;
    /// Of a particle: 1 in Q15.16; in packed worlds 2, to 7 bits.
    static constexpr std::int64_t kMassOnFaces = weir::Stored<Real>::coarse ? 2 * 128 : 65536;

    weir::Simulation<Real>& simulation() const { return state_.simulation; }
    weir::BodyTable<Real>& bodies() const { return simulation().bodies; }
    weir::WholeMomentum given() const { return weir::whole_ledger(bodies()).gravity; }
    static std::uint64_t rounded_down(Wide exact) {
        return static_cast<std::uint64_t>(exact >> 30);
    }

    weir::WholeMomentum received() const {
        weir::WholeMomentum sum;
        for (std::int32_t slot = 0; slot <= bodies().capacity; ++slot) {
            sum = sum + weir::whole_received(simulation(), slot);
        }
        return sum;
    }
    template <class Add>
    void for_each_particle(Add add) const {
        const weir::Particles<Real>& particles = simulation().particles;
        for (std::int32_t k = 0; k < particles.count; ++k) {
            const bool second =
                particles.kind != nullptr && particles.kind[k] == weir::Liquid::second;
            add(weir::whole_weight(simulation().settings, second),
                weir::Vec2<Real>(particles.velocity[k]));
        }
    }
    weir::WholeMomentum liquid() const {
        weir::WholeMomentum sum;
        for_each_particle([&](std::uint64_t weight, weir::Vec2<Real> velocity) {
            sum = sum + weight * weir::convert<std::uint64_t>(
                                     weir::Vec2<std::int32_t>{velocity.x.raw, velocity.y.raw});
        });
        return sum;
    }
    std::uint64_t weight() const {
        std::uint64_t sum = 0;
        for_each_particle([&](std::uint64_t weight, weir::Vec2<Real>) { sum += weight; });
        return sum;
    }
    template <class Field>
    std::int64_t sum_of_faces(const Field* field, bool is_u) const {
        const weir::GridShape& s = simulation().grid.shape;
        const std::int32_t last = is_u ? s.nx : s.ny;
        std::int64_t sum = 0;
        for (std::int32_t j = 0; j < s.ny + (is_u ? 0 : 1); ++j) {
            for (std::int32_t i = 0; i < s.nx + (is_u ? 1 : 0); ++i) {
                const std::int32_t across = is_u ? i : j;
                const std::int64_t raw = field[s.index(i, j)].raw;
                sum += across == 0 || across == last ? raw : 2 * raw;
            }
        }
        return sum;
    }

    weir::World<Real>& world_;
    weir::detail::WorldState<Real>& state_;
    weir::WholeMomentum before_;
    weir::WholeMomentum gravity_;
    weir::WholeMomentum off_;
    weir::WholeMomentum drift_;
    Wide exact_x_ = 0;
    Wide exact_y_ = 0;
    double settled_square_ = 0.0;
    int steps_ = 0;
};

}  // namespace measure
