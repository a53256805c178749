// Eight floats side by side, as two groups of four, for files that are compiled for processors with
// AVX2 (`..._wide.cpp`) or more. Lane by lane as in math/lanes.hpp, and so with the same bits.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "math/wide_lanes.hpp"

namespace weir {

#if WEIR_HAS_WIDE_LANES && defined(__AVX2__)

// No other file may be given what is compiled here.
namespace {

/// For each set of eight: which are in it, the last one first, a byte each.
struct LastFirst {
    std::uint64_t of[256] = {};

    constexpr LastFirst() {
        for (std::uint32_t set = 0; set < 256; ++set) {
            std::uint32_t shift = 0;
            for (std::uint32_t k = 8; k-- > 0;) {
                if ((set >> k & 1U) != 0) {
                    of[set] |= static_cast<std::uint64_t>(k) << shift;
                    shift += 8;
                }
            }
        }
    }
};
constexpr LastFirst kLastFirst;

/// What more than four lanes have alike, whatever their number.
template <std::int32_t N>
struct WideGroups {
    typedef float Floats __attribute__((vector_size(4 * N)));  // g++ takes no alias of N
    typedef std::int32_t Ints __attribute__((vector_size(4 * N)));
    using Four = float __attribute__((vector_size(16)));
    static constexpr std::int32_t kGroups = N / 4;
    static constexpr std::int32_t kLanes = N;

    template <int G>
    static Four group(Floats a) {
        return __builtin_shufflevector(a, a, 4 * G, 4 * G + 1, 4 * G + 2, 4 * G + 3);
    }
    static Floats load(const float* from) {
        Floats lanes;
        __builtin_memcpy(&lanes, from, sizeof lanes);
        return lanes;
    }
    static void store(float* to, Floats lanes) { __builtin_memcpy(to, &lanes, sizeof lanes); }
    static Floats absolute(Floats a) {
        return reinterpret_cast<Floats>(reinterpret_cast<Ints>(a) & (Ints{} + 0x7FFFFFFF));
    }
    static Floats minimum(Floats a, Floats b) { return b < a ? b : a; }
    static Floats maximum(Floats a, Floats b) { return a < b ? b : a; }
    static Floats clamp(Floats a, Floats low, Floats high) {
        return a < low ? low : (high < a ? high : a);
    }
};

struct EightLanes : WideGroups<8> {
    using UpToEight = EightLanes;
    using Shorts = std::int16_t __attribute__((vector_size(32)));
    using FourInts = std::int32_t __attribute__((vector_size(16)));
    static constexpr std::integral_constant<std::int32_t, 0> kFirstGroup{};

