// Runs a microbit image and counts cycles, by the manual of the Cortex-M0 (ARM DDI 0432C, 3.3; flash
// without wait states, a multiplier of one cycle): its timers go by cycles, so that what an image
// prints as ticks are cycles, where an emulated board prints instructions.
//
//   cycles_m0 IMAGE.elf      the image's console on stdout
#include <elf.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <vector>

namespace {

using Word = std::uint32_t;

constexpr Word kRam = 0x20000000;
constexpr Word kRamBytes = 16 * 1024;
constexpr Word kPeripherals = 0x40000000;

[[noreturn]] void stop(const char* what, Word at) {
    std::fprintf(stderr, "cycles_m0: %s %08x\n", what, at);
    std::exit(2);
}

class Chip {
public:
    explicit Chip(const std::vector<char>& image) : code_(256 * 1024), ram_(kRamBytes) {
        Elf32_Ehdr head;
        std::memcpy(&head, image.data(), sizeof head);
        for (int k = 0; k < head.e_phnum; ++k) {
            Elf32_Phdr part;
            std::memcpy(&part, image.data() + head.e_phoff + k * sizeof part, sizeof part);
            if (part.p_type == PT_LOAD && part.p_filesz > 0) {
                std::memcpy(code_.data() + part.p_paddr, image.data() + part.p_offset,
                            part.p_filesz);
            }
        }
        r_[13] = main_stack_ = load(0, 4);
        r_[15] = load(4, 4) & ~1U;
    }

    /// Until the image exits, with its code.
    int run() {
        while (!done_) {
            step();
        }
        return exit_code_;
    }

private:
    Word load(Word at, Word bytes) const {
        Word value = 0;
        if (at % bytes != 0) {
            stop("unaligned", at);
        }
        if (at < code_.size()) {
            std::memcpy(&value, code_.data() + at, bytes);
        } else if (at - kRam < kRamBytes) {
            std::memcpy(&value, ram_.data() + (at - kRam), bytes);
        } else if (at >= kPeripherals) {
            // 125 ticks are 2048 counts of the timers, as instructions are on the emulated board.
            const std::uint64_t count = cycles_ * 2048 / 125;
            value = static_cast<Word>((at & 0x1000U) != 0 ? count >> 9U : count);
        } else {
            stop("no memory", at);
        }
        return value;
    }
    void store(Word at, Word bytes, Word value) {
        if (at % bytes != 0) {
            stop("unaligned", at);
        }
        if (at - kRam < kRamBytes) {
            std::memcpy(ram_.data() + (at - kRam), &value, bytes);
        } else if (at < kPeripherals) {
            stop("no memory", at);
        }
    }

    void flags_of(Word value) {
        negative_ = (value >> 31U) != 0;
        zero_ = value == 0;
    }
    Word sum(Word a, Word b, Word carry) {
        const std::uint64_t all = std::uint64_t{a} + b + carry;
        const auto value = static_cast<Word>(all);
        carry_ = (all >> 32U) != 0;
        overflow_ = ((~(a ^ b) & (a ^ value)) >> 31U) != 0;
        flags_of(value);
        return value;
    }
    Word difference(Word a, Word b) { return sum(a, ~b, 1); }
    /// kind: left, right, right with sign, around.
    Word shifted(Word value, Word kind, Word by) {
        const auto bit = [&](Word k) { return ((value >> k) & 1U) != 0; };
        const auto with_sign = static_cast<std::int32_t>(value);
        if (by != 0) {
            switch (kind) {
                case 0:
                    carry_ = by <= 32 && bit(32 - by);
                    value = by < 32 ? value << by : 0;
                    break;
                case 1:
                    carry_ = by <= 32 && bit(by - 1);
                    value = by < 32 ? value >> by : 0;
                    break;
                case 2:
                    carry_ = bit(by < 32 ? by - 1 : 31);
                    value = static_cast<Word>(with_sign >> (by < 32 ? by : 31));
                    break;
                default:
                    value = (by & 31U) != 0 ? value >> (by & 31U) | value << (32 - (by & 31U))
                                            : value;
                    carry_ = (value >> 31U) != 0;
            }
        }
        flags_of(value);
        return value;
    }

