// What the pressure needs is free before it is solved. In packed worlds, where it lies behind the
// velocities, it is free again afterwards: words for other stages.
#pragma once

#include <cstdint>

#include "base/array_view.hpp"
#include "pressure/pressure_fields.hpp"

namespace weir {

using FreeWords = ArrayView<std::uint32_t>;

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

/// Two and more for each row.
template <class Real>
ArrayView<std::int32_t> words_before_pressure(const PressureFields<Real>& fields,
                                              const GridShape& stored) {
    if constexpr (Stored<Real>::shares_momentum) {
        const FreeWords free = free_words(fields, stored);
        return {reinterpret_cast<std::int32_t*>(free.data), free.size};
    } else {
        const std::int32_t rows = coarse_cells(stored.ny) + 2;
        return {reinterpret_cast<std::int32_t*>(fields.coarse.correction),
                kCoarseFields * fields.coarse.shape.stride * rows};
    }
}

}  // namespace weir
