// The bodies that are drawn in a part of the tank, listed once for all who ask there: of a map of
// thousands of tiles only few are near.
#pragma once

#include "solid/body_table.hpp"

namespace weir {

/// Room for such a list. Whoever asks for all bodies has none: small chips have little stack. Tiles
/// of a cell around 4 × 4 nodes are fewer than 96; packed worlds have room for as many larger ones.
template <class Real>
struct BodyRoom {
    static constexpr std::int32_t kMost = Stored<Real>::coarse ? 16 : 96;
    std::uint16_t slot[kMost];
};

template <class Real>
class DrawnBodies {
public:
    /// All of them.
    explicit DrawnBodies(const BodyTable<Real>& table) : table_(&table) {}
    /// The same, with room to narrow them.
    DrawnBodies(const DrawnBodies& all, BodyRoom<Real>& room)
        : table_(all.table_), listed_(room.slot) {}

    /// Those of a wider list that may have drawn a node of a box, and for which fits(body) holds.
    /// If they are too many, they are not listed, and still all of the table's slots are asked.
    template <class Fits>
    void narrow(const DrawnBodies& wider, const NodeBox& box, const Fits& fits) {
        count_ = 0;
        box_ = box;
        wider.for_each_at(box, [&](std::uint16_t slot, const Body<Real>& body) {
            if (count_ >= 0 && fits(body)) {
                if (count_ == BodyRoom<Real>::kMost) {
                    count_ = kNotListed;
                } else {
                    listed_[count_++] = slot;
                }
            }
        });
    }

    /// Whether those nodes are in the box that they were last narrowed to.
    bool is_about(const NodeBox& nodes) const { return holds(box_, nodes); }
    /// Whether it is known that there are fewer.
    bool fewer_than(std::int32_t bodies) const { return count_ >= 0 && count_ < bodies; }

    /// Calls visit(slot, body) for those that may have drawn a node of a box, in the table's order.
    template <class Visit>
    void for_each_at(const NodeBox& box, const Visit& visit) const {
        const std::int32_t end = count_ < 0 ? table_->capacity : count_;
        for (std::int32_t k = 0; k < end; ++k) {
            const auto slot = count_ < 0 ? static_cast<std::uint16_t>(k) : listed_[k];
            const Body<Real>& body = table_->body[slot];
            if (body.kind != BodyKind::free && overlap(body.drawn, box)) {
                visit(slot, body);
            }
        }
    }
    bool any_at(const NodeBox& box) const {
        bool any = false;
        for_each_at(box, [&](std::uint16_t, const Body<Real>&) { any = true; });
        return any;
    }

    /// A body's edges.
    Outline<Real> outline(const Body<Real>& body) const { return table_->outline(body); }

private:
    static constexpr std::int32_t kNotListed = -1;

    const BodyTable<Real>* table_;
    std::int32_t count_ = kNotListed;
    NodeBox box_;
    std::uint16_t* listed_ = nullptr;
};

/// The nodes that any body may be drawn at.
template <class Real>
NodeBox all_drawn(const BodyTable<Real>& bodies) {
    NodeBox all;
    for (std::int32_t slot = 0; slot < bodies.capacity; ++slot) {
        const Body<Real>& body = bodies.body[slot];
        if (body.kind != BodyKind::free) {
            all = unite(all, body.drawn);
        }
    }
    return all;
}

}  // namespace weir
