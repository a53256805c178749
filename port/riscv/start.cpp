// From reset to the first line of C++, and from a trap to its report.
#include "start.hpp"

#include "fence.hpp"
#include "symbols.hpp"

extern "C" {

/// Where the processor starts: first in the image. mscratch keeps the top of the handlers' stack,
/// which a trap changes its own for: one that main()'s stack caused has somewhere to run. An FPU is
/// off until it is asked for; fcsr = 0 rounds to nearest, which the same-bits promise needs.
[[gnu::section(".vectors"), gnu::naked, gnu::used]] void port_reset() {
  asm volatile(
      ".option push \n"
      ".option norelax \n"  // this is what relaxed addresses are relative to
      "la gp, __global_pointer$ \n"
      ".option pop \n"
#if defined(__riscv_flen)
      "li t0, 0x6000 \n"  // mstatus.FS
      "csrs mstatus, t0 \n"
      "fscsr zero \n"
#endif
      "la sp, port_handler_stack_top \n"
      "csrw mscratch, sp \n"
      "la t0, port_trap \n"
      "csrw mtvec, t0 \n"
      "call port_prepare_memory \n"
      "la sp, port_stack_top \n"
      "tail port_run \n");
}

/// Nothing here uses interrupts: whatever arrives is a fault, and nothing is returned to.
[[gnu::naked, gnu::used, gnu::aligned(4)]] void port_trap() {
  asm volatile(
      "csrrw sp, mscratch, sp \n"
      "csrr a0, mscratch \n"
      "mv a1, ra \n"
      "tail port_report_fault \n");
}

}  // extern "C"

namespace port {

void prepare_processor() { raise_fence(); }

}  // namespace port
