#include "v_tank.hpp"

namespace solids {

Vec shift_of(int start) {
    return {std::fmod(0.31 + 0.618034 * start, 1.0), std::fmod(0.17 + 0.754878 * start, 1.0)};
}

Wedge v_tank(int depth, double tilt, Vec shift) {
    Wedge wedge;
    const double half = 1.45 * depth;  // half of the tank: room for the V turned
    wedge.vessel.cells_x = static_cast<int>(2.0 * half) + 6;
    wedge.vessel.cells_y = static_cast<int>(2.0 * half) + 6;
    wedge.vessel.tilt = tilt;
    const Vec middle = wedge.vessel.middle();
    const Vec apex{middle.x + shift.x, middle.y - 0.62 * depth - shift.y};
    const double far = 4.0 * depth + 20.0;
    wedge.apex = apex;
    wedge.depth = depth;
    wedge.vessel.walls = {{apex,
                           {apex.x - far, apex.y + far},
                           {apex.x - far, apex.y - far},
                           {apex.x + far, apex.y - far},
                           {apex.x + far, apex.y + far}}};
    wedge.vessel.liquid = [apex, depth](Vec p) {
        const Vec d = p - apex;
        return d.y < depth && d.y > std::abs(d.x);
    };
    return wedge;
}

}  // namespace solids
