// The table for people, the CSV for programs, the curves for gnuplot.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "analysis.hpp"
#include "case.hpp"
#include "measure/report.hpp"

namespace accuracy {

/// What one figure is called, its unit, and how large it may be at which resolution.
struct Metric {
    const char* name;
    const char* unit;
    std::vector<std::pair<int, double>> limits;  ///< cells, |value| at most
};

/// One line of a plot; the reference is drawn as black points.
struct Curve {
    std::string title;
    Signal data;
    bool is_points = false;
    int colour = 0;  ///< gnuplot's line colour; 0: its next one, black for points
};

class Report : public measure::Report {
public:
    /// Writes `path` and, beside it, a folder of curves and pictures of the same name.
    explicit Report(const std::string& path);

    void heading(const std::string& text) const;
    /// A line of the CSV; `limit` empty where there is none. Not printed.
    void row(const std::string& name, double value, const char* unit, const double* limit);
    /// A line of the table and of the CSV: a figure for each lattice, the worst counts.
    void worst_of(const std::string& prefix, const Metric& metric, int cells,
                  const std::vector<double>& per_lattice);
    /// Convergence orders: printed and in the CSV, without a target.
    void order(const std::string& prefix, const Metric& metric, double order);
    /// Errors that have a target, and the targets, over the cells per reference length.
    /// `worst[m][k]`: of metric m at resolution k.
    void convergence(const std::string& prefix, const std::vector<int>& cells,
                     const std::vector<Metric>& metrics,
                     const std::vector<std::vector<double>>& worst);
    /// Curves of one picture; written with a gnuplot script and, if gnuplot is there, drawn.
    void plot(const std::string& name, const std::string& x_label, const std::string& y_label,
              const std::vector<Curve>& curves, const std::string& extra = "");
    /// What cannot be run, and why.
    void skipped(const std::string& name, const std::string& why);
    /// A run broke (not finite, lost particles): the program's exit status becomes 1.
    void broken(const std::string& what);

    bool is_broken() const { return broken_; }
    /// What is short, as a list and as a picture: errors over their targets.
    void summary();

private:
    bool broken_ = false;
    std::map<std::string, Signal> over_target_;  ///< by metric: cells, |error| / target
};

}  // namespace accuracy
