// Volume over long times (R14): how high the liquid stands against its volume. A dam break that
// has settled, a half full tank turned over 80 times, and a resting pool for 10^5 steps (10^6 as
// an option).
#include <algorithm>
#include <cmath>

#include "dam_break.hpp"
#include "problems.hpp"

namespace accuracy {

namespace {

/// Per cent by which the liquid stands too high over the floor y = 0. In a strip of width w with n
/// particles it should reach up to n / (4 w), its centre of mass half as high; strips of four
/// cells, so that sloshing does not count as volume.
double height_error(const Particles& particles, int width) {
    const int strips = std::max(1, width / 4);
    const double strip = static_cast<double>(width) / strips;
    std::vector<int> count(static_cast<std::size_t>(strips), 0);
    double sum = 0.0;
    for (const Particle& p : particles) {
        const int k = std::max(0, std::min(strips - 1, static_cast<int>(p.x.x / strip)));
        ++count[static_cast<std::size_t>(k)];
        sum += p.x.y;
    }
    double exact = 0.0;
    for (const int n : count) {
        exact += 0.5 * n * n / (kPerCell * strip);
    }
    return 100.0 * (sum / exact - 1.0);
}

/// Advances and returns the mean error over the last `averaged` units of time.
double settle(Scheme& scheme, int width, double time, double averaged, double since,
              Signal& course) {
    double sum = 0.0;
    int count = 0;
    const auto steps = static_cast<int>(time / scheme.interval());
    for (int k = 1; k <= steps; ++k) {
        scheme.advance();
        const double t = k * scheme.interval();
        if (k % 16 == 0 || t > time - averaged) {
            const double error = height_error(scheme.particles(), width);
            course.add(since + t, error);
            sum += t > time - averaged ? error : 0.0;
            count += t > time - averaged ? 1 : 0;
        }
    }
    return sum / count;
}

Outcome run_settled_dam_break(Scheme& scheme, const Case& c) {
    Setup setup = dam_break_setup(c);
    const Particles start = dam_break_column(c);
    scheme.start(setup, start);
    Outcome outcome;
    Signal course;
    outcome.add("height_error", settle(scheme, setup.nx, 60.0, 10.0, 0.0, course));
    outcome.curves.emplace_back("height", course);
    check_particles(scheme, start.size(), setup.nx, setup.ny, 2.0, outcome);
    return outcome;
}

Outcome run_flips(Scheme& scheme, const Case& c) {
    constexpr int kFlips = 80;
    Setup setup;
    setup.nx = c.cells;
    setup.ny = c.cells;
    setup.gravity = {0.0, -double(c.cells)};
    setup.interval = 0.05;
    setup.sound_speed = 10.0 * c.cells;
    setup.top_speed = 4.0 * c.cells;
    setup.options = c.options;
    const Particles start =
        seed_box(c.lattice, {0.0, 0.0}, {double(c.cells), 0.5 * c.cells});
    scheme.start(setup, start);
    Signal unused;
    double sign = 1.0;
    for (int flip = 0; flip < kFlips; ++flip) {
        sign = -sign;
        scheme.set_gravity(sign * setup.gravity);
        settle(scheme, setup.nx, 4.0, 0.05, 0.0, unused);
    }
    Outcome outcome;
    Signal course;
    outcome.add("height_error", settle(scheme, setup.nx, 40.0, 10.0, 0.0, course));
    outcome.add("residual_speed", speed(scheme.particles()).rms / c.cells);
    outcome.curves.emplace_back("height", course);
    check_particles(scheme, start.size(), setup.nx, setup.ny, 2.0, outcome);
    return outcome;
}

Outcome run_pool(Scheme& scheme, const Case& c, int steps) {
    Setup setup;
    setup.nx = 16;
    setup.ny = c.cells + 8;
    setup.gravity = {0.0, -double(c.cells)};
    setup.interval = std::sqrt(0.1 / c.cells);
    setup.sound_speed = 10.0 * c.cells;
    setup.top_speed = c.cells;
    setup.options = c.options;
    const Particles start = seed_box(c.lattice, {0.0, 0.0}, {16.0, double(c.cells)});
    scheme.start(setup, start);
    Signal course;
    double early = 0.0;
    for (int k = 1; k <= steps; ++k) {
        scheme.advance();
        if (k % 500 == 0) {
            course.add(k, height_error(scheme.particles(), setup.nx));
            early = k == 1000 ? course.y.back() : early;
        }
    }
    Outcome outcome;
    outcome.add("height_error", course.y.back());
    outcome.add("creep_since_step_1000", course.y.back() - early);
    outcome.add("residual_speed", speed(scheme.particles()).largest / c.cells);
    outcome.curves.emplace_back("height", course);
    check_particles(scheme, start.size(), setup.nx, setup.ny, 1.0, outcome);
    return outcome;
}

}  // namespace

void report_volume(Report& report, const Effort& effort) {
    const std::vector<std::pair<int, double>> one_percent = {{16, 1.0}, {32, 1.0}, {64, 1.0}};
    const Metric height{"height_error", "%", one_percent};
    const Metric quiet{"residual_speed", "sqrt(g h)", {}};
    std::vector<Curve> curves;
    report.heading("R14 volume: dam break, settled");
    const std::vector<int> cells = resolutions(effort, 32);
    const std::vector<Plan> dams = {{Kind::projection, cells, 3},
                                    {Kind::equation_of_state, {16}, 1},
                                    {Kind::reference, {16}, 1}};
    for (const Plan& plan : chosen(effort, dams)) {
        const auto last =
            sweep(report, effort, "R14.dam_break", plan, {height}, run_settled_dam_break);
        for (const Outcome& outcome : last) {
            curves.push_back({kind_name(plan.kind), *outcome.curve("height"), false});
        }
    }
    report.plot("R14 dam break", "t sqrt(g/H)", "height error, per cent", curves);

    report.heading("R14 volume: 80 gravity flips");
    std::vector<Plan> flips = {{Kind::projection, cells, 3}};
    if (!effort.quick) {
        flips.push_back({Kind::equation_of_state, {16}, 1});
    }
    for (const Plan& plan : chosen(effort, flips)) {
        sweep(report, effort, "R14.flips", plan, {height, quiet}, run_flips);
    }

    const int steps = effort.long_soak ? 1000000 : effort.quick ? 10000 : 100000;
    report.heading("R14 volume: resting pool, " + std::to_string(steps) + " steps");
    const std::vector<Plan> pools = {
        {Kind::projection, {effort.quick ? 16 : 32}, effort.quick ? 1 : 3}};
    for (const Plan& plan : chosen(effort, pools)) {
        const auto pool = sweep(
            report, effort, "R14.pool", plan,
            {height, {"creep_since_step_1000", "%", one_percent}, quiet},
            [&](Scheme& s, const Case& c) { return run_pool(s, c, steps); });
        for (const Outcome& outcome : pool) {
            report.plot("R14 pool", "step", "height error, per cent",
                        {{std::string(kind_name(plan.kind)) + ", last lattice",
                          *outcome.curve("height"), false}});
        }
    }
}

}  // namespace accuracy
