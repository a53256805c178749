// Goes wrong on purpose, in the way `fault=` asks for. Each must end as a named fault: if the line
// "survived" appears, or nothing does, a real program's mistake would have gone unseen.
#include <cstdint>

#include "port/port.hpp"
#include "port/print.hpp"

namespace {

/// There is no strcmp without libc.
bool equal(const char* a, const char* b) {
  while (*a != '\0' && *a == *b) ++a, ++b;
  return *a == *b;
}

bool asked(const char* kind) {
  char text[32];
  return port::argument("fault", text, sizeof text) != 0 && equal(text, kind);
}

/// Endless recursion that the compiler can neither see through nor turn into a loop.
[[gnu::noinline]] std::uint32_t deeper(volatile std::uint32_t* above) {
  volatile std::uint32_t frame[16] = {};
  frame[0] = *above + 1;
  volatile bool always = true;
  if (always) frame[1] = deeper(frame);
  return frame[0] + frame[1];
}

/// One frame far larger than any stack: it leaps over a guard zone that is only narrow.
[[gnu::noinline]] void leap() {
  [[maybe_unused]] volatile unsigned char frame[40000];
  frame[0] = 1;
}

std::uintptr_t address_argument(const char* key) {
  char text[16];
  port::argument(key, text, sizeof text);
  std::uintptr_t address = 0;
  for (const char* digit = text; *digit != '\0'; ++digit) {
    address = address * 16 +
              static_cast<std::uintptr_t>(*digit <= '9' ? *digit - '0' : *digit - 'a' + 10);
  }
  return address;
}

void go_wrong() {
  volatile std::uintptr_t null = 0;
  if (asked("assert")) weir_fault("1 == 2", "scene.cpp", 7);
  if (asked("exit")) port::exit(5);
  if (asked("stack")) {
    volatile std::uint32_t top = 0;
    deeper(&top);
  }
  if (asked("leap")) leap();
  if (asked("store"))
    *reinterpret_cast<volatile std::uint32_t*>(address_argument("at")) = 0x5A5A5A5Au;
  if (asked("null_read")) static_cast<void>(*reinterpret_cast<volatile std::uint32_t*>(null));
  if (asked("null_call")) reinterpret_cast<void (*)()>(null)();
#if defined(__arm__)
  if (asked("undefined")) asm volatile(".inst.n 0xde00");  // UDF #0
  constexpr std::uint16_t kReturn = 0x4770;                // bx lr
  constexpr std::uintptr_t kOfCode = 1;                    // Thumb
#elif defined(__XTENSA__)
  if (asked("undefined")) asm volatile("ill");
  constexpr std::uint16_t kReturn = 0xF00D;  // ret.n
  constexpr std::uintptr_t kOfCode = 0;
#else
#if defined(__riscv)
  if (asked("undefined")) asm volatile("unimp");
#endif
  constexpr std::uint16_t kReturn = 0x8082;  // ret, of RISC-V
  constexpr std::uintptr_t kOfCode = 0;
#endif
  if (asked("run_data")) {
    static std::uint16_t code[] = {kReturn, kReturn};
    reinterpret_cast<void (*)()>(reinterpret_cast<std::uintptr_t>(code) | kOfCode)();
  }
}

}  // namespace

int main() {
  port::init();
  go_wrong();
  port::print("survived\n");
  return 1;
}
