// weir_solids OUT.csv [quick|full] [NAME ...]: what the solids hold, each figure with its target.
// Without names, every problem. Exit status 1 if a target is short.
#include <chrono>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "problems.hpp"

namespace {

struct Problem {
    const char* name;
    const char* title;
    void (*run)(solids::Report&, const solids::Effort&);
};

constexpr Problem kProblems[] = {
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
    {"R10", "viscous liquid between a body at rest and one that moves", solids::couette},
    {"R12", "a floating box: draft, and heave", solids::floating_box},
    {"R13a", "a jet on a plate: force", solids::jet_on_plate},
    {"piston", "a body that compresses a full tank", solids::piston},
    // Still water.
    {"R4c", "still water between inclined walls", solids::still_water},
    {"R6b", "sloshing between inclined walls", solids::sloshing},
    {"R4d", "force of still water on submerged polygons", solids::buoyancy},
    {"R14", "soak: vessels with thin, turned and pointed walls", solids::vessels_soak},
    // Cost.
    {"cost", "scenes with against without solids", solids::cost_of_solids},
};

bool known(const std::string& name) {
    for (const Problem& problem : kProblems) {
        if (name == problem.name) {
            return true;
        }
    }
    return false;
}

bool chosen(const std::vector<std::string>& names, const char* name) {
    for (const std::string& wanted : names) {
        if (wanted == name) {
            return true;
        }
    }
    return names.empty();
}

int usage() {
    std::fprintf(stderr, "usage: weir_solids OUT.csv [quick|full] [NAME ...]\nnames:");
    for (const Problem& problem : kProblems) {
        std::fprintf(stderr, " %s", problem.name);
    }
    std::fprintf(stderr, "\n");
    return 2;
}

int run(const char* path, const std::vector<std::string>& names, const solids::Effort& effort) {
    solids::Report report(path);
    for (const Problem& problem : kProblems) {
        if (!chosen(names, problem.name)) {
            continue;
        }
        report.heading(std::string(problem.name) + ": " + problem.title);
        const auto begin = std::chrono::steady_clock::now();
        try {
            problem.run(report, effort);
        } catch (const std::exception& error) {
            std::printf("  %s\n", error.what());
            report.holds(std::string(problem.name) + ".ran_to_its_end", false);
        }
        const auto end = std::chrono::steady_clock::now();
        std::printf("  (%.1f s)\n", std::chrono::duration<double>(end - begin).count());
    }
    report.summary();
    return report.is_short() ? 1 : 0;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 2) {
        return usage();
    }
    solids::Effort effort;
    std::vector<std::string> names;
    for (int k = 2; k < argc; ++k) {
        const std::string word = argv[k];
        if (word == "quick" || word == "full") {
            effort.full = word == "full";
        } else if (known(word)) {
            names.push_back(word);
        } else {
            return usage();
        }
    }
    try {
        return run(argv[1], names, effort);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "weir_solids: %s\n", error.what());
        return 2;
    }
}
