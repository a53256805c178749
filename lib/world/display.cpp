#include "weir/display.hpp"

#include "math/scalar.hpp"
#include "world/validate.hpp"

namespace weir {

namespace {

constexpr std::int32_t kOne = 256;  // of a cell, and of a full cell
constexpr std::int32_t kMostPixels = 1024;

/// 0 … kOne.
template <class Number>
std::int32_t filled(Number density) {
    if constexpr (std::is_floating_point<Number>::value) {
        return density >= Number(1) ? kOne : static_cast<std::int32_t>(density * Number(kOne));
    } else if constexpr (std::is_convertible<Number, SmallFixed>::value) {
        return clamp(static_cast<SmallFixed>(density).raw >> 8, 0, kOne);
    } else {
        return clamp(density.raw >> 8, 0, kOne);
    }
}

/// −kOne … kOne.
template <class Number>
std::int32_t limited_distance(Number distance) {
    if (distance <= Number(-1)) {
        return -kOne;
    }
    return distance < Number(0) ? -filled(Number(-distance)) : filled(distance);
}

/// A place along an axis between two samples.
struct Between {
    std::int32_t low;
    std::int32_t high;
    std::int32_t part;  ///< 0 … kOne − 1 of the way
};

/// Pixel k of `pixels` over samples that stand at `first` + n, in 1/kOne cells; ends repeat.
Between between(std::int32_t k, std::int32_t pixels, std::int32_t cells, std::int32_t first,
                std::int32_t samples) {
    // Most pixels over most cells are just below 2³².
    const std::uint32_t place = static_cast<std::uint32_t>(2 * k + 1) *
                                static_cast<std::uint32_t>(cells * kOne);
    const std::int32_t at =
        static_cast<std::int32_t>(place / static_cast<std::uint32_t>(2 * pixels)) - first;
    const std::int32_t low = clamp(at >> 8, 0, samples - 1);
    return {low, clamp((at >> 8) + 1, 0, samples - 1), at & (kOne - 1)};
}

template <class Field, class Value>
std::int32_t sample(const Field& field, std::int32_t beyond, const Between& x, const Between& y,
                    Value value) {
    const auto at = [&](std::int32_t i, std::int32_t j) {
        i -= field.first_column;  // what is not stored is empty, and open
        j -= field.first_row;
        return 0 <= i && i < field.columns && 0 <= j && j < field.rows ? value(field.at(i, j))
                                                                       : beyond;
    };
    const auto row = [&](std::int32_t j) {
        const std::int32_t left = at(x.low, j);
        return left * kOne + x.part * (at(x.high, j) - left);
    };
    const std::int32_t low = row(y.low);
    return (low + y.part * ((row(y.high) - low) >> 8)) >> 8;
}

/// The shade of so full a place, kept as long as it is near enough.
std::uint32_t shade_of(const Display& display, std::int32_t full, std::uint32_t before) {
    const std::int32_t exact = full * display.liquid;  // in 1/kOne shades
    const std::int32_t off = exact - static_cast<std::int32_t>(before) * kOne;
    const std::int32_t most = kOne / 2 + display.hysteresis;
    if (before <= display.liquid && off > -most && off < most) {
        return before;
    }
    return static_cast<std::uint32_t>((exact + kOne / 2) >> 8);
}

}  // namespace

template <class Real>
ChangedRows draw(const World<Real>& world, const Display& display) {
    const auto density = world.density();
    const auto distance = world.signed_distance();
    const bool can_be = display.pixels != nullptr && display.width % 2 == 0 &&
                        display.width <= kMostPixels && within(display.height, 0, kMostPixels);
    if (density.data == nullptr || !can_be) {
        return {};
    }
    ChangedRows changed{display.height, -1};
    for (std::int32_t row = 0; row < display.height; ++row) {
        const std::int32_t up = display.height - 1 - row;
        const Between cell_y = between(up, display.height, world.cells_y(), kOne / 2,
                                       world.cells_y());
        const Between node_y = between(up, display.height, world.cells_y(), 0,
                                       world.cells_y() + 1);
        for (std::int32_t column = 0; column < display.width; ++column) {
            std::uint8_t& pair = display.pixels[(row * display.width + column) / 2];
            const std::uint32_t shift = (column & 1) == 0 ? 4U : 0U;
            const std::uint32_t before = (static_cast<std::uint32_t>(pair) >> shift) & 15U;
            const Between node_x =
                between(column, display.width, world.cells_x(), 0, world.cells_x() + 1);
            std::uint32_t shade = display.solid;
            const auto near = [](auto value) { return limited_distance(value); };
            if (distance.data == nullptr || sample(distance, kOne, node_x, node_y, near) > 0) {
                const Between cell_x = between(column, display.width, world.cells_x(), kOne / 2,
                                               world.cells_x());
                const auto full = [](auto value) { return filled(value); };
                shade = shade_of(display, sample(density, 0, cell_x, cell_y, full), before);
            }
            if (shade != before) {
                pair = static_cast<std::uint8_t>((pair & (0xF0U >> shift)) | shade << shift);
                changed = {minimum(changed.first, row), row};
            }
        }
    }
    return changed;
}

#define WEIR_INSTANTIATE(Real) \
    template ChangedRows draw(const World<Real>&, const Display&);
WEIR_FOR_EACH_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
