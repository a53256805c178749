// How free bodies push into cells: computed once for a pressure solve where there is room for it.
#pragma once

#include "solid/body_coupling.hpp"
#include "solid/body_reach.hpp"

namespace weir {

/// Of a body's closed faces on one cell: what the body's twist pushes into the cell. The bodies of
/// a cell's four faces may be four.
template <class Real>
struct Lever {
    std::uint16_t slot = kNoBody;
    Impulse<Real> reach;  ///< flow = reach · twist
};

template <class Real>
inline Face<Real> flow(const Impulse<Real>& reach, const Twist<Real>& twist) {
    return dot(reach.linear, twist.velocity) + reach.angular * twist.spin;
}

template <class Real>
struct Levers {
    Lever<Real> lever[6];
    std::int32_t count = 0;
    CellReach<Real> own;  ///< of the body that is asked for, without films
    /// What goes into films, and by spin beyond what `wall_flow` takes, as bodies are before the
    /// pressure.
    Face<Real> before = Face<Real>(0);

    Impulse<Real>* of(std::uint16_t slot) {
        std::int32_t k = 0;
        while (k < count && lever[k].slot != slot) {
            ++k;
        }
        if (k == 6) {
            return nullptr;
        }
        count = maximum(count, k + 1);
        lever[k].slot = slot;
        return &lever[k].reach;
    }
};

/// A cell of a body's rectangle on which a free body presses; its levers stand behind it.
template <class Real>
struct LeverCell {
    std::int32_t i;
    std::int32_t j;
    std::uint16_t slot;   ///< whose rectangle it is
    std::uint8_t count;   ///< of levers
    bool again;           ///< another body's rectangle had it before
    Face<Real> before;    ///< as in Levers
    Face<Real> diagonal;  ///< with what bodies yield, if it is ours to relax
    CellReach<Real> own;  ///< of the body of that rectangle, without films, where there is liquid
    std::int32_t chained;  ///< where the next one stands that is relaxed in the same half sweep

    const Lever<Real>* levers() const { return reinterpret_cast<const Lever<Real>*>(this + 1); }
    const LeverCell* next() const { return reinterpret_cast<const LeverCell*>(levers() + count); }
    LeverCell* next() {
        return reinterpret_cast<LeverCell*>(reinterpret_cast<Lever<Real>*>(this + 1) + count);
    }
};

/// Those of all rectangles, one behind the other, if there is room for them.
template <class Real>
struct KeptLevers {
    LeverCell<Real>* first;
    std::int32_t* bytes;  ///< that they take; negative: they are not kept
    std::int32_t* chain;  ///< for both colours: where the first one stands that is relaxed, or -1
    std::int32_t room;    ///< in bytes

    explicit KeptLevers(const BodyTable<Real>& table)
        : bytes(reinterpret_cast<std::int32_t*>(Meetings<Real>(table).levers)),
          chain(bytes + 1),
          room(WEIR_PARALLEL
                   ? table.capacity * static_cast<std::int32_t>(kLeverBytes<Real>) - kHead
                   : 0) {
        first = reinterpret_cast<LeverCell<Real>*>(Meetings<Real>(table).levers + kHead);
    }
    LeverCell<Real>* at(std::int32_t place) const {
        return reinterpret_cast<LeverCell<Real>*>(reinterpret_cast<std::byte*>(first) + place);
    }
    std::int32_t place_of(const LeverCell<Real>* cell) const {
        return static_cast<std::int32_t>(reinterpret_cast<const std::byte*>(cell) -
                                         reinterpret_cast<const std::byte*>(first));
    }
    bool are_kept() const { return WEIR_PARALLEL && *bytes >= 0; }
    LeverCell<Real>* begin() const { return first; }
    const LeverCell<Real>* end() const { return at(*bytes); }

private:
    static constexpr std::int32_t kHead = 16;
};

/// Impulses of the pressure on free bodies, slot by slot: by what is kept, if it is, with the bits
/// of `impulse_on_free`.
template <class Real>
struct PressureOnFree {
    KeptLevers<Real> kept;
    const LeverCell<Real>* cursor;

    explicit PressureOnFree(const BodyTable<Real>& table) : kept(table), cursor(kept.begin()) {}

    Impulse<Real> next(const GridShape& shape, const BodyTable<Real>& table,
                       const Walls<Real>& walls, std::uint16_t slot,
                       const PressedCells<Real>& cells) {
        if (!kept.are_kept()) {
            return impulse_on_free(shape, table, walls, slot, cells);
        }
        Impulse<Real> impulse;
        for (; cursor != kept.end() && cursor->slot == slot; cursor = cursor->next()) {
            if (cursor->own.any) {
                impulse.add(
                    cursor->own.impulse(cells.pressure[shape.index(cursor->i, cursor->j)]));
            }
        }
        return impulse;
    }
};

}  // namespace weir
