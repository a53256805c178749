// Pictures to files. On failure: false, and a text in *error (which may be nullptr).
#pragma once

#include <string>
#include <vector>

#include "weir_picture/canvas.hpp"

namespace weir_picture {

bool write_png(const std::string& path, const Canvas& canvas, std::string* error);

// An endless animation. All frames must have the size of the first; centiseconds 2 .. 65535 are
// the time each is shown (browsers slow 0 and 1 down). 255 colours are chosen from all frames.
bool write_gif(const std::string& path, const std::vector<Canvas>& frames, int centiseconds,
               std::string* error);

}  // namespace weir_picture
