// Outlines of a scene for pictures. Host only.
#pragma once

#include <vector>

#include "scene.hpp"

namespace scene {

// All rings in one closed line: to each hole and back along the same way, which the even-odd rule
// does not see.
inline std::vector<Point> one_line(const Shape& shape) {
    std::vector<Point> line(shape.points, shape.points + ring_end(shape, 0));
    for (std::int32_t ring = 1; ring < shape.rings; ++ring) {
        line.push_back(shape.points[0]);
        line.insert(line.end(), shape.points + ring_begin(shape, ring),
                    shape.points + ring_end(shape, ring));
        line.push_back(shape.points[ring_begin(shape, ring)]);
    }
    return line;
}

}  // namespace scene
