#pragma once

namespace port {

/// Let the MPU refuse everything but: code (read, run), RAM up to its limit (read, write), devices,
/// and make page zero unreadable where code lies there. Accesses past the RAM limit, below the
/// stack and through a null pointer become MemManage faults, also on boards whose memory repeats or
/// swallows stores past its end. Does nothing on ARMv6-M (no MPU).
void raise_fence();

}  // namespace port
