// mps2-an386: Arm MPS2 with a Cortex-M4F.
#pragma once

#include <cstdint>

namespace port::board {

constexpr std::uintptr_t kTimer = 0x40002000;  // dual timer

// 25 MHz, and one instruction is 64 ns under -icount shift=6: 8 counts are 5 instructions.
constexpr const char* kTickUnit = "instructions";
constexpr std::uint64_t kTickFactor = 5;
constexpr unsigned kTickShift = 3;
constexpr std::uint64_t kTickRounding = (1u << kTickShift) - 1u;  // up: a count is cut, not rounded

}  // namespace port::board
