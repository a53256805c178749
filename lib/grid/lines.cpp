#include "grid/lines.hpp"

namespace weir {

namespace {

/// A number of so many bytes, whatever it means.
template <class Whole>
struct Bits {
    using Type [[gnu::may_alias]] = Whole;
};

template <class Whole>
void copy_column(void* field, const Line to, const Line from) {
    auto* const bits = static_cast<typename Bits<Whole>::Type*>(field);
    auto* at = bits + to.first;
    const auto* other = bits + from.first;
    for (std::int32_t left = to.count; left > 0; --left, at += to.step, other += from.step) {
        *at = *other;
    }
}

}  // namespace

void copy_line(void* field, std::size_t size, const Line& to, const Line& from) {
    if (to.step == 1) {
        auto* const bytes = static_cast<std::byte*>(field);
        const auto at = [&](const Line& line) {
            return bytes + static_cast<std::ptrdiff_t>(line.first) *
                               static_cast<std::ptrdiff_t>(size);
        };
        std::memcpy(at(to), at(from), static_cast<std::size_t>(to.count) * size);
        return;
    }
    switch (size) {
        case 1: return copy_column<std::uint8_t>(field, to, from);
        case 2: return copy_column<std::uint16_t>(field, to, from);
        case 4: return copy_column<std::uint32_t>(field, to, from);
        default: return copy_column<std::uint64_t>(field, to, from);
    }
}

void fill_ghosts(void* field, std::size_t size, const GridShape& s, bool seam_x, bool seam_y,
                 bool seams_only) {
    const auto ghosts = [&](Line (*line)(const GridShape&, std::int32_t), std::int32_t last,
                            bool seam) {
        if (seam || !seams_only) {
            copy_line(field, size, line(s, -1), line(s, seam ? last : 0));
            copy_line(field, size, line(s, last + 1), line(s, seam ? 0 : last));
        }
    };
    ghosts(column, s.nx - 1, seam_x);
    ghosts(row, s.ny - 1, seam_y);
}

}  // namespace weir
