// The port's own test: ticks repeat exactly, arguments arrive, files are written, memory facts make
// sense, the FPU and the memory functions work. Prints one line a check and "PORT OK" at the end.
// Wants the words `name=abc long=0123456789ab`; where no words arrive, as on a board without
// semihosting, it says so and passes over what it asks of them.
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "port/port.hpp"
#include "port/print.hpp"

namespace {

/// There is no strcmp without libc.
bool equal(const char* a, const char* b) {
  while (*a != '\0' && *a == *b) ++a, ++b;
  return *a == *b;
}

bool g_ok = true;

void check(bool good, const char* what) {
  port::print(good ? "ok   " : "FAIL ", what, "\n");
  g_ok = g_ok && good;
}

/// A loop the compiler must run in full.
[[gnu::noinline]] std::uint32_t known_work(std::uint32_t turns) {
  volatile std::uint32_t sum = 0;
  for (std::uint32_t i = 0; i < turns; ++i) sum = sum + i;
  return sum;
}

[[gnu::noinline]] std::uint64_t ticks_of(std::uint32_t turns) {
  const std::uint64_t start = port::ticks();
  known_work(turns);
  return port::ticks() - start;
}

/// The fewest ticks of a few runs: on a clock of real time a single run may have been interrupted.
std::uint64_t fewest_ticks_of(std::uint32_t turns) {
  std::uint64_t fewest = ticks_of(turns);
  for (int run = 1; run < 50; ++run) {
    const std::uint64_t now = ticks_of(turns);
    if (now < fewest) fewest = now;
  }
  return fewest;
}

/// The difference between two lengths frees the figure of the cost of reading the counter.
void check_ticks() {
  const std::uint64_t first = ticks_of(1000);
  const std::uint64_t second = ticks_of(1000);
  const std::uint64_t longer = ticks_of(3000);
  const std::uint64_t longest = ticks_of(5000);
  port::print("ticks ", first, " ", second, " ", longer, " ", longest, " ", port::tick_unit(),
              "\n");
  check(fewest_ticks_of(5000) > fewest_ticks_of(1000), "ticks grow with the work");
  if (equal(port::tick_unit(), "instructions")) {
    check(first == second, "equal work counts equal");
    check(longest - longer == longer - first, "counts are linear in the work");
  }
}

/// Past the wrap of a 32-bit counter (asked for by `wrap=1`: it takes seconds).
void check_wrap() {
  constexpr std::uint32_t kTurns = 100'000'000;
  const std::uint64_t per_turns = ticks_of(kTurns);
  const std::uint64_t start = port::ticks();
  std::uint64_t runs = 0;
  while (runs * per_turns <= std::uint64_t{1} << 32) {
    if (ticks_of(kTurns) != per_turns) check(false, "a count across a wrap");
    ++runs;
  }
  const std::uint64_t total = port::ticks() - start;
  port::print(runs, " times ", per_turns, " is ", total, "\n");
  check(total >= runs * per_turns && total < runs * per_turns + 10'000, "counts past 32 bits");
}

void check_arguments() {
  char text[8] = "unset";
  check(port::argument("nothing", text, sizeof text) == 0 && text[0] == '\0',
        "an absent argument is empty");
  if (port::argument("name", nullptr, 0) == 0 && port::argument("long", nullptr, 0) == 0) {
    port::print("skip arguments: none arrived of name=abc long=0123456789ab\n");
    return;
  }
  check(port::argument("name", text, sizeof text) == 3 && equal(text, "abc"), "name=abc");
  check(port::argument("ame", text, sizeof text) == 0, "a key is a whole word");
  check(port::argument("long", text, sizeof text) == 12 && equal(text, "0123456"),
        "a long value is cut");
  check(port::argument("name", nullptr, 0) == 3, "the length alone");
}

void check_file() {
  char name[128];
  if (port::argument("file", name, sizeof name) == 0) return;
  check(port::file_write(name, "one\n", 4, false), "a file is written");
  check(port::file_write(name, "two\n", 4, true), "a file is appended to");
  check(!port::file_write("/nowhere/at/all", "x", 1, false), "an impossible name is refused");
}

[[gnu::noinline]] void use_stack(std::size_t bytes) {
  [[maybe_unused]] volatile char room[1024];
  for (std::size_t i = 0; i < bytes; ++i) room[i] = 1;
}

void check_memory_facts() {
  if (port::stack_bytes() == 0) return;
  const std::size_t before = port::stack_high_water();
  use_stack(1024);
  const std::size_t after = port::stack_high_water();
  port::print("stack ", before, " then ", after, " of ", port::stack_bytes(), ", code ",
              port::code_bytes(), ", ram ", port::ram_bytes(), " bytes\n");
  check(before > 0 && after >= 1024 && after > before && after < port::stack_bytes(),
        "the stack's high water");
  check(port::ram_bytes() > port::stack_bytes() && port::code_bytes() > 1000, "code and ram");
}

std::uint32_t bits_of(float value) {
  std::uint32_t bits;
  std::memcpy(&bits, &value, sizeof bits);
  return bits;
}

void check_arithmetic() {
  volatile float one = 1.0f, three = 3.0f, tiny = 1e-38f, ten = 10.0f;
  const float third = one / three;
  check(bits_of(third) == 0x3EAAAAABu, "1/3 rounds to nearest");
  check(bits_of(tiny / ten) == 0x000AE398u, "denormals are kept");
  volatile std::uint64_t big = 0x123456789ABCDEF0u, divisor = 1'000'003u;
  check(big / divisor * divisor + big % divisor == big, "64-bit division links and works");
}

/// Against a plain byte loop, every alignment and length around a word, overlapping both ways.
void check_memory_functions() {
  unsigned char area[96], expected[96];
  bool copies = true, sets = true;
  for (std::size_t to = 0; to < 40; to += 3) {
    for (std::size_t from = 0; from < 40; ++from) {
      volatile std::size_t bytes = (to * 7 + from) % 48;
      for (std::size_t i = 0; i < sizeof area; ++i)
        area[i] = expected[i] = static_cast<unsigned char>(i * 5 + 1);
      for (std::size_t i = 0; i < bytes; ++i)
        expected[to + i] = static_cast<unsigned char>((from + i) * 5 + 1);
      std::memmove(area + to, area + from, bytes);
      copies = copies && std::memcmp(area, expected, sizeof area) == 0;
      std::memset(area + from, static_cast<int>(to), bytes);
      for (std::size_t i = 0; i < bytes; ++i) expected[from + i] = static_cast<unsigned char>(to);
      for (std::size_t i = 0; i < sizeof area; ++i) sets = sets && area[i] == expected[i];
    }
  }
  check(copies, "memmove, memcmp");
  check(sets, "memset");
  volatile unsigned char low = 1, high = 200;
  const unsigned char a[] = {low, high}, b[] = {low, low};
  check(std::memcmp(a, b, 2) > 0 && std::memcmp(b, a, 2) < 0 && std::memcmp(a, b, 1) == 0,
        "memcmp's order");
}

/// Data with a value, zeroed data, and an object whose constructor needs to run.
volatile int g_value = 42;
volatile int g_zero;
struct Constructed {
  Constructed() : value(g_value + 1) {}
  volatile int value;
} g_constructed;

void check_printing() {
  port::print("print ", 0, " ", -1, " ", INT64_MIN, " ", UINT64_MAX, " ", std::uint8_t{200}, " ",
              port::hex(std::uint32_t{0xBEEF}), '\n');
}

}  // namespace

int main() {
  port::init();
  port::write("hello\n", 6);
  check(g_value == 42 && g_zero == 0 && g_constructed.value == 43, "data is set up");
  check_printing();
  check_ticks();
  check_arguments();
  check_file();
  check_memory_facts();
  check_arithmetic();
  check_memory_functions();
  char wrap[2];
  if (port::argument("wrap", wrap, sizeof wrap) != 0) check_wrap();
  port::wait_for_tick();
  port::print(g_ok ? "PORT OK\n" : "PORT FAILED\n");
  return g_ok ? 0 : 1;
}
