// The reference problems. Each has a function that runs one case and one that reports on many.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "case.hpp"
#include "report.hpp"

namespace accuracy {

/// How much is run.
struct Effort {
    bool quick = false;  ///< 16 and 32 cells, for every change
    bool long_soak = false;  ///< a million steps of a resting pool
    std::string data;    ///< folder of the reference tables
    Options options;     ///< of every run, to see what a setting does
    std::string scheme;  ///< only this one; empty: all
};

using Run = std::function<Outcome(Scheme&, const Case&)>;

/// Which scheme runs at which resolutions, on how many of the three lattices.
struct Plan {
    Kind kind;
    std::vector<int> cells;
    int lattices = 3;
};

/// What runs: all plans, or with `effort.scheme` those of its method in float, in its format.
std::vector<Plan> chosen(const Effort& effort, const std::vector<Plan>& plans);

/// What runs where projection is measured, and others only stand beside it at one resolution.
std::vector<Plan> beside_others(const Effort& effort, const std::vector<int>& cells,
                                const std::vector<Kind>& others);

/// Runs a plan and reports every metric, worst lattice counting, and the convergence orders.
/// Resolutions end where the scheme is unable to hold the problem.
/// @return the outcomes on the last lattice that was run, one for each resolution.
std::vector<Outcome> sweep(Report& report, const Effort& effort, const std::string& problem,
                           const Plan& plan, const std::vector<Metric>& metrics, const Run& run);

/// Of a curve: scheme and resolution.
std::string title_of(const Plan& plan, std::size_t resolution);

/// 32, 64 and 128, or 16 and 32 when quick; at most `most` cells.
std::vector<int> resolutions(const Effort& effort, int most = 128);

Outcome run_hydrostatic(Scheme& scheme, const Case& c);
Outcome run_dam_break(Scheme& scheme, const Case& c);
/// Until the front reaches the far wall: what the front alone needs.
Outcome run_dam_break_front(Scheme& scheme, const Case& c);
/// From `c.start` if there is one, which then is at rest.
Outcome run_standing_wave(Scheme& scheme, const Case& c);
/// The relaxed lattice that a standing wave begins with.
Particles rest_before_wave(Scheme& scheme, const Case& c);
Outcome run_oscillating_drop(Scheme& scheme, const Case& c, int periods);

void report_hydrostatic(Report& report, const Effort& effort);
void report_dam_break(Report& report, const Effort& effort);
void report_standing_wave(Report& report, const Effort& effort);
void report_format_wave(Report& report, const Effort& effort);
void report_format_difference(Report& report, const Effort& effort);
void report_free_drop(Report& report, const Effort& effort);
void report_oscillating_drop(Report& report, const Effort& effort);
void report_rotation(Report& report, const Effort& effort);
void report_taylor_green(Report& report, const Effort& effort);
void report_channel_flow(Report& report, const Effort& effort);
void report_volume(Report& report, const Effort& effort);

}  // namespace accuracy
