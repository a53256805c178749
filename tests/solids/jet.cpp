// R13a: a steady jet on a plate without gravity. The plate takes the jet's momentum along its
// normal, ρ U² b sin α (momentum balance; no pressure on the free surfaces).
#include <cmath>

#include "math/vec2.hpp"
#include "problems.hpp"
#include "tank.hpp"

namespace solids {

namespace {

constexpr double kDegree = M_PI / 180.0;
constexpr double kSpeed = 1.0;  ///< U, m/s
constexpr double kReach = 6.0;  ///< of the plate to both sides, and of the jet, in its widths

/// Force on the plate over ρ U² b sin α, and its part along the plate over the same.
struct PlateForce {
    double normal = 0.0;
    double along = 0.0;
};

template <class Real>
class Jet {
public:
    /// `angle` between jet and plate.
    Jet(int cells, double angle)
        : cells_(cells),
          along_{std::cos(angle), std::sin(angle)},
          hit_{(kReach + kReach * std::abs(along_.x) + 0.5) * cells + 8.0,
               (kReach * along_.y + 1.0) * cells + 0.5 * cells},
          tank_(definition()) {
        const double thick = 4.0;  // cells
        const Ring plate = rectangle((2.0 * kReach + 1.0) * cells * cell(), thick * cell());
        const weir::Vec2<double> normal{along_.y, -along_.x};
        weir::BodyDef body = body_of(plate, (hit_.x + 0.5 * thick * normal.x) * cell(),
                                     (hit_.y + 0.5 * thick * normal.y) * cell(), angle);
        require(tank_->add_static_body(body, &plate_));
    }

    /// Over the times 20 to 40 b/U.
    PlateForce run() {
        weir::Vec2<double> impulse;
        double time = 0.0;
        const int steps = 40 * cells_;  // a cell each
        for (int k = 0; k < steps; ++k) {
            emit();
            const weir::StepReport report = tank_->step(static_cast<float>(cell() / kSpeed));
            drain();
            if (k >= steps / 2) {
                weir::BodyForce force;
                require(tank_->force(plate_, &force));
                impulse = impulse + weir::convert<double>(force.impulse_m3ps);
                time += static_cast<double>(report.dt_s);
            }
        }
        const double full = time * kSpeed * kSpeed * cells_ * cell() * along_.y;
        const weir::Vec2<double> normal{along_.y, -along_.x};
        return {weir::dot(impulse, normal) / full, weir::dot(impulse, along_) / full};
    }

private:
    static double cell() { return 1.0 / 64.0; }

    weir::WorldDef definition() const {
        weir::WorldDef def;
        def.cell_m = static_cast<float>(cell());
        def.gravity_mps2 = {};
        def.capacity.cells_x =
            static_cast<int>(hit_.x + (kReach * std::abs(along_.x) + 0.5) * cells_) + 8;
        def.capacity.cells_y = static_cast<int>(2.0 * hit_.y);
        def.capacity.particles = 4 * 4 * static_cast<int>(kReach) * cells_ * cells_;
        def.capacity.bodies = 1;
        def.capacity.vertices = 4;
        def.capacity.two_way = true;
        return def;
    }

    /// Two columns of the lattice behind those that went on by a cell.
    void emit() {
        const double start = hit_.x - kReach * cells_;
        for (const double x : {start + 0.25, start + 0.75}) {
            for (int row = 0; row < 2 * cells_; ++row) {
                const double y = hit_.y - 0.5 * cells_ + 0.25 + 0.5 * row;
                require(tank_->add_particle(
                    {static_cast<float>(x * cell()), static_cast<float>(y * cell())},
                    {static_cast<float>(kSpeed), 0.0F}));
            }
        }
    }

    /// Takes out what has come to the ends of the plate.
    void drain() {
        for (int k = tank_->particle_positions().size - 1; k >= 0; --k) {
            const weir::Vec2<double> x = tank_.position(k);
            if (std::abs(weir::dot(x - hit_, along_)) > kReach * cells_) {
                require(tank_->remove_particle(k));
            }
        }
    }

    int cells_;
    weir::Vec2<double> along_;  ///< the plate
    weir::Vec2<double> hit_;    ///< where the jet's axis meets it, cells
    Tank<Real> tank_;
    weir::BodyId plate_;
};

template <class Real>
void push(Report& report, int cells, double degrees) {
    const std::string name = "R13a." + std::to_string(static_cast<int>(degrees)) + "deg.";
    const std::string n = std::to_string(cells);
    rows(report, name + n, [&] {
        const PlateForce force = Jet<Real>(cells, degrees * kDegree).run();
        report.at_most(name + "force_error." + n, 100.0 * std::abs(force.normal - 1.0), "%",
                       cells == 16 ? 2.0 : 1.0);
        report.figure(name + "force_along_plate." + n, 100.0 * force.along, "%");
    });
}

}  // namespace

void jet_on_plate(Report& report, const Effort& effort) {
    for (const int cells : {16, 32}) {
        for (const double degrees : {90.0, 60.0, 45.0}) {
            if (cells > 16 && degrees < 50.0 && !effort.full) {
                continue;
            }
            in_scalar(report, effort.real,
                      [&](auto zero) { push<decltype(zero)>(report, cells, degrees); });
        }
    }
}

}  // namespace solids
