// The four functions a freestanding compiler may call without being asked. Words where both ends
// are aligned alike, bytes elsewhere.
#include <cstddef>
#include <cstdint>

namespace {

using Word = std::uint32_t;
// Bytes are read as words here, which only a type that may alias anything is allowed to do.
using AliasWord [[gnu::may_alias]] = Word;
// What a processor loads and stores at once.
struct [[gnu::may_alias]] Four {
  Word word[4];
};

bool aligned(const void* a, const void* b) {
  return ((reinterpret_cast<std::uintptr_t>(a) | reinterpret_cast<std::uintptr_t>(b)) &
          (sizeof(Word) - 1)) == 0;
}

/// In ascending order, and nothing is written before it is read: right also for regions that
/// overlap, if `out` is below `in`. (So no __restrict here.)
void copy_forwards(unsigned char* out, const unsigned char* in, std::size_t bytes) {
  if (aligned(out, in)) {
    auto* out_four = reinterpret_cast<Four*>(out);
    auto* in_four = reinterpret_cast<const Four*>(in);
    for (; bytes >= sizeof(Four); bytes -= sizeof(Four)) *out_four++ = *in_four++;
    auto* out_word = reinterpret_cast<AliasWord*>(out_four);
    auto* in_word = reinterpret_cast<const AliasWord*>(in_four);
    for (; bytes >= sizeof(Word); bytes -= sizeof(Word)) *out_word++ = *in_word++;
    out = reinterpret_cast<unsigned char*>(out_word);
    in = reinterpret_cast<const unsigned char*>(in_word);
  }
  for (; bytes > 0; --bytes) *out++ = *in++;
}

/// Sets words, four at a time, and takes what it has set off `bytes`; returns the next one.
AliasWord* set_fours(AliasWord* out_word, Word pattern, std::size_t* left) {
  std::size_t bytes = *left;
#if defined(__arm__)
  // One store for four words, which compilers do not make of words that are alike.
  register Word a __asm__("r3") = pattern;
  register Word b __asm__("r4") = pattern;
  register Word c __asm__("r5") = pattern;
  register Word d __asm__("r6") = pattern;
  __asm__ volatile(
      ".syntax unified\n\t"
      "b 1f\n"
      "0:\n\t"
      "stmia %[out]!, {%[a], %[b], %[c], %[d]}\n"
      "1:\n\t"
      "subs %[bytes], %[bytes], #16\n\t"
      "bhs 0b\n\t"
      "adds %[bytes], %[bytes], #16\n\t"
      : [out] "+l"(out_word), [bytes] "+l"(bytes), [a] "+l"(a), [b] "+l"(b), [c] "+l"(c),
        [d] "+l"(d)
      :
      : "cc", "memory");
#else
  for (; bytes >= 4 * sizeof(Word); bytes -= 4 * sizeof(Word), out_word += 4) {
    out_word[0] = out_word[1] = out_word[2] = out_word[3] = pattern;
  }
#endif
  *left = bytes;
  return out_word;
}

}  // namespace

extern "C" {

void* memcpy(void* __restrict to, const void* __restrict from, std::size_t bytes) {
  copy_forwards(static_cast<unsigned char*>(to), static_cast<const unsigned char*>(from), bytes);
  return to;
}

void* memmove(void* to, const void* from, std::size_t bytes) {
  auto* out = static_cast<unsigned char*>(to);
  auto* in = static_cast<const unsigned char*>(from);
  // One unsigned comparison for "out starts inside [in, in + bytes)": then copy from the end.
  if (reinterpret_cast<std::uintptr_t>(out) - reinterpret_cast<std::uintptr_t>(in) < bytes) {
    for (std::size_t i = bytes; i-- > 0;) out[i] = in[i];
  } else {
    copy_forwards(out, in, bytes);
  }
  return to;
}

void* memset(void* to, int value, std::size_t bytes) {
  auto* out = static_cast<unsigned char*>(to);
  const auto byte = static_cast<unsigned char>(value);
  if (aligned(out, out)) {
    const Word pattern = byte * Word{0x01010101u};
    auto* out_word = reinterpret_cast<AliasWord*>(out);
    out_word = set_fours(out_word, pattern, &bytes);
    for (; bytes >= sizeof(Word); bytes -= sizeof(Word)) *out_word++ = pattern;
    out = reinterpret_cast<unsigned char*>(out_word);
  }
  for (; bytes > 0; --bytes) *out++ = byte;
  return to;
}

int memcmp(const void* left, const void* right, std::size_t bytes) {
  auto* a = static_cast<const unsigned char*>(left);
  auto* b = static_cast<const unsigned char*>(right);
  for (; bytes > 0; --bytes, ++a, ++b) {
    if (*a != *b) return *a < *b ? -1 : 1;
  }
  return 0;
}

}  // extern "C"
