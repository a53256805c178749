#include "trap.hpp"

namespace port {
namespace {

/// The exceptions of the privileged architecture (table of mcause).
constexpr Cause kCauses[] = {{0, "InstructionMisaligned", "call to a damaged function pointer"},
                             {1, "InstructionAccess", kForbiddenCall},
                             {2, "IllegalInstruction", kUndefined},
                             {3, "Breakpoint", "processor fault"},
                             {4, "LoadMisaligned", kUnaligned},
                             {5, "LoadAccess", kForbidden},
                             {6, "StoreMisaligned", kUnaligned},
                             {7, "StoreAccess", kForbidden}};

}  // namespace
}  // namespace port

/// What port_trap found: main()'s stack pointer, and where the last call was to return to.
extern "C" [[gnu::used, noreturn]] void port_report_fault(std::uint32_t stack_pointer,
                                                          std::uint32_t return_address) {
  port::Trap trap;
  asm volatile("csrr %0, mcause" : "=r"(trap.number));
  asm volatile("csrr %0, mepc" : "=r"(trap.pc));
  asm volatile("csrr %0, mtval" : "=r"(trap.address));
  port::report(port::kCauses, trap, stack_pointer, return_address);
}
