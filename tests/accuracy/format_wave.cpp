// R6a in every format: fast and slow flow against the same in double. It needs no lattices but the one
// that `fill` makes.
#include "measure/format_wave.hpp"

#include <string>

#include "problems.hpp"

namespace accuracy {

namespace {

constexpr double kMostPeriod = 0.5;   ///< per cent
constexpr double kMostHeight = 0.05;  ///< of the first, after five periods

void compare(Report& report, const std::string& name, const measure::Wave& exact,
             const measure::Wave& wave, bool has_target) {
    const double period = 100.0 * std::fabs(wave.period / exact.period - 1.0);
    const double height = std::fabs(wave.height - exact.height);
    if (has_target) {
        report.at_most(name + ".period_error", period, "%", kMostPeriod);
        report.at_most(name + ".height_error", height, "1", kMostHeight);
    } else {
        report.figure(name + ".period_error", period, "%");
        report.figure(name + ".height_error", height, "1");
    }
}

}  // namespace

void report_format_wave(Report& report, const Effort& effort) {
    report.heading("R6a in fixed point, against double");
    for (const int cells : effort.quick ? std::vector<int>{32} : std::vector<int>{32, 64}) {
        for (const double pace : {1.0, 0.5, 0.2}) {
            measure::WaveCase wave;
            wave.cells = cells;
            wave.cells_per_step = pace;
            wave.sweeps = effort.options.sweeps < 0 ? wave.sweeps : effort.options.sweeps;
            const measure::Wave exact = measure::run_wave<double>(wave);
            const std::string at =
                "." + std::to_string(cells) + "." + std::to_string(pace).substr(0, 3);
            compare(report, "R6a_formats.fixed" + at, exact,
                    measure::run_wave<weir::Fixed>(wave), true);
            compare(report, "R6a_formats.small_fixed" + at, exact,
                    measure::run_wave<weir::SmallFixed>(wave), true);
            wave.known_speed = false;
            compare(report, "R6a_formats.small_fixed_without_top_speed" + at, exact,
                    measure::run_wave<weir::SmallFixed>(wave), false);
        }
    }
}

}  // namespace accuracy
