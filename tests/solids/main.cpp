// weir_solids OUT.csv [quick|full] [real=SCALAR] [NAME ...]: what the solids hold, each figure with
// its target, in float unless another arithmetic is named. Without names, every problem. Exit status
// 1 if a target is short.
#include <cstdio>
#include <string>
#include <vector>

#include "measure/suite.hpp"
#include "problems.hpp"

namespace {

constexpr measure::Problem<solids::Report, solids::Effort> kProblems[] = {
    // Contours.
    {"R1", "one particle against walls at 76 angles", solids::one_particle},
    {"R2", "area and centroid of polygons on the grid", solids::coverage},
    {"R3", "contour normals and positions", solids::contour_normals},
    // Polygons.
    {"real", "coastline, letters, drawings: pieces, and liquid poured over them",
     solids::real_geometry},
    // Tightness.
    {"torture", "particles thrown at random polygons", solids::torture},
    {"thin", "walls thinner than a cell hold a column of liquid", solids::thin_walls},
    // Moving bodies.
    {"R10", "viscous liquid between bodies without slip", solids::couette},
    {"R12", "a floating box: draft, and heave", solids::floating_box},
    {"R13a", "a jet on a plate: force", solids::jet_on_plate},
    {"piston", "a body that compresses a full tank", solids::piston},
    {"third_law", "what bodies and tank receive is what the liquid loses", solids::third_law},
    // Still water.
    {"R4c", "still water between inclined walls", solids::still_water},
    {"R6b", "sloshing between inclined walls", solids::sloshing},
    {"formats", "the same in fixed point against double", solids::formats},
    {"R4d", "force of still water on submerged polygons", solids::buoyancy},
    {"R14", "soak: vessels with thin, turned and pointed walls", solids::vessels_soak},
    // Cost.
    {"cost", "scenes with against without solids", solids::cost_of_solids},
};

constexpr char kArguments[] =
    "weir_solids OUT.csv [quick|full] [real=float|double|fixed|small_fixed]";

/// Problems that are not for `real=`: geometry, what another program counts, all at once.
bool of_one_kind(const std::string& name) {
    for (const char* one : {"R2", "R3", "third_law", "formats", "cost"}) {
        if (name == one) {
            return true;
        }
    }
    return false;
}

bool take_scalar(const std::string& word, solids::Scalar& real) {
    for (const solids::NamedScalar& one : solids::kScalars) {
        if (word == std::string("real=") + one.name) {
            real = one.scalar;
            return true;
        }
    }
    return false;
}

/// Those that run without being named: what the arithmetic has, but the formats' long runs.
std::vector<std::string> usual_names(const solids::Effort& effort) {
    const bool usual = effort.real == solids::Scalar::single_precision;
    std::vector<std::string> names;
    for (const auto& problem : kProblems) {
        const std::string name = problem.name;
        if ((usual || !of_one_kind(name)) && (effort.full || name != "formats")) {
            names.push_back(name);
        }
    }
    return names;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 2) {
        return measure::usage(kArguments, kProblems);
    }
    solids::Effort effort;
    std::vector<std::string> names;
    for (int k = 2; k < argc; ++k) {
        const std::string word = argv[k];
        if (word == "quick" || word == "full") {
            effort.full = word == "full";
        } else if (measure::known(kProblems, word)) {
            names.push_back(word);
        } else if (!take_scalar(word, effort.real)) {
            return measure::usage(kArguments, kProblems);
        }
    }
    for (const std::string& name : names) {
        if (effort.real != solids::Scalar::single_precision && of_one_kind(name)) {
            std::fprintf(stderr, "%s: not for real=\n", name.c_str());
            return 2;
        }
    }
    return measure::run<solids::Report>(argv[1], kProblems,
                                        names.empty() ? usual_names(effort) : names, effort);
}
