// R12: a box that floats in a tank four times as wide and twice as deep as the box is wide. Its
// draft at rest is Archimedes'; lifted and let go it heaves as linear potential flow in this tank
// says (finite elements, 30 cells a width).
#include <algorithm>
#include <cmath>

#include "measure/tank_def.hpp"
#include "problems.hpp"
#include "tank.hpp"

namespace solids {

namespace {

constexpr double kWidth = 0.2;  ///< of the box, m
constexpr double kHeight = 0.6 * kWidth;
constexpr double kDensity = 0.5;
constexpr double kDraft = kDensity * kHeight;
constexpr double kDepth = 2.0 * kWidth;
const double kUnit_s = std::sqrt(kWidth / 9.81);

/// The reference's first minimum, over the lift; at 2.58 units.
constexpr double kFirstMinimum = -0.944;

template <class Real>
struct Box {
    Tank<Real> tank;
    weir::BodyId id;

    Box(int cells, double lift) : tank(definition(cells)) {
        const Ring ring = rectangle(kWidth, kHeight);
        weir::BodyDef body =
            body_of(ring, 2.0 * kWidth, kDepth - kDraft + lift + 0.5 * kHeight);
        body.density_ratio = static_cast<float>(kDensity);
        weir::BodyId held;
        require(tank->add_static_body(body, &held));
        // The surface is flat while the box is lifted.
        const auto level = static_cast<float>(kDepth - lift / 3.0);
        require(tank->fill({{0.0F, 0.0F}, {static_cast<float>(4.0 * kWidth), level}}));
        for (int k = 0; k < 120; ++k) {
            tank->step(1.0F / 120.0F);
        }
        require(tank->remove_body(held));
        require(tank->add_free_body(body, &id));
    }

    static weir::WorldDef definition(int cells) {
        weir::WorldDef def = measure::tank_def(4 * cells, 3 * cells, 4 * 4 * cells * 2 * cells, 1,
                                               4);
        def.cell_m = static_cast<float>(kWidth / cells);
        def.capacity.two_way = true;
        return def;
    }

    /// A sixtieth of the unit of time; the time that was simulated, in units.
    double step() {
        return static_cast<double>(tank->step(static_cast<float>(kUnit_s / 60.0)).dt_s) / kUnit_s;
    }
    /// Height over where the draft is Archimedes', m.
    double height() {
        weir::Motion motion;
        require(tank->motion(id, &motion));
        return static_cast<double>(motion.position_m.y) - (kDepth - kDraft + 0.5 * kHeight);
    }
};

/// Mean difference to Archimedes' draft, of the width. The box sinks by z, the level around it
/// rises by z / 3.
template <class Real>
double draft_error(int cells) {
    Box<Real> box(cells, 0.0);
    double time = 0.0;
    double sum = 0.0;
    int count = 0;
    while (time < 24.0) {
        time += box.step();
        if (time > 8.0) {
            sum += box.height();
            ++count;
        }
    }
    return -4.0 / 3.0 * sum / count / kWidth;
}

/// Lowest height over the lift within the first four units of time.
template <class Real>
double first_minimum(int cells) {
    const double lift = 1.5 / 32.0 * kWidth;  // so that the surface is a row of the lattice
    Box<Real> box(cells, lift);
    double lowest = 1.0;
    for (double time = 0.0; time < 4.0;) {
        time += box.step();
        lowest = std::min(lowest, box.height() / lift);
    }
    return lowest;
}

template <class Real>
void float_box(Report& report, int cells) {
    const std::string n = std::to_string(cells);
    const double scale = 32.0 / cells;
    report.at_most("R12.draft_error." + n, 100.0 * std::abs(draft_error<Real>(cells)),
                   "% of width", 1.0 * scale);
    report.at_most("R12.first_minimum_error." + n,
                   100.0 * std::abs(first_minimum<Real>(cells) - kFirstMinimum), "% of lift",
                   4.0 * scale);
}

}  // namespace

void floating_box(Report& report, const Effort& effort) {
    at_resolutions(report, effort, {32, 64}, [&](auto zero, int cells) {
        rows(report, "R12." + std::to_string(cells),
             [&] { float_box<decltype(zero)>(report, cells); });
    });
}

}  // namespace solids
