// Each frame stores only the rectangle that changed, and in it only the pixels that changed; the
// others are transparent. That is most of the compression an animation of a tank gets.
#include <gif_lib.h>

#include <algorithm>
#include <cstdio>

#include "palette.hpp"
#include "weir_picture/image_file.hpp"

namespace weir_picture {

namespace {

constexpr int kTransparent = 255;  // last index of the table; colours use the others

struct Rectangle {
    int left;
    int top;
    int right;   // one past
    int bottom;  // one past
};

std::vector<GifByteType> indexed(const Canvas& canvas, const Palette& palette) {
    std::vector<GifByteType> out;
    const std::vector<std::uint8_t>& bytes = canvas.bytes();
    out.reserve(bytes.size() / 3);
    for (std::size_t i = 0; i + 2 < bytes.size(); i += 3) {
        out.push_back(palette.nearest[color_key({bytes[i], bytes[i + 1], bytes[i + 2]})]);
    }
    return out;
}

// Bounds of the pixels that differ; one pixel if none do, since a frame may not be empty.
Rectangle changed(const std::vector<GifByteType>& before, const std::vector<GifByteType>& now,
                  int width, int height) {
    Rectangle r{width, height, 0, 0};
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const std::size_t at = static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                                   static_cast<std::size_t>(x);
            if (before[at] != now[at]) {
                r = {std::min(r.left, x), std::min(r.top, y), std::max(r.right, x + 1),
                     std::max(r.bottom, y + 1)};
            }
        }
    }
    return r.right == 0 ? Rectangle{0, 0, 1, 1} : r;
}

bool put_loop_forever(GifFileType* file) {
    const unsigned char repeat[] = {1, 0, 0};  // sub-block 1, count 0: no end
    return EGifPutExtensionLeader(file, APPLICATION_EXT_FUNC_CODE) != GIF_ERROR &&
           EGifPutExtensionBlock(file, 11, "NETSCAPE2.0") != GIF_ERROR &&
           EGifPutExtensionBlock(file, 3, repeat) != GIF_ERROR &&
           EGifPutExtensionTrailer(file) != GIF_ERROR;
}

bool put_frame(GifFileType* file, const std::vector<GifByteType>& before,
               const std::vector<GifByteType>& now, Rectangle r, int width, int centiseconds) {
    GraphicsControlBlock control{};
    control.DisposalMode = DISPOSE_DO_NOT;
    control.DelayTime = centiseconds;
    control.TransparentColor = kTransparent;
    GifByteType block[4];
    EGifGCBToExtension(&control, block);
    if (EGifPutExtension(file, GRAPHICS_EXT_FUNC_CODE, sizeof block, block) == GIF_ERROR ||
        EGifPutImageDesc(file, r.left, r.top, r.right - r.left, r.bottom - r.top, false,
                         nullptr) == GIF_ERROR) {
        return false;
    }
    std::vector<GifByteType> line(static_cast<std::size_t>(r.right - r.left));
    for (int y = r.top; y < r.bottom; ++y) {
        const std::size_t start = static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                                  static_cast<std::size_t>(r.left);
        for (std::size_t x = 0; x < line.size(); ++x) {
            const bool same = !before.empty() && before[start + x] == now[start + x];
            line[x] = same ? static_cast<GifByteType>(kTransparent) : now[start + x];
        }
        if (EGifPutLine(file, line.data(), r.right - r.left) == GIF_ERROR) {
            return false;
        }
    }
    return true;
}

bool put_all(GifFileType* file, const std::vector<Canvas>& frames, int centiseconds) {
    const int width = frames[0].width();
    const int height = frames[0].height();
    const Palette palette = median_cut(frames, kTransparent);
    GifColorType table[256] = {};
    for (std::size_t i = 0; i < palette.colors.size(); ++i) {
        table[i] = {palette.colors[i].r, palette.colors[i].g, palette.colors[i].b};
    }
    ColorMapObject* map = GifMakeMapObject(256, table);
    if (map == nullptr) {
        return false;
    }
    EGifSetGifVersion(file, true);
    bool good = EGifPutScreenDesc(file, width, height, 8, 0, map) != GIF_ERROR;
    GifFreeMapObject(map);
    good = good && put_loop_forever(file);
    std::vector<GifByteType> before;
    for (std::size_t i = 0; good && i < frames.size(); ++i) {
        std::vector<GifByteType> now = indexed(frames[i], palette);
        const Rectangle r = before.empty() ? Rectangle{0, 0, width, height}
                                           : changed(before, now, width, height);
        good = put_frame(file, before, now, r, width, centiseconds);
        before = std::move(now);
    }
    return good;
}

// giflib's own way to open a file makes it readable by its owner only.
int write_to_file(GifFileType* file, const GifByteType* bytes, int count) {
    FILE* out = static_cast<FILE*>(file->UserData);
    return static_cast<int>(std::fwrite(bytes, 1, static_cast<std::size_t>(count), out));
}

bool fail(std::string* error, const std::string& text) {
    if (error != nullptr) {
        *error = text;
    }
    return false;
}

}  // namespace

bool write_gif(const std::string& path, const std::vector<Canvas>& frames, int centiseconds,
               std::string* error) {
    if (frames.empty()) {
        return fail(error, "no frames for " + path);
    }
    for (const Canvas& frame : frames) {
        if (frame.width() != frames[0].width() || frame.height() != frames[0].height()) {
            return fail(error, "frames of different sizes for " + path);
        }
    }
    FILE* out = std::fopen(path.c_str(), "wb");
    if (out == nullptr) {
        return fail(error, "cannot write " + path);
    }
    int code = 0;
    GifFileType* file = EGifOpen(out, write_to_file, &code);
    const bool written =
        file != nullptr && put_all(file, frames, std::max(2, std::min(centiseconds, 65535)));
    const bool finished = file != nullptr && EGifCloseFile(file, &code) != GIF_ERROR;
    const bool closed = std::fclose(out) == 0;
    return written && finished && closed ? true : fail(error, "cannot write all of " + path);
}

}  // namespace weir_picture
