// nRF51 TIMER0 at 16 MHz (fine) and TIMER1 at 16 MHz / 512 (coarse), both 32 bits wide. On silicon
// TIMER1 has only 16 bits: there the count ends after 2^25.
#include "board.hpp"
#include "symbols.hpp"
#include "timer.hpp"

namespace port {
namespace {
constexpr std::uintptr_t kStart = 0x000, kCapture = 0x040, kCaptured = 0x540;
constexpr std::uintptr_t kBitMode = 0x508, kPrescaler = 0x510;
constexpr std::uint32_t k32Bit = 3;

void start(std::uintptr_t timer, std::uint32_t prescaler) {
  word_at(timer + kBitMode) = k32Bit;
  word_at(timer + kPrescaler) = prescaler;
  word_at(timer + kStart) = 1;
}

std::uint32_t read(std::uintptr_t timer) {
  word_at(timer + kCapture) = 1;
  return word_at(timer + kCaptured);
}
}  // namespace

void start_timer() {
  start(board::kCoarseTimer, 9);
  start(board::kFineTimer, 0);
}

std::uint32_t timer_fine() { return read(board::kFineTimer); }
std::uint64_t timer_coarse() {
  return std::uint64_t{read(board::kCoarseTimer)} << 9;
}

}  // namespace port
