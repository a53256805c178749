// The solids of the scenes box, standard and complex: one list for the paper's tables and for
// boards, which have no heap. Lengths are in cells, the origin is the tank's lower left corner.
#pragma once

namespace paper_bench {

enum class Setting { box, standard, complex };

/// About its own origin: a rectangle of so much to either side; half of one, below its diagonal;
/// or a regular outline of a radius.
enum class Form { rectangle, ramp, triangle, hexagon, star };

struct PlacedForm {
    Form form;
    float x;
    float y;
    float size_x;  ///< half a width, or the radius
    float size_y;
    float angle_rad;
    float spin_radps;  ///< 0: static
};

inline constexpr int kMostSettingSolids = 3 + 6 + 48;
inline constexpr float kThickness = 4.3F;  ///< of the box's walls; not on the grid's lines
inline constexpr float kTurn = 2.0F;       ///< rad/s of the turning polygons

/// Floor and side walls, reaching out of the tank.
template <class Visit>
void for_each_wall(float w, float h, const Visit& visit) {
    const float half = 0.5F * kThickness;
    visit(PlacedForm{Form::rectangle, 0.5F * w, half, 0.5F * w, half, 0.0F, 0.0F});
    visit(PlacedForm{Form::rectangle, half, 0.5F * h, half, 0.5F * h, 0.0F, 0.0F});
    visit(PlacedForm{Form::rectangle, w - half, 0.5F * h, half, 0.5F * h, 0.0F, 0.0F});
}

/// A few in the way of the wave, in shares of the tank's height.
template <class Visit>
void for_each_obstacle(float h, const Visit& visit) {
    visit(PlacedForm{Form::ramp, 1.60F * h, 0.14F * h, 0.20F * h, 0.1F * h, 0.0F, 0.0F});
    const float at[][2] = {{0.3F, 0.3F}, {0.7F, 0.45F}, {1.1F, 0.25F}, {1.4F, 0.55F}};
    for (const auto& place : at) {
        visit(PlacedForm{Form::hexagon, place[0] * h, place[1] * h, 0.08F * h, 0.0F, 0.2F, 0.0F});
    }
    visit(PlacedForm{Form::rectangle, 1.1F * h, 0.6F * h, 0.15F * h, 0.03F * h, -0.4F, 0.0F});
}

/// And a crowd of small ones between the wave's feet, every third of them turning.
template <class Visit>
void for_each_of_the_crowd(float h, const Visit& visit) {
    const Form forms[] = {Form::triangle, Form::hexagon, Form::star};
    int index = 0;
    for (int row = 0; row < 4; ++row) {
        for (int column = 0; column < 12; ++column, ++index) {
            visit(PlacedForm{forms[(index + row) % 3],
                             (0.14F + 0.15F * static_cast<float>(column)) * h,
                             (0.12F + 0.2F * static_cast<float>(row)) * h, 0.03F * h, 0.0F,
                             static_cast<float>(index), index % 3 == 0 ? kTurn : 0.0F});
        }
    }
}

/// Of a tank of w × h cells.
template <class Visit>
void for_each_solid(Setting setting, float w, float h, const Visit& visit) {
    for_each_wall(w, h, visit);
    if (setting != Setting::box) {
        for_each_obstacle(h, visit);
    }
    if (setting == Setting::complex) {
        for_each_of_the_crowd(h, visit);
    }
}

}  // namespace paper_bench
