// Floats in software (IEEE 754: nearest, ties to even, with denormals), in integers of their size.
#pragma once

#include <cstdint>

namespace port {

template <class Word>
constexpr int kWidth = static_cast<int>(sizeof(Word)) * 8;

template <class Word>
struct Product {
  Word high;
  Word low;
};

/// Of two words, from products of their halves.
template <class Word>
Product<Word> product(Word a, Word b) {
  constexpr int kHalf = kWidth<Word> / 2;
  constexpr Word kMask = (Word{1} << kHalf) - 1;
  const Word low = (a & kMask) * (b & kMask);
  const Word first = (a >> kHalf) * (b & kMask) + (low >> kHalf);
  const Word second = (a & kMask) * (b >> kHalf) + (first & kMask);
  return {(a >> kHalf) * (b >> kHalf) + (first >> kHalf) + (second >> kHalf),
          second << kHalf | (low & kMask)};
}

/// A float's numbers: sign, exponent, and a fraction of so many bits whose leading one is not kept.
template <class Word, int kFraction>
class SoftFloat {
public:
  static constexpr Word kSign = Word{1} << (kWidth<Word> - 1);

  static Word sum(Word a, Word b) {
    if (special(a) || special(b)) {
      const bool torn = infinite(a) && infinite(b) && a != b;
      return nan(a) || nan(b) || torn ? kNan : special(a) ? a : b;
    }
    Parts x = parts(a), y = parts(b);
    if (x.exponent < y.exponent) {
      const Parts z = x;
      x = y, y = z;
    }
    const Word more = x.digits << kExtra;
    const Word less = shifted(y.digits << kExtra, x.exponent - y.exponent);
    if (x.sign == y.sign) return packed(x.sign, x.exponent, more + less);
    if (more == less) return 0;
    return more > less ? packed(x.sign, x.exponent, more - less)
                       : packed(y.sign, x.exponent, less - more);
  }

  static Word times(Word a, Word b) {
    const Word sign = (a ^ b) & kSign;
    if (special(a) || special(b)) {
      return nan(a) || nan(b) || zero(a) || zero(b) ? kNan : sign | kInfinity;
    }
    const Parts x = full(parts(a)), y = full(parts(b));
    const Product<Word> all = product(x.digits, y.digits);
    constexpr int kLess = kFraction - kExtra;
    const Word kept = all.high << (kWidth<Word> - kLess) | shifted(all.low, kLess);
    return packed(sign, x.exponent + y.exponent - kBias, kept);
  }

  static Word over(Word a, Word b) {
    const Word sign = (a ^ b) & kSign;
    if (nan(a) || nan(b) || (special(a) && special(b)) || (zero(a) && zero(b))) return kNan;
    if (special(a) || zero(b)) return sign | kInfinity;
    if (special(b) || zero(a)) return sign;
    const Parts x = full(parts(a)), y = full(parts(b));
    Word rest = x.digits, whole = 0;
    for (int k = 0; k <= kFraction + kExtra; ++k) {
      const bool fits = rest >= y.digits;
      whole = whole << 1 | static_cast<Word>(fits);
      rest = (fits ? rest - y.digits : rest) << 1;
    }
    return packed(sign, x.exponent - y.exponent + kBias, whole | static_cast<Word>(rest != 0));
  }

  static Word of_integer(Word sign, Word magnitude) {
    return packed(sign, kBias + kFraction + kExtra, magnitude);
  }

  /// Towards zero; what is too large becomes the largest.
  static std::int32_t to_integer(Word a) {
    const Parts x = parts(a);
    const int power = x.exponent - kBias;
    if (power < 0) return 0;
    if (power > 30) return x.sign != 0 ? INT32_MIN : INT32_MAX;
    const auto size = static_cast<std::int32_t>(x.digits >> (kFraction - power));
    return x.sign != 0 ? -size : size;
  }

  /// The same number of a narrower kind.
  template <class Narrow, int kFew>
  static Word widened(Narrow a) {
    using From = SoftFloat<Narrow, kFew>;
    const Word sign = static_cast<Word>(a & From::kSign) << (kWidth<Word> - kWidth<Narrow>);
    if (From::special(a)) return From::nan(a) ? kNan : sign | kInfinity;
    const typename From::Parts x = From::parts(a);
    return packed(sign, x.exponent - From::kBias + kBias,
                  static_cast<Word>(x.digits) << (kFraction - kFew + kExtra));
  }

private:
  template <class, int>
  friend class SoftFloat;

  static constexpr int kExtra = 3;  ///< digits more while a result is made: the last is sticky
  static constexpr int kMost = (1 << (kWidth<Word> - 1 - kFraction)) - 1;
  static constexpr int kBias = kMost / 2;
  static constexpr Word kOne = Word{1} << kFraction;
  static constexpr Word kInfinity = static_cast<Word>(kMost) << kFraction;
  static constexpr Word kNan = kInfinity | kOne >> 1;

  struct Parts {
    Word sign;
    int exponent;
    Word digits;  ///< with the leading one, but of denormals
  };

  static bool special(Word a) { return (a & kInfinity) == kInfinity; }
  static bool infinite(Word a) { return (a & ~kSign) == kInfinity; }
  static bool nan(Word a) { return (a & ~kSign) > kInfinity; }
  static bool zero(Word a) { return (a & ~kSign) == 0; }

  static Parts parts(Word a) {
    const int exponent = static_cast<int>((a & kInfinity) >> kFraction);
    const Word fraction = a & (kOne - 1);
    return {a & kSign, exponent > 0 ? exponent : 1, exponent > 0 ? fraction | kOne : fraction};
  }

  /// With a leading one, unless it is zero.
  static Parts full(Parts x) {
    for (; x.digits != 0 && x.digits < kOne; x.digits <<= 1) --x.exponent;
    return x;
  }

  /// To the right; the last digit tells of all that were lost.
  static Word shifted(Word digits, int places) {
    if (places == 0) return digits;
    if (places >= kWidth<Word>) return static_cast<Word>(digits != 0);
    return digits >> places | static_cast<Word>(digits << (kWidth<Word> - places) != 0);
  }

  static Word packed(Word sign, int exponent, Word digits) {
    if (digits == 0) return sign;
    for (; digits < kOne << kExtra && exponent > 1; digits <<= 1) --exponent;
    for (; digits >= kOne << (kExtra + 1); digits = shifted(digits, 1)) ++exponent;
    if (exponent < 1) {
      digits = shifted(digits, 1 - exponent);
      exponent = 1;
    }
    const Word odd = digits >> kExtra & 1;
    digits = (digits + (Word{1} << (kExtra - 1)) - 1 + odd) >> kExtra;
    if (digits >= kOne << 1) {
      digits >>= 1;
      ++exponent;
    }
    if (exponent >= kMost) return sign | kInfinity;
    // Of a denormal the exponent is 0, as its leading one is.
    return sign + (static_cast<Word>(exponent - 1) << kFraction) + digits;
  }
};

using Single = SoftFloat<std::uint32_t, 23>;
using Double = SoftFloat<std::uint64_t, 52>;

}  // namespace port
