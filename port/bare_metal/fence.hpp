#pragma once

namespace port {

/// Let memory protection refuse everything but: code (read, run), RAM up to its limit (read,
/// write), devices. Accesses past the RAM limit, below the stack and through a null pointer then
/// are faults, also on boards whose memory repeats or swallows stores past its end. Does nothing
/// where the processor has none (ARMv6-M).
void raise_fence();

}  // namespace port
