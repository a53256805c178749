// The colours of an animation reduced to a table, by median cut.
//
// Colours are told apart by the upper five bits of each channel.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "weir_picture/canvas.hpp"

namespace weir_picture {

struct Palette {
    std::vector<Color> colors;         // at most the number asked for
    std::vector<std::uint8_t> nearest; // table of 2^15: colour key -> index
};

// Key of a colour in Palette::nearest.
inline std::size_t color_key(Color c) {
    return (static_cast<std::size_t>(c.r >> 3) << 10) | (static_cast<std::size_t>(c.g >> 3) << 5) |
           static_cast<std::size_t>(c.b >> 3);
}

// size: 1 .. 256. Reference: Heckbert, "Color image quantization for frame buffer display", 1982.
Palette median_cut(const std::vector<Canvas>& frames, int size);

}  // namespace weir_picture
