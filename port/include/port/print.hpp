// print("x ", 12, " = ", hex(bits), "\n"): text and whole numbers to the port's console, without
// libc. There is no floating-point output: print hex(bits) of a float, or a scaled integer with its
// unit.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "port/port.hpp"

namespace port {

/// A number to be printed as 0x and `digits` (1..16) lower-case hexadecimal digits, leading zeros
/// kept.
struct Hex {
  std::uint64_t value;
  int digits;
};

/// The whole width of T: hex(std::uint32_t{10}) prints 0x0000000a.
template <class T>
constexpr Hex hex(T value) {
  static_assert(std::is_unsigned<T>::value, "hex() shows bits: pass an unsigned integer");
  return {value, static_cast<int>(sizeof(T) * 2)};
}

inline void print_one(const char* text) {
  std::size_t bytes = 0;
  while (text[bytes] != '\0') ++bytes;
  write(text, bytes);
}

inline void print_one(char character) { write(&character, 1); }

inline void print_one(Hex number) {
  char text[2 + 16] = {'0', 'x'};
  for (int i = 0; i < number.digits; ++i) {
    text[2 + i] = "0123456789abcdef"[(number.value >> (4 * (number.digits - 1 - i))) & 15u];
  }
  write(text, static_cast<std::size_t>(2 + number.digits));
}

inline void print_decimal(std::uint64_t magnitude, bool negative) {
  char text[1 + 20];  // a sign and the 20 digits of 2^64 - 1
  char* first = text + sizeof text;
  do {
    *--first = static_cast<char>('0' + magnitude % 10u);
    magnitude /= 10u;
  } while (magnitude != 0);
  if (negative) *--first = '-';
  write(first, static_cast<std::size_t>(text + sizeof text - first));
}

template <class T, std::enable_if_t<std::is_integral<T>::value, int> = 0>
void print_one(T number) {
  const auto bits = static_cast<std::uint64_t>(number);  // sign-extends
  const bool negative = std::is_signed<T>::value && number < T{0};
  print_decimal(negative ? 0u - bits : bits, negative);
}

/// Print every argument in turn: text, a character, an integer of any width, or hex(...).
template <class... Items>
void print(const Items&... items) {
  (print_one(items), ...);
}

}  // namespace port
