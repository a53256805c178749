// What solids cost: the paper's scenes with against without them, in instructions (Callgrind) and in
// time, and many still polygons against few. A step of the one is compared with a step of the other,
// per particle and substep. The liquid falls differently where there are no solids (in one block,
// past where they were), so that a step of the same liquid is compared, too.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <vector>

#include "problems.hpp"

namespace solids {

namespace {

struct Run {
    double substeps = 0.0;
    double particles = 0.0;
    double seconds = 0.0;
    double instructions = 0.0;
};

/// Standard output of a command. Throws if it fails.
std::string output_of(const std::string& command) {
    std::FILE* pipe = popen(command.c_str(), "r");
    if (pipe == nullptr) {
        throw std::runtime_error("cannot run " + command);
    }
    std::string text;
    char buffer[256];
    while (std::fgets(buffer, sizeof buffer, pipe) != nullptr) {
        text += buffer;
    }
    if (pclose(pipe) != 0) {
        throw std::runtime_error("failed: " + command);
    }
    return text;
}

/// Frames of a scene. `after`: from the liquid as it is after so many with solids; 0: as poured.
struct Frames {
    std::string scene;
    bool solids = true;
    int count = 1;
    int after = 0;

    std::string command() const {
        return std::string(WEIR_SOLIDS_SCENE) + " " + scene + (solids ? " with " : " without ") +
               std::to_string(count) + (after > 0 ? " " + std::to_string(after) : "");
    }
};

Run timed(const Frames& frames) {
    Run run;
    const std::string text = output_of(frames.command());
    if (std::sscanf(text.c_str(), "%lf %lf %lf", &run.substeps, &run.particles, &run.seconds) != 3) {
        throw std::runtime_error("what does this mean: " + text);
    }
    return run;
}

Run counted(const Frames& frames) {
    const std::string command =
        "valgrind --tool=callgrind --callgrind-out-file=/dev/null "
        "--toggle-collect='weir::World<float>::step(*' " +
        frames.command() + " 2>&1";
    const std::string text = output_of(command);
    Run run = timed(frames);
    const std::size_t at = text.find("Collected : ");
    if (at == std::string::npos) {
        throw std::runtime_error("no count: " + text);
    }
    run.instructions = std::atof(text.c_str() + at + 12);
    if (!(run.instructions > 0.0)) {
        throw std::runtime_error("nothing was counted: " + text);
    }
    return run;
}

/// Instructions per particle and substep of some frames, without the first one's long solve.
double instructions(Frames frames) {
    const Run all = counted(frames);
    frames.count = 1;
    const Run first = counted(frames);
    return (all.instructions - first.instructions) /
           ((all.substeps - first.substeps) * all.particles);
}
double instructions(const std::string& scene, bool solids) {
    return instructions({scene, solids, 13});
}

/// With over without solids, mean of frames that begin with the same liquid.
double same_liquid_ratio(const std::string& scene) {
    double sum = 0.0;
    for (const int after : {4, 8, 12}) {
        sum += instructions({scene, true, 2, after}) / instructions({scene, false, 2, after});
    }
    return sum / 3.0;
}

/// Median of the ratios of seconds per particle and substep, turn by turn.
double time_ratio(const std::string& scene) {
    std::vector<double> ratios;
    for (int turn = 0; turn < 5; ++turn) {
        const Run with = timed({scene, true, 13});
        const Run without = timed({scene, false, 13});
        ratios.push_back((with.seconds / (with.substeps * with.particles)) /
                         (without.seconds / (without.substeps * without.particles)));
    }
    std::sort(ratios.begin(), ratios.end());
    return ratios[ratios.size() / 2];
}

}  // namespace

void cost_of_solids(Report& report, const Effort&) {
    for (const char* scene : {"box", "standard", "complex"}) {
        const double with = instructions(scene, true);
        const double without = instructions(scene, false);
        const std::string name = std::string("cost.") + scene;
        report.figure(name + ".instructions_with", with, "a particle and substep");
        report.at_most(name + ".instructions_with_over_without", with / without, "1", 1.03);
        report.at_most(name + ".instructions_of_the_same_liquid", same_liquid_ratio(scene), "1",
                       1.03);
        report.at_most(name + ".time_with_over_without", time_ratio(scene), "1", 1.03);
    }
    const double few = instructions("250", true);
    const double many = instructions("1000", true);
    const double few_without = instructions("250", false);
    const double many_without = instructions("1000", false);
    report.at_most("cost.still_polygons_1000_over_250", many / few, "1", 1.02);
    report.figure("cost.their_liquid_without_them", many_without / few_without, "1");
    report.figure("cost.still_polygons_250.with_over_without", few / few_without, "1");
    report.figure("cost.still_polygons_1000.with_over_without", many / many_without, "1");
    report.at_most("cost.still_solids_as_1000_polygons_over_250", instructions("250cut", true) / few,
                   "1", 1.02);
    const double turning = instructions("250turning", true);
    report.figure("cost.250_turning_over_still", turning / few, "1");
    report.figure("cost.1000_turning_over_250_turning", instructions("1000turning", true) / turning,
                  "1");
}

}  // namespace solids
