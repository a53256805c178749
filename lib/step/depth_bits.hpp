// Levels as bits, for loops without lanes: up to 29 cells of a row are asked at once whether liquid
// is all around them, and each is looked at once.
#pragma once

#include <type_traits>

#include "grid/staggered_grid.hpp"

namespace weir {

/// Cells of a row, a bit each.
struct CellBits {
    std::uint32_t wet = 0;   ///< liquid
    std::uint32_t held = 0;  ///< not empty
};

/// `bits`, moved up by one, and below them whether number ≥ least.
inline std::uint32_t with_bit(std::uint32_t bits, std::uint32_t number, std::uint32_t least) {
#if defined(__thumb2__)  // what comparing carries is the bit
    __asm__("cmp %1, %2\n\tadc %0, %0, %0" : "+r"(bits) : "r"(number), "r"(least) : "cc");
    return bits;
#else
    return bits + bits + (number >= least ? 1U : 0U);
#endif
}

/// Some columns of row j and of the rows around it.
template <class Real>
class DepthBits {
public:
    static constexpr std::int32_t kColumns = 29;  ///< two more before them, one behind

    /// Columns from `first` on, 1 or more.
    DepthBits(const GridShape& s, const LevelOf<Real>* level, std::int32_t first, std::int32_t row)
        : s_(s),
          level_(level),
          count_(minimum(kColumns, s.nx - first) + 3),
          with_first_((count_ > 3 ? (0xFFFFFFFFU >> (35 - count_)) << 2U : 0U) |
                      (first == 1 ? 2U : 0U)),
          j(row),
          place(s.index(first - 2, row)),
          of_u(with_first_ & ~2U),
          under(j > 0 ? look(-2) : CellBits()),
          below(look(-1)),
          here(look(0)),
          above(look(1)) {
        const std::int32_t last = s.nx - 1 - (first - 2);
        inside = (first == 1 ? ~3U : ~0U) & (last < 32 ? (1U << last) - 1U : ~0U);
    }

    /// One row up.
    void advance() {
        ++j;
        place += s_.stride;
        under = below;
        below = here;
        here = above;
        above = look(1);
    }

    /// V faces that are looked at: those of the columns, and of column 0.
    std::uint32_t of_v() const { return j > 0 ? with_first_ : 0U; }

private:
    CellBits look(std::int32_t rows_up) const {
        const LevelOf<Real>* level = level_ + place + rows_up * s_.stride;
        CellBits bits;
        if constexpr (std::is_same<Real, float>::value) {
            // As whole numbers without a sign, what is negative is larger than all that is not.
            std::uint32_t dry = ~0U;
            std::uint32_t empty = ~0U;
            for (const float* at = level + count_; at != level;) {
                const auto key = static_cast<std::uint32_t>(bound_key(*--at));
                dry = with_bit(dry, key - 1U, 0x7FFFFFFFU);
                empty = with_bit(
                    empty, key, static_cast<std::uint32_t>(bound_key(kEmptyLevel<float>)));
            }
            return {~dry, ~empty};
        }
        for (std::int32_t k = count_ - 1; k >= 0; --k) {
            const bool wet = is_positive(Real(level[k]));
            const bool held = bound_key(Real(-level[k])) < bound_key(Real(-kEmptyLevel<Real>));
            bits.wet = bits.wet + bits.wet + (wet ? 1U : 0U);
            bits.held = bits.held + bits.held + (held ? 1U : 0U);
        }
        return bits;
    }

    const GridShape& s_;
    const LevelOf<Real>* level_;
    std::int32_t count_;
    std::uint32_t with_first_;  ///< the columns, and column 0 where it is before them

public:
    std::int32_t j;
    std::int32_t place;    ///< index of the lowest bit's cell in row j
    std::uint32_t of_u;    ///< u faces that are looked at
    CellBits under;        ///< row j − 2; none where j is 0
    CellBits below;
    CellBits here;
    CellBits above;
    std::uint32_t inside;  ///< columns that touch neither side of the tank
};

/// visit(bits) for some rows: u faces from column 1 on, v faces from row 1 on. What lies on a seam
/// looks two cells beyond it, and is not among them.
template <class Real, class Visit>
inline void for_each_depth(const GridShape& s, const LevelOf<Real>* level, const Part& rows,
                           const Visit& visit) {
    for (std::int32_t first = 1; rows.first < rows.end && (first == 1 || first < s.nx);
         first += DepthBits<Real>::kColumns) {
        DepthBits<Real> bits(s, level, first, rows.first);
        for (;; bits.advance()) {
            visit(bits);
            if (bits.j + 1 >= rows.end) {
                break;
            }
        }
    }
}

/// visit(place, its bit) for each bit of a row whose lowest one is at `place`.
template <class Visit>
inline void for_each_bit(std::uint32_t bits, std::int32_t place, const Visit& visit) {
    for (; bits != 0; bits &= bits - 1U) {
        visit(place + WEIR_TRAILING_ZEROS(bits), bits & (0U - bits));
    }
}

}  // namespace weir
