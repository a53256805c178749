// One moment of a simulation as a picture. All positions are in cells, y up, origin bottom left.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "weir_picture/canvas.hpp"

namespace weir_picture {

// Particles, as the simulation has them. Coordinates may be interleaved (x = xy, y = xy + 1,
// stride 2) or separate (stride 1).
struct Particles {
    const float* x = nullptr;
    const float* y = nullptr;
    std::size_t stride = 1;
    const float* speed = nullptr;  // one a particle, or nullptr: all drawn as slow
    std::size_t count = 0;
};

struct Polygon {
    std::vector<Point> points;  // where it is now
    bool moving = false;
};

struct Style {
    int pixels_per_cell = 10;
    float particle_radius_cells = 0.30f;
    float full_speed = 1.0f;  // drawn in the fast colour; same unit as Particles::speed, > 0
    Color background{250, 249, 246};
    Color solid{58, 66, 78};
    Color moving{200, 85, 61};
    Color slow{24, 78, 168};
    Color medium{45, 140, 220};
    Color fast{150, 214, 246};
    Color text{58, 66, 78};
    Color frame{58, 66, 78};
};

// Style whose pixels per cell make the longer side about that many pixels.
Style style_for(int cells_x, int cells_y, int longer_side_pixels);

// Draws particles, then solids, then moving bodies, then a caption on a band below the picture.
// Not finite particles are left out. An empty caption leaves no band.
Canvas draw_frame(int cells_x, int cells_y, const Particles& particles,
                  const std::vector<Polygon>& polygons, const std::string& caption,
                  const Style& style);

// "t = 1.50 s"
std::string time_caption(float time_s);

// Frames side by side in rows; columns below 1 count as 1. No frames give a 1 x 1 picture.
Canvas contact_sheet(const std::vector<Canvas>& frames, int columns,
                     Color background = Color{225, 224, 220});

}  // namespace weir_picture