    template <class Body>
    static void each_group(const Body& body) {
        body(std::integral_constant<std::int32_t, 0>{});
        body(std::integral_constant<std::int32_t, 1>{});
    }
    static Floats all(float x) { return Floats{x, x, x, x, x, x, x, x}; }
    static Floats repeat(float a, float b, float c, float d) {
        return Floats{a, b, c, d, a, b, c, d};
    }
    static Floats load_some(const float* from, std::int32_t count) {
        Floats lanes{};
        __builtin_memcpy(&lanes, from, static_cast<std::size_t>(count) * sizeof *from);
        return lanes;
    }
    static Four load_four(const float* from) {
        Four lanes;
        __builtin_memcpy(&lanes, from, sizeof lanes);
        return lanes;
    }
    /// Two, and two that are 0.
    static Four load_two(const float* from) {
        using Halves = double __attribute__((vector_size(16)));
        double both;
        __builtin_memcpy(&both, from, sizeof both);
        return reinterpret_cast<Four>(Halves{both, 0.0});
    }
    /// In two loads. Each finds what it reads in one store; a load across the last two waits for
    /// both. (A compiler would make one load of two.) What is loaded twice side by side and blended
    /// takes no shuffle, for which, and for sums, processors have two places.
    static Four load_halves(const float* from) {
        struct Pair {
            float first, second;
        };
        Four low;
        Four high;
        __asm__("vmovq %1, %0" : "=x"(low) : "m"(*reinterpret_cast<const Pair*>(from)));
        __asm__("vmovddup %1, %0" : "=x"(high) : "m"(*reinterpret_cast<const Pair*>(from + 2)));
        return __builtin_ia32_blendps(low, high, 0xC);
    }
    static Floats one_a_group(const float* from) {
        const Four two = load_two(from);
        return __builtin_shufflevector(two, two, 0, 0, 0, 0, 1, 1, 1, 1);
    }
    struct Rows {
        Floats a;
        Floats b;
    };
    static Rows load_rows(const float* u, const float* v, const std::uint32_t* at) {
        const auto row = [&](std::int32_t k) {
            return __builtin_shufflevector(
                load_four(u + 2 * static_cast<std::size_t>(at[k])),
                load_four(v + 2 * static_cast<std::size_t>(at[2 + k])), 0, 1, 2, 3, 4, 5, 6, 7);
        };
        return {row(0), row(1)};
    }
    template <int G>
    static void add_rows(float* u, float* v, const Rows& rows) {
        const Floats sums = G == 0 ? rows.a : rows.b;
        add_group<0>(u, sums);
        add_group<1>(v, sums);
    }
    static void store_kinds(float* to, Floats u, Floats v) { store_in_turn(to, u, v); }
    static void store_kinds(std::uint32_t* to, Ints a) {
        __builtin_memcpy(to, &a, sizeof a);
    }
    static Floats ones_before_kinds(const float* from) {
        const Four two = load_four(from);
        const Floats lanes = __builtin_shufflevector(two, two, 0, 0, 0, 2, 0, 1, 0, 3);
        return __builtin_shufflevector(all(1.0F), lanes, 0, 9, 2, 11, 4, 13, 6, 15);
    }
    static Floats first_of_kinds(Floats a, Floats b) {
        const Floats v = second_groups(a, b);
        return __builtin_ia32_blendps256(first_groups(a, b), shuffle<0, 0, 2, 2>(v, v), 0xAA);
    }
    static Floats second_of_kinds(Floats a, Floats b) {
        const Floats u = first_groups(a, b);
        return __builtin_ia32_blendps256(shuffle<1, 1, 3, 3>(u, u), second_groups(a, b), 0xAA);
    }
    template <int G>
    static void add_group(float* to, Floats a) {
        const Four lanes = load_halves(to) + group<G>(a);
        __builtin_memcpy(to, &lanes, sizeof lanes);
    }
    static void store_halves(std::uint32_t* first, std::uint32_t* second, Ints a) {
        const Ints halves = __builtin_shufflevector(a, a, 0, 1, 4, 5, 2, 3, 6, 7);
        const FourInts low = __builtin_shufflevector(halves, halves, 0, 1, 2, 3);
        const FourInts high = __builtin_shufflevector(halves, halves, 4, 5, 6, 7);
        __builtin_memcpy(first, &low, sizeof low);
        __builtin_memcpy(second, &high, sizeof high);
    }
    static Floats first_groups(Floats a, Floats b) {
        return __builtin_shufflevector(a, b, 0, 1, 2, 3, 8, 9, 10, 11);
    }
    static Floats second_groups(Floats a, Floats b) {
        return __builtin_shufflevector(a, b, 4, 5, 6, 7, 12, 13, 14, 15);
    }
    static void store_in_turn(float* to, Floats a, Floats b) {
        store(to, first_groups(a, b));
        store(to + 8, second_groups(a, b));
    }
    /// Appends those of a set, the last one first: their numbers, from `first` on, and what
    /// `store_halves` would store of them. Returns how many. Writes eight of either.
    static std::int32_t append(std::uint32_t set, std::int32_t first, Ints a,
                               std::int32_t* number, std::uint32_t* value) {
        const Ints which = bytes(reinterpret_cast<const std::uint8_t*>(kLastFirst.of + set));
        store_whole(number, which + first);
        const Ints in_order = __builtin_shufflevector(a, a, 0, 1, 4, 5, 2, 3, 6, 7);
        const Ints chosen = __builtin_ia32_permvarsi256(in_order, which);
        __builtin_memcpy(value, &chosen, sizeof chosen);
        return __builtin_popcount(set);
    }
    /// Stores which of eight are in a set, from `first` on, the first one first. The set's lowest
    /// bit is for the last of them.
    static void store_set(std::uint32_t set, std::int32_t first, std::int32_t* number) {
        const Ints from_end = bytes(reinterpret_cast<const std::uint8_t*>(kLastFirst.of + set));
        store_whole(number, first + 7 - from_end);
    }
    /// Bytes at numbers that `sums_of_products` gave: a bit for each that is not 0, in the order of
    /// `store_halves`. Three bytes more than the last one are read. Mostly all are 0, which eight
    /// loads tell sooner than one of eight places.
    static std::uint32_t set_bytes(const std::uint8_t* bytes, Ints lanes) {
        std::uint32_t n[kLanes];
        __builtin_memcpy(n, &lanes, sizeof n);
        if ((bytes[n[0]] | bytes[n[1]] | bytes[n[2]] | bytes[n[3]] | bytes[n[4]] | bytes[n[5]] |
             bytes[n[6]] | bytes[n[7]]) == 0) {
            return 0;
        }
        const Ints at = __builtin_shufflevector(lanes, lanes, 0, 1, 4, 5, 2, 3, 6, 7);
        return bits_of(bytes_at(bytes, at) > 0);
    }
    static Ints look_up(const std::int32_t* table, const std::uint8_t* bytes,
                        const std::uint32_t* at) {
        return whole_at<4>(table, bytes_at(bytes, load_whole(at)));
    }
    struct Places {
        Floats x;
        Floats y;
    };
    static Places places_at(const float* pairs, const std::int32_t* at) {
        const Ints n = load_whole(at);
        return {floats_at<8>(pairs, n), floats_at<8>(pairs + 1, n)};
    }
    struct Squares {
        Floats low_left;
        Floats low_right;
        Floats high_left;
        Floats high_right;
    };
    template <class Place>
    static Squares squares_at(const float* low, const float* high, const Place* at) {
        const Ints n = load_whole(at);
        return {floats_at<4>(low, n), floats_at<4>(low + 1, n), floats_at<4>(high, n),
                floats_at<4>(high + 1, n)};
    }
    template <int I, int J, int K, int L>
    static Floats shuffle(Floats a, Floats b) {
        return __builtin_shufflevector(a, b, at<I>(0), at<J>(0), at<K>(0), at<L>(0), at<I>(4),
                                       at<J>(4), at<K>(4), at<L>(4));
    }
    static Floats in_order(Floats a) {
        return __builtin_shufflevector(a, a, 0, 4, 1, 5, 2, 6, 3, 7);
    }
    static Floats every_second(Floats a, Floats b) {
        return __builtin_shufflevector(a, b, 0, 2, 4, 6, 8, 10, 12, 14);
    }
    static Floats every_other(Floats a, Floats b) {
        return __builtin_shufflevector(a, b, 1, 3, 5, 7, 9, 11, 13, 15);
    }
    static Ints whole(Floats a) { return __builtin_convertvector(a, Ints); }
    static Floats floats(Ints a) { return __builtin_convertvector(a, Floats); }
    static Ints bytes(const std::uint8_t* from) {
#if defined(__clang__)
        return widened(from);
#else  // g++ would take each by itself
        using Words = long long __attribute__((vector_size(16)));
        using Bytes = char __attribute__((vector_size(16)));
        Words lanes{};
        __builtin_memcpy(&lanes, from, 8);
        return __builtin_ia32_pmovzxbd256(reinterpret_cast<Bytes>(lanes));
#endif
    }
    static void store_bytes(std::uint8_t* to, Ints lanes) { store_narrowed(to, lanes); }
    static Ints shorts(const std::uint16_t* from) { return widened(from); }
    static void store_shorts(std::uint16_t* to, Ints lanes) { store_narrowed(to, lanes); }
    template <class Small>
    static Ints widened(const Small* from) {
        typedef Small Few __attribute__((vector_size(8 * sizeof(Small))));
        Few lanes;
        __builtin_memcpy(&lanes, from, sizeof lanes);
        return __builtin_convertvector(lanes, Ints);
    }
    template <class Small>
    static void store_narrowed(Small* to, Ints lanes) {
        typedef Small Few __attribute__((vector_size(8 * sizeof(Small))));
        const auto some = __builtin_convertvector(lanes, Few);
        __builtin_memcpy(to, &some, sizeof some);
    }
    static Shorts pairs_of_shorts(std::int32_t first, std::int32_t second) {
        const auto a = static_cast<std::int16_t>(first);
        const auto b = static_cast<std::int16_t>(second);
        return Shorts{a, b, a, b, a, b, a, b, a, b, a, b, a, b, a, b};
    }
    static Ints sums_of_products(Ints a, Ints b, Shorts f) {
        return __builtin_ia32_pmaddwd256(__builtin_ia32_packssdw256(a, b), f);
    }
    /// Which sum `sums_of_products` has in a lane.
    static std::int32_t place_of_sum(std::int32_t lane) {
        return (lane & 1) | (lane & 2) << 1 | (lane & 4) >> 1;
    }
    struct Alternate {
        Floats even;  ///< 0, 2, 8, 10, 4, 6, 12, 14
        Floats odd;   ///< 1, 3, 9, 11, 5, 7, 13, 15
    };
    static Alternate load_alternate(const float* from) {
        const Floats a = load(from);
        const Floats b = load(from + 8);
        return {shuffle<0, 2, 4, 6>(a, b), shuffle<1, 3, 5, 7>(a, b)};
    }
    static void store_alternate(float* to, Floats even, Floats odd) {
        store(to, shuffle<0, 4, 1, 5>(even, odd));
        store(to + 8, shuffle<2, 6, 3, 7>(even, odd));
    }
    static Floats odd_before(Floats before, Floats odd) {
        return __builtin_shufflevector(before, odd, 7, 8, 13, 10, 9, 12, 11, 14);
    }
    static Ints alternate_from(std::int32_t k) { return Ints{0, 1, 4, 5, 2, 3, 6, 7} >= k; }
    static Floats square_root(Floats a) { return __builtin_ia32_sqrtps256(a); }
    static std::uint32_t signs(Floats a) {
        return static_cast<std::uint32_t>(__builtin_ia32_movmskps256(a));
    }
    static std::uint32_t bits_of(Ints mask) { return signs(reinterpret_cast<Floats>(mask)); }
    static Ints lanes_of(std::uint32_t bits) {
        return (Ints{1, 2, 4, 8, 16, 32, 64, 128} & static_cast<std::int32_t>(bits)) != 0;
    }
    static bool all_true(Ints mask) {
        return __builtin_ia32_vtestcps256(reinterpret_cast<Floats>(mask), true_lanes()) != 0;
    }
    static bool any_true(Ints mask) { return any_negative(reinterpret_cast<Floats>(mask)); }
    static bool any_negative(Floats a) {
        return __builtin_ia32_vtestzps256(a, true_lanes()) == 0;
    }

