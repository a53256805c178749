// Newton's third law, checked from outside: what bodies and tank received against what the liquid's
// momentum changed by beyond gravity. And from inside: how much of that was not counted where it is
// exchanged (pressure on faces, blows of particles, drag), but given to balance the ledger.
#include <algorithm>
#include <cmath>

#include "math/vec2.hpp"
#include "measure/momentum_book.hpp"
#include "measure/stirred_tank.hpp"
#include "measure/tank_def.hpp"
#include "problems.hpp"
#include "tank.hpp"
#include "world/world_state.hpp"

namespace solids {

namespace {

using Vec2d = weir::Vec2<double>;

constexpr int kCells = 32;
constexpr double kCell = 0.02;
constexpr float kFrame = 1.0F / 120.0F;

/// Over the liquid's weight times the step.
struct Balance {
    Vec2d rest;     ///< received by all + gained by the liquid − gravity's: 0 if action is reaction
    Vec2d settled;  ///< what the ledger gave of it
};

class Scene {
public:
    Scene(double column, double depth, bool bodies) : tank_(definition()) {
        if (bodies) {
            add(rectangle(0.16, 0.12), 0.46, 0.14, false);
            add(rectangle(0.1, 0.08), 0.7, 0.35, true);
            add({{0.0F, 0.0F}, {0.16F, 0.0F}, {0.0F, 0.16F}}, 0.9, 0.0, false);
        }
        require(tank_->fill({{0.0F, 0.0F},
                             {static_cast<float>(column), static_cast<float>(depth)}}));
        require(tank_->diagnose(&before_));
    }

    Balance step() {
        const double dt = static_cast<double>(tank_->step(kFrame).dt_s);
        weir::Diagnostics after;
        require(tank_->diagnose(&after));
        const double weight = 9.81 * dt * after.mass_m2;
        Vec2d sum = after.momentum_m3ps - before_.momentum_m3ps + Vec2d{0.0, weight};
        weir::BodyForce force;
        for (const weir::BodyId id : ids_) {
            require(tank_->force(id, &force));
            sum = sum + weir::convert<double>(force.impulse_m3ps);
        }
        require(tank_->tank_force(&force));
        sum = sum + weir::convert<double>(force.impulse_m3ps);
        before_ = after;
        const auto& bodies =
            reinterpret_cast<const weir::detail::WorldState<float>*>(tank_.memory())
                ->simulation.bodies;
        const Vec2d given = weir::convert<double>(weir::settled(bodies));
        return {(1.0 / weight) * sum, (kCell * kCell * kCell / weight) * given};
    }

private:
    static weir::WorldDef definition() {
        weir::WorldDef def = measure::tank_def(2 * kCells, kCells, 8 * kCells * kCells, 3, 16);
        def.cell_m = static_cast<float>(kCell);
        def.capacity.two_way = true;
        return def;
    }

    void add(const Ring& ring, double x, double y, bool is_free) {
        weir::BodyDef body = body_of(ring, x, y, 0.2);
        body.surface.friction = 0.2F;
        weir::BodyId id;
        require(is_free ? tank_->add_free_body(body, &id) : tank_->add_static_body(body, &id));
        ids_.push_back(id);
    }

    Tank<float> tank_;
    std::vector<weir::BodyId> ids_;
    weir::Diagnostics before_;
};

void balance(Report& report, const std::string& name, Scene scene, double most_settled) {
    constexpr int kSteps = 600;
    double square = 0.0;
    double settled = 0.0;
    double worst = 0.0;
    Vec2d rest;
    for (int k = 0; k < kSteps; ++k) {
        const Balance balance = scene.step();
        const Vec2d b = balance.rest;
        settled += weir::dot(balance.settled, balance.settled);
        square += weir::dot(b, b);
        worst = std::max(worst, std::sqrt(weir::dot(b, b)));
        rest = rest + b;
    }
    report.at_most(name + ".rest_over_weight_rms", 100.0 * std::sqrt(square / kSteps), "%", 0.001);
    report.at_most(name + ".settled_over_weight_rms", 100.0 * std::sqrt(settled / kSteps), "%",
                   most_settled);
    report.figure(name + ".rest_over_weight_worst_step", 100.0 * worst, "%");
    report.figure(name + ".rest_over_weight_mean",
                  100.0 * std::sqrt(weir::dot(rest, rest)) / kSteps, "%");
}

/// Fixed point: to the last unit, over a million steps. Mass, too.
template <class Real>
void whole_numbers(Report& report, const std::string& name, int steps, double most_settled) {
    measure::Stirred how;
    how.bodies = how.swings = true;
    measure::StirredTank<Real> tank(how);
    measure::MomentumBook<Real> book(tank.world(), tank.memory());
    std::int64_t off = 0;
    std::int64_t mass_off = 0;
    std::int64_t gravity_off = 0;
    std::int32_t lost = 0;
    std::int32_t crowded = 0;
    for (int k = 0; k < steps; ++k) {
        tank.swing(k);
        const weir::StepReport step = book.step(kFrame);
        off = std::max(off, measure::largest(book.off()));
        gravity_off = std::max(gravity_off, measure::largest(book.gravity_off()));
        mass_off = std::max(mass_off, measure::largest(book.mass_off()));
        lost = std::max(lost, std::abs(tank.particles() - step.particles));
        crowded += step.particles_crowded;
    }
    report.figure(name + ".steps", steps, "1");
    report.equals(name + ".drift_lsb", static_cast<double>(measure::largest(book.drift())), "LSB",
                  0);
    report.equals(name + ".worst_step_lsb", static_cast<double>(off), "LSB", 0);
    report.equals(name + ".gravity_off_lsb", static_cast<double>(gravity_off), "LSB", 0);
    report.equals(name + ".mass_on_faces_off_lsb", static_cast<double>(mass_off), "LSB", 0);
    report.equals(name + ".particles_lost", lost, "1", 0);
    report.figure(name + ".particles_crowded", crowded, "1");
    report.at_most(name + ".settled_over_weight_rms", 100.0 * book.settled_rms(), "%",
                   most_settled);
}

}  // namespace

void third_law(Report& report, const Effort& effort) {
    balance(report, "third_law.pool", Scene(1.28, 0.32, false), 0.001);
    balance(report, "third_law.pool_with_bodies", Scene(1.28, 0.32, true), 0.3);
    balance(report, "third_law.dam_break_over_bodies", Scene(0.4, 0.5, true), 5.0);
    const int steps = effort.full ? 1'000'000 : 2'000;
    whole_numbers<weir::Fixed>(report, "ledger.fixed", steps, 10.0);
    whole_numbers<weir::SmallFixed>(report, "ledger.small_fixed", steps, 10.0);
}

}  // namespace solids
