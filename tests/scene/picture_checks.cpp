// Checks of the picture library; prints the line of the first that fails.
#include <gif_lib.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "weir_picture/frame.hpp"
#include "weir_picture/image_file.hpp"

namespace {

using weir_picture::Canvas;
using weir_picture::Color;

constexpr Color kWhite{255, 255, 255};
constexpr Color kBlack{0, 0, 0};
constexpr Color kRed{220, 30, 40};

void check(bool good, int line) {
    if (!good) {
        std::printf("picture_checks.cpp:%d failed\n", line);
        std::exit(1);
    }
}
#define CHECK(x) check((x), __LINE__)

bool near(Color a, Color b, int slack) {
    return std::abs(a.r - b.r) <= slack && std::abs(a.g - b.g) <= slack &&
           std::abs(a.b - b.b) <= slack;
}

// Ink on a white canvas, in pixels.
double ink(const Canvas& canvas) {
    double sum = 0.0;
    for (const std::uint8_t byte : canvas.bytes()) {
        sum += (255.0 - byte) / (3.0 * 255.0);
    }
    return sum;
}

void check_drawing() {
    Canvas square(40, 30, kWhite);
    square.fill_polygon({{10.5f, 5.0f}, {20.25f, 5.0f}, {20.25f, 15.5f}, {10.5f, 15.5f}}, kBlack);
    CHECK(std::fabs(ink(square) - 9.75 * 10.5) < 0.5);
    CHECK(near(square.pixel(15, 10), kBlack, 0) && near(square.pixel(10, 10), {128, 128, 128}, 1));
    Canvas disc(40, 30, kWhite);
    disc.fill_disc({20.0f, 15.0f}, 10.0f, kBlack);
    CHECK(std::fabs(ink(disc) - 314.16) < 2.0);
    Canvas edge(40, 30, kWhite);
    edge.fill_disc({0.0f, 15.0f}, 10.0f, kBlack);
    edge.fill_polygon({{30.0f, -50.0f}, {90.0f, -50.0f}, {90.0f, 90.0f}, {30.0f, 90.0f}}, kBlack);
    CHECK(std::fabs(ink(edge) - (157.08 + 300.0)) < 2.0);
    Canvas nothing(40, 30, kWhite);
    nothing.fill_disc({NAN, 15.0f}, 10.0f, kBlack);
    nothing.fill_disc({INFINITY, 15.0f}, 10.0f, kBlack);
    nothing.fill_polygon({{1.0f, 1.0f}, {NAN, 5.0f}, {9.0f, 9.0f}}, kBlack);
    nothing.fill_polygon({{1.0f, 1.0f}, {9.0f, 9.0f}}, kBlack);
    nothing.fill_rectangle(-5, -5, 3, 3, kBlack);
    CHECK(ink(nothing) == 0.0);
    Canvas text(40, 30, kWhite);
    text.draw_text(1, 1, "I", 1, kBlack);
    CHECK(std::fabs(ink(text) - 11.0) < 1e-9 && near(text.pixel(3, 4), kBlack, 0));
    text.draw_text(1, 1, "\xff", 1, kBlack);
}

void check_frame() {
    const float xy[] = {2.0f, 1.0f, 6.0f, 1.0f, NAN, 1.0f};
    const float speed[] = {0.0f, 9.0f, 0.0f};
    weir_picture::Style style = weir_picture::style_for(8, 4, 160);
    CHECK(style.pixels_per_cell == 20);
    const weir_picture::Particles particles{xy, xy + 1, 2, speed, 3};
    const std::vector<weir_picture::Polygon> bodies = {
        {{{3.0f, 2.0f}, {5.0f, 2.0f}, {5.0f, 4.0f}, {3.0f, 4.0f}}, true},
        {{{3.5f, 2.0f}, {5.0f, 2.0f}, {5.0f, 3.0f}, {3.5f, 3.0f}}, false}};
    const Canvas frame = weir_picture::draw_frame(8, 4, particles, bodies, "", style);
    CHECK(frame.width() == 176 && frame.height() == 96);
    CHECK(near(frame.pixel(8 + 40, 8 + 60), style.slow, 0));
    CHECK(near(frame.pixel(8 + 120, 8 + 60), style.fast, 0));
    CHECK(near(frame.pixel(8 + 80, 8 + 30), style.moving, 0));
    CHECK(near(frame.pixel(8 + 20, 8 + 20), style.background, 0));
    const Canvas captioned = weir_picture::draw_frame(8, 4, particles, bodies, "t", style);
    CHECK(captioned.height() > frame.height());
    CHECK(weir_picture::time_caption(1.5f) == "t = 1.50 s");
    const Canvas sheet = weir_picture::contact_sheet({frame, frame, frame}, 2);
    CHECK(sheet.width() == 2 * 184 + 8 && sheet.height() == 2 * 104 + 8);
    CHECK(near(sheet.pixel(8 + 8 + 40, 8 + 104 + 8 + 60), style.slow, 0));
}

// Plays a GIF back and compares every frame with what was drawn.
void check_gif(const std::string& path, const std::vector<Canvas>& frames) {
    std::string error;
    CHECK(weir_picture::write_gif(path, frames, 5, &error));
    int code = 0;
    GifFileType* file = DGifOpenFileName(path.c_str(), &code);
    CHECK(file != nullptr && DGifSlurp(file) == GIF_OK);
    CHECK(file->ImageCount == static_cast<int>(frames.size()));
    Canvas shown(file->SWidth, file->SHeight, kBlack);
    for (std::size_t i = 0; i < frames.size(); ++i) {
        const SavedImage& image = file->SavedImages[i];
        GraphicsControlBlock control{};
        CHECK(DGifSavedExtensionToGCB(file, static_cast<int>(i), &control) == GIF_OK);
        CHECK(control.DelayTime == 5);
        const GifImageDesc& d = image.ImageDesc;
        for (int y = 0; y < d.Height; ++y) {
            for (int x = 0; x < d.Width; ++x) {
                const int index = image.RasterBits[y * d.Width + x];
                if (index != control.TransparentColor) {
                    const GifColorType c = file->SColorMap->Colors[index];
                    shown.set(d.Left + x, d.Top + y, {c.Red, c.Green, c.Blue});
                }
            }
        }
        for (int y = 0; y < shown.height(); ++y) {
            for (int x = 0; x < shown.width(); ++x) {
                CHECK(near(shown.pixel(x, y), frames[i].pixel(x, y), 8));
            }
        }
    }
    DGifCloseFile(file, &code);
}

void check_files(const std::string& folder) {
    std::vector<Canvas> frames;
    for (int i = 0; i < 5; ++i) {
        frames.emplace_back(40, 30, kWhite);
        frames.back().fill_disc({5.0f + 6.0f * static_cast<float>(i), 15.0f}, 6.0f, kRed);
    }
    frames.push_back(frames.back());  // a frame in which nothing changes
    std::string error;
    CHECK(weir_picture::write_png(folder + "/still.png", frames[0], &error));
    check_gif(folder + "/moving.gif", frames);
    CHECK(!weir_picture::write_png(folder + "/no/such/still.png", frames[0], &error));
    CHECK(error.find("no/such/still.png") != std::string::npos);
    CHECK(!weir_picture::write_gif(folder + "/no/such/moving.gif", frames, 5, &error));
    CHECK(error.find("no/such/moving.gif") != std::string::npos);
    CHECK(!weir_picture::write_gif(folder + "/a.gif", {}, 5, nullptr));
    frames.emplace_back(41, 30, kWhite);
    CHECK(!weir_picture::write_gif(folder + "/a.gif", frames, 5, &error));
}

}  // namespace

int main(int argc, char** argv) {
    CHECK(argc == 2);
    check_drawing();
    check_frame();
    check_files(argv[1]);
    return 0;
}
