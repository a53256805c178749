// From reset to the first line of C++, and from an exception to its report. Compilers for Xtensa
// know no functions without a frame.
#include "start.hpp"

#include "fence.hpp"

/// First in the image, where the processor starts. VECBASE is set to that, too: each kind of
/// exception has its place behind it. Nothing here uses interrupts, so whatever arrives is a fault,
/// and nothing is returned to. The report is told main()'s stack pointer, and where the last call
/// was to return to, and has a stack of its own: what main()'s stack caused has somewhere to run.
asm(".section .vectors, \"ax\" \n"
    ".balign 256 \n"
    ".global port_reset \n"
    "port_reset: \n"
    "j port_start \n"
    ".org 0x20 \n"
    "j port_trap \n"  // not maskable
    ".org 0x30 \n"
    "j port_trap \n"  // of the kernel
    ".org 0x50 \n"
    "j port_trap \n"  // of users
    ".org 0x70 \n"
    "j port_trap \n"  // while one is answered
    ".balign 4 \n"
    ".literal_position \n"
    "port_trap: \n"
    "mov a2, a1 \n"
    "mov a3, a0 \n"
    "movi a1, port_handler_stack_top \n"
    "movi a4, port_report_fault \n"
    "jx a4 \n"
    ".balign 4 \n"
    ".literal_position \n"
    "port_start: \n"
    "movi a2, 15 \n"  // no interrupts; exceptions are answered one at a time
    "wsr.ps a2 \n"
    "movi a2, port_reset \n"
    "wsr.vecbase a2 \n"
    "rsync \n"
    "movi a1, port_handler_stack_top \n"
    "movi a2, port_prepare_memory \n"
    "callx0 a2 \n"
    "movi a1, port_stack_top \n"
    "movi a2, port_run \n"
    "jx a2 \n"
    ".text \n");

namespace port {

void prepare_processor() { raise_fence(); }

}  // namespace port
