// Sixteen floats side by side, for loops over cells and faces in files that are compiled for
// processors with AVX-512 (`..._widest.cpp`). Lane by lane as in math/lanes.hpp, and so with the
// same bits.
#pragma once

#include <cstdint>
#include <type_traits>

#include "math/eight_lanes.hpp"

namespace weir {

#if WEIR_HAS_WIDEST_LANES && defined(__AVX512F__) && defined(__AVX512DQ__)

// No other file may be given what is compiled here.
namespace {

struct SixteenLanes : WideGroups<16> {
    using UpToEight = EightLanes;

    template <class Body>
    static void each_group(const Body& body) {
        body(std::integral_constant<std::int32_t, 0>{});
        body(std::integral_constant<std::int32_t, 1>{});
        body(std::integral_constant<std::int32_t, 2>{});
        body(std::integral_constant<std::int32_t, 3>{});
    }
    static Floats all(float x) { return Floats{x, x, x, x, x, x, x, x, x, x, x, x, x, x, x, x}; }
    static Floats repeat(float a, float b, float c, float d) {
        return Floats{a, b, c, d, a, b, c, d, a, b, c, d, a, b, c, d};
    }
    static Floats one_a_group(const float* from) {
        Four four;
        __builtin_memcpy(&four, from, sizeof four);
        return __builtin_shufflevector(four, four, 0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3);
    }
    static void store_in_turn(float* to, Floats a, Floats b) {
        store(to, __builtin_shufflevector(a, b, 0, 1, 2, 3, 16, 17, 18, 19, 4, 5, 6, 7, 20, 21,
                                          22, 23));
        store(to + 16, __builtin_shufflevector(a, b, 8, 9, 10, 11, 24, 25, 26, 27, 12, 13, 14, 15,
                                               28, 29, 30, 31));
    }
    template <int I, int J, int K, int L>
    static Floats shuffle(Floats a, Floats b) {
        return __builtin_shufflevector(a, b, at<I>(0), at<J>(0), at<K>(0), at<L>(0), at<I>(4),
                                       at<J>(4), at<K>(4), at<L>(4), at<I>(8), at<J>(8), at<K>(8),
                                       at<L>(8), at<I>(12), at<J>(12), at<K>(12), at<L>(12));
    }
    static Floats every_second(Floats a, Floats b) {
        return __builtin_shufflevector(a, b, 0, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20, 22, 24, 26, 28,
                                       30);
    }
    static Floats every_other(Floats a, Floats b) {
        return __builtin_shufflevector(a, b, 1, 3, 5, 7, 9, 11, 13, 15, 17, 19, 21, 23, 25, 27, 29,
                                       31);
    }
    static Ints bytes(const std::uint8_t* from) {
        using Bytes = std::uint8_t __attribute__((vector_size(16)));
        Bytes lanes;
        __builtin_memcpy(&lanes, from, sizeof lanes);
        return __builtin_convertvector(lanes, Ints);
    }
    struct Alternate {
        Floats even;
        Floats odd;
    };
    static Alternate load_alternate(const float* from) {
        const Floats a = load(from);
        const Floats b = load(from + 16);
        return {every_second(a, b), every_other(a, b)};
    }
    static void store_alternate(float* to, Floats even, Floats odd) {
        store(to, __builtin_shufflevector(even, odd, 0, 16, 1, 17, 2, 18, 3, 19, 4, 20, 5, 21, 6,
                                          22, 7, 23));
        store(to + 16, __builtin_shufflevector(even, odd, 8, 24, 9, 25, 10, 26, 11, 27, 12, 28, 13,
                                               29, 14, 30, 15, 31));
    }
    static Floats odd_before(Floats before, Floats odd) {
        return __builtin_shufflevector(before, odd, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26,
                                       27, 28, 29, 30);
    }
    static Ints alternate_from(std::int32_t k) { return numbers() >= k; }
    static Floats square_root(Floats a) {
#if defined(__clang__)
        return __builtin_ia32_sqrtps512(a, 4);
#else
        return __builtin_ia32_sqrtps512_mask(a, Floats{}, -1, 4);
#endif
    }
    static std::uint32_t bits_of(Ints mask) {
        return static_cast<std::uint16_t>(__builtin_ia32_cvtd2mask512(mask));
    }
    static Ints lanes_of(std::uint32_t bits) {
        return __builtin_ia32_cvtmask2d512(static_cast<std::uint16_t>(bits));
    }
    static bool all_true(Ints mask) { return bits_of(mask) == 0xFFFFU; }
    static bool any_true(Ints mask) { return bits_of(mask) != 0; }
    static bool any_negative(Floats a) { return bits_of(reinterpret_cast<Ints>(a)) != 0; }

private:
    static Ints numbers() { return Ints{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15}; }
    /// Of four from a and four from b to sixteen from each.
    template <int I>
    static constexpr int at(int group) {
        return (I & 3) + (I & 4) * 4 + group;
    }
};

}  // namespace

#endif

}  // namespace weir
