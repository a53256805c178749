// Vectors, and from reset to the first line of C++: FPU, and main() on a stack of its own.
#include "start.hpp"

#include "fence.hpp"
#include "symbols.hpp"
#include "timer.hpp"

extern "C" {

void port_reset();
void port_fault();

/// Sixteen words: the first stack pointer, reset, the processor's own exceptions. Nothing here uses
/// interrupts; a board that does appends its vectors.
[[gnu::section(".vectors"), gnu::used]] void* const port_vectors[16] = {
    port_handler_stack_top,
    reinterpret_cast<void*>(port_reset),
    reinterpret_cast<void*>(port_fault),  // NMI
    reinterpret_cast<void*>(port_fault),  // HardFault
    reinterpret_cast<void*>(port_fault),  // MemManage
    reinterpret_cast<void*>(port_fault),  // BusFault
    reinterpret_cast<void*>(port_fault),  // UsageFault
    reinterpret_cast<void*>(port_fault),  // SecureFault
    nullptr,
    nullptr,
    nullptr,
    reinterpret_cast<void*>(port_fault),  // SVCall
    reinterpret_cast<void*>(port_fault),  // DebugMonitor
    nullptr,
    reinterpret_cast<void*>(port_fault),  // PendSV
    reinterpret_cast<void*>(port_fault),  // SysTick
};

/// No compiled code runs before the FPU is on: at -O2 the compiler may use its registers to copy
/// memory. FPSCR = 0: denormals are kept and rounding is to nearest, which the same-bits promise
/// needs; but LTPSIZE stays, which loops of Armv8.1-M go by. main() runs on the process stack
/// (PSP), faults on the main stack (MSP), so that a fault caused by the former has somewhere to
/// run.
[[gnu::naked, gnu::used]] void port_reset() {
  asm volatile(
#if defined(__ARM_FP)
      "ldr r0, =0xE000ED88 \n"  // CPACR: full access to CP10 and CP11
      "ldr r1, [r0] \n"
      "orr r1, r1, #0xF00000 \n"
      "str r1, [r0] \n"
      "dsb \n"
      "isb \n"
      "vmrs r0, fpscr \n"
      "and r0, r0, #0x70000 \n"
      "vmsr fpscr, r0 \n"
#endif
      "ldr r0, =port_prepare_memory \n"
      "blx r0 \n"
      "ldr r0, =port_stack_top \n"
      "msr psp, r0 \n"
#if defined(__ARM_ARCH_8M_MAIN__)
      "ldr r0, =port_stack_bottom \n"
      "msr psplim, r0 \n"
      "ldr r0, =port_handler_stack_bottom \n"
      "msr msplim, r0 \n"
#endif
      "movs r0, #2 \n"  // SPSEL: thread mode uses PSP
      "msr control, r0 \n"
      "isb \n"
      "ldr r0, =port_run \n"
      "blx r0 \n"
      ".pool \n");
}

}  // extern "C"

namespace port {

void prepare_processor() {
#if __ARM_ARCH >= 7
  constexpr std::uintptr_t kVectorTable = 0xE000ED08, kHandlerControl = 0xE000ED24;
  word_at(kVectorTable) =
      static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(port_vectors));
  word_at(kHandlerControl) |= 0xFu << 16;  // each fault by its own name, not as HardFault
#endif
  raise_fence();
  start_timer();
}

}  // namespace port
