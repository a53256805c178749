#include "palette.hpp"

#include <algorithm>

namespace weir_picture {

namespace {

constexpr std::size_t kKeys = 1u << 15;

// What falls on one colour key.
struct Bin {
    std::uint64_t count = 0;
    std::uint64_t sum[3] = {0, 0, 0};
    std::size_t key = 0;
};

// Bins [first, last) that will share one colour.
struct Box {
    std::size_t first;
    std::size_t last;
};

int channel_of(const Bin& bin, int channel) {
    return static_cast<int>((bin.key >> (10 - 5 * channel)) & 31u);
}

std::vector<Bin> histogram(const std::vector<Canvas>& frames) {
    std::vector<Bin> all(kKeys);
    for (const Canvas& frame : frames) {
        const std::vector<std::uint8_t>& bytes = frame.bytes();
        for (std::size_t i = 0; i + 2 < bytes.size(); i += 3) {
            Bin& bin = all[color_key({bytes[i], bytes[i + 1], bytes[i + 2]})];
            ++bin.count;
            for (std::size_t c = 0; c < 3; ++c) {
                bin.sum[c] += bytes[i + c];
            }
        }
    }
    std::vector<Bin> used;
    for (std::size_t key = 0; key < kKeys; ++key) {
        if (all[key].count > 0) {
            all[key].key = key;
            used.push_back(all[key]);
        }
    }
    return used;
}

// Longest side of a box: returns its length, and which channel it is.
int extent(const std::vector<Bin>& bins, Box box, int* channel) {
    int longest = -1;
    for (int c = 0; c < 3; ++c) {
        int low = 31;
        int high = 0;
        for (std::size_t i = box.first; i < box.last; ++i) {
            low = std::min(low, channel_of(bins[i], c));
            high = std::max(high, channel_of(bins[i], c));
        }
        if (high - low > longest) {
            longest = high - low;
            *channel = c;
        }
    }
    return longest;
}

// Sorts a box along its longest side and cuts it where half of the pixels lie on either side.
std::size_t median(std::vector<Bin>* bins, Box box, int channel) {
    const auto begin = bins->begin();
    std::sort(begin + static_cast<std::ptrdiff_t>(box.first),
              begin + static_cast<std::ptrdiff_t>(box.last), [channel](const Bin& a, const Bin& b) {
                  const int ca = channel_of(a, channel);
                  const int cb = channel_of(b, channel);
                  return ca != cb ? ca < cb : a.key < b.key;
              });
    std::uint64_t total = 0;
    for (std::size_t i = box.first; i < box.last; ++i) {
        total += (*bins)[i].count;
    }
    std::uint64_t run = 0;
    for (std::size_t i = box.first; i + 1 < box.last; ++i) {
        run += (*bins)[i].count;
        if (2 * run >= total) {
            return i + 1;
        }
    }
    return box.last - 1;
}

std::vector<Box> cut(std::vector<Bin>* bins, std::size_t size) {
    std::vector<Box> boxes{{0, bins->size()}};
    while (boxes.size() < size) {
        int best_length = 0;
        int best_channel = 0;
        std::size_t best = boxes.size();
        for (std::size_t i = 0; i < boxes.size(); ++i) {
            int channel = 0;
            const int length = extent(*bins, boxes[i], &channel);
            if (length > best_length) {
                best_length = length;
                best_channel = channel;
                best = i;
            }
        }
        if (best == boxes.size()) {
            break;  // every box is one colour
        }
        const std::size_t middle = median(bins, boxes[best], best_channel);
        boxes.push_back({middle, boxes[best].last});
        boxes[best].last = middle;
    }
    return boxes;
}

}  // namespace

Palette median_cut(const std::vector<Canvas>& frames, int size) {
    std::vector<Bin> bins = histogram(frames);
    Palette palette;
    palette.nearest.assign(kKeys, 0);
    if (bins.empty()) {
        palette.colors.push_back({});
        return palette;
    }
    for (const Box box : cut(&bins, static_cast<std::size_t>(std::max(1, std::min(size, 256))))) {
        std::uint64_t count = 0;
        std::uint64_t sum[3] = {0, 0, 0};
        for (std::size_t i = box.first; i < box.last; ++i) {
            palette.nearest[bins[i].key] = static_cast<std::uint8_t>(palette.colors.size());
            count += bins[i].count;
            for (std::size_t c = 0; c < 3; ++c) {
                sum[c] += bins[i].sum[c];
            }
        }
        palette.colors.push_back({static_cast<std::uint8_t>(sum[0] / count),
                                  static_cast<std::uint8_t>(sum[1] / count),
                                  static_cast<std::uint8_t>(sum[2] / count)});
    }
    return palette;
}

}  // namespace weir_picture
