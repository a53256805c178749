// Whether a block of particles is in the open.
#pragma once

#include "fluid/particles.hpp"

namespace weir {

/// Whether all of some bytes are 0.
inline bool are_zero(const std::uint8_t* bytes, std::int32_t count) {
    std::uint64_t any = 0;
    std::int32_t k = 0;
    for (; k + 8 <= count; k += 8) {
        std::uint64_t eight;
        WEIR_COPY_BYTES(&eight, bytes + k, sizeof eight);
        any |= eight;
    }
    for (; k < count; ++k) {
        any |= bytes[k];
    }
    return any == 0;
}

/// Whether there is no solid around all that so many particles go through, if that is sooner told
/// than asked for each of them.
inline bool is_open_around(const GridShape& s, const std::uint8_t* cell_case,
                           const Extent<float>& ways, std::int32_t particles) {
    constexpr float kRounding = 1.0F / 64.0F;  // of the way in is_path_open
    constexpr std::int32_t kCellsAParticle = 4;
    const auto cell = [](float x, std::int32_t cells) {
        return clamp(static_cast<std::int32_t>(x), 0, cells - 1);
    };
    const std::int32_t i0 = cell(ways.low.x - kRounding, s.nx);
    const std::int32_t j0 = cell(ways.low.y - kRounding, s.ny);
    const std::int32_t width = cell(ways.high.x + kRounding, s.nx) + 1 - i0;
    const std::int32_t height = cell(ways.high.y + kRounding, s.ny) + 1 - j0;
    if (width * height > kCellsAParticle * particles) {
        return false;
    }
    for (std::int32_t y = 0; y < height; ++y) {
        if (!are_zero(cell_case + s.index(i0, j0 + y), width)) {
            return false;
        }
    }
    return true;
}

}  // namespace weir
