// A port to copy. It compiles, links and does nothing; port/port.hpp says what each function must
// do, the comments here say how that is usually done. Fill them in from the top: after write() and
// exit() a program can already tell what is wrong.
#include "port/port.hpp"

namespace port {

// Clocks, FPU, UART or debug channel, free-running timer.
void init() {}

// Polled UART, RTT, semihosting SYS_WRITE. Block rather than drop: tests compare what is printed.
void write(const char* /*text*/, std::size_t /*bytes*/) {}

// Flush the console, then semihosting SYS_EXIT_EXTENDED, a watchdog reset, or stop here.
volatile int exit_code;  // for a debugger to read
void exit(int code) {
  for (;;) exit_code = code;
}

// DWT CYCCNT, a 32-bit timer, SysTick: extended to 64 bits, e.g. with a second, prescaled timer.
std::uint64_t ticks() { return 0; }

const char* tick_unit() { return "none"; }

// Wait for display sync or a periodic timer (WFI until its flag is set).
void wait_for_tick() {}

// A second core: hand it the odd numbers.
void parallel_for(void (*task)(void*, std::int32_t), void* context, std::int32_t count) {
  for (std::int32_t k = 0; k < count; ++k) task(context, k);
}
void set_threads(int /*threads*/) {}

// Differences of linker-script symbols; the high water by filling the stack at reset and scanning
// it.
std::size_t stack_bytes() { return 0; }
std::size_t stack_high_water() { return 0; }
std::size_t code_bytes() { return 0; }
std::size_t ram_bytes() { return 0; }

// Words from the debugger, the boot loader or a settings page.
std::size_t argument(const char* /*key*/, char* out, std::size_t size) {
  if (size > 0) out[0] = '\0';
  return 0;
}

// Semihosting, an SD card, a flash file system.
bool file_write(const char*, const void* /*data*/, std::size_t /*bytes*/, bool /*append*/) {
  return false;
}

}  // namespace port

// Say where (write() is usable here), then never return.
extern "C" [[gnu::weak]] void weir_fault(const char*, const char* /*file*/, int /*line*/) {
  port::exit(3);
}
