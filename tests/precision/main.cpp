// weir_precision OUT.csv [quick]: error against run time, for the library's two pressures and the
// paper's own method, over resolutions, step lengths and settings. All on the rotated lattice.
// The score is how many times faster than the paper's method a scheme reaches the paper's own best
// error, as a geometric mean over the problems.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <map>
#include <string>
#include <vector>

#include "dam_break.hpp"
#include "pareto.hpp"
#include "problems.hpp"

namespace {

using accuracy::Case;
using accuracy::Kind;
using accuracy::Options;
using accuracy::Outcome;
using accuracy::Report;
using accuracy::Scheme;
using precision::Point;

constexpr int kRepeats = 3;  ///< run times are the median of so many

struct Problem {
    const char* name;
    const char* unit;
    double fixed_error;  ///< time to this is reported for the library
    Outcome (*run)(Scheme&, const Case&);
    double (*error)(const Outcome&);
};

Outcome one_period(Scheme& scheme, const Case& c) {
    return accuracy::run_oscillating_drop(scheme, c, 1);
}

double wave_error(const Outcome& o) {
    return std::hypot(o.value("frequency_error"), o.value("loss_per_period"));
}

/// Energy alone passes through zero where noise feeds what dissipation takes.
double swing_error(const Outcome& o) {
    return std::hypot(o.value("energy_loss_per_period"), o.value("last_elongation_error"));
}

const Problem kProblems[] = {
    {"R4a", "% of rho g H", 1.0, accuracy::run_hydrostatic,
     [](const Outcome& o) { return 100.0 * o.value("pressure_l2"); }},
    {"R5A", "% of the front", 0.7, accuracy::run_dam_break_front,
     [](const Outcome& o) { return o.value("front_error"); }},
    {"R6a", "% frequency and loss", 1.0, accuracy::run_standing_wave, wave_error},
    {"R8", "% energy and elongation", 1.0, one_period, swing_error},
};

struct Trial {
    Kind kind;
    int cells;
    Options options;
    std::string label;  ///< what differs from the default
};

std::string text(const char* format, double value) {
    char buffer[32];
    std::snprintf(buffer, sizeof buffer, format, value);
    return buffer;
}

/// The library's defaults, then one setting changed at a time.
std::vector<std::pair<std::string, Options>> settings(int cells) {
    std::vector<std::pair<std::string, Options>> list = {{"default", {}}};
    const auto with = [&](const std::string& name, auto change) {
        Options options;
        change(options);
        list.emplace_back(name, options);
    };
    for (const int sweeps : {8, 32}) {
        with("sweeps" + std::to_string(sweeps), [=](Options& o) { o.sweeps = sweeps; });
    }
    if (cells >= 64) {
        with("sweeps64", [](Options& o) { o.sweeps = 64; });
        return list;
    }
    for (const double ratio : {0.9, 0.99}) {
        with(text("flip%g", ratio), [=](Options& o) { o.flip_ratio = ratio; });
    }
    for (const double gain : {0.0, 0.25}) {
        with(text("gain%g", gain), [=](Options& o) { o.volume_gain = gain; });
    }
    return list;
}

std::vector<Trial> projection_trials(bool quick) {
    std::vector<Trial> trials;
    for (const int cells : {16, 32, 64}) {
        if (quick && cells > 32) {
            continue;
        }
        for (const double scale : {0.5, 1.0, 2.0}) {
            if (cells >= 64 && scale < 1.0) {
                continue;
            }
            for (const auto& setting : settings(cells)) {
                Options options = setting.second;
                options.step_scale = scale;
                options.cfl = std::max(1.0, scale);
                trials.push_back({Kind::projection, cells, options,
                                  setting.first + text(".dt%g", scale)});
            }
        }
    }
    return trials;
}

/// Weakly compressible schemes: the sound speed sets the step.
std::vector<Trial> sound_trials(Kind kind, bool quick) {
    std::vector<Trial> trials;
    for (const int cells : {16, 32}) {
        if (quick && cells > 16) {
            continue;
        }
        for (const double sound : {0.3, 0.5, 1.0}) {
            for (const double ratio : {0.97, 0.99}) {
                if (kind == Kind::reference && ratio != 0.97) {
                    continue;  // its own smoothing is fixed
                }
                Options options;
                options.sound_scale = sound;
                options.flip_ratio = ratio;
                trials.push_back({kind, cells, options,
                                  text("sound%g", sound) +
                                      (kind == Kind::reference ? "" : text(".flip%g", ratio))});
            }
        }
    }
    return trials;
}

struct Measured {
    Point point;
    double ns_per_particle_step = 0.0;
    bool broken = false;
};

Measured measure(const Problem& problem, const Trial& trial) {
    Case c;
    c.cells = trial.cells;
    c.lattice = accuracy::Lattice::rotated;
    c.options = trial.options;
    Measured result;
    std::vector<double> per_unit;
    std::vector<double> per_step;
    for (int repeat = 0; repeat < kRepeats; ++repeat) {
        const auto scheme = accuracy::make_scheme(trial.kind);
        const Outcome outcome = problem.run(*scheme, c);
        result.broken = result.broken || !outcome.broken.empty();
        result.point.error = problem.error(outcome);
        const double particles = static_cast<double>(scheme->particles().size());
        const double steps = static_cast<double>(scheme->steps());
        per_unit.push_back(scheme->seconds() / scheme->time());
        per_step.push_back(1e9 * scheme->seconds() / (particles * steps));
    }
    std::sort(per_unit.begin(), per_unit.end());
    std::sort(per_step.begin(), per_step.end());
    result.point.time = per_unit[kRepeats / 2];
    result.ns_per_particle_step = per_step[kRepeats / 2];
    result.point.label = std::to_string(trial.cells) + "." + trial.label;
    return result;
}

using Points = std::map<Kind, std::vector<Point>>;

Points measure_all(Report& report, const Problem& problem, const std::vector<Trial>& trials) {
    Points points;
    std::printf("\n%s\n  %-48s %14s %14s %12s\n", problem.name, "", "s per unit time",
                problem.unit, "ns/p/step");
    for (const Trial& trial : trials) {
        const Measured m = measure(problem, trial);
        const std::string name = std::string(problem.name) + "." +
                                 accuracy::kind_name(trial.kind) + "." + m.point.label;
        std::printf("  %-48s %14.5g %14.4g %12.1f%s\n", name.c_str(), m.point.time,
                    m.point.error, m.ns_per_particle_step, m.broken ? "  BROKEN" : "");
        std::fflush(stdout);
        report.row(name + ".time", m.point.time, "s per unit time", nullptr);
        report.row(name + ".error", m.point.error, problem.unit, nullptr);
        report.row(name + ".ns_per_particle_step", m.ns_per_particle_step, "ns", nullptr);
        if (m.broken || !std::isfinite(m.point.error)) {
            report.broken(name);
        } else {
            points[trial.kind].push_back(m.point);
        }
    }
    return points;
}

void plot(Report& report, const Problem& problem, const Points& points) {
    std::vector<accuracy::Curve> curves;
    int colour = 0;
    for (const auto& entry : points) {
        ++colour;
        const std::string name = accuracy::kind_name(entry.first);
        accuracy::Curve all{name + ", every setting", {}, true, colour};
        for (const Point& point : entry.second) {
            all.data.add(point.time, point.error);
        }
        accuracy::Curve best{name + ", best", {}, false, colour};
        for (const Point& point : precision::pareto_front(entry.second)) {
            best.data.add(point.time, point.error);
        }
        curves.push_back(all);
        curves.push_back(best);
    }
    report.plot(std::string(problem.name) + " error against time", "wall s per unit of time",
                problem.unit, curves, "set logscale xy\nset key left bottom");
}

/// Speed-up over the paper's method at the paper's own best error, and what it took.
void compare(Report& report, const Problem& problem, Points& points,
             std::map<Kind, std::vector<double>>& speedups) {
    const std::vector<Point> paper = precision::pareto_front(points[Kind::reference]);
    for (const Kind kind : {Kind::projection, Kind::equation_of_state}) {
        const std::vector<Point> front = precision::pareto_front(points[kind]);
        const std::string name = std::string(problem.name) + "." + accuracy::kind_name(kind);
        const auto fixed = precision::time_to_error(front, problem.fixed_error);
        if (fixed) {
            std::printf("  %-48s %14.5g   to %g %s\n", (name + " time").c_str(), *fixed,
                        problem.fixed_error, problem.unit);
            report.row(name + ".time_to_fixed_error", *fixed, "s per unit time", nullptr);
        }
        const auto within = precision::error_within(front, paper.back().time);
        if (within) {
            report.row(name + ".error_over_papers_in_its_time", *within / paper.back().error, "1",
                       nullptr);
        }
        const auto time = precision::time_to_error(front, paper.back().error);
        if (!time) {
            std::printf("  %-48s never reaches the paper's error %.4g\n", name.c_str(),
                        paper.back().error);
            continue;
        }
        const double speedup = paper.back().time / *time;
        std::printf("  %-48s %14.4g   times the paper's speed at its best error, %.4g\n",
                    (name + " speed-up").c_str(), speedup, paper.back().error);
        report.row(name + ".speedup_at_papers_error", speedup, "1", nullptr);
        speedups[kind].push_back(speedup);
    }
}

int run(const std::string& path, bool quick) {
    Report report(path);
    std::vector<Trial> trials = projection_trials(quick);
    for (const Kind kind : {Kind::equation_of_state, Kind::reference}) {
        const std::vector<Trial> more = sound_trials(kind, quick);
        trials.insert(trials.end(), more.begin(), more.end());
    }
    std::map<Kind, std::vector<double>> speedups;
    for (const Problem& problem : kProblems) {
        Points points = measure_all(report, problem, trials);
        plot(report, problem, points);
        compare(report, problem, points, speedups);
    }
    std::printf("\n");
    for (const auto& entry : speedups) {
        double sum = 0.0;
        for (const double speedup : entry.second) {
            sum += std::log(speedup);
        }
        const double score = std::exp(sum / static_cast<double>(entry.second.size()));
        std::printf("score: %s reaches the paper's best errors %.4g times as fast "
                    "(geometric mean of %zu problems)\n",
                    accuracy::kind_name(entry.first), score, entry.second.size());
        report.row(std::string("score.") + accuracy::kind_name(entry.first), score, "1", nullptr);
    }
    return report.is_broken() ? 1 : 0;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 2) {
        std::fprintf(stderr, "usage: weir_precision OUT.csv [quick]\n");
        return 2;
    }
    accuracy::reference_folder() = WEIR_ACCURACY_DATA;
    try {
        return run(argv[1], argc > 2 && std::string(argv[2]) == "quick");
    } catch (const std::exception& error) {
        std::fprintf(stderr, "weir_precision: %s\n", error.what());
        return 1;
    }
}
