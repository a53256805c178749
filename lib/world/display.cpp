#include "weir/display.hpp"

#include "math/scalar.hpp"
#include "world/validate.hpp"

namespace weir {

namespace {

constexpr std::int32_t kOne = 256;  // of a cell, and of a full cell
constexpr std::int32_t kMostPixels = 1024;
constexpr std::uint32_t kMostShade = 15;

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
    return distance < Number(0) ? -filled(Number(-distance)) : filled(distance);
}

/// A length along an axis, in 1/kOne cells.
struct Span {
    std::int32_t first;
    std::int32_t length;  ///< 0: none
};

/// Between two places of an axis with so many cells, metres; all of it if both are 0.
Span span_of(float low_m, float high_m, float cell_m, std::int32_t cells) {
    if (low_m == 0.0F && high_m == 0.0F) {
        return {0, cells * kOne};
    }
    constexpr auto kMost = static_cast<float>(kMaxCells * kOne);
    const float each = static_cast<float>(kOne) / cell_m;
    const float low = low_m * each;
    const float high = high_m * each;
    if (!(low > -kMost && low < high && high < kMost)) {
        return {0, 0};
    }
    const auto rounded = [](float at) {  // no libc
        return static_cast<std::int32_t>(at + kMost + 0.5F) - static_cast<std::int32_t>(kMost);
    };
    return {rounded(low), rounded(high) - rounded(low)};
}

/// Pixels' centres along an axis, one after the other, in 1/kOne cells. One division for all.
class Places {
public:
    Places(std::int32_t pixels, const Span& shown)
        : over_(2 * pixels), step_(2 * shown.length / over_), rest_(2 * shown.length % over_),
          at_(shown.first + shown.length / over_), left_(shown.length % over_) {}

    std::int32_t at() const { return at_; }
    void next() {
        at_ += step_;
        left_ += rest_;
        if (left_ >= over_) {
            left_ -= over_;
            ++at_;
        }
    }

private:
    std::int32_t over_;
    std::int32_t step_;
    std::int32_t rest_;
    std::int32_t at_;
    std::int32_t left_;
};

/// A place along an axis between two samples.
struct Between {
    std::int32_t low;
    std::int32_t high;
    std::int32_t part;  ///< 0 … kOne − 1 of the way
};

/// Samples stand at `first` + n, in 1/kOne cells; ends repeat.
Between between(std::int32_t place, std::int32_t first, std::int32_t samples) {
    const std::int32_t at = place - first;
    return {clamp(at >> 8, 0, samples - 1), clamp((at >> 8) + 1, 0, samples - 1),
            at & (kOne - 1)};
}

/// Two rows of samples with a row of pixels between them. What is not stored is empty, and open.
template <class Number>
class Rows {
public:
    Rows(const FieldView<Number>& field, const Between& y, Number beyond)
        : low_(row(field, y.low)), high_(row(field, y.high)), first_(field.first_column),
          columns_(field.columns), part_(y.part), beyond_(beyond) {}

    /// Whether test(sample) holds for all four around.
    template <class Test>
    bool all(const Between& x, Test test) const {
        return test(at(low_, x.low)) && test(at(low_, x.high)) && test(at(high_, x.low)) &&
               test(at(high_, x.high));
    }
    template <class Value>
    std::int32_t sample(const Between& x, Value value) const {
        const auto along = [&](const Number* row) {
            const std::int32_t left = value(at(row, x.low));
            return left * kOne + x.part * (value(at(row, x.high)) - left);
        };
        const std::int32_t low = along(low_);
        return (low + part_ * ((along(high_) - low) >> 8)) >> 8;
    }

private:
    static const Number* row(const FieldView<Number>& field, std::int32_t j) {
        j -= field.first_row;
        return 0 <= j && j < field.rows ? &field.at(0, j) : nullptr;
    }
    Number at(const Number* row, std::int32_t i) const {
        i -= first_;
        return row != nullptr && 0 <= i && i < columns_ ? row[i] : beyond_;
    }

