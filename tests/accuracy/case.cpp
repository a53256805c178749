#include "case.hpp"

#include <cmath>

namespace accuracy {

namespace {

constexpr double kSoundRatio = 10.0;  ///< sound speed over sqrt(g H)

}  // namespace

Particles start_pool(const Case& c, Scheme& scheme, Setup& setup) {
    const double depth = 0.5 * c.cells;
    setup.nx = c.cells;
    setup.ny = 3 * c.cells / 4;
    setup.gravity = {0.0, -depth};
    setup.interval = std::sqrt(0.1 / depth);
    setup.sound_speed = kSoundRatio * depth;
    setup.top_speed = depth;  // sqrt(g H): its waves are slower
    setup.options = c.options;
    const Particles start =
        c.start != nullptr ? *c.start
                           : seed_box(c.lattice, {0.0, 0.0}, {double(c.cells), depth});
    scheme.start(setup, start);
    return start;
}

}  // namespace accuracy
