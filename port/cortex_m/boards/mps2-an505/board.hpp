// mps2-an505: Arm MPS2 with a Cortex-M33, in the secure state.
#pragma once

#include <cstdint>

namespace port::board {

constexpr std::uintptr_t kTimer = 0x50002000;  // dual timer

// 20 MHz, and one instruction is 64 ns under -icount shift=6: 32 counts are 25 instructions.
constexpr const char* kTickUnit = "instructions";
constexpr std::uint64_t kTickFactor = 25;
constexpr unsigned kTickShift = 5;
constexpr std::uint64_t kTickRounding = (1u << kTickShift) - 1u;  // up: a count is cut, not rounded

}  // namespace port::board
