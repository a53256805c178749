// weir_stability OUT.csv [quick|full] [real=R] [seed=N] [scenes=N] [steps=N] [case ...]: what the
// library is put through, and whether it stays finite, whole, inside and within its energy. Without
// cases, all; without an arithmetic in float, and what is cheap in double, too.
// Exit status 1 if anything that has to hold does not.
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include "cases.hpp"
#include "measure/suite.hpp"

namespace {

constexpr measure::Problem<stability::Report, stability::Effort> kCases[] = {
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

constexpr char kArguments[] =
    "weir_stability OUT.csv [quick|full] [real=float|double|fixed|small_fixed] [seed=N] "
    "[scenes=N] [steps=N]";

bool take_scalar(const std::string& name, stability::Scalar& scalar) {
    constexpr std::pair<const char*, stability::Scalar> kScalars[] = {
        {"float", stability::Scalar::single},
        {"double", stability::Scalar::twice},
        {"fixed", stability::Scalar::fixed},
        {"small_fixed", stability::Scalar::small_fixed},
    };
    for (const auto& one : kScalars) {
        if (name == one.first) {
            scalar = one.second;
            return true;
        }
    }
    return false;
}

/// False for a word that is neither a setting nor a case.
bool take(const std::string& word, stability::Effort& effort, std::vector<std::string>& names) {
    if (word == "quick" || word == "full") {
        effort.full = word == "full";
    } else if (word.rfind("real=", 0) == 0) {
        return take_scalar(word.substr(5), effort.scalar);
    } else if (word.rfind("seed=", 0) == 0) {
        effort.seed = std::strtoull(word.c_str() + 5, nullptr, 10);
    } else if (word.rfind("scenes=", 0) == 0) {
        effort.scenes = std::atoi(word.c_str() + 7);
    } else if (word.rfind("steps=", 0) == 0) {
        effort.steps = std::atoi(word.c_str() + 6);
    } else if (measure::known(kCases, word)) {
        names.push_back(word);
    } else {
        return false;
    }
    return true;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 2) {
        return measure::usage(kArguments, kCases);
    }
    stability::Effort effort;
    std::vector<std::string> names;
    for (int k = 2; k < argc; ++k) {
        if (!take(argv[k], effort, names)) {
            return measure::usage(kArguments, kCases);
        }
    }
    if (effort.seed != 0 && names.empty()) {
        names.emplace_back("random");
    }
    return measure::run<stability::Report>(argv[1], kCases, names, effort);
}