    Word get(Word reg) const { return reg == 15 ? r_[15] + 4 : r_[reg]; }
    void branch(Word to, int cycles) {
        next_ = to & ~1U;
        cost_ = cycles;
    }

    bool holds(Word condition) const {
        const bool pairs[] = {zero_, carry_, negative_, overflow_, carry_ && !zero_,
                              negative_ == overflow_, !zero_ && negative_ == overflow_};
        return pairs[condition >> 1U] == ((condition & 1U) == 0);
    }

    void data(Word op) {  // 010000: both operands in registers
        Word& d = r_[op & 7U];
        const Word m = r_[(op >> 3U) & 7U];
        switch ((op >> 6U) & 15U) {
            case 0: flags_of(d &= m); break;
            case 1: flags_of(d ^= m); break;
            case 2: d = shifted(d, 0, m & 255U); break;
            case 3: d = shifted(d, 1, m & 255U); break;
            case 4: d = shifted(d, 2, m & 255U); break;
            case 5: d = sum(d, m, carry_ ? 1 : 0); break;
            case 6: d = sum(d, ~m, carry_ ? 1 : 0); break;
            case 7: d = shifted(d, 3, m & 255U); break;
            case 8: flags_of(d & m); break;
            case 9: d = difference(0, m); break;
            case 10: difference(d, m); break;
            case 11: sum(d, m, 0); break;
            case 12: flags_of(d |= m); break;
            case 13: flags_of(d *= m); break;
            case 14: flags_of(d &= ~m); break;
            default: flags_of(d = ~m);
        }
    }

    void high(Word op) {  // 010001: registers of all kinds, and jumps
        const Word d = (op & 7U) | ((op >> 4U) & 8U);
        const Word m = get((op >> 3U) & 15U);
        const Word kind = (op >> 8U) & 3U;
        if (kind == 1) {
            difference(get(d), m);
        } else if (kind == 3) {
            if ((op & 0x80U) != 0) {
                r_[14] = (r_[15] + 2) | 1U;
            }
            branch(m, 3);
        } else {
            const Word value = kind == 0 ? get(d) + m : m;
            d == 15 ? branch(value, 3) : static_cast<void>(r_[d] = value);
        }
    }

    void access(Word op) {  // 0101: an address of two registers
        const Word at = r_[(op >> 3U) & 7U] + r_[(op >> 6U) & 7U];
        Word& d = r_[op & 7U];
        cost_ = 2;
        switch ((op >> 9U) & 7U) {
            case 0: store(at, 4, d); break;
            case 1: store(at, 2, d); break;
            case 2: store(at, 1, d); break;
            case 3: d = static_cast<Word>(static_cast<std::int8_t>(load(at, 1))); break;
            case 4: d = load(at, 4); break;
            case 5: d = load(at, 2); break;
            case 6: d = load(at, 1); break;
            default: d = static_cast<Word>(static_cast<std::int16_t>(load(at, 2)));
        }
    }

    void access_near(Word op) {  // 011, 1000: an address beside a register
        const Word bytes = (op >> 12U) == 8 ? 2 : ((op >> 12U) == 7 ? 1 : 4);
        const Word at = r_[(op >> 3U) & 7U] + ((op >> 6U) & 31U) * bytes;
        Word& d = r_[op & 7U];
        cost_ = 2;
        (op & 0x800U) != 0 ? static_cast<void>(d = load(at, bytes)) : store(at, bytes, d);
    }

    void many(Word op) {  // 1100: several registers
        const Word base = (op >> 8U) & 7U;
        Word at = r_[base];
        for (Word k = 0; k < 8; ++k) {
            if (((op >> k) & 1U) != 0) {
                (op & 0x800U) != 0 ? static_cast<void>(r_[k] = load(at, 4)) : store(at, 4, r_[k]);
                at += 4;
                ++cost_;
            }
        }
        if ((op & 0x800U) == 0 || ((op >> base) & 1U) == 0) {
            r_[base] = at;
        }
    }

