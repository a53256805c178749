// Registers of the LM3S6965 and commands of the SSD0323.
#include "oled.hpp"

namespace oled {

namespace {

constexpr std::int32_t kWidth = 128;
constexpr std::int32_t kHeight = 64;
std::uint8_t g_pixels[kWidth * kHeight / 2];

void set(std::uintptr_t address, std::uint32_t value) {
    *reinterpret_cast<volatile std::uint32_t*>(address) = value;
}
std::uint32_t get(std::uintptr_t address) {
    return *reinterpret_cast<volatile std::uint32_t*>(address);
}

constexpr std::uintptr_t kSsi = 0x40008000;
constexpr std::uintptr_t kPortA = 0x40004000, kPortC = 0x40006000, kPortD = 0x40007000;
constexpr std::uintptr_t kDirection = 0x400, kAlternate = 0x420, kDigital = 0x51C;
constexpr std::uint32_t kBusy = 1U << 4U;

void send(std::uint32_t byte) {
    set(kSsi + 0x08, byte);
    while ((get(kSsi + 0x0C) & kBusy) != 0) {
    }
    get(kSsi + 0x08);
}

/// PC7 tells commands (0) from data.
void mode(bool data) { set(kPortC + 0x200, data ? 0x80 : 0); }

template <class... Bytes>
void command(Bytes... bytes) {
    mode(false);
    (send(bytes), ...);
}

}  // namespace

void start() {
    set(0x400FE108, 0xFFFF);  // clocks of the ports and of SSI0
    set(0x400FE104, 0x10);
    set(kPortC + kDirection, 0x80);
    set(kPortC + kDigital, 0x80);
    set(kPortD + kDirection, 1);  // PD0 keeps the SD card off the bus
    set(kPortD + kDigital, 1);
    set(kPortD + 0x004, 1);
    set(kPortA + kDirection, 0x08);  // PA3 selects the display, PA2, 4 and 5 are the bus
    set(kPortA + kDigital, 0x3C);
    set(kPortA + kAlternate, 0x34);
    set(kPortA + 0x020, 0);
    set(kSsi + 0x04, 0);
    set(kSsi + 0x00, 7);
    set(kSsi + 0x10, 2);
    set(kSsi + 0x04, 2);
    command(0xA0, 0x52, 0xA4, 0xAF);
}

void show(const weir::World<weir::SmallFixed>& world) {
    weir::Display display;
    display.width = kWidth;
    display.height = kHeight;
    display.pixels = g_pixels;
    const weir::ChangedRows rows = weir::draw(world, display);
    if (rows.first > rows.last) {
        return;
    }
    command(0x15, 0, 63, 0x75, static_cast<std::uint32_t>(rows.first),
            static_cast<std::uint32_t>(rows.last));
    mode(true);
    for (std::int32_t k = rows.first * kWidth / 2; k < (rows.last + 1) * kWidth / 2; ++k) {
        send(g_pixels[k]);
    }
}

}  // namespace oled
