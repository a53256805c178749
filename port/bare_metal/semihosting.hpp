// Semihosting: calls that the debugger or emulator answers (Arm, "Semihosting for AArch32 and
// AArch64"; RISC-V International, "RISC-V Semihosting", has the same calls).
#pragma once

#include <cstddef>
#include <cstdint>

namespace port::semihosting {

enum class Mode : std::uint32_t { kWriteBinary = 5, kAppendBinary = 9, kConsoleWrite = 4 };

/// A handle, or -1. ":tt" is the console.
int open(const char* name, Mode mode);

/// The number of bytes NOT written; 0 is success.
std::size_t write(int handle, const void* data, std::size_t bytes);

/// Later writes go after the file's present end. False if the file cannot tell its length.
bool seek_end(int handle);

bool close(int handle);

/// The command line, the image's name first, ended with a zero. False if it does not fit or there
/// is none.
bool command_line(char* out, std::size_t size);

[[noreturn]] void exit(int code);

}  // namespace port::semihosting
