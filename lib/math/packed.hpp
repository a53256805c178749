// Arithmetic of packed numbers: that of the SmallFixed that each reads as.
#pragma once

#include "math/fixed.hpp"
#include "weir/storage.hpp"

namespace weir {

#define WEIR_OPERATOR(Result, op)                                                      \
    template <class A, int F, class B, int G>                                          \
    inline Result operator op(Packed<A, F> a, Packed<B, G> b) {                        \
        return static_cast<SmallFixed>(a) op static_cast<SmallFixed>(b);               \
    }                                                                                  \
    template <class A, int F>                                                          \
    inline Result operator op(Packed<A, F> a, SmallFixed b) {                          \
        return static_cast<SmallFixed>(a) op b;                                        \
    }                                                                                  \
    template <class A, int F>                                                          \
    inline Result operator op(SmallFixed a, Packed<A, F> b) {                          \
        return a op static_cast<SmallFixed>(b);                                        \
    }
WEIR_OPERATOR(SmallFixed, +)
WEIR_OPERATOR(SmallFixed, -)
WEIR_OPERATOR(SmallFixed, *)
WEIR_OPERATOR(SmallFixed, /)
WEIR_OPERATOR(bool, ==)
WEIR_OPERATOR(bool, !=)
WEIR_OPERATOR(bool, <)
WEIR_OPERATOR(bool, <=)
WEIR_OPERATOR(bool, >)
WEIR_OPERATOR(bool, >=)
#undef WEIR_OPERATOR

template <class A, int F>
constexpr bool is_finite(Packed<A, F>) {
    return true;
}
template <class A, int F>
inline SmallFixed operator-(Packed<A, F> a) {
    return -static_cast<SmallFixed>(a);
}
template <class A, int F, class B>
inline Packed<A, F>& operator+=(Packed<A, F>& a, B b) {
    return a = a + b;
}
template <class A, int F, class B>
inline Packed<A, F>& operator-=(Packed<A, F>& a, B b) {
    return a = a - b;
}

}  // namespace weir
