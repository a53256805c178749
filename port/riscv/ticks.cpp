// ticks() from the counter of instructions that every processor has, by its architecture.
#include "port/port.hpp"

namespace port {

/// The counter's halves are read one after the other. If the upper one changed meanwhile, the lower
/// one has just begun again: 0 is right, and takes as long as any other answer.
std::uint64_t ticks() {
  std::uint32_t before = 0, low = 0, high = 0;
  asm volatile(
      "csrr %0, minstreth \n"
      "csrr %1, minstret \n"
      "csrr %2, minstreth \n"
      : "=r"(before), "=r"(low), "=r"(high));
  const std::uint32_t same = 0u - static_cast<std::uint32_t>(before == high);
  return std::uint64_t{high} << 32 | (low & same);
}

const char* tick_unit() { return "instructions"; }

}  // namespace port
