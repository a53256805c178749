#include "pressure/cut_off.hpp"

#include "pressure/coarse_shares.hpp"
#include "pressure/patch_links.hpp"

namespace weir {

namespace {

/// Where a part of a patch that is cut off reaches cells that are the own ones of other patches.
template <class Real>
struct CutOffPart {
    const Walls<Real>& walls;
    const PressureFields<Real>& fields;
    const GridShape& s;
    const Patch& patch;
    std::uint32_t cells;

    /// Faces to those of the patch beside or above by which cells of one edge lead to it. `edge`:
    /// these; `face`, `cell`: from one of them to its face and the cell behind; `bits`: between
    /// that cell's bit in its patch and its own.
    std::int32_t reach(std::uint32_t edge, const ShareOf<Real>* open, std::int32_t face,
                       std::int32_t cell, std::int32_t q, std::int32_t bits) const {
        const std::uint32_t theirs = fields.coarse.cut_off[q].cells;
        std::int32_t count = 0;
        for_each_of_patch(cells & edge, [&](std::int32_t bit, std::int32_t x, std::int32_t y) {
            const std::int32_t c = s.index(patch.i + x, patch.j + y);
            const bool open_way = !is_zero(Real(open[c + face])) &&
                                  !is_zero(Real(fields.inverse_diagonal[c + cell]));
            count += open_way && !has_bit(theirs, bit + bits) ? 1 : 0;
        });
        return count;
    }
};

/// To which coarse cell each cell of a part goes: of those beside and above it, as its place to the
/// middle of the patch's own liquid tells (`CoarseShares`), to the one that is reached through more
/// faces.
template <class Real>
void join_part(const CutOffPart<Real>& part, CutOff& cut) {
    const GridShape& s = part.s;
    const Patch& patch = part.patch;
    const CoarseGrid<Real>& coarse = part.fields.coarse;
    const Walls<Real>& walls = part.walls;
    constexpr std::int32_t kBack = kCoarseEdge - 1;
    const std::int32_t up = coarse.shape.stride;
    const std::int32_t q = patch.q;
    const bool last_column = patch.i + patch.width == s.nx;
    const bool last_row = patch.j + patch.height == s.ny;
    const std::int32_t left =
        patch.i > 0 ? part.reach(0x1111, walls.open_u, 0, -1, q - 1, kBack) : 0;
    const std::int32_t right =
        last_column ? 0 : part.reach(0x8888, walls.open_u, 1, 1, q + 1, -kBack);
    const std::int32_t below =
        patch.j > 0 ? part.reach(0x000F, walls.open_v, 0, -s.stride, q - up, 4 * kBack) : 0;
    const std::int32_t above =
        last_row ? 0 : part.reach(0xF000, walls.open_v, s.stride, s.stride, q + up, -4 * kBack);
    for_each_of_patch(part.cells, [&](std::int32_t bit, std::int32_t x, std::int32_t y) {
        const bool on_left = static_cast<Real>(x) <= coarse.centre_x[q];
        const bool lower = static_cast<Real>(y) <= coarse.centre_y[q];
        const std::int32_t along_x = on_left ? left : right;
        const std::int32_t along_y = lower ? below : above;
        std::uint16_t& to = along_x >= along_y ? cut.beside : cut.above;
        if (maximum(along_x, along_y) > 0) {
            to = static_cast<std::uint16_t>(to | 1U << static_cast<std::uint32_t>(bit));
        }
    });
}

/// How one cell of a patch shares in its own coarse cell's neighbours (`CoarseShares`).
template <class Real>
struct CellShare {
    std::int32_t beside;
    std::int32_t above;
    Real of_beside;
    Real of_above;

    CellShare(const CoarseShares<Real>& shares, std::int32_t q, std::int32_t up,
              std::int32_t bit) {
        const std::int32_t x = bit % kCoarseEdge;
        const std::int32_t y = bit / kCoarseEdge;
        beside = x < shares.columns_before ? q - 1 : q + 1;
        above = y < shares.rows_before ? q - up : q + up;
        of_beside = shares.of_beside[x];
        of_above = shares.of_above[y];
    }
};

/// How a cell shares that is cut off: in the unknown of the coarse cell that it goes with, as if it
/// lay there, and in that of the one above or beside which is next to it.
template <class Real>
struct CutShare {
    std::int32_t q = -1;  ///< −1: it goes with none
    std::int32_t next = 0;
    Real of_next{};

