// Liquid and solids as shades of a small display, row by row: what changed is told, so that only
// that is sent, and a surface at rest does not flicker.
#pragma once

#include <cstdint>

#include "weir/world.hpp"

namespace weir {

/// A picture of 16 shades, two pixels a byte, the left one in the upper half; rows from the top.
/// A row begins with a byte. The caller owns the bytes; start with zeros.
struct Display {
    std::int32_t width = 0;         ///< pixels, at most 1024
    std::int32_t height = 0;        ///< pixels, at most 1024
    std::uint8_t* pixels = nullptr;  ///< (width + 1) / 2 · height bytes
    std::uint8_t liquid = 11;       ///< shade of full liquid, 1 … 15
    std::uint8_t solid = 4;         ///< shade of solids, 0 … 15
    std::uint8_t hysteresis = 96;   ///< a shade changes if it is off by ½ and this / 256 of one
    /// What is shown, metres, as a camera that scrolls and zooms has it, to the nearest 256th of a
    /// cell, within `kMaxCells` of the tank's corner. An axis whose ends are both 0: all of it.
    Box shown_m = {};
};

/// First and last row that changed; none: first > last.
struct ChangedRows {
    std::int32_t first = 0;
    std::int32_t last = -1;
};

/// Draws what is shown over the whole display: the density of cells, bilinear between their
/// centres, as `World::density` knows it; solids where the contour is, and beyond the tank. Pixels
/// take integers only. Of a tank with `Capacity::window_cells` what is beyond the window is drawn
/// empty, its solids left out, too. A display that cannot be, without pixels, of a place that is
/// none or with a shade that is none, is left as it is.
/// Cost: 140 instructions a pixel on a Cortex-M4, 190 where there are bodies, 240 and more on an
/// M0: whoever sleeps draws once when `StepReport::asleep` first says so, and then no more.
template <class Real>
ChangedRows draw(const World<Real>& world, const Display& display);

extern template ChangedRows draw(const World<float>&, const Display&);
extern template ChangedRows draw(const World<double>&, const Display&);
extern template ChangedRows draw(const World<Fixed>&, const Display&);
extern template ChangedRows draw(const World<SmallFixed>&, const Display&);

}  // namespace weir
