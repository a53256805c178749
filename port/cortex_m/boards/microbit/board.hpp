// microbit: nRF51822, Cortex-M0.
#pragma once

#include <cstdint>

namespace port::board {

constexpr std::uintptr_t kFineTimer = 0x40008000;    // TIMER0
constexpr std::uintptr_t kCoarseTimer = 0x40009000;  // TIMER1

// 16 MHz, and one instruction is 1024 ns under -icount shift=10: 2048 counts are 125 instructions.
// QEMU's timer gains up to half a nanosecond a read; rounding to the nearest hides it for the first
// 1000 reads, after which a difference may be off by one instruction.
constexpr const char* kTickUnit = "instructions";
constexpr std::uint64_t kTickFactor = 125;
constexpr unsigned kTickShift = 11;
constexpr std::uint64_t kTickRounding = 1u << (kTickShift - 1);

}  // namespace port::board
