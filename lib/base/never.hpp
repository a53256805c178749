#pragma once

namespace weir {

/// In place of a pointer to what a kind of world never has: null, and of no size. Whatever asks for
/// it is left out.
template <class T>
struct Never {
    constexpr Never() = default;
    constexpr Never(T*) {}  // NOLINT
    constexpr operator T*() const { return nullptr; }  // NOLINT
    constexpr T& operator*() const { return *static_cast<T*>(*this); }
    constexpr T* operator->() const { return nullptr; }
};

}  // namespace weir
