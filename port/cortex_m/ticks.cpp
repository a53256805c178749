// ticks() from two counters of one clock: the fine one counts, the coarse one says how often the
// fine one wrapped.
#include "board.hpp"
#include "port/port.hpp"
#include "timer.hpp"

namespace port {

std::uint64_t ticks() {
  const std::uint32_t fine = timer_fine();
  const std::uint64_t coarse = timer_coarse();
  const auto correction = static_cast<std::int32_t>(fine - static_cast<std::uint32_t>(coarse));
  const std::uint64_t count = coarse + static_cast<std::uint64_t>(std::int64_t{correction});
  return (count * board::kTickFactor + board::kTickRounding) >> board::kTickShift;
}

const char* tick_unit() { return board::kTickUnit; }

}  // namespace port
