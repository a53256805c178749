// The port to a hosted system: stdio, the steady clock, words of the command line or the
// environment.
#include "port/port.hpp"

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#ifdef _WIN32
#include <fcntl.h>
#include <io.h>
#endif

namespace port {
namespace {

/// Copy as port::argument promises.
std::size_t copy_value(const char* value, char* out, std::size_t size) {
  const std::size_t length = std::strlen(value);
  if (size > 0) {
    const std::size_t kept = length < size ? length : size - 1;
    std::memcpy(out, value, kept);
    out[kept] = '\0';
  }
  return length;
}

/// The words of the command line, each ended by a zero, on Linux and Windows; 0 bytes elsewhere.
/// Not taken from main(), which so looks the same on every port.
#ifdef _WIN32
std::size_t command_line(char* out, std::size_t size) {
  std::size_t bytes = 0;
  for (int k = 0; k < __argc && bytes + std::strlen(__argv[k]) < size; ++k) {
    bytes += copy_value(__argv[k], out + bytes, size - bytes) + 1;
  }
  return bytes;
}
#else
std::size_t command_line(char* out, std::size_t size) {
  std::FILE* file = std::fopen("/proc/self/cmdline", "rb");
  if (file == nullptr) return 0;
  const std::size_t bytes = std::fread(out, 1, size - 1, file);
  std::fclose(file);
  out[bytes] = '\0';
  return bytes;
}
#endif

}  // namespace

#ifdef _WIN32
/// Lines end as they are written.
void init() {
  _setmode(_fileno(stdout), _O_BINARY);
  _setmode(_fileno(stderr), _O_BINARY);
}
#else
void init() {}
#endif

void write(const char* text, std::size_t bytes) { std::fwrite(text, 1, bytes, stdout); }

void exit(int code) { std::exit(code); }

std::uint64_t ticks() {
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  return static_cast<std::uint64_t>(
      std::chrono::duration_cast<std::chrono::nanoseconds>(now).count());
}

const char* tick_unit() { return "ns"; }

void wait_for_tick() {}

std::size_t stack_bytes() { return 0; }
std::size_t stack_high_water() { return 0; }
std::size_t code_bytes() { return 0; }
std::size_t ram_bytes() { return 0; }

std::size_t argument(const char* key, char* out, std::size_t size) {
  static char words[8192];
  static const std::size_t bytes = command_line(words, sizeof words);
  const std::size_t key_length = std::strlen(key);
  for (std::size_t at = 0; at < bytes; at += std::strlen(words + at) + 1) {
    const char* word = words + at;
    if (std::strncmp(word, key, key_length) == 0 && word[key_length] == '=') {
      return copy_value(word + key_length + 1, out, size);
    }
  }
  const char* value = std::getenv(key);
  return copy_value(value != nullptr ? value : "", out, size);
}

bool file_write(const char* name, const void* data, std::size_t bytes, bool append) {
  std::FILE* file = std::fopen(name, append ? "ab" : "wb");
  if (file == nullptr) return false;
  const bool whole = std::fwrite(data, 1, bytes, file) == bytes;
  return std::fclose(file) == 0 && whole;
}

}  // namespace port
