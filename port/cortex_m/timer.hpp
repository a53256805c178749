// What a board's timer must give (timers/*.cpp): two free-running counters of one clock.
#pragma once

#include <cstdint>

namespace port {

/// Start both counters. Called once, from the start-up code.
void start_timer();

/// The fine counter: all 32 bits, upwards, wraps.
std::uint32_t timer_fine();

/// The same count from a prescaled counter, in units of the fine one. It may be off by up to 2^30:
/// only how often the fine counter wrapped is taken from it.
std::uint64_t timer_coarse();

}  // namespace port
