// A 5 x 7 dot font for captions.
#pragma once

namespace weir_picture {

inline constexpr int kGlyphWidth = 5;
inline constexpr int kGlyphHeight = 7;

// Column 0 .. 4 of a printable ASCII character ('?' for others); bit 0 is the top dot.
unsigned glyph_column(char c, int column);

}  // namespace weir_picture
