#include "pressure/inlets.hpp"

#include "math/packed_arithmetic.hpp"
#include "pressure/domain.hpp"
#include "pressure/make_room.hpp"

namespace weir {

namespace {

/// Where there are too many inlets one takes what was added so near to it along either axis.
constexpr std::int32_t kNearInlet = 4;
/// Less is asked for at once, cells.
template <class Real>
constexpr Real kLeastOwed = Real(1.0 / 32.0);

/// Density below which there is room: what is added takes the place of what was taken out.
template <class Real>
constexpr Real kThin = Real(0.5);
/// Nothing is asked for under a column of so many times the part of the tank that liquid is in: a
/// full tank cannot yield, and compressible liquid would burst out of it when it can. Not where a
/// second liquid may weigh more.
template <class Real>
constexpr Real kMostHead = Real(1.25);
/// So much of what would have been asked for is forgotten there: a pool that was just set in motion
/// yields again, a full tank does not.
template <class Real>
constexpr Real kForgotten = Real(0.125);

/// Which part of what is owed a substep asks for: spread over the time in which gravity moves
/// something by half a cell, so that it stirs no more than a steady inflow would.
template <class Real>
Real share_of_substep(const PressureFields<Real>& fields) {
    const Real share = square_root(fields.last_dt * fields.cell_weight);
    return clamp<Real>(share, Real(1.0 / 64.0), Real(0.25));
}

/// Whether a cell is wet, and all around it that is not behind a wall: what has a level over 0, or,
/// without levels, had any pressure.
template <class Real>
[[gnu::noinline]] bool is_beneath(const GridShape& s, const Walls<Real>& walls, std::int32_t i,
                                  std::int32_t j, const Real* level, const Real* pressure) {
    const std::int32_t c = s.index(i, j);
    const auto wet = [&](std::int32_t at) {
        return level != nullptr ? level[at] > Real(0) : pressure[at] != Real(0);
    };
    const auto none_dry = [&](bool inside, const ShareOf<Real>* open, std::int32_t face,
                              std::int32_t next) {
        return !inside || wet(next) || (walls.active && !(Real(open[face]) > Real(0)));
    };
    return wet(c) && none_dry(i > 0, walls.open_u, c, c - 1) &&
           none_dry(i + 1 < s.nx, walls.open_u, c + 1, c + 1) &&
           none_dry(j > 0, walls.open_v, c, c - s.stride) &&
           none_dry(j + 1 < s.ny, walls.open_v, c + s.stride, c + s.stride);
}

/// Whether a substep asks for room there: what is added to a surface rises by itself.
template <class Real>
bool wants_room(const Domain<Real>& domain, std::int32_t i, std::int32_t j) {
    const GridShape& s = domain.grid.shape;
    const PressureFields<Real>& f = domain.fields;
    if (j < 0 || j >= s.ny || i < s.columns(j).first || i >= s.columns(j).end) {
        return false;
    }
    const std::int32_t c = s.index(i, j);
    return Real(f.density[c]) > kThin<Real> && !is_zero(Real(f.inverse_diagonal[c])) &&
           is_beneath<Real>(s, domain.walls, i, j, f.level, f.pressure);
}

/// Whether there is hope for room.
template <class Real>
bool yields(const GridShape& s, std::int32_t c, const PressureFields<Real>& f) {
    const Real column = static_cast<Real>(maximum(s.nx, s.ny)) * f.cell_weight;
    const bool any_pressure =
        f.elasticity == nullptr && (is_zero(column) || f.second_liquid != nullptr);
    return any_pressure || f.pressure[c] < kMostHead<Real> * column;
}

/// A source of so much volume in this substep.
template <class Real>
void add_source(std::int32_t c, Real volume, PressureFields<Real>& f) {
    if (f.elasticity != nullptr) {
        const Real way = f.last_dt * f.sound_speed;
        f.pressure[c] = f.pressure[c] + way * (f.sound_speed * volume);
    } else {
        ask_for_outflow<Real>(c, volume / f.last_dt, f);
    }
}

template <class Real>
void make_room(const Domain<Real>& domain) {
    const GridShape& s = domain.grid.shape;
    PressureFields<Real>& fields = domain.fields;
    Inlets<Real>& inlets = fields.inlets;
    const Real pace = pace_of_room(fields);
    const Real share = pace * share_of_substep(fields);
    const Real least = pace * kLeastOwed<Real>;
    std::int32_t left = 0;
    for (std::int32_t k = 0; k < inlets.count; ++k) {
        Inlet<Real> inlet = inlets.at[k];
        const std::int32_t i = inlet.i - s.i0;
        const std::int32_t j = inlet.j - s.j0;
        if (!wants_room(domain, i, j)) {
            continue;
        }
        const std::int32_t c = s.index(i, j);
        Real volume = inlet.owed > kLeastOwed<Real> ? share * inlet.owed
                                                    : minimum(inlet.owed, least);
        if (yields(s, c, fields)) {
            add_source(c, volume, fields);
        } else {
            volume = kForgotten<Real> * volume;
        }
        inlet.owed = inlet.owed - volume;
        if (inlet.owed > Real(0)) {
            inlets.at[left++] = inlet;
        }
    }
    inlets.count = left;
}

/// The inlet that takes what is added in a cell; null: none does.
template <class Real>
Inlet<Real>* inlet_for(std::int32_t i, std::int32_t j, Inlets<Real>& inlets) {
    Inlet<Real>* nearest = nullptr;
    std::int32_t way = kNearInlet + 1;
    for (std::int32_t k = 0; k < inlets.count; ++k) {
        Inlet<Real>& one = inlets.at[k];
        const std::int32_t x = one.i < i ? i - one.i : one.i - i;
        const std::int32_t y = one.j < j ? j - one.j : one.j - j;
        if (maximum(x, y) < way) {
            way = maximum(x, y);
            nearest = &one;
        }
    }
    if (way == 0 || inlets.count == kMostInlets) {
        return nearest;
    }
    Inlet<Real>& added = inlets.at[inlets.count++];
    added = {static_cast<std::int16_t>(i), static_cast<std::int16_t>(j), Real(0)};
    return &added;
}

/// Excess from which on a packed cell asks, 128ths: more than most lattices have.
constexpr std::int32_t kDense = 8;

}  // namespace

void note_dense(const GridShape& tank, Vec2<SmallFixed> place, SmallFixed weight,
                PressureFields<SmallFixed>& fields) {
    const std::int32_t c =
        tank.index(static_cast<std::int32_t>(place.x), static_cast<std::int32_t>(place.y));
    if (fields.pressure[c] > weight) {
        fields.room_turns = kRoomTurns;
    }
}

/// Of what a cell has too much 4 g dt² flow out of it in a substep, half of it in the longest: the
/// less time there is the less is asked for, so that nothing is flung. Nothing yields under two
/// columns of the tank.
void make_room_packed(const GridShape& s, PressureFields<SmallFixed>& fields) {
    const std::int32_t weight = fields.cell_weight.raw;
    const std::int32_t most = 2 * maximum(s.nx, s.ny) * (weight >> 8);
    for (std::int32_t j = fields.solve.first_row; j <= fields.solve.last_row; ++j) {
        const std::int32_t end = s.index(s.nx, j);
        for (std::int32_t c = s.index(0, j); c < end; ++c) {
            const std::int32_t over = fields.density[c].raw - (128 + kDense);
            const std::int32_t pressure = fields.pressure[c].raw;
            if (over > 0 && pressure > weight && pressure >> 8 < most &&
                fields.inverse_diagonal[c].raw != 0) {
                std::int16_t& flow = fields.divergence[c].raw;
                flow = short_of(flow - ((over * (weight >> 6)) >> 8));
            }
        }
    }
}

template <class Real>
void link_inlets([[maybe_unused]] PressureFields<Real>& fields) {
    if constexpr (kHasInlets<Real>) {
        fields.inlets.make_room = make_room<Real>;
        link_make_room(fields);
    }
}

template <class Real>
void note_inlet([[maybe_unused]] const GridShape& tank, [[maybe_unused]] const Walls<Real>& walls,
                [[maybe_unused]] Vec2<Real> place, [[maybe_unused]] Real volume,
                [[maybe_unused]] PressureFields<Real>& fields) {
    if constexpr (kHasInlets<Real>) {
        const auto i = static_cast<std::int32_t>(place.x);
        const auto j = static_cast<std::int32_t>(place.y);
        const GridShape stored = stored_part(walls, tank);
        const bool known = i >= stored.i0 && i < stored.i0 + stored.nx && j >= stored.j0 &&
                           j < stored.j0 + stored.ny;
        if (!known || !is_beneath<Real>(tank, walls, i, j, nullptr, fields.pressure)) {
            return;
        }
        link_inlets(fields);
        Inlet<Real>* const inlet = inlet_for(i, j, fields.inlets);
        const Real owed = inlet != nullptr ? inlet->owed + volume : kMostOwed<Real> + volume;
        if (inlet != nullptr) {
            inlet->owed = minimum(owed, kMostOwed<Real>);
        }
        if (owed > kMostOwed<Real>) {  // nobody remembers where: all that is too dense asks
            fields.room_turns = kRoomTurns;
        }
    }
}

#define WEIR_INSTANTIATE(Real)                                                                  \
    template void note_inlet(const GridShape&, const Walls<Real>&, Vec2<Real>, Real,            \
                             PressureFields<Real>&);                                            \
    template void link_inlets(PressureFields<Real>&);
WEIR_FOR_EACH_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
