// R5A: a column 2H wide and H high collapses in a tank 5.366H × 3H. Unit of length: a cell; of
// time: sqrt(H/g). The front is compared to the mean of two SPH schemes at H/400, the pressure at
// the far wall to the median-filtered signals of De Courcy et al. 2024 (CMAME 420:116700).
#include <algorithm>
#include <cmath>

#include "dam_break.hpp"
#include "problems.hpp"
#include "reference_data.hpp"

namespace accuracy {

namespace {

constexpr double kEnd = 6.6;
constexpr double kFrontEnd = 2.25;
constexpr double kSoundRatio = 10.0;
constexpr double kMedianWidth = 0.12;
constexpr double kSensorCentre[4] = {0.01, 0.05, 0.1, 0.2667};  ///< height over H
constexpr double kSensorSize = 0.014;
const char* const kSensorName[4] = {"P1", "P2", "P3", "P4"};

double front(const Particles& particles) {
    double x = 0.0;
    for (const Particle& p : particles) {
        x = std::max(x, p.x.x);
    }
    return x + 0.5 * kSpacing;
}

/// The far edge of the farthest column of cells that holds at least half a cell of liquid.
double column_front(const Particles& particles, int nx) {
    std::vector<int> count(static_cast<std::size_t>(nx) + 1, 0);
    for (const Particle& p : particles) {
        ++count[static_cast<std::size_t>(std::max(0.0, std::min(p.x.x, double(nx))))];
    }
    for (int i = nx; i >= 0; --i) {
        if (count[static_cast<std::size_t>(i)] >= 0.5 * kPerCell) {
            return i + 1.0;
        }
    }
    return 0.0;
}

/// Wall pressure at a height: linear between cell centres and below the lowest.
double wall_pressure(const Scheme& scheme, int nx, double y) {
    const double row = std::max(0.0, y - 0.5);
    const int j = static_cast<int>(row);
    const double low = scheme.pressure(nx - 1, j);
    const double high = scheme.pressure(nx - 1, j + 1);
    return low + (y - 0.5 - j) * (high - low);
}

double sensor(const Scheme& scheme, int nx, int h, int index) {
    constexpr int kPoints = 5;
    double sum = 0.0;
    for (int k = 0; k < kPoints; ++k) {
        const double offset = kSensorSize * ((k + 0.5) / kPoints - 0.5);
        sum += std::max(0.0, wall_pressure(scheme, nx, (kSensorCentre[index] + offset) * h));
    }
    return sum / kPoints;
}

double front_error(const Signal& measured, const std::string& data) {
    const Signal reference = front_reference(data);
    double sum = 0.0;
    for (const double t : kFrontTimes) {
        const double e = value_at(measured, t) / value_at(reference, t) - 1.0;
        sum += e * e;
    }
    return 100.0 * std::sqrt(sum / 5.0);
}

void add_pressures(const Signal (&raw)[4], const std::string& data, Outcome& outcome) {
    for (int k = 0; k < 4; ++k) {
        const std::string name = kSensorName[k];
        const Signal filtered = running_median(raw[k], kMedianWidth);
        const Signal reference = pressure_reference(data, name);
        const auto off = [&](const Signal& measured) {
            return rms_difference(measured, reference, kPressureFrom, kPressureTo);
        };
        outcome.add(name, off(filtered));
        outcome.add(name + "_raw", off(raw[k]));
        outcome.curves.emplace_back(name, filtered);
    }
}

}  // namespace

std::string& reference_folder() {
    static std::string folder;
    return folder;
}

Signal front_reference(const std::string& data) {
    const std::string path = data + "/dambreak_2HxH_front_trixi_sph.csv";
    return mean_of(read_column(path, "xfront_over_H_wcsph_400"),
                   read_column(path, "xfront_over_H_edac_400"));
}

Signal pressure_reference(const std::string& data, const std::string& sensor_name) {
    return read_column(data + "/dambreak_2HxH_pressure_decourcy_median.csv",
                       sensor_name + "_over_rho_g_H");
}

Setup dam_break_setup(const Case& c) {
    Setup setup;
    setup.nx = static_cast<int>(std::lround(5.366 * c.cells));
    setup.ny = 3 * c.cells;
    setup.gravity = {0.0, -double(c.cells)};
    // The front runs at up to 2 sqrt(g H) = 2H cells per unit of time; 0.1 / whole number.
    setup.interval = 0.1 / std::ceil(0.1 * 2.0 * c.cells);
    setup.sound_speed = kSoundRatio * c.cells;
    setup.top_speed = 3.0 * c.cells;
    setup.options = c.options;
    return setup;
}

Particles dam_break_column(const Case& c) {
    return seed_box(c.lattice, {0.0, 0.0}, {2.0 * c.cells, double(c.cells)});
}

namespace {

/// What the liquid has as the column that it fills: particles of a shifted lattice stand lower.
double energy_of_column(const Particles& start, const Case& c) {
    const double count = static_cast<double>(start.size());
    const double height = count * kSpacing * kSpacing / (2.0 * c.cells);
    return 0.5 * count * c.cells * height;
}

Outcome run_until(Scheme& scheme, const Case& c, double end, bool pressures) {
    const Setup setup = dam_break_setup(c);
    const Particles start = dam_break_column(c);
    scheme.start(setup, start);
    const double unit = 1.0 / c.cells;
    const double initial =
        std::max(energy(start, setup.gravity).total(), energy_of_column(start, c));
    double largest = initial;
    Signal by_particle;
    Signal by_column;
    Signal energies;
    Signal raw[4];
    by_particle.add(0.0, front(start) * unit);
    by_column.add(0.0, column_front(start, setup.nx) * unit);
    const auto steps = static_cast<int>(std::ceil(end / scheme.interval()));
    for (int k = 1; k <= steps; ++k) {
        scheme.advance();
        const double t = k * scheme.interval();
        const Particles now = scheme.particles();
        const double e = energy(now, setup.gravity, scheme.own_step()).total();
        largest = std::max(largest, e);
        energies.add(t, e / initial);
        by_particle.add(t, front(now) * unit);
        by_column.add(t, column_front(now, setup.nx) * unit);
        for (int s = 0; pressures && s < 4; ++s) {
            raw[s].add(t, sensor(scheme, setup.nx, c.cells, s) * unit * unit);
        }
    }
    Outcome outcome;
    outcome.add("front_error", front_error(by_particle, reference_folder()));
    outcome.add("front_error_by_column", front_error(by_column, reference_folder()));
    outcome.add("energy_rise", largest / initial - 1.0);
    if (pressures) {
        add_pressures(raw, reference_folder(), outcome);
    }
    outcome.curves.emplace_back("front", by_particle);
    outcome.curves.emplace_back("energy", energies);
    check_particles(scheme, start.size(), setup.nx, setup.ny, 2.0, outcome);
    return outcome;
}

Signal until(const Signal& signal, double end) {
    Signal result;
    for (std::size_t k = 0; k < signal.t.size() && signal.t[k] <= end; ++k) {
        result.add(signal.t[k], signal.y[k]);
    }
    return result;
}

}  // namespace

Outcome run_dam_break(Scheme& scheme, const Case& c) {
    return run_until(scheme, c, kEnd, true);
}

Outcome run_dam_break_front(Scheme& scheme, const Case& c) {
    return run_until(scheme, c, kFrontEnd, false);
}

void report_dam_break(Report& report, const Effort& effort) {
    report.heading("R5A dam break");
    const std::vector<Metric> metrics = {
        {"front_error", "%", {{32, 0.7}, {64, 0.35}, {128, 0.2}}},
        {"front_error_by_column", "%", {}},
        {"P1", "rho g H", {{32, 0.10}, {64, 0.06}, {128, 0.04}}},
        {"P2", "rho g H", {{32, 0.05}, {64, 0.03}, {128, 0.025}}},
        {"P3", "rho g H", {{32, 0.05}, {64, 0.03}, {128, 0.025}}},
        {"P4", "rho g H", {{32, 0.05}, {64, 0.03}, {128, 0.025}}},
        {"P1_raw", "rho g H", {{32, 0.15}, {64, 0.10}, {128, 0.08}}},
        {"P2_raw", "rho g H", {{32, 0.15}, {64, 0.10}, {128, 0.08}}},
        {"P3_raw", "rho g H", {{32, 0.15}, {64, 0.10}, {128, 0.08}}},
        {"P4_raw", "rho g H", {{32, 0.15}, {64, 0.10}, {128, 0.08}}},
        {"energy_rise", "E0", {{16, 1e-4}, {32, 1e-4}, {64, 1e-4}, {128, 1e-4}}}};
    std::vector<Curve> curves[6];
    const char* const names[6] = {"front", "energy", "P1", "P2", "P3", "P4"};
    for (const Plan& plan : beside_others(effort, resolutions(effort),
                                          {Kind::equation_of_state, Kind::reference})) {
        const auto last = sweep(report, effort, "R5A", plan, metrics, run_dam_break);
        for (std::size_t k = 0; k < last.size(); ++k) {
            const std::string title = title_of(plan, k);
            for (int n = 0; n < 6; ++n) {
                const Signal& signal = *last[k].curve(names[n]);
                curves[n].push_back({title, n == 0 ? until(signal, 2.4) : signal, false});
            }
        }
    }
    curves[0].push_back({"SPH, H/400 (mean of two)", front_reference(effort.data), true});
    for (int n = 2; n < 6; ++n) {
        curves[n].push_back(
            {"De Courcy et al. 2024", pressure_reference(effort.data, names[n]), true});
    }
    report.plot("R5A front", "t sqrt(g/H)", "x / H", curves[0], "set key left top");
    report.plot("R5A energy", "t sqrt(g/H)", "E / E0", curves[1]);
    for (int n = 2; n < 6; ++n) {
        report.plot(std::string("R5A ") + names[n], "t sqrt(g/H)", "p / (rho g H)", curves[n]);
    }
}

}  // namespace accuracy