    CutShare(const CoarseGrid<Real>& coarse, std::int32_t patch, std::int32_t bit) {
        const CutOff& cut = coarse.cut_off[patch];
        const auto x = static_cast<Real>(bit % kCoarseEdge);
        const auto y = static_cast<Real>(bit / kCoarseEdge);
        const std::int32_t up = coarse.shape.stride;
        if (has_bit(cut.beside, bit)) {
            q = x <= coarse.centre_x[patch] ? patch - 1 : patch + 1;
            share_in(y - coarse.centre_y[q], coarse.reach_v, up);
        } else if (has_bit(cut.above, bit)) {
            q = y <= coarse.centre_y[patch] ? patch - up : patch + up;
            share_in(x - coarse.centre_x[q], coarse.reach_u, 1);
        }
    }

private:
    void share_in(Real way, const Real* reach, std::int32_t step) {
        constexpr Real kPerEdge = Real(1.0 / kCoarseEdge);
        const bool before = !(way > Real(0));
        next = before ? q - step : q + step;
        of_next = kPerEdge * (before ? -way * reach[q] : way * reach[next]);
    }
};

}  // namespace

template <class Real>
void cut_patch(const Walls<Real>& walls, const GridShape& s, const PressureFields<Real>& fields,
               const Patch& patch, CoarseGrid<Real>& coarse) {
    const PatchLinks links = links_of(walls, fields, s, patch);
    const std::uint32_t cells = cells_cut_off(links);
    if (cells == 0) {
        return;
    }
    coarse.cut_off[patch.q].cells = static_cast<std::uint16_t>(cells);
    coarse.residual[patch.q] = kPartly<Real>;
    std::int32_t columns = 0;
    std::int32_t rows = 0;
    const std::uint32_t own = links.liquid & ~cells;
    for_each_of_patch(own, [&](std::int32_t, std::int32_t x, std::int32_t y) {
        columns += x;
        rows += y;
    });
    put_centre(patch.q, count_bits(own), columns, rows, coarse);
}

template <class Real>
void join_cut_off(const Walls<Real>& walls, const PressureFields<Real>& fields, const GridShape& s,
                  const Patch& patch) {
    CutOff& cut = fields.coarse.cut_off[patch.q];
    const PatchLinks links = links_of(walls, fields, s, patch);
    for (std::uint32_t rest = cut.cells; rest != 0;) {
        const std::uint32_t cells = links.part_of(rest);
        rest &= ~cells;
        join_part(CutOffPart<Real>{walls, fields, s, patch, cells}, cut);
    }
}

template <class Real>
void move_residual(std::int32_t patch, std::int32_t bit, Real residual, const Targets& targets,
                   CoarseGrid<Real>& coarse) {
    const auto add = [&](std::int32_t q, Real some) {
        if (targets.has(q)) {
            coarse.residual[q] += some;
        }
    };
    const CellShare<Real> from(CoarseShares<Real>(coarse, patch), patch, coarse.shape.stride, bit);
    add(from.beside, -from.of_beside * residual);
    add(from.above, -from.of_above * residual);
    add(patch, -(residual - (from.of_beside * residual + from.of_above * residual)));
    const CutShare<Real> to(coarse, patch, bit);
    if (to.q >= 0) {
        add(to.q, residual - to.of_next * residual);
        add(to.next, to.of_next * residual);
    }
}

template <class Real>
void correct_cut_off(const GridShape& s, const Part& rows, PressureFields<Real>& fields) {
    const CoarseGrid<Real>& coarse = fields.coarse;
    const Real* const e = coarse.correction;
    for_each_parted(s, coarse, rows, [&](const Patch& patch) {
        if (is_zero(coarse.inverse_diagonal[patch.q])) {
            return;
        }
        const CoarseShares<Real> shares(coarse, patch.q);
        const std::uint32_t cells = coarse.cut_off[patch.q].cells;
        for_each_of_patch(cells, [&](std::int32_t bit, std::int32_t x, std::int32_t y) {
            const CellShare<Real> from(shares, patch.q, coarse.shape.stride, bit);
            const Real own = e[patch.q];
            const Real added = (own + from.of_above * (e[from.above] - own)) +
                               from.of_beside * (e[from.beside] - own);
            const CutShare<Real> to(coarse, patch.q, bit);
            const Real wanted =
                to.q < 0 ? Real(0) : e[to.q] + to.of_next * (e[to.next] - e[to.q]);
            fields.pressure[s.index(patch.i + x, patch.j + y)] += wanted - added;
        });
    });
}

#define WEIR_INSTANTIATE(Real)                                                                    \
    template void cut_patch(const Walls<Real>&, const GridShape&, const PressureFields<Real>&,    \
                            const Patch&, CoarseGrid<Real>&);                                     \
    template void join_cut_off(const Walls<Real>&, const PressureFields<Real>&, const GridShape&, \
                               const Patch&);                                                     \
    template void move_residual(std::int32_t, std::int32_t, Real, const Targets&,                 \
                                CoarseGrid<Real>&);                                               \
    template void correct_cut_off(const GridShape&, const Part&, PressureFields<Real>&);
WEIR_FOR_EACH_ROOMY_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
