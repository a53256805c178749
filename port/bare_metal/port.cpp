// port.hpp, but for ticks, on any processor with a debugger or emulator that answers semihosting.
#include "port/port.hpp"

#include "port/print.hpp"
#include "semihosting.hpp"
#include "symbols.hpp"

namespace port {
namespace {

int g_console = 0;  // its handle + 1, so that a fault before data was set up finds it closed

/// Not on the stack, where it would be the high-water mark of small programs.
char g_command_line[512];

/// The value's first character if `word` reads `key=...`, else null.
const char* value_if(const char* word, const char* key) {
  while (*key != '\0' && *word == *key) ++word, ++key;
  return *key == '\0' && *word == '=' ? word + 1 : nullptr;
}

bool in_word(char character) { return character != '\0' && character != ' '; }

}  // namespace

void init() {}  // the start-up code has done it

void write(const char* text, std::size_t bytes) {
  if (g_console == 0) g_console = semihosting::open(":tt", semihosting::Mode::kConsoleWrite) + 1;
  semihosting::write(g_console - 1, text, bytes);
}

void exit(int code) { semihosting::exit(code); }

void wait_for_tick() {}

void parallel_for(void (*task)(void*, std::int32_t), void* context, std::int32_t count) {
  for (std::int32_t k = 0; k < count; ++k) task(context, k);
}
void set_threads(int) {}

std::size_t stack_bytes() { return value_of(port_stack_top) - value_of(port_stack_bottom); }

std::size_t stack_high_water() {
  const std::uint32_t* word = port_stack_bottom;
  while (word != port_stack_top && *word == kStackPaint) ++word;
  return value_of(port_stack_top) - value_of(word);
}

std::size_t code_bytes() { return value_of(::port_code_bytes); }
std::size_t ram_bytes() { return value_of(::port_ram_bytes); }

std::size_t argument(const char* key, char* out, std::size_t size) {
  if (size > 0) out[0] = '\0';
  if (!semihosting::command_line(g_command_line, sizeof g_command_line)) {
    weir_fault("command line shorter than 512 bytes", __FILE__, __LINE__);
  }
  const char* word = g_command_line;
  while (*word != '\0') {
    const char* value = value_if(word, key);
    if (value != nullptr) {
      std::size_t length = 0;
      for (; in_word(value[length]); ++length) {
        if (length + 1 < size) out[length] = value[length], out[length + 1] = '\0';
      }
      return length;
    }
    while (in_word(*word)) ++word;
    while (*word == ' ') ++word;
  }
  return 0;
}

bool file_write(const char* name, const void* data, std::size_t bytes, bool append) {
  const int handle = semihosting::open(
      name, append ? semihosting::Mode::kAppendBinary : semihosting::Mode::kWriteBinary);
  if (handle < 0) return false;
  // Some emulators (QEMU 7.2) open for appending and then write from the start.
  const bool placed = !append || semihosting::seek_end(handle);
  const bool whole = placed && semihosting::write(handle, data, bytes) == 0;
  return semihosting::close(handle) && whole;
}

}  // namespace port

extern "C" [[gnu::weak]] void weir_fault(const char* expression, const char* file, int line) {
  port::print("FAULT ", expression, ' ', file, ':', line, "\n");
  port::exit(3);
}
