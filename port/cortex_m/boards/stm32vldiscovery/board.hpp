// stm32vldiscovery: STM32F100, Cortex-M3. QEMU gives it no timer but SysTick: nothing is counted.
#pragma once

#include <cstdint>

namespace port::board {

constexpr const char* kTickUnit = "uncounted";
constexpr std::uint64_t kTickFactor = 1;
constexpr unsigned kTickShift = 0;
constexpr std::uint64_t kTickRounding = 0;

}  // namespace port::board