    struct Threes {
        Floats left;
        Floats middle;
        Floats right;
    };
    static Threes threes_at(const float* from, const std::int32_t* at) {
        const Ints n = load_whole(at);
        return {floats_at<4>(from - 1, n), floats_at<4>(from, n), floats_at<4>(from + 1, n)};
    }
    static Floats numbers_at(const float* from, Ints at) { return floats_at<4>(from, at); }
    /// Two bytes more than the last one are read.
    static Ints shorts_at(const std::uint16_t* from, Ints at) {
        return whole_at<2>(reinterpret_cast<const std::int32_t*>(from), at) & 0xFFFF;
    }
    template <class Number>
    static Ints load_whole(const Number* from) {
        Ints lanes;
        __builtin_memcpy(&lanes, from, sizeof lanes);
        return lanes;
    }
    static void store_whole(std::int32_t* to, Ints lanes) {
        __builtin_memcpy(to, &lanes, sizeof lanes);
    }

private:
    /// Numbers so many times `Bytes` bytes from an address.
    template <int Bytes>
    static Ints whole_at(const std::int32_t* from, Ints at) {
#if defined(__clang__)
        return __builtin_ia32_gatherd_d256(Ints{}, from, at, ~Ints{}, Bytes);
#else
        return __builtin_ia32_gathersiv8si(Ints{}, from, at, ~Ints{}, Bytes);
#endif
    }
    template <int Bytes>
    static Floats floats_at(const float* from, Ints at) {
#if defined(__clang__)
        return __builtin_ia32_gatherd_ps256(Floats{}, from, at, true_lanes(), Bytes);
#else
        return __builtin_ia32_gathersiv8sf(Floats{}, from, at, true_lanes(), Bytes);
#endif
    }
    static Ints bytes_at(const std::uint8_t* from, Ints at) {
        return whole_at<1>(reinterpret_cast<const std::int32_t*>(from), at) & 0xFF;
    }
    static Floats true_lanes() { return reinterpret_cast<Floats>(~Ints{}); }
    /// Of four from a and four from b to eight from each.
    template <int I>
    static constexpr int at(int group) {
        return (I & 3) + (I & 4) * 2 + group;
    }
};

}  // namespace

#endif

}  // namespace weir
