// weir_solids_scene SCENE with|without FRAMES [AFTER]: one scene of the paper's tables, for counting the
// instructions of its steps. SCENE: box, standard, complex, or a number of hexagons: 250, 250turning,
// or 250cut, each in four triangles. AFTER: begins
// with the liquid as it is after so many frames with solids, so that both have the same. Prints the number of substeps and of particles, and the seconds
// that the frames after the first took.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "runners.hpp"

namespace {

constexpr int kParticles = 50000;

/// The same solids, each hexagon as the four triangles of a fan.
void cut_hexagons(paper_bench::Scene& scene) {
    std::vector<paper_bench::Solid> triangles;
    for (const paper_bench::Solid& hexagon : scene.solids) {
        for (std::size_t k = 1; k + 1 < hexagon.outline.size(); ++k) {
            paper_bench::Solid triangle = hexagon;
            triangle.outline = {hexagon.outline[0], hexagon.outline[k], hexagon.outline[k + 1]};
            triangles.push_back(triangle);
        }
    }
    scene.solids = triangles;
}

paper_bench::Scene scene_of(const std::string& name) {
    using paper_bench::Setting;
    for (const Setting setting : {Setting::box, Setting::standard, Setting::complex}) {
        if (name == paper_bench::setting_name(setting)) {
            return paper_bench::setting_scene(setting, kParticles);
        }
    }
    const auto has = [&](const char* word) { return name.find(word) != std::string::npos; };
    paper_bench::Scene scene = paper_bench::polygon_scene(
        paper_bench::Shape::hexagon, std::atoi(name.c_str()), kParticles, has("turning"));
    if (has("cut")) {
        cut_hexagons(scene);
    }
    return scene;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 4) {
        return 2;
    }
    paper_bench::Scene scene = scene_of(argv[1]);
    if (argc > 4) {
        scene = paper_bench::scene_after(scene, std::atoi(argv[4]));
    }
    const auto runner = paper_bench::make_weir(scene, std::string(argv[2]) == "with");
    if (runner == nullptr) {
        return 1;
    }
    int substeps = 0;
    double seconds = 0.0;
    for (int frame = 0; frame < std::atoi(argv[3]); ++frame) {
        const auto begin = std::chrono::steady_clock::now();
        substeps += runner->step().steps;
        const auto end = std::chrono::steady_clock::now();
        seconds += frame > 0 ? std::chrono::duration<double>(end - begin).count() : 0.0;
    }
    std::printf("%d %d %.6f\n", substeps, runner->particles(), seconds);
    return 0;
}
