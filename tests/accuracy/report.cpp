#include "report.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>

namespace accuracy {

namespace {

/// Of gnuplot, before they come again: then lines are dashed.
constexpr std::size_t kColours = 8;

/// Where the CSV goes, and the pictures beside it.
const std::string& with_folder(const std::string& path) {
    const std::filesystem::path p(path);
    std::filesystem::create_directories(p.parent_path() / p.stem());
    return path;
}

const double* limit_at(const Metric& metric, int cells) {
    for (const auto& limit : metric.limits) {
        if (limit.first == cells) {
            return &limit.second;
        }
    }
    return nullptr;
}

/// Spaces and slashes have no place in file names and columns.
std::string plain(std::string text) {
    for (char& c : text) {
        c = c == ' ' || c == '/' || c == ',' ? '_' : c;
    }
    return text;
}

}  // namespace

Report::Report(const std::string& path) : measure::Report(with_folder(path)) {}

void Report::heading(const std::string& text) const {
    std::printf("\n%s\n  %-52s %12s %12s %12s %12s %10s\n", text.c_str(), "", "aligned", "shifted",
                "rotated", "worst", "target");
    std::fflush(stdout);
}

void Report::row(const std::string& name, double value, const char* unit, const double* limit) {
    if (limit == nullptr) {
        measure::Report::row(name, value, unit);
    } else {
        measure::Report::row(name, value, unit, "<=", *limit, std::fabs(value) <= *limit);
    }
}

void Report::worst_of(const std::string& prefix, const Metric& metric, int cells,
                      const std::vector<double>& per_lattice) {
    double worst = 0.0;
    for (const double value : per_lattice) {
        worst = std::isnan(value) || std::fabs(value) > std::fabs(worst) ? value : worst;
    }
    const std::string name = prefix + "." + std::to_string(cells) + "." + metric.name;
    const double* limit = limit_at(metric, cells);
    std::printf("  %-52s", name.c_str());
    for (std::size_t k = 0; k < 3; ++k) {
        if (k < per_lattice.size()) {
            std::printf(" %12.4g", per_lattice[k]);
        } else {
            std::printf(" %12s", "");
        }
    }
    std::printf(" %12.4g", worst);
    if (limit != nullptr) {
        std::printf(" %10.4g  %s", *limit, std::fabs(worst) <= *limit ? "yes" : "SHORT");
    }
    std::printf("\n");
    std::fflush(stdout);
    row(name, worst, metric.unit, limit);
    if (limit != nullptr && prefix.find(".projection") + 11 == prefix.size()) {
        over_target_[prefix + "." + metric.name].add(cells, std::fabs(worst) / *limit);
    }
}

void Report::order(const std::string& prefix, const Metric& metric, double value) {
    const std::string name = prefix + ".order." + metric.name;
    std::printf("  %-52s %38s %12.2f\n", name.c_str(), "", value);
    row(name, value, "1", nullptr);
}

void Report::convergence(const std::string& prefix, const std::vector<int>& cells,
                         const std::vector<Metric>& metrics,
                         const std::vector<std::vector<double>>& worst) {
    std::vector<Curve> curves;
    int colour = 0;
    for (std::size_t m = 0; m < metrics.size(); ++m) {
        Signal errors;
        Signal targets;
        for (std::size_t k = 0; k < cells.size(); ++k) {
            errors.t.push_back(cells[k]);
            errors.y.push_back(worst[m][k]);
            if (const double* limit = limit_at(metrics[m], cells[k])) {
                targets.t.push_back(cells[k]);
                targets.y.push_back(*limit);
            }
        }
        if (!targets.t.empty()) {
            const std::string title = std::string(metrics[m].name) + ", " + metrics[m].unit;
            ++colour;
            curves.push_back({title, errors, false, colour});
            curves.push_back({"its targets", targets, true, colour});
        }
    }
    if (!curves.empty() && cells.size() > 1) {
        plot(prefix + ".convergence", "cells per reference length", "worst of the lattices", curves,
             "set logscale xy 2\nset format y '%g'\nset key outside bottom center");
    }
}

void Report::plot(const std::string& name, const std::string& x_label,
                  const std::string& y_label, const std::vector<Curve>& curves,
                  const std::string& extra) {
    const std::string base = stem() + "/" + plain(name);
    std::FILE* data = std::fopen((base + ".dat").c_str(), "w");
    std::FILE* script = std::fopen((base + ".gp").c_str(), "w");
    if (data == nullptr || script == nullptr) {
        throw std::runtime_error("cannot write " + base);
    }
    std::fprintf(script,
                 "set terminal png size 900,600\nset output '%s.png'\nset grid\n"
                 "set key noenhanced\nset xlabel '%s' noenhanced\nset ylabel '%s' noenhanced\n%s\n",
                 plain(name).c_str(), x_label.c_str(), y_label.c_str(), extra.c_str());
    const char* separator = "plot";
    for (std::size_t k = 0; k < curves.size(); ++k) {
        const Curve& curve = curves[k];
        std::fprintf(data, "# %s\n", curve.title.c_str());
        for (std::size_t n = 0; n < curve.data.t.size(); ++n) {
            std::fprintf(data, "%.8g %.8g\n", curve.data.t[n], curve.data.y[n]);
        }
        std::fprintf(data, "\n\n");
        std::string style = curve.is_points ? "points pt 7 ps 0.7" : "lines lw 1.5";
        style += " dt " + std::to_string(1 + k / kColours);
        if (curve.colour > 0) {
            style += " lc " + std::to_string(curve.colour);
        } else if (curve.is_points) {
            style += " lc rgb 'black'";
        }
        std::fprintf(script, "%s '%s.dat' index %zu using 1:2 with %s title '%s'", separator,
                     plain(name).c_str(), k, style.c_str(), curve.title.c_str());
        separator = ", \\\n    ";
    }
    std::fprintf(script, "\n");
    std::fclose(data);
    std::fclose(script);
    const std::string command =
        "cd '" + stem() + "' && gnuplot '" + plain(name) + ".gp' 2> /dev/null";
    if (std::system(command.c_str()) != 0) {
        std::printf("  (not drawn: %s.gp)\n", base.c_str());
    }
}

void Report::skipped(const std::string& name, const std::string& why) {
    std::printf("  %-52s skipped: %s\n", name.c_str(), why.c_str());
    measure::Report::row(name, ("skipped: " + plain(why)).c_str());
}

void Report::broken(const std::string& what) {
    std::printf("  BROKEN: %s\n", what.c_str());
    measure::Report::row(plain(what), 1.0, "1", "==", 0.0, false);
    broken_ = true;
}

void Report::summary() {
    measure::Report::summary();
    std::vector<Curve> curves;
    for (const auto& [name, ratios] : over_target_) {
        if (*std::max_element(ratios.y.begin(), ratios.y.end()) > 1.0) {
            curves.push_back({name, ratios});
        }
    }
    if (!curves.empty()) {
        plot("short", "cells per reference length", "error over target", curves,
             "set terminal pngcairo size 1000,560\nset logscale xy\nset xtics (16, 32, 64, 128)\n"
             "set xrange [14:140]\nset yrange [0.1:100]\nset format y '%g'\nset key outside right\n"
             "set arrow from graph 0, first 1 to graph 1, first 1 nohead lw 3");
    }
}

}  // namespace accuracy
