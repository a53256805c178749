#include "semihosting.hpp"

namespace port::semihosting {
namespace {

enum class Call : std::uint32_t {
  kOpen = 0x01,
  kClose = 0x02,
  kWrite = 0x05,
  kSeek = 0x0A,
  kFileLength = 0x0C,
  kCommandLine = 0x15,
  kExit = 0x20,
};

/// Every call takes the address of a block of words and returns a word. The memory clobber makes
/// the compiler store the block, and what it points at, first.
std::uint32_t call(Call operation, const void* block) {
#if defined(__riscv)
  register std::uint32_t a0 asm("a0") = static_cast<std::uint32_t>(operation);
  register const void* a1 asm("a1") = block;
  // A breakpoint is a call if just these two stand around it, uncompressed and on one page.
  asm volatile(
      ".option push \n"
      ".option norvc \n"
      ".balign 16 \n"
      "slli zero, zero, 0x1f \n"
      "ebreak \n"
      "srai zero, zero, 7 \n"
      ".option pop \n"
      : "+r"(a0)
      : "r"(a1)
      : "memory");
  return a0;
#else
  register std::uint32_t r0 asm("r0") = static_cast<std::uint32_t>(operation);
  register const void* r1 asm("r1") = block;
  asm volatile("bkpt 0xAB" : "+r"(r0) : "r"(r1) : "memory");
  return r0;
#endif
}

std::uint32_t word_of(const void* pointer) {
  return static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(pointer));
}

}  // namespace

int open(const char* name, Mode mode) {
  std::uint32_t length = 0;
  while (name[length] != '\0') ++length;
  const std::uint32_t block[] = {word_of(name), static_cast<std::uint32_t>(mode), length};
  return static_cast<int>(call(Call::kOpen, block));
}

std::size_t write(int handle, const void* data, std::size_t bytes) {
  const std::uint32_t block[] = {static_cast<std::uint32_t>(handle), word_of(data), bytes};
  return call(Call::kWrite, block);
}

bool seek_end(int handle) {
  const std::uint32_t file[] = {static_cast<std::uint32_t>(handle)};
  const std::uint32_t length = call(Call::kFileLength, file);
  const std::uint32_t block[] = {static_cast<std::uint32_t>(handle), length};
  return static_cast<std::int32_t>(length) >= 0 && call(Call::kSeek, block) == 0;
}

bool close(int handle) {
  const std::uint32_t block[] = {static_cast<std::uint32_t>(handle)};
  return call(Call::kClose, block) == 0;
}

bool command_line(char* out, std::size_t size) {
  const std::uint32_t block[] = {word_of(out), size};
  return call(Call::kCommandLine, block) == 0;
}

void exit(int code) {
  constexpr std::uint32_t kApplicationExit = 0x20026;
  const std::uint32_t block[] = {kApplicationExit, static_cast<std::uint32_t>(code)};
  call(Call::kExit, block);
  for (;;) asm volatile("");
}

}  // namespace port::semihosting
