// netduinoplus2: STM32F405, Cortex-M4F.
#pragma once

#include <cstdint>

namespace port::board {

constexpr std::uintptr_t kFineTimer = 0x40000000;         // TIM2
constexpr std::uintptr_t kCoarseTimer = 0x40000C00;       // TIM5
constexpr std::uintptr_t kTimerClockEnable = 0x40023840;  // RCC_APB1ENR
constexpr std::uint32_t kTimerClockBits = 1u << 0 | 1u << 3;

// 1 GHz in QEMU, and one instruction is 1 ns under -icount shift=0: a count is an instruction. On
// silicon the same timer counts its bus clock.
constexpr const char* kTickUnit = "instructions";
constexpr std::uint64_t kTickFactor = 1;
constexpr unsigned kTickShift = 0;
constexpr std::uint64_t kTickRounding = 0;

}  // namespace port::board
