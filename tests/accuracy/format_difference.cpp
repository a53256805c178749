// What the number formats do to a solution, against what the grid does to it: R5A and R6a at 32
// cells on the same lattices in every format. The difference to double is taken in the norm of the
// problem's own error; in fixed point it may be a tenth of double's error, the worst lattice of
// each counting. Float's stands beside it: where trajectories are chaotic, any rounding makes as
// much. R6a begins with 1000 steps of rest, each format's own: what becomes of the lattice is part of
// the difference. From double's, which it is also run from, the wave alone differs.
#include <cmath>
#include <functional>

#include "dam_break.hpp"
#include "problems.hpp"

namespace accuracy {

namespace {

constexpr int kCells = 32;
constexpr double kMostRatio = 0.1;

/// By lattice.
using Outcomes = std::vector<Outcome>;

/// Something that is measured: its name among an outcome's values, and how far an outcome is from
/// another in it, in the same unit.
struct Quantity {
    std::string name;
    const char* unit;
    std::function<double(const Outcome&, const Outcome&)> difference;
};

struct Problem {
    const char* name;
    Run run;
    std::vector<Quantity> quantities;
    bool given_rest = false;  ///< all start from the particles that are at rest in double
};

Outcomes run_lattices(Report& report, const Effort& effort, const Problem& problem, Kind kind) {
    Outcomes outcomes;
    for (const Lattice lattice : kLattices) {
        Case c{kCells, lattice, effort.options};
        Particles rested;
        if (problem.given_rest) {
            rested = rest_before_wave(*make_scheme(Kind::projection_double), c);
            c.start = &rested;
        }
        outcomes.push_back(problem.run(*make_scheme(kind), c));
        if (!outcomes.back().broken.empty()) {
            report.broken(std::string("formats.") + problem.name + "." + kind_name(kind) + "." +
                          lattice_name(lattice) + " " + outcomes.back().broken);
        }
    }
    return outcomes;
}

double largest(const std::vector<double>& values) {
    double most = 0.0;
    for (const double value : values) {
        most = std::isnan(value) ? value : std::fmax(most, std::fabs(value));
    }
    return most;
}

double mean_size(const std::vector<double>& values) {
    double sum = 0.0;
    for (const double value : values) {
        sum += std::fabs(value);
    }
    return sum / static_cast<double>(values.size());
}

/// `of - exact` of a value.
Quantity value_of(const std::string& name, const char* unit) {
    return {name, unit, [name](const Outcome& of, const Outcome& exact) {
                return of.value(name) - exact.value(name);
            }};
}

/// The front's places over those in double, less 1, at the times of the error.
double front_difference(const Outcome& of, const Outcome& exact) {
    double sum = 0.0;
    for (const double t : kFrontTimes) {
        const double e = value_at(*of.curve("front"), t) / value_at(*exact.curve("front"), t) - 1.0;
        sum += e * e;
    }
    return 100.0 * std::sqrt(sum / 5.0);
}

/// A sensor's signals at the times of the reference.
Quantity pressure(const Effort& effort, const std::string& sensor) {
    const Signal reference = pressure_reference(effort.data, sensor);
    return {sensor, "rho g H", [reference, sensor](const Outcome& of, const Outcome& exact) {
                Signal at_its_times;
                for (const double t : reference.t) {
                    at_its_times.add(t, value_at(*exact.curve(sensor), t));
                }
                return rms_difference(*of.curve(sensor), at_its_times, kPressureFrom, kPressureTo);
            }};
}

std::vector<Problem> problems_of(const Effort& effort) {
    std::vector<Quantity> dam = {{"front_error", "%", front_difference}};
    for (const char* sensor : {"P1", "P2", "P3", "P4"}) {
        dam.push_back(pressure(effort, sensor));
    }
    const std::vector<Quantity> wave = {value_of("frequency_error", "%"),
                                        value_of("loss_per_period", "%")};
    return {{"R5A", run_dam_break, dam},
            {"R6a", run_standing_wave, wave},
            {"R6a_from_rest", run_standing_wave, wave, true}};
}

void compare(Report& report, const Problem& problem, const Outcomes& exact, const Outcomes& of,
             Kind kind) {
    const std::string prefix = std::string("formats.") + problem.name + "." + kind_name(kind);
    for (const Quantity& quantity : problem.quantities) {
        std::vector<double> errors;
        std::vector<double> differences;
        for (std::size_t k = 0; k < exact.size(); ++k) {
            errors.push_back(exact[k].value(quantity.name));
            differences.push_back(quantity.difference(of[k], exact[k]));
        }
        const std::string difference = quantity.name + ".difference";
        report.worst_of(prefix, {difference.c_str(), quantity.unit, {}}, kCells, differences);
        const std::string name = prefix + "." + quantity.name;
        const double ratio = largest(differences) / largest(errors);
        if (kind == Kind::projection_fixed) {
            report.at_most(name + ".difference_over_error", ratio, "1", kMostRatio);
        } else {
            report.figure(name + ".difference_over_error", ratio, "1");
        }
        report.figure(name + ".mean_difference_over_mean_error",
                      mean_size(differences) / mean_size(errors), "1");
    }
}

void report_errors(Report& report, const Problem& problem, const Outcomes& exact) {
    const std::string prefix = std::string("formats.") + problem.name + ".projection_double";
    for (const Quantity& quantity : problem.quantities) {
        std::vector<double> errors;
        for (const Outcome& outcome : exact) {
            errors.push_back(outcome.value(quantity.name));
        }
        report.worst_of(prefix, {quantity.name.c_str(), quantity.unit, {}}, kCells, errors);
    }
}

}  // namespace

void report_format_difference(Report& report, const Effort& effort) {
    report.heading("R5A and R6a in every format, against double");
    for (const Problem& problem : problems_of(effort)) {
        const Outcomes exact = run_lattices(report, effort, problem, Kind::projection_double);
        report_errors(report, problem, exact);
        for (const Kind kind : {Kind::projection_fixed, Kind::projection_small_fixed,
                                Kind::projection}) {
            compare(report, problem, exact, run_lattices(report, effort, problem, kind), kind);
        }
    }
}

}  // namespace accuracy
