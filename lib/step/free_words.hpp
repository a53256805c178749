// What a packed world's pressure has needed is free once it is solved, and lies behind its
// velocities: words for the stages that follow.
#pragma once

#include <cstdint>

#include "pressure/pressure_fields.hpp"

namespace weir {

struct FreeWords {
    std::uint32_t* first;
    std::int32_t count;
};

/// The smallest tank has room for so many.
template <class Real>
inline constexpr std::int32_t kFewestFreeWords =
    (kMinCells + 2) * (kMinCells + 2) * static_cast<std::int32_t>(sizeof(VelocityOf<Real>)) / 4 - 1;

template <class Real>
FreeWords free_words(const PressureFields<Real>& fields, const GridShape& tank) {
    constexpr std::uintptr_t kWord = sizeof(std::uint32_t);
    const auto first = reinterpret_cast<std::uintptr_t>(fields.divergence);
    const std::uintptr_t begin = (first + kWord - 1) / kWord * kWord;
    const std::uintptr_t end =
        first + static_cast<std::uintptr_t>(tank.size()) * sizeof(VelocityOf<Real>);
    return {reinterpret_cast<std::uint32_t*>(begin),
            static_cast<std::int32_t>((end - begin) / kWord)};
}

}  // namespace weir
