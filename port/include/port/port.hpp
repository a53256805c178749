// The port: everything a program built on Weir needs from the machine it runs on. Weir itself needs
// one function of it, weir_fault; the rest serves the examples, the tests and the measurements.
//
// To port: copy port/template/port.cpp and fill in the bodies (port/README.md has the checklist).
// Every function says what it must do and what is lost if it does nothing, so a port can start with
// an empty body.
#pragma once

#include <cstddef>
#include <cstdint>

namespace port {

/// Make the machine ready: console, tick counter, file access. Call once, first thing in main().
/// Doing nothing is right where start-up code has done it already.
void init();

/// Write `bytes` characters to the console, in order, before returning (or in order with a later
/// exit()). `text` need not end in a zero. Doing nothing: the program runs mute, and no test can
/// pass.
void write(const char* text, std::size_t bytes);

/// End the program; an emulator or a host hands `code` (0..255) to its caller. 0 success, 1 failed
/// test, 3 assertion (weir_fault), 4 processor fault. On a device with nowhere to return to: stop
/// or restart. Must not return.
[[noreturn]] void exit(int code);

/// A count that only goes up, in tick_unit(), from an arbitrary start. Only differences mean
/// anything. Must be 64-bit: extend a narrow counter here, because one step may outlast its wrap.
/// Reading it should cost little and always the same. Returning 0: reports say 0 ticks, nothing
/// else changes.
std::uint64_t ticks();

/// What one tick is: "instructions", "cycles", "ns"; a static string, printed beside figures.
const char* tick_unit();

/// Wait until the next frame is due (display sync, timer, sleep). Returning at once: the program
/// runs as fast as it can, which is what the host and the emulated boards do.
void wait_for_tick();

/// Call task(context, k) for k = 0 … count − 1, on as many processors as set_threads() was last
/// told, the caller's included, and return when all are done: for weir::WorldDef::parallel_for. One
/// caller at a time. Calling them one after the other is right where there is one processor.
void parallel_for(void (*task)(void* context, std::int32_t k), void* context, std::int32_t count);
/// 1 … 64; 1 at the start. Doing nothing: one.
void set_threads(int threads);

/// Memory facts, in bytes; 0 means unknown, and reports leave the line out.
std::size_t stack_bytes();       ///< room set aside for the stack of main()
std::size_t stack_high_water();  ///< deepest use of that stack since reset
std::size_t code_bytes();        ///< read-only image: code, constants, initial values of data
std::size_t ram_bytes();         ///< static RAM in use: data, zeroed data, all stacks

/// Find `key=value` among the words of the command line and copy the value to out[0..size), cut if
/// it must be and always ended with a zero when size > 0. Returns the value's whole length; 0 when
/// the key is absent or its value empty (out is then "" ), so a result >= size means it was cut.
/// Always returning 0 (with out[0] = 0): programs run with their defaults.
std::size_t argument(const char* key, char* out, std::size_t size);

/// Write `bytes` of `data` to the file `name` on the development machine, after its present content
/// if `append`, otherwise in place of it. True if every byte was taken. Always false: nothing is
/// recorded.
bool file_write(const char* name, const void* data, std::size_t bytes, bool append);

}  // namespace port

/// The one function Weir calls upward: a programmer's error was found and going on would be wrong.
/// Must say where, and must not return. The ports here print `FAULT expression file:line` and
/// exit(3); a program may bring its own (log to flash, restart, light a lamp).
extern "C" [[noreturn]] void weir_fault(const char* expression, const char* file, int line);
