// A window of elements that may be written, inside the caller's memory.
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

}  // namespace weir
