// ticks() from CCOUNT, which counts cycles in 32 bits. How often it has begun again is known as
// long as it is read at least once in a round: as emulated, 3.3e9 instructions.
#include "port/port.hpp"

namespace port {
namespace {

std::uint32_t g_last = 0;
std::uint32_t g_rounds = 0;

}  // namespace

/// As emulated an instruction takes 2^5 ns (`run`), and a cycle 25: so each has a count of its own.
std::uint64_t ticks() {
  std::uint32_t count = 0;
  asm volatile("rsr.ccount %0" : "=r"(count));
  g_rounds += static_cast<std::uint32_t>(count < g_last);
  g_last = count;
  const std::uint64_t cycles = std::uint64_t{g_rounds} << 32 | count;
  return (cycles * 25 + 31) >> 5;
}

const char* tick_unit() { return "instructions"; }

}  // namespace port
