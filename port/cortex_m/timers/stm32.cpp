// STM32 TIM2 (fine) and TIM5 with the largest prescaler (coarse). Together 2^48 counts.
#include "board.hpp"
#include "symbols.hpp"
#include "timer.hpp"

namespace port {
namespace {
constexpr std::uintptr_t kControl = 0x00, kEvent = 0x14, kCount = 0x24, kPrescaler = 0x28,
                         kReload = 0x2C;

void start(std::uintptr_t timer, std::uint32_t prescaler) {
  word_at(timer + kPrescaler) = prescaler;
  word_at(timer + kReload) = 0xFFFFFFFFu;
  word_at(timer + kEvent) = 1;  // load the prescaler now
  word_at(timer + kControl) = 1;
}
}  // namespace

void start_timer() {
  word_at(board::kTimerClockEnable) |= board::kTimerClockBits;
  start(board::kCoarseTimer, 0xFFFF);
  start(board::kFineTimer, 0);
}

std::uint32_t timer_fine() { return word_at(board::kFineTimer + kCount); }
std::uint64_t timer_coarse() {
  return std::uint64_t{word_at(board::kCoarseTimer + kCount)} << 16;
}

}  // namespace port
