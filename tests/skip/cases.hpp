// What a scene may lack, and what that saves: each case is run in up to three ways.
#pragma once

#include <cstddef>
#include <cstdint>

namespace skip {

/// How a case is run. What is skipped should cost what it costs where it is absent.
enum class Way {
    absent,   ///< the world has no room for it, or knows nothing of it
    skipped,  ///< it is there, and nothing needs it now
    used,     ///< it does its work
};

struct Case {
    const char* name;
    const char* skipped;  ///< what the skipped variant is
    bool has[3];          ///< which ways there are
};

inline constexpr Case kCases[] = {
    {"solids", "three solids in the air above the water", {true, true, true}},
    {"lines", "three thin walls in the air above the water", {true, true, true}},
    {"raster", "bodies that may move and stand still", {true, true, true}},
    {"rectangle", "bodies turning in a tank 16 times as large", {true, true, false}},
    {"columns", "the empty width of rows: a drop that is far away", {true, true, false}},
    {"viscosity", "0", {false, true, true}},
    {"weightless", "gravity in a world that is defined without", {true, true, true}},
    {"tension", "0", {false, true, true}},
    {"second_liquid", "no room for it", {false, true, true}},
    {"domain", "4096 x 4096 cells, of which those around the same water are stored", {true, true, true}},
    {"level", "the same with 1,024 bodies all over it, three of them in the water", {true, true, false}},
    {"sleep", "a world at rest, asleep", {true, true, false}},
    {"regions", "a splash beside nine pools at rest, asleep", {true, true, true}},
    {"looking", "views of particles and pressure", {true, true, true}},
};

/// What a run was, for all to be put in relation.
struct Run {
    std::int64_t particle_substeps = 0;
    std::int64_t nodes = 0;  ///< rasterized
    std::size_t world_bytes = 0;
    double seconds = 0.0;
    std::int32_t asleep = 0;  ///< at the end
};

/// Sets the case up and measures some steps of it, in `weir_skip_measured`.
Run run(const Case& which, Way way);

}  // namespace skip
