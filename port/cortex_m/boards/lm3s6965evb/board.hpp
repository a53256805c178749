// lm3s6965evb: Stellaris LM3S6965, Cortex-M3. QEMU does not let its timers be read: nothing is
// counted.
#pragma once

#include <cstdint>

namespace port::board {

constexpr const char* kTickUnit = "uncounted";
constexpr std::uint64_t kTickFactor = 1;
constexpr unsigned kTickShift = 0;
constexpr std::uint64_t kTickRounding = 0;

}  // namespace port::board
