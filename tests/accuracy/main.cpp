// weir_accuracy OUT.csv [quick] [soak] [problem ...] [setting=value ...]: the reference problems,
// figures and pictures. Without problems, all of them. A setting holds for every run.
#include <chrono>
#include <cstdio>
#include <exception>
#include <string>
#include <utility>
#include <vector>

#include "dam_break.hpp"
#include "measure/suite.hpp"
#include "problems.hpp"

namespace {

struct Problem {
    const char* name;
    void (*report)(accuracy::Report&, const accuracy::Effort&);
};

constexpr Problem kProblems[] = {
    {"R4a", accuracy::report_hydrostatic},
    {"R5A", accuracy::report_dam_break},
    {"R6a", accuracy::report_standing_wave},
    {"R6a_formats", accuracy::report_format_wave},
    {"formats", accuracy::report_format_difference},
    {"R7", accuracy::report_free_drop},
    {"R8", accuracy::report_oscillating_drop},
    {"R9", accuracy::report_taylor_green},
    {"R10", accuracy::report_channel_flow},
    {"R11", accuracy::report_rotation},
    {"R14", accuracy::report_volume},
};

/// `name=value` for the words that change a setting; false for any other word.
bool take_setting(const std::string& word, accuracy::Effort& effort) {
    const std::size_t equals = word.find('=');
    if (equals == std::string::npos) {
        return false;
    }
    const std::string name = word.substr(0, equals);
    const std::string text = word.substr(equals + 1);
    accuracy::Options& options = effort.options;
    if (name == "scheme") {
        effort.scheme = text;
        return true;
    }
    const double value = std::stod(text);
    const std::pair<const char*, double*> known[] = {{"flip_ratio", &options.flip_ratio},
                                                     {"volume_gain", &options.volume_gain},
                                                     {"step_scale", &options.step_scale},
                                                     {"sound_scale", &options.sound_scale},
                                                     {"cfl", &options.cfl}};
    for (const auto& setting : known) {
        if (name == setting.first) {
            *setting.second = value;
            return true;
        }
    }
    options.sweeps = name == "sweeps" ? static_cast<int>(value) : options.sweeps;
    return name == "sweeps";
}

int usage() {
    std::fprintf(stderr, "usage: weir_accuracy OUT.csv [quick] [soak] [problem ...] "
                         "[setting=value ...]\n"
                         "settings: flip_ratio sweeps volume_gain step_scale sound_scale cfl "
                         "scheme\nproblems:");
    for (const Problem& problem : kProblems) {
        std::fprintf(stderr, " %s", problem.name);
    }
    std::fprintf(stderr, "\n");
    return 2;
}

int run(const std::string& path, const std::vector<std::string>& names,
        const accuracy::Effort& effort) {
    accuracy::Report report(path);
    for (const Problem& problem : kProblems) {
        if (!measure::chosen(names, problem.name)) {
            continue;
        }
        const auto begin = std::chrono::steady_clock::now();
        problem.report(report, effort);
        const auto end = std::chrono::steady_clock::now();
        std::printf("  (%s: %.1f s)\n", problem.name,
                    std::chrono::duration<double>(end - begin).count());
    }
    report.summary();
    return report.is_broken() ? 1 : 0;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 2) {
        return usage();
    }
    accuracy::Effort effort;
    effort.data = WEIR_ACCURACY_DATA;
    accuracy::reference_folder() = effort.data;
    std::vector<std::string> names;
    for (int k = 2; k < argc; ++k) {
        const std::string word = argv[k];
        effort.quick = effort.quick || word == "quick";
        effort.long_soak = effort.long_soak || word == "soak";
        if (word != "quick" && word != "soak" && !take_setting(word, effort)) {
            names.push_back(word);
        }
    }
    try {
        return run(argv[1], names, effort);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "weir_accuracy: %s\n", error.what());
        return 1;
    }
}
