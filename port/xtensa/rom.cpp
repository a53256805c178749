// What an ESP8266 has in its ROM, and Debian's libgcc for its processor therefore lacks: products
// and quotients of integers, floats. Firmware for the chip itself links the ROM's addresses instead
// of this file.
#include <cstring>

#include "soft_float.hpp"

namespace {

using port::Double;
using port::Single;

template <class To, class From>
To bits(From value) {
  static_assert(sizeof(To) == sizeof(From), "the same bits");
  To same;
  std::memcpy(&same, &value, sizeof same);
  return same;
}

std::uint32_t of(float value) { return bits<std::uint32_t>(value); }
std::uint64_t of(double value) { return bits<std::uint64_t>(value); }
float single_of(std::uint32_t value) { return bits<float>(value); }
double double_of(std::uint64_t value) { return bits<double>(value); }

template <class Word>
struct Quotient {
  Word whole = 0;
  Word rest = 0;
};

/// Digit by digit. By 0 all digits are ones.
template <class Word>
Quotient<Word> quotient(Word of, Word by) {
  Quotient<Word> found;
  for (int k = port::kWidth<Word> - 1; k >= 0; --k) {
    const bool carried = found.rest >> (port::kWidth<Word> - 1) != 0;
    found.rest = found.rest << 1 | (of >> k & 1);
    if (carried || found.rest >= by) {
      found.rest -= by;
      found.whole |= Word{1} << k;
    }
  }
  return found;
}

template <class Word, class Signed>
Word size_of(Signed value) {
  return value < 0 ? Word{0} - static_cast<Word>(value) : static_cast<Word>(value);
}

template <class Word, class Signed>
Signed signed_quotient(Signed of, Signed by) {
  const Word whole = quotient(size_of<Word>(of), size_of<Word>(by)).whole;
  return static_cast<Signed>((of < 0) != (by < 0) ? Word{0} - whole : whole);
}

}  // namespace

extern "C" {

std::uint64_t __muldi3(std::uint64_t a, std::uint64_t b) {
  const auto low_a = static_cast<std::uint32_t>(a), low_b = static_cast<std::uint32_t>(b);
  const auto high_a = static_cast<std::uint32_t>(a >> 32);
  const auto high_b = static_cast<std::uint32_t>(b >> 32);
  const port::Product<std::uint32_t> low = port::product(low_a, low_b);
  return std::uint64_t{low.high + low_a * high_b + high_a * low_b} << 32 | low.low;
}

std::uint32_t __udivsi3(std::uint32_t a, std::uint32_t b) { return quotient(a, b).whole; }
std::uint32_t __umodsi3(std::uint32_t a, std::uint32_t b) { return quotient(a, b).rest; }
std::uint64_t __udivdi3(std::uint64_t a, std::uint64_t b) { return quotient(a, b).whole; }
std::uint64_t __umoddi3(std::uint64_t a, std::uint64_t b) { return quotient(a, b).rest; }
std::int32_t __divsi3(std::int32_t a, std::int32_t b) {
  return signed_quotient<std::uint32_t>(a, b);
}
std::int64_t __divdi3(std::int64_t a, std::int64_t b) {
  return signed_quotient<std::uint64_t>(a, b);
}

float __addsf3(float a, float b) { return single_of(Single::sum(of(a), of(b))); }
float __subsf3(float a, float b) { return single_of(Single::sum(of(a), of(b) ^ Single::kSign)); }
float __mulsf3(float a, float b) { return single_of(Single::times(of(a), of(b))); }
float __floatsisf(std::int32_t a) {
  return single_of(Single::of_integer(a < 0 ? Single::kSign : 0, size_of<std::uint32_t>(a)));
}
float __floatunsisf(std::uint32_t a) { return single_of(Single::of_integer(0, a)); }

double __adddf3(double a, double b) { return double_of(Double::sum(of(a), of(b))); }
double __subdf3(double a, double b) { return double_of(Double::sum(of(a), of(b) ^ Double::kSign)); }
double __muldf3(double a, double b) { return double_of(Double::times(of(a), of(b))); }
double __divdf3(double a, double b) { return double_of(Double::over(of(a), of(b))); }
double __floatsidf(std::int32_t a) {
  return double_of(Double::of_integer(a < 0 ? Double::kSign : 0, size_of<std::uint32_t>(a)));
}
std::int32_t __fixdfsi(double a) { return Double::to_integer(of(a)); }
double __extendsfdf2(float a) {
  return double_of(Double::widened<std::uint32_t, 23>(of(a)));
}

}  // extern "C"
