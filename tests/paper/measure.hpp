// Interleaved timing and the report: a table for people, a CSV, a plot.
#pragma once

#include <string>
#include <vector>

#include "runners.hpp"

namespace paper_bench {

/// One method on one scene, a value per round. Rounds go A B A B, so that value k of one method
/// and value k of another were taken within the same moment of the machine's mood.
struct Timing {
    std::vector<double> ms_per_step;
    std::vector<double> s_per_simulated_s;
    double steps_per_simulated_s = 0.0;
    int particles = 0;
    int astray = 0;
};

/// Runs all up to the same physical time, then measures them over equal spans of it.
std::vector<Timing> measure(const std::vector<Runner*>& runners);

double median(std::vector<double> values);
/// Median of a[k] / b[k].
double median_ratio(const std::vector<double>& a, const std::vector<double>& b);

class Report {
public:
    explicit Report(std::string csv_path) : csv_path_(std::move(csv_path)) {}

    void title(const std::string& text);
    /// A line of the table, and its figures as rows `key.ms_per_step` and so on.
    void line(const std::string& key, const std::string& scene, const std::string& method,
              const Timing& timing);
    /// A CSV row. An empty target says nothing about ok; otherwise "<=x", ">=x" or "==x".
    void row(const std::string& name, double value, const std::string& unit,
             const std::string& target = "");
    /// A bar of the plot: the two methods' nanoseconds per particle and step.
    void bar(const std::string& label, double reference_ns, double weir_ns);

    /// Writes the CSV, and beside it a gnuplot script and, where gnuplot is at hand, the plot.
    bool write() const;

private:
    bool write_plot() const;

    std::string csv_path_;
    std::string rows_;
    std::string bars_;
};

}  // namespace paper_bench
