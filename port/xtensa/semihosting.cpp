// Xtensa's own calls (`simcall`), which its simulators and QEMU answer.
#include "semihosting.hpp"

namespace port::semihosting {
namespace {

enum class Call : std::uint32_t {
  kExit = 1,
  kWrite = 4,
  kOpen = 5,
  kClose = 6,
  kSeek = 19,
  kArgumentCount = 1000,
  kArgumentBytes = 1001,
  kArguments = 1002,
};

std::uint32_t call(Call operation, std::uint32_t first = 0, std::uint32_t second = 0,
                   std::uint32_t third = 0) {
  register std::uint32_t a2 asm("a2") = static_cast<std::uint32_t>(operation);
  register std::uint32_t a3 asm("a3") = first;
  register std::uint32_t a4 asm("a4") = second;
  register std::uint32_t a5 asm("a5") = third;
  asm volatile("simcall" : "+r"(a2), "+r"(a3) : "r"(a4), "r"(a5) : "memory");
  return a2;
}

std::uint32_t word_of(const void* pointer) {
  return static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(pointer));
}

}  // namespace

/// The console is open. Flags are those of Linux, which QEMU hands on.
int open(const char* name, Mode mode) {
  if (mode == Mode::kConsoleWrite) return 1;
  constexpr std::uint32_t kWriteOnly = 1, kCreate = 0100, kTruncate = 01000, kAppend = 02000;
  const std::uint32_t begin = mode == Mode::kAppendBinary ? kAppend : kTruncate;
  return static_cast<int>(call(Call::kOpen, word_of(name), kWriteOnly | kCreate | begin, 0666));
}

std::size_t write(int handle, const void* data, std::size_t bytes) {
  const auto written = static_cast<std::int32_t>(
      call(Call::kWrite, static_cast<std::uint32_t>(handle), word_of(data), bytes));
  return written < 0 ? bytes : bytes - static_cast<std::size_t>(written);
}

bool seek_end(int handle) {
  constexpr std::uint32_t kFromEnd = 2;
  return static_cast<std::int32_t>(
             call(Call::kSeek, static_cast<std::uint32_t>(handle), 0, kFromEnd)) >= 0;
}

bool close(int handle) { return call(Call::kClose, static_cast<std::uint32_t>(handle)) == 0; }

/// What comes is a pointer to each word, a null pointer, and the words, each ended with a zero.
bool command_line(char* out, std::size_t size) {
  const std::uint32_t bytes = call(Call::kArgumentBytes);
  const std::uint32_t words = call(Call::kArgumentCount);
  const std::uint32_t pointers = (words + 1) * sizeof(char*);
  if (words == 0 || bytes > size) return false;
  call(Call::kArguments, word_of(out));
  const std::uint32_t length = bytes - pointers;
  for (std::uint32_t k = 0; k < length; ++k) {
    const char character = out[pointers + k];
    out[k] = character != '\0' ? character : ' ';
  }
  out[length - 1] = '\0';
  return true;
}

void exit(int code) {
  call(Call::kExit, static_cast<std::uint32_t>(code));
  for (;;) asm volatile("");
}

}  // namespace port::semihosting
