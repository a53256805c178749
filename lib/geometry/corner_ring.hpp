// A polygon as one ring of corners: holes are joined to the outer ring by bridges, each walked once
// there and once back. Without holes corner k is vertex k.
#pragma once

#include <cstdint>

#include "base/array_view.hpp"
#include "geometry/outline.hpp"
#include "geometry/polygon.hpp"

namespace weir {

/// Set in a corner's entry of the sequence: the edge to the next corner is a bridge, no outline.
inline constexpr std::uint16_t kBridge = 0x8000;

/// Orientation is tested in double, where products of floats are exact: this is set-up, and a wrong
/// sign here is a hole in a solid.
template <class Real>
struct CornerRing {
    const Vec2<Real>* vertex = nullptr;
    ArrayView<std::uint16_t> sequence;  ///< vertex number of each corner, and kBridge

    std::int32_t count() const { return sequence.size; }
    std::int32_t vertex_of(std::int32_t corner) const {
        return sequence[corner] & ~static_cast<std::int32_t>(kBridge);
    }
    Vec2<double> at(std::int32_t corner) const {
        return convert<double>(vertex[vertex_of(corner)]);
    }
    double turn_at(std::int32_t a, std::int32_t b, std::int32_t c) const {
        return turn(at(a), at(b), at(c));
    }
    bool is_outline_edge(std::int32_t from, std::int32_t to) const {
        return to == (from + 1 < count() ? from + 1 : 0) && (sequence[from] & kBridge) == 0;
    }
};

/// Corners linked both ways: next of corner i at 2i, previous at 2i + 1. Numbers leave the top bit
/// free; on `previous` it is the mark of whoever walks.
struct CornerLinks {
    static constexpr std::uint16_t kMark = 0x8000;
    ArrayView<std::uint16_t> data;

    std::int32_t next(std::int32_t i) const { return data[2 * i]; }
    std::int32_t previous(std::int32_t i) const {
        return data[2 * i + 1] & ~static_cast<std::int32_t>(kMark);
    }
    bool marked(std::int32_t i) const { return (data[2 * i + 1] & kMark) != 0; }
    void mark(std::int32_t i) const {
        data[2 * i + 1] = static_cast<std::uint16_t>(data[2 * i + 1] | kMark);
    }
    void unmark(std::int32_t i) const { data[2 * i + 1] = static_cast<std::uint16_t>(previous(i)); }
    /// Makes b follow a, and takes b's mark away.
    void join(std::int32_t a, std::int32_t b) const {
        data[2 * a] = static_cast<std::uint16_t>(b);
        data[2 * b + 1] = static_cast<std::uint16_t>(a);
    }
};

}  // namespace weir
