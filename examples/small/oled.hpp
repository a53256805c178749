// The 128 × 64 display of the lm3s6965evb: an SSD0323 behind SSI0, 16 shades.
#pragma once

#include "weir/display.hpp"

namespace oled {

/// Switches the display on.
void start();

/// Draws the world and sends the rows that changed.
void show(const weir::World<weir::SmallFixed>& world);

}  // namespace oled
