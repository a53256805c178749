// The stable region: a short violent dam break for each point over CFL number × sweeps (equation
// of state: sound speed) × particles per cell × viscosity. Drawn by gnuplot, if it is there.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "cases.hpp"

namespace stability {

namespace {

struct Axes {
    std::vector<float> cfl;
    std::vector<float> rows;  ///< sweeps, or sound speed in m/s
    std::vector<std::int32_t> particles_per_cell;
    std::vector<float> viscosity;  ///< ν dt of a frame, cells²
};

Axes axes_of(const Scheme& scheme, bool full) {
    Axes axes;
    axes.cfl = full ? std::vector<float>{0.1F, 0.25F, 0.5F, 0.75F, 1.0F, 1.5F, 2.0F}
                    : std::vector<float>{0.25F, 0.5F, 1.0F, 2.0F};
    if (scheme.elastic()) {
        axes.rows = full ? std::vector<float>{1, 2, 4, 8, 16, 32} : std::vector<float>{2, 8, 16};
    } else {
        axes.rows = full ? std::vector<float>{1, 2, 4, 8, 16, 32, 64}
                         : std::vector<float>{1, 4, 8, 16, 40};
    }
    axes.particles_per_cell =
        full ? std::vector<std::int32_t>{1, 4, 9, 16} : std::vector<std::int32_t>{1, 4};
    axes.viscosity = full ? std::vector<float>{0, 0.25F, 4} : std::vector<float>{0, 1};
    return axes;
}

struct Point {
    double energy = 0.0;
    double volume = 0.0;
    bool whole = false;
};

template <class Real>
Point measure(const Scheme& scheme, float cfl, float row, std::int32_t per_cell, float viscosity) {
    weir::WorldDef def = tank_def(scheme, 20, 16, 20 * 16 * per_cell);
    def.cfl = cfl;
    def.particles_per_cell = per_cell;
    def.max_substeps = 200;
    if (scheme.elastic()) {
        def.sound_speed_mps = row;
    } else {
        def.pressure_sweeps = static_cast<std::int32_t>(row);
    }
    def.viscosity_m2ps = viscosity * kCell * kCell / kFrame;
    Tank<Real> tank(def);
    tank.fill(0, 0, 8, 12);
    // Two frames a step: the CFL number decides how it is cut.
    tank.run(60, 2.0F * kFrame);
    // Long enough to come to rest.
    tank.run(90, 2.0F * kFrame);
    return {tank.tally().energy_ratio, tank.volume_error(), tank.tally().whole()};
}

/// Fewer than 8 sweeps are known not to be stable.
bool enough(const Scheme& scheme, float row) { return scheme.elastic() || row >= 8.0F; }

/// One panel of a picture: a matrix file, rows from below.
void write_panel(const std::string& path, const std::vector<std::vector<double>>& values) {
    std::FILE* file = std::fopen(path.c_str(), "w");
    if (file == nullptr) {
        return;
    }
    for (const auto& row : values) {
        for (const double value : row) {
            std::fprintf(file, "%.6g ", value);
        }
        std::fprintf(file, "\n");
    }
    std::fclose(file);
}

template <class Number>
std::string tics(const std::vector<Number>& values) {
    std::string text;
    for (std::size_t k = 0; k < values.size(); ++k) {
        char one[48];
        std::snprintf(one, sizeof one, "%s'%g' %zu", k == 0 ? "" : ",",
                      static_cast<double>(values[k]), k);
        text += one;
    }
    return text;
}

struct Panel {
    std::string title;
    std::string file;
};

void draw(const std::string& picture, const Axes& axes, const char* row_label,
          const std::vector<Panel>& panels, const char* palette) {
    std::FILE* script = std::fopen((picture + ".gp").c_str(), "w");
    if (script == nullptr) {
        return;
    }
    const std::size_t columns = axes.viscosity.size();
    const std::size_t rows = axes.particles_per_cell.size();
    std::fprintf(script, "set terminal png size %zu,%zu\nset output '%s.png'\n", 420 * columns,
                 340 * rows, picture.c_str());
    std::fprintf(script, "set multiplot layout %zu,%zu\n%s\n", rows, columns, palette);
    std::fprintf(script, "set xtics (%s)\nset ytics (%s)\nset xlabel 'CFL number'\n",
                 tics(axes.cfl).c_str(), tics(axes.rows).c_str());
    std::fprintf(script, "set ylabel '%s'\nunset key\n", row_label);
    for (const Panel& panel : panels) {
        std::fprintf(script, "set title '%s' noenhanced\nplot '%s' matrix with image\n",
                     panel.title.c_str(), panel.file.c_str());
    }
    std::fprintf(script, "unset multiplot\n");
    std::fclose(script);
    const std::string command = "gnuplot '" + picture + ".gp' 2> /dev/null";
    std::printf("  %s.png%s\n", picture.c_str(),
                std::system(command.c_str()) == 0 ? "" : " (not drawn)");
}

constexpr const char* kEnergyPalette =
    "set cblabel 'log10 of energy gained'\nset cbrange [-8:2]\n"
    "set palette defined (-8 'dark-green', -4 'light-green', -3.9 'yellow', 0 'red', 2 'black')";
constexpr const char* kVolumePalette =
    "set cblabel 'settled volume error, %'\nset cbrange [-20:20]\n"
    "set palette defined (-20 'blue', -5 'light-blue', 0 'white', 5 'orange', 20 'red')";

template <class Real>
void map_scheme(Report& report, const Scheme& scheme, bool full) {
    const Axes axes = axes_of(scheme, full);
    const std::string name = "map." + scheme.name();
    const std::string stem = report.stem() + "_" + scheme.name();
    std::vector<Panel> energy_panels;
    std::vector<Panel> volume_panels;
    int points = 0;
    int broken = 0;
    int gained = 0;
    int gained_with_enough = 0;
    double worst_gain = 0.0;
    double worst_volume = 0.0;
    for (const std::int32_t per_cell : axes.particles_per_cell) {
        for (const float viscosity : axes.viscosity) {
            std::vector<std::vector<double>> energy(axes.rows.size());
            std::vector<std::vector<double>> volume(axes.rows.size());
            for (std::size_t r = 0; r < axes.rows.size(); ++r) {
                for (const float cfl : axes.cfl) {
                    const Point p = measure<Real>(scheme, cfl, axes.rows[r], per_cell, viscosity);
                    ++points;
                    broken += p.whole ? 0 : 1;
                    const bool more = !(p.energy <= bounds_of(scheme).energy);
                    gained += more ? 1 : 0;
                    gained_with_enough += more && enough(scheme, axes.rows[r]) ? 1 : 0;
                    worst_gain = std::max(worst_gain, p.energy);
                    worst_volume = std::max(worst_volume, std::fabs(p.volume));
                    energy[r].push_back(std::log10(std::max(1.0e-8, p.energy - 1.0)));
                    volume[r].push_back(100.0 * p.volume);
                }
            }
            char title[80];
            std::snprintf(title, sizeof title, "%d per cell, nu dt = %g", per_cell,
                          static_cast<double>(viscosity));
            const std::string file = stem + "_" + std::to_string(energy_panels.size());
            write_panel(file + "_energy.dat", energy);
            write_panel(file + "_volume.dat", volume);
            energy_panels.push_back({title, file + "_energy.dat"});
            volume_panels.push_back({title, file + "_volume.dat"});
        }
    }
    const char* row_label = scheme.elastic() ? "sound speed, m/s" : "sweeps";
    draw(stem + "_energy", axes, row_label, energy_panels, kEnergyPalette);
    draw(stem + "_volume", axes, row_label, volume_panels, kVolumePalette);
    report.figure(name + ".points", points, "1");
    report.equals(name + ".not_whole", broken, "points", 0);
    report.figure(name + ".energy_grew", gained, "points");
    report.equals(name + ".energy_grew_with_enough_sweeps", gained_with_enough, "points", 0);
    report.figure(name + ".worst_energy", worst_gain, "of put in");
    report.figure(name + ".worst_settled_volume_error", worst_volume, "1");
}

}  // namespace

void stability_map(Report& report, const Effort& effort) {
    each_scheme(effort.scalar, false, false, [&](const Scheme& scheme, auto real) {
        map_scheme<decltype(real)>(report, scheme, effort.full);
    });
}

}  // namespace stability
