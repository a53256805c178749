// Arrays in the caller's memory: a window of elements that may be written, and one numbered from
// elsewhere.
#pragma once

#include <cstdint>

namespace weir {

template <class T>
struct ArrayView {
    T* data = nullptr;
    std::int32_t size = 0;

    constexpr T& operator[](std::int32_t index) const { return data[index]; }
    constexpr T* begin() const { return data; }
    constexpr T* end() const { return data + size; }
    constexpr bool empty() const { return size == 0; }
};

/// Where an array would begin whose entry of that number is `first`. By integers: that may lie
/// outside of any array.
template <class T>
T* numbered_from(T* first, std::int32_t number) {
    const auto bytes = static_cast<std::intptr_t>(number) * static_cast<std::intptr_t>(sizeof(T));
    return reinterpret_cast<T*>(reinterpret_cast<std::uintptr_t>(first) -
                                static_cast<std::uintptr_t>(bytes));
}

}  // namespace weir