    void push(Word op) {
        const bool link = (op & 0x100U) != 0;
        const int count = __builtin_popcount(op & 255U) + (link ? 1 : 0);
        r_[13] -= 4 * static_cast<Word>(count);
        Word at = r_[13];
        for (Word k = 0; k < 8; ++k) {
            if (((op >> k) & 1U) != 0) {
                store(at, 4, r_[k]);
                at += 4;
            }
        }
        if (link) {
            store(at, 4, r_[14]);
        }
        cost_ = 1 + count;
    }
    void pop(Word op) {
        const int count = __builtin_popcount(op & 255U);
        for (Word k = 0; k < 8; ++k) {
            if (((op >> k) & 1U) != 0) {
                r_[k] = load(r_[13], 4);
                r_[13] += 4;
            }
        }
        cost_ = 1 + count;
        if ((op & 0x100U) != 0) {
            branch(load(r_[13], 4), 4 + count + 1);
            r_[13] += 4;
        }
    }

    void semihosting() {
        const Word block = r_[1];
        switch (r_[0]) {
            case 0x01: r_[0] = 1; break;
            case 0x05:
                for (Word k = 0; k < load(block + 8, 4); ++k) {
                    std::putchar(static_cast<int>(load(load(block + 4, 4) + k, 1)));
                }
                r_[0] = 0;
                break;
            case 0x15:
                store(load(block, 4), 1, 0);
                r_[0] = 0;
                break;
            case 0x20:
                exit_code_ = static_cast<int>(load(block + 4, 4));
                done_ = true;
                break;
            default: stop("no such call of the host", r_[0]);
        }
    }

    void others(Word op) {  // 1011
        Word& d = r_[op & 7U];
        const Word n = r_[(op >> 3U) & 7U];
        if ((op & 0xFF00U) == 0xB000U) {
            r_[13] += (op & 0x80U) != 0 ? 0U - 4 * (op & 127U) : 4 * (op & 127U);
        } else if ((op & 0xFF00U) == 0xB200U) {
            const Word values[] = {static_cast<Word>(static_cast<std::int16_t>(n)),
                                   static_cast<Word>(static_cast<std::int8_t>(n)), n & 0xFFFFU,
                                   n & 0xFFU};
            d = values[(op >> 6U) & 3U];
        } else if ((op & 0xFE00U) == 0xB400U) {
            push(op);
        } else if ((op & 0xFE00U) == 0xBC00U) {
            pop(op);
        } else if ((op & 0xFF00U) == 0xBE00U) {
            semihosting();
        } else if ((op & 0xFFC0U) == 0xBA00U) {
            d = __builtin_bswap32(n);
        } else if ((op & 0xFF00U) != 0xBF00U && (op & 0xFFEFU) != 0xB662U) {
            stop("no such instruction", op);
        }
    }

    /// 11110: calls, and what only start-up code asks for.
    void wide(Word op) {
        const Word low = load(r_[15] + 2, 2);
        next_ = r_[15] + 4;
        cost_ = 4;
        if ((low & 0xD000U) == 0xD000U) {
            const Word s = (op >> 10U) & 1U;
            const Word i1 = ((low >> 13U) & 1U) ^ s ^ 1U;
            const Word i2 = ((low >> 11U) & 1U) ^ s ^ 1U;
            const Word way = s << 24U | i1 << 23U | i2 << 22U | (op & 0x3FFU) << 12U |
                             (low & 0x7FFU) << 1U;
            r_[14] = next_ | 1U;
            branch(next_ + static_cast<Word>(static_cast<std::int32_t>(way << 7U) >> 7), 4);
        } else if ((op & 0xFFE0U) == 0xF380U) {
            set_special(low & 255U, r_[op & 15U]);
        } else if (op == 0xF3EFU) {
            r_[(low >> 8U) & 15U] = (low & 255U) == 20 ? control_ : 0;
        } else if (op != 0xF3BFU) {
            stop("no such instruction", op);
        }
    }
    void set_special(Word which, Word value) {
        const bool on_process = (control_ & 2U) != 0;
        if (which == 8 || which == 9) {
            ((which == 9) == on_process ? r_[13] : (which == 9 ? process_stack_ : main_stack_)) =
                value;
        } else if (which == 20) {
            if (((value & 2U) != 0) != on_process) {
                (on_process ? process_stack_ : main_stack_) = r_[13];
                r_[13] = on_process ? main_stack_ : process_stack_;
            }
            control_ = value;
        }
    }

