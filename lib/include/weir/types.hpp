// Plain values that cross the public face. Data only: no float arithmetic here, because a user's
// compiler flags apply to what a header computes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace weir {

/// A point or a vector. Metres or metres per second at the edge of the library, cells inside it.
template <class Real>
struct Vec2 {
    Real x{};
    Real y{};

    /// Packed numbers and what they stand for (weir/storage.hpp); floats want a `convert`.
    template <class To, std::enable_if_t<std::is_class<Real>::value &&
                                             !std::is_same<Real, To>::value &&
                                             (std::is_convertible<Real, To>::value ||
                                              std::is_convertible<To, Real>::value), int> = 0>
    constexpr operator Vec2<To>() const {  // NOLINT
        return {To(x), To(y)};
    }
};
using Vec2f = Vec2<float>;

/// An axis-aligned rectangle in metres, origin at the lower left corner of the tank.
struct Box {
    Vec2f min_m;
    Vec2f max_m;
};

/// A body's name: a slot in the body table and the generation that the slot had when the body was
/// added, so that the name of a removed body is refused and does not reach its successors, but for
/// each 65,536th; and the world's own tag, so that one world refuses another's names. The tag is
/// its place in memory: after another `init` there, names of before may be those of new bodies.
struct BodyId {
    std::uint16_t slot = 0xFFFF;
    std::uint16_t generation = 0;
    std::uint16_t world = 0;

    friend constexpr bool operator==(const BodyId& a, const BodyId& b) {
        return a.slot == b.slot && a.generation == b.generation && a.world == b.world;
    }
    friend constexpr bool operator!=(const BodyId& a, const BodyId& b) { return !(a == b); }
};

namespace detail {
/// Where arrays, and what has data() and size(), begin and how much they hold; no header of theirs.
template <class T, std::size_t Size>
constexpr T* first_of(T (&array)[Size]) {
    return array;
}
template <class Range>
constexpr auto first_of(Range& range) -> decltype(range.data()) {
    return range.data();
}
template <class T, std::size_t Size>
constexpr std::size_t size_of(T (&)[Size]) {
    return Size;
}
template <class Range>
constexpr auto size_of(Range& range) -> decltype(static_cast<std::size_t>(range.size())) {
    return static_cast<std::size_t>(range.size());
}
/// Never defined: something with a name, for `decltype`.
template <class Range>
Range& named();
template <class Range>
using ElementOf = std::remove_cv_t<std::remove_pointer_t<decltype(first_of(named<Range>()))>>;
}  // namespace detail

/// A read-only window into memory that somebody else owns.
template <class T>
struct View {
    const T* data = nullptr;
    std::int32_t size = 0;

    constexpr View() = default;
    constexpr View(const T* data_, std::int32_t size_) : data(data_), size(size_) {}
    /// All of an array, a std::array, a std::vector: of one that has a name, and so outlives this.
    template <class Range,
              std::enable_if_t<std::is_same<detail::ElementOf<Range>, T>::value, int> = 0>
    constexpr View(Range& range)  // NOLINT
        : data(detail::first_of(range)), size(static_cast<std::int32_t>(detail::size_of(range))) {}

    constexpr const T* begin() const { return data; }
    constexpr const T* end() const { return data + size; }
    constexpr const T& operator[](std::int32_t index) const { return data[index]; }
};

/// Rows of a cell or node field: value(i, j) = data[j * stride + i]. With `Capacity::window_cells`
/// only of a part of the tank, whose lower left corner is told.
template <class T>
struct FieldView {
    const T* data = nullptr;
    std::int32_t columns = 0;
    std::int32_t rows = 0;
    std::int32_t stride = 0;
    std::int32_t first_column = 0;
    std::int32_t first_row = 0;

    constexpr const T& at(std::int32_t i, std::int32_t j) const { return data[j * stride + i]; }
};

}  // namespace weir
