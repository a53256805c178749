// weir_stability OUT.csv [quick|full] [seed=N] [scenes=N] [case ...]: what the library is put
// through, and whether it stays finite, whole, inside and within its energy. Without cases, all.
// Exit status 1 if anything that has to hold does not.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <vector>

#include "cases.hpp"

namespace {

struct Case {
    const char* name;
    const char* title;
    void (*run)(stability::Report&, const stability::Effort&);
};

constexpr Case kCases[] = {
    {"S1", "two particles at the same point", stability::coincident_particles},
    {"S2", "1,000 particles in one cell, released", stability::crowded_cell},
    {"S3", "near-empty faces", stability::near_empty_faces},
    {"S4", "cells per step: substeps and limits", stability::fast_liquid},
    {"S5", "a drop from 50 times its height", stability::high_drop},
    {"S6", "a jet into a 10 degree wedge", stability::jet_into_wedge},
    {"S7", "hostile polygons", stability::hostile_polygons},
    {"S8", "a body squeezes the water", stability::squeezing_body},
    {"S9", "time step jitters by 50 %", stability::jittering_step},
    {"S10", "CFL and sound speed swept", stability::step_sweep},
    {"S11", "viscosity swept over its limit", stability::viscosity_sweep},
    {"S12", "gravity flips every 100 steps", stability::flipping_gravity},
    {"S13", "translated and mirrored scenes", stability::moved_scene},
    {"S14", "the same run again", stability::same_run},
    {"S15", "save and restore", stability::save_and_restore},
    {"S16", "NaN and infinity", stability::bad_numbers},
    {"S17", "every particle in one cell", stability::highest_density},
    {"random", "random scenes", stability::random_scenes},
    {"soak", "R14: soak of a closed box", stability::soak},
    {"rest", "R14: a resting pool stops moving", stability::resting_pool},
    {"map", "map of the stable region", stability::stability_map},
};

bool chosen(const std::vector<std::string>& names, const char* name) {
    for (const std::string& wanted : names) {
        if (wanted == name) {
            return true;
        }
    }
    return names.empty();
}

bool known(const std::string& name) {
    for (const Case& one : kCases) {
        if (name == one.name) {
            return true;
        }
    }
    return false;
}

int usage() {
    std::fprintf(stderr,
                 "usage: weir_stability OUT.csv [quick|full] [seed=N] [scenes=N] [case ...]\n"
                 "cases:");
    for (const Case& one : kCases) {
        std::fprintf(stderr, " %s", one.name);
    }
    std::fprintf(stderr, "\n");
    return 2;
}

/// False for a word that is neither a setting nor a case.
bool take(const std::string& word, stability::Effort& effort, std::vector<std::string>& names) {
    if (word == "quick" || word == "full") {
        effort.full = word == "full";
    } else if (word.rfind("seed=", 0) == 0) {
        effort.seed = std::strtoull(word.c_str() + 5, nullptr, 10);
    } else if (word.rfind("scenes=", 0) == 0) {
        effort.scenes = std::atoi(word.c_str() + 7);
    } else if (known(word)) {
        names.push_back(word);
    } else {
        return false;
    }
    return true;
}

int run(const char* path, const std::vector<std::string>& names,
        const stability::Effort& effort) {
    stability::Report report(path);
    for (const Case& one : kCases) {
        if (!chosen(names, one.name)) {
            continue;
        }
        report.heading((std::string(one.name) + ": " + one.title).c_str());
        const auto begin = std::chrono::steady_clock::now();
        try {
            one.run(report, effort);
        } catch (const std::exception& error) {
            std::printf("  %s\n", error.what());
            report.holds(std::string(one.name) + ".ran_to_its_end", false);
        }
        const auto end = std::chrono::steady_clock::now();
        std::printf("  (%.1f s)\n", std::chrono::duration<double>(end - begin).count());
    }
    report.summary();
    return report.is_broken() ? 1 : 0;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 2) {
        return usage();
    }
    stability::Effort effort;
    std::vector<std::string> names;
    for (int k = 2; k < argc; ++k) {
        if (!take(argv[k], effort, names)) {
            return usage();
        }
    }
    if (effort.seed != 0 && names.empty()) {
        names.emplace_back("random");
    }
    try {
        return run(argv[1], names, effort);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "weir_stability: %s\n", error.what());
        return 2;
    }
}