    void step() {
        const Word op = load(r_[15], 2);
        Word& low = r_[op & 7U];
        Word& middle = r_[(op >> 8U) & 7U];
        const Word n = r_[(op >> 3U) & 7U];
        const Word byte = op & 255U;
        const Word by = (op >> 6U) & 31U;
        next_ = r_[15] + 2;
        cost_ = 1;
        switch (op >> 11U) {
            case 0: low = shifted(n, 0, by); break;
            case 1: low = shifted(n, 1, by != 0 ? by : 32); break;
            case 2: low = shifted(n, 2, by != 0 ? by : 32); break;
            case 3: {
                const Word m = (op & 0x400U) != 0 ? by & 7U : r_[by & 7U];
                low = (op & 0x200U) != 0 ? difference(n, m) : sum(n, m, 0);
                break;
            }
            case 4: flags_of(middle = byte); break;
            case 5: difference(middle, byte); break;
            case 6: middle = sum(middle, byte, 0); break;
            case 7: middle = difference(middle, byte); break;
            case 8: (op & 0x400U) != 0 ? high(op) : data(op); break;
            case 9:
                middle = load(((r_[15] + 4) & ~3U) + 4 * byte, 4);
                cost_ = 2;
                break;
            case 10:
            case 11: access(op); break;
            case 12:
            case 13:
            case 14:
            case 15:
            case 16:
            case 17: access_near(op); break;
            case 18:
                store(r_[13] + 4 * byte, 4, middle);
                cost_ = 2;
                break;
            case 19:
                middle = load(r_[13] + 4 * byte, 4);
                cost_ = 2;
                break;
            case 20: middle = ((r_[15] + 4) & ~3U) + 4 * byte; break;
            case 21: middle = r_[13] + 4 * byte; break;
            case 22:
            case 23: others(op); break;
            case 24:
            case 25: many(op); break;
            case 26:
            case 27:
                if (holds((op >> 8U) & 15U)) {
                    const auto way = static_cast<std::int8_t>(byte);
                    branch(r_[15] + 4 + static_cast<Word>(2 * way), 3);
                }
                break;
            case 28:
                branch(r_[15] + 4 + static_cast<Word>(static_cast<std::int32_t>(op << 21U) >> 20),
                       3);
                break;
            case 30: wide(op); break;
            default: stop("no such instruction", op);
        }
        r_[15] = next_;
        cycles_ += static_cast<std::uint64_t>(cost_);
    }

    std::vector<char> code_;
    std::vector<char> ram_;
    Word r_[16] = {};
    bool negative_ = false;
    bool zero_ = false;
    bool carry_ = false;
    bool overflow_ = false;
    Word main_stack_ = 0;
    Word process_stack_ = 0;
    Word control_ = 0;
    Word next_ = 0;
    int cost_ = 0;
    std::uint64_t cycles_ = 0;
    bool done_ = false;
    int exit_code_ = 0;
};

}  // namespace

int main(int count, char** arguments) {
    std::FILE* file = count == 2 ? std::fopen(arguments[1], "rb") : nullptr;
    if (file == nullptr) {
        std::fprintf(stderr, "cycles_m0 IMAGE.elf\n");
        return 64;
    }
    std::vector<char> image;
    for (int byte = std::fgetc(file); byte != EOF; byte = std::fgetc(file)) {
        image.push_back(static_cast<char>(byte));
    }
    std::fclose(file);
    return Chip(image).run();
}
