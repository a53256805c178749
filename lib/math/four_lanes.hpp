// Four floats side by side as loops know them that are written for any number of groups of four.
#pragma once

#include <type_traits>

#include "math/lanes.hpp"

namespace weir {

#if WEIR_HAS_LANES

struct FourLanes {
    using Floats = Lanes;
    using Four = Lanes;
    using Ints = LaneMask;
    using UpToEight = FourLanes;  ///< as many of these, but no more
    using Shorts = std::int16_t __attribute__((vector_size(16)));
    static constexpr std::int32_t kGroups = 1;
    static constexpr std::int32_t kLanes = 4;
    static constexpr std::integral_constant<std::int32_t, 0> kFirstGroup{};

    /// body(number of the group), a constant.
    template <class Body>
    static void each_group(const Body& body) {
        body(kFirstGroup);
    }
    template <int G>
    static Floats group(Floats a) {
        return a;
    }
    static Floats all(float value) { return all_lanes(value); }
    /// The same in each group.
    static Floats repeat(float a, float b, float c, float d) { return Floats{a, b, c, d}; }
    static Floats load(const float* from) { return load_lanes(from); }
    /// The first few; the others are 0.
    static Floats load_some(const float* from, std::int32_t count) {
        Floats lanes{};
        __builtin_memcpy(&lanes, from, static_cast<std::size_t>(count) * sizeof *from);
        return lanes;
    }
    static void store(float* to, Floats lanes) { store_lanes(to, lanes); }
    /// A number for each group.
    static Floats one_a_group(const float* from) { return all_lanes(*from); }
    /// Rows of stencils, four numbers each, of as many particles as groups: of one on u and on v;
    /// of two particles each with its row on u in the first group and the one on v in the second.
    struct Rows {
        Floats a;
        Floats b;
    };
    /// From pairs `at` on, in the order of `store_kinds`.
    static Rows load_rows(const float* u, const float* v, const std::uint32_t* at) {
        return {load_lanes(u + 2 * static_cast<std::size_t>(at[0])),
                load_lanes(v + 2 * static_cast<std::size_t>(at[1]))};
    }
    /// Adds those of one particle.
    template <int G>
    static void add_rows(float* u, float* v, const Rows& rows) {
        add_group<G>(u, rows.a);
        add_group<G>(v, rows.b);
    }
    /// Pairs on u and on v of particles → of as many as groups all on u, all on v.
    static void store_kinds(float* to, Floats u, Floats v) {
        store_lanes(to, weir::shuffle<0, 1, 4, 5>(u, v));
        store_lanes(to + 4, weir::shuffle<2, 3, 6, 7>(u, v));
    }
    /// The same of numbers, of which each group has two on u, then two on v.
    static void store_kinds(std::uint32_t* to, Ints a) {
        const Ints lanes = __builtin_shufflevector(a, a, 0, 2, 1, 3);
        __builtin_memcpy(to, &lanes, sizeof lanes);
    }
    /// Components of as many velocities as groups, in that order, after a 1 each.
    static Floats ones_before_kinds(const float* from) {
        return weir::shuffle<0, 4, 1, 5>(all(1.0F), load_pair(from));
    }
    /// Of pairs in that order, of as many particles as groups here and there: first numbers on u
    /// and v of each, and second ones.
    static Floats first_of_kinds(Floats a, Floats b) { return weir::shuffle<0, 2, 4, 6>(a, b); }
    static Floats second_of_kinds(Floats a, Floats b) { return weir::shuffle<1, 3, 5, 7>(a, b); }
    template <int G>
    static void add_group(float* to, Floats lanes) {
        store_lanes(to, load_lanes(to) + lanes);
    }
    /// Lanes 0 and 1 of each group here, 2 and 3 there.
    static void store_halves(std::uint32_t* first, std::uint32_t* second, Ints lanes) {
        const Ints later = __builtin_shufflevector(lanes, lanes, 2, 3, 2, 3);
        __builtin_memcpy(first, &lanes, 2 * sizeof *first);
        __builtin_memcpy(second, &later, 2 * sizeof *second);
    }
    /// Appends those of a set, the last one first: their numbers, from `first` on, and what
    /// `store_halves` would store of them. Returns how many.
    static std::int32_t append(std::uint32_t set, std::int32_t first, Ints a,
                               std::int32_t* number, std::uint32_t* value) {
        std::uint32_t lane[4];
        store_halves(lane, lane + 2, a);
        std::int32_t n = 0;
        for (; set != 0; ++n) {
            const std::int32_t k = 31 - __builtin_clz(set);
            set ^= 1U << static_cast<std::uint32_t>(k);
            number[n] = first + k;
            value[n] = lane[k];
        }
        return n;
    }
    /// Bytes at numbers that `sums_of_products` gave: a bit for each that is not 0, in the order of
    /// `store_halves`.
    static std::uint32_t set_bytes(const std::uint8_t* bytes, Ints at) {
        std::uint32_t number[4];
        store_halves(number, number + 2, at);
        const auto byte = [&](std::int32_t k) { return bytes[number[k]]; };
        if ((byte(0) | byte(1) | byte(2) | byte(3)) == 0) {
            return 0;
        }
        return (byte(0) != 0 ? 1U : 0U) | (byte(1) != 0 ? 2U : 0U) | (byte(2) != 0 ? 4U : 0U) |
               (byte(3) != 0 ? 8U : 0U);
    }
    /// A group of a, one of b, the next of a …
    static void store_in_turn(float* to, Floats a, Floats b) {
        store_lanes(to, a);
        store_lanes(to + 4, b);
    }
    /// Within each group.
    template <int I, int J, int K, int L>
    static Floats shuffle(Floats a, Floats b) {
        return weir::shuffle<I, J, K, L>(a, b);
    }
    /// Of groups that hold every second of several things: all in their order.
    static Floats in_order(Floats a) { return a; }
    /// Lanes 0, 2 … of a, then of b; 1, 3 …
    static Floats every_second(Floats a, Floats b) { return weir::shuffle<0, 2, 4, 6>(a, b); }
    static Floats every_other(Floats a, Floats b) { return weir::shuffle<1, 3, 5, 7>(a, b); }
    static Ints whole(Floats a) { return __builtin_convertvector(a, Ints); }
    static Floats floats(Ints a) { return __builtin_convertvector(a, Floats); }
    /// Numbers first, second … of a table, for the bytes at some places.
    static Ints look_up(const std::int32_t* table, const std::uint8_t* bytes,
                        const std::uint32_t* at) {
        const auto number = [&](std::int32_t k) { return table[bytes[at[k]]]; };
        return Ints{number(0), number(1), number(2), number(3)};
    }
    struct Places {
        Floats x;
        Floats y;
    };
    /// Some of many pairs.
    static Places places_at(const float* pairs, const std::int32_t* at) {
        const auto two = [&](std::int32_t a, std::int32_t b) {
            return weir::shuffle<0, 1, 4, 5>(load_pair(pairs + 2 * at[a]),
                                             load_pair(pairs + 2 * at[b]));
        };
        return {weir::shuffle<0, 2, 4, 6>(two(0, 1), two(2, 3)),
                weir::shuffle<1, 3, 5, 7>(two(0, 1), two(2, 3))};
    }
    template <class Place>
    static Squares squares_at(const float* low, const float* high, const Place* at) {
        return weir::squares_at(low, high, at);
    }
    /// Numbers before, at and behind some places.
    struct Threes {
        Floats left;
        Floats middle;
        Floats right;
    };
    static Threes threes_at(const float* from, const std::int32_t* at) {
        const auto four = [&](std::int32_t k) { return load_lanes(from - 2 + at[k]); };
        const Lanes a = weir::shuffle<0, 4, 1, 5>(four(0), four(1));
        const Lanes b = weir::shuffle<0, 4, 1, 5>(four(2), four(3));
        const Lanes c = weir::shuffle<2, 6, 3, 7>(four(0), four(1));
        const Lanes d = weir::shuffle<2, 6, 3, 7>(four(2), four(3));
        return {weir::shuffle<2, 3, 6, 7>(a, b), weir::shuffle<0, 1, 4, 5>(c, d),
                weir::shuffle<2, 3, 6, 7>(c, d)};
    }
    static Floats numbers_at(const float* from, Ints at) {
        return Floats{from[at[0]], from[at[1]], from[at[2]], from[at[3]]};
    }
    static Ints shorts_at(const std::uint16_t* from, Ints at) {
        return Ints{from[at[0]], from[at[1]], from[at[2]], from[at[3]]};
    }
    static Ints load_whole(const std::int32_t* from) {
        Ints lanes;
        __builtin_memcpy(&lanes, from, sizeof lanes);
        return lanes;
    }
    static void store_whole(std::int32_t* to, Ints lanes) {
        __builtin_memcpy(to, &lanes, sizeof lanes);
    }
    static Ints bytes(const std::uint8_t* from) { return widened(from); }
    static void store_bytes(std::uint8_t* to, Ints lanes) { store_narrowed(to, lanes); }
    static Ints shorts(const std::uint16_t* from) { return widened(from); }
    static void store_shorts(std::uint16_t* to, Ints lanes) { store_narrowed(to, lanes); }
    template <class Small>
    static Ints widened(const Small* from) {
        typedef Small Few __attribute__((vector_size(4 * sizeof(Small))));
        Few lanes;
        __builtin_memcpy(&lanes, from, sizeof lanes);
        return __builtin_convertvector(lanes, Ints);
    }
    template <class Small>
    static void store_narrowed(Small* to, Ints lanes) {
        typedef Small Few __attribute__((vector_size(4 * sizeof(Small))));
        const auto some = __builtin_convertvector(lanes, Few);
        __builtin_memcpy(to, &some, sizeof some);
    }
    /// Two numbers again and again.
    static Shorts pairs_of_shorts(std::int32_t first, std::int32_t second) {
        const auto a = static_cast<std::int16_t>(first);
        const auto b = static_cast<std::int16_t>(second);
        return Shorts{a, b, a, b, a, b, a, b};
    }
    /// Lane 0 times the first number + lane 1 times the second, then of lanes 2 and 3: in each
    /// group first those of a, then those of b. All of them are numbers that 16 bits hold.
    static Ints sums_of_products(Ints a, Ints b, Shorts f) {
#if defined(__SSE2__)
        return __builtin_ia32_pmaddwd128(__builtin_ia32_packssdw128(a, b), f);
#else
        const std::int32_t x = f[0];
        const std::int32_t y = f[1];
        return __builtin_shufflevector(a, b, 0, 2, 4, 6) * Ints{x, x, x, x} +
               __builtin_shufflevector(a, b, 1, 3, 5, 7) * Ints{y, y, y, y};
#endif
    }
    /// Which of them it has in a lane.
    static std::int32_t place_of_sum(std::int32_t lane) { return lane; }
    /// Every second of twice as many numbers, from the first one on and from the second one on, in
    /// an order of their own.
    struct Alternate {
        Floats even;
        Floats odd;
    };
    static Alternate load_alternate(const float* from) {
        const EvenOdd numbers = load_eight(from);
        return {numbers.even, numbers.odd};
    }
    static void store_alternate(float* to, Floats even, Floats odd) {
        store_lanes(to, weir::shuffle<0, 4, 1, 5>(even, odd));
        store_lanes(to + 4, weir::shuffle<2, 6, 3, 7>(even, odd));
    }
    /// The odd number before each: `before` holds those of the numbers before.
    static Floats odd_before(Floats before, Floats odd) {
        return weir::shuffle<3, 4, 5, 6>(before, odd);
    }
    /// Which of `even`, or of `odd`, are not among the first k.
    static Ints alternate_from(std::int32_t k) { return Ints{0, 1, 2, 3} >= k; }
    static Floats absolute(Floats a) { return weir::absolute(a); }
    static Floats square_root(Floats a) { return weir::square_root(a); }
    static Floats minimum(Floats a, Floats b) { return weir::minimum(a, b); }
    static Floats maximum(Floats a, Floats b) { return weir::maximum(a, b); }
    static Floats clamp(Floats a, Floats low, Floats high) { return weir::clamp(a, low, high); }
    /// A bit for each lane that is true, the lowest for lane 0.
    static std::uint32_t bits_of(Ints mask) { return weir::bits_of(mask); }
    /// The other way round.
    static Ints lanes_of(std::uint32_t bits) {
        return (Ints{1, 2, 4, 8} & static_cast<std::int32_t>(bits)) != 0;
    }
    static bool all_true(Ints mask) { return weir::all_true(mask); }
    static bool any_true(Ints mask) { return weir::any_true(mask); }
    /// A negative zero may count as one.
    static bool any_negative(Floats a) { return weir::any_negative(a); }
};

/// Four by four numbers, rows and columns exchanged, in each group.
template <class L>
inline void transpose(typename L::Floats (&v)[4]) {
    const auto a = L::template shuffle<0, 4, 1, 5>(v[0], v[1]);
    const auto b = L::template shuffle<0, 4, 1, 5>(v[2], v[3]);
    const auto c = L::template shuffle<2, 6, 3, 7>(v[0], v[1]);
    const auto d = L::template shuffle<2, 6, 3, 7>(v[2], v[3]);
    v[0] = L::template shuffle<0, 1, 4, 5>(a, b);
    v[1] = L::template shuffle<2, 3, 6, 7>(a, b);
    v[2] = L::template shuffle<0, 1, 4, 5>(c, d);
    v[3] = L::template shuffle<2, 3, 6, 7>(c, d);
}

#endif

}  // namespace weir