    const Number* low_;
    const Number* high_;
    std::int32_t first_;
    std::int32_t columns_;
    std::int32_t part_;
    Number beyond_;
};

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

/// What of a world is drawn.
template <class Real>
struct Scene {
    FieldView<DensityOf<Real>> density;
    FieldView<DistanceOf<Real>> distance;  ///< empty: no solids
    std::int32_t columns;
    std::int32_t rows;
    Span across;
    Span upwards;
};

/// Whether a place lies within an axis with so many cells.
bool on_axis(std::int32_t place, std::int32_t cells) {
    return static_cast<std::uint32_t>(place) < static_cast<std::uint32_t>(cells * kOne);
}

/// A row of pixels at that height. Whether any changed.
template <class Real>
bool draw_row(const Scene<Real>& scene, const Display& display, std::int32_t y,
              std::uint8_t* pixels) {
    const std::int32_t columns = scene.columns;
    const bool solids = scene.distance.data != nullptr;
    const Rows<DensityOf<Real>> cells(scene.density, between(y, kOne / 2, scene.rows),
                                      DensityOf<Real>(0));
    const Rows<DistanceOf<Real>> nodes(scene.distance, between(y, 0, scene.rows + 1),
                                       DistanceOf<Real>(1));
    const auto is_open = [](DistanceOf<Real> d) { return d > DistanceOf<Real>(0); };
    const auto near = [](DistanceOf<Real> d) { return limited_distance(d); };
    const auto full = [](DensityOf<Real> d) { return filled(d); };
    bool changed = false;
    const bool tank = on_axis(y, scene.rows);
    Places x(display.width, scene.across);
    for (std::int32_t column = 0; column < display.width; ++column, x.next()) {
        std::uint8_t& pair = pixels[column / 2];
        const std::uint32_t shift = (column & 1) == 0 ? 4U : 0U;
        const std::uint32_t before = (static_cast<std::uint32_t>(pair) >> shift) & 15U;
        const Between node = between(x.at(), 0, columns + 1);
        std::uint32_t shade = display.solid;
        if (tank && on_axis(x.at(), columns) &&
            (!solids || nodes.all(node, is_open) || nodes.sample(node, near) > 0)) {
            const Between cell = between(x.at(), kOne / 2, columns);
            shade = shade_of(display, cells.sample(cell, full), before);
        }
        if (shade != before) {
            pair = static_cast<std::uint8_t>((pair & (0xF0U >> shift)) | shade << shift);
            changed = true;
        }
    }
    return changed;
}

}  // namespace

template <class Real>
ChangedRows draw(const World<Real>& world, const Display& display) {
    const bool can_be = display.pixels != nullptr && within(display.width, 1, kMostPixels) &&
                        within(display.height, 1, kMostPixels) &&
                        display.liquid >= 1 && display.liquid <= kMostShade &&
                        display.solid <= kMostShade;
    const Box& shown = display.shown_m;
    const std::int32_t columns = world.cells_x();
    const std::int32_t rows = world.cells_y();
    const Scene<Real> scene{
        world.density(),
        world.signed_distance(),
        columns,
        rows,
        span_of(shown.min_m.x, shown.max_m.x, world.cell_m(), columns),
        span_of(shown.min_m.y, shown.max_m.y, world.cell_m(), rows),
    };
    if (scene.density.data == nullptr || !can_be || scene.across.length <= 0 ||
        scene.upwards.length <= 0) {
        return {};
    }
    ChangedRows changed{display.height, -1};
    const std::int32_t row_bytes = (display.width + 1) / 2;
    Places y(display.height, scene.upwards);
    for (std::int32_t row = display.height - 1; row >= 0; --row, y.next()) {
        if (draw_row(scene, display, y.at(), display.pixels + row * row_bytes)) {
            changed = {row, maximum(changed.last, row)};
        }
    }
    return changed;
}

#define WEIR_INSTANTIATE(Real) \
    template ChangedRows draw(const World<Real>&, const Display&);
WEIR_FOR_EACH_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
