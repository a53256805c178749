// Arm CMSDK dual timer: its first counter at the clock (fine), its second at the clock / 256
// (coarse). Together 2^40 counts. Both count down.
#include "board.hpp"
#include "symbols.hpp"
#include "timer.hpp"

namespace port {
namespace {
constexpr std::uintptr_t kSecond = 0x20;
constexpr std::uintptr_t kLoad = 0x00, kValue = 0x04, kControl = 0x08;
constexpr std::uint32_t kEnable = 1u << 7, kPeriodic = 1u << 6, kDivideBy256 = 2u << 2,
                        k32Bit = 1u << 1;
}  // namespace

void start_timer() {
  word_at(board::kTimer + kSecond + kLoad) = 0xFFFFFFFFu;
  word_at(board::kTimer + kSecond + kControl) = kEnable | kPeriodic | kDivideBy256 | k32Bit;
  word_at(board::kTimer + kLoad) = 0xFFFFFFFFu;
  word_at(board::kTimer + kControl) = kEnable | kPeriodic | k32Bit;
}

std::uint32_t timer_fine() { return ~word_at(board::kTimer + kValue); }
std::uint64_t timer_coarse() {
  return std::uint64_t{~word_at(board::kTimer + kSecond + kValue)} << 8;
}

}  // namespace port
