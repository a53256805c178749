// A small display of a world: what is asked for is drawn, and nonsense is left alone.
#include "weir/display.hpp"

#include <algorithm>
#include <functional>
#include <limits>

#include "test_world.hpp"

namespace weir {
namespace {

TEST(Display, WhatCannotBeIsLeftAsItIs) {
    TestWorld<float> world(small_def());
    expect_ok(world->fill({{0.0F, 0.0F}, {0.2F, 0.1F}}));
    world->step(0.01F);
    std::vector<std::uint8_t> pixels(16 * 16, 0x33);
    const std::vector<std::uint8_t> before = pixels;
    const auto changed = [&](std::int32_t width, std::int32_t height, std::uint8_t* at) {
        Display display;
        display.width = width;
        display.height = height;
        display.pixels = at;
        const ChangedRows rows = draw(*world, display);
        return rows.first <= rows.last;
    };
    EXPECT_FALSE(changed(16, 16, nullptr));
    for (const std::int32_t width : {0, -1, -16, 1025, 1026}) {
        EXPECT_FALSE(changed(width, 8, pixels.data())) << width;
    }
    EXPECT_FALSE(changed(16, 0, pixels.data()));
    EXPECT_FALSE(changed(16, -16, pixels.data()));
    EXPECT_FALSE(changed(16, 1025, pixels.data()));
    for (const auto shade : {&Display::liquid, &Display::solid}) {
        for (const int none : {16, 200, 255}) {  // no half byte
            Display display;
            display.width = 16;
            display.height = 16;
            display.pixels = pixels.data();
            display.*shade = static_cast<std::uint8_t>(none);
            EXPECT_EQ(draw(*world, display).last, -1) << none;
        }
    }
    Display unseen;
    unseen.width = 16;
    unseen.height = 16;
    unseen.pixels = pixels.data();
    unseen.liquid = 0;  // air's
    EXPECT_EQ(draw(*world, unseen).last, -1);
    EXPECT_EQ(pixels, before);
    EXPECT_TRUE(changed(16, 16, pixels.data()));
    EXPECT_NE(pixels, before);
}

/// The half byte at the end of a row is nobody's.
TEST(Display, MayBeOfAnOddWidth) {
    WorldDef def = small_def();
    def.capacity.particles = 1000;
    TestWorld<float> world(def);
    expect_ok(world->fill({{0.0F, 0.0F}, {0.32F, 0.17F}}));
    world->step(0.01F);
    constexpr std::int32_t kHeight = 16;
    Display display;
    display.width = 15;
    display.height = kHeight;
    std::vector<std::uint8_t> odd(8 * kHeight, 0x07), even(8 * kHeight, 0);
    display.pixels = odd.data();
    EXPECT_EQ(draw(*world, display).last, kHeight - 1);
    display.width = 16;
    display.pixels = even.data();
    draw(*world, display);
    for (std::size_t byte = 0; byte < odd.size(); ++byte) {  // the liquid is level
        const int lower = byte % 8 == 7 ? 0x07 : even[byte] & 0x0F;
        EXPECT_EQ(odd[byte], (even[byte] & 0xF0) | lower) << byte;
    }
    EXPECT_EQ(even.front(), 0x00);
    EXPECT_EQ(even.back(), 0xBB);
    display.width = 1;
    std::vector<std::uint8_t> narrow(kHeight, 0);
    display.pixels = narrow.data();
    draw(*world, display);
    EXPECT_EQ(narrow.back(), 0xB0);
}

/// What is not said is said by the header: all of the tank, in these shades.
TEST(Display, HasDefaults) {
    const WorldDef def = small_def();
    TestWorld<float> world(def);
    put_static(*world, body_of(kSquare4cm, {0.2F, 0.1F}));
    expect_ok(world->fill({{0.0F, 0.0F}, {0.13F, 0.1F}}));
    world->step(0.01F);
    std::vector<std::uint8_t> plain(10 * 20, 0), said(10 * 20, 0);
    Display display;
    EXPECT_EQ(draw(*world, display).last, -1) << "it has no pixels";
    display.width = display.height = 20;
    display.pixels = plain.data();
    draw(*world, display);
    display.pixels = said.data();
    display.liquid = 11;
    display.solid = 4;
    display.hysteresis = 96;
    display.shown_m = {{0.0F, 0.0F}, {16 * def.cell_m, 16 * def.cell_m}};
    draw(*world, display);
    EXPECT_EQ(plain, said);
    EXPECT_EQ(plain[19 * 10], 0xBB) << "liquid in the lower left corner";
    EXPECT_EQ(plain[13 * 10 + 6] >> 4, 4) << "a solid";
    EXPECT_EQ(ChangedRows().first, 0);
    EXPECT_EQ(ChangedRows().last, -1);
    EXPECT_EQ(draw(*world, display).last, -1) << "nothing has changed";
}

/// A camera at whole pixels shows what the picture of the whole tank has there, and walls around.
TEST(Display, ShowsAPartOfTheTank) {
    const WorldDef def = small_def();
    TestWorld<float> world(def);
    put_static(*world, body_of(kSquare4cm, {0.2F, 0.1F}));
    expect_ok(world->fill({{0.0F, 0.0F}, {0.13F, 0.1F}}));
    world->step(0.01F);
    const std::int32_t columns = 4 * world->cells_x();
    const std::int32_t rows = 4 * world->cells_y();
    const auto picture_of = [&](std::int32_t x, std::int32_t y, std::int32_t width,
                                std::int32_t height) {
        const float pixel_m = def.cell_m / 4.0F;
        std::vector<std::uint8_t> pixels(static_cast<std::size_t>((width + 1) / 2 * height), 0);
        Display display;
        display.width = width;
        display.height = height;
        display.pixels = pixels.data();
        const auto place = [&](std::int32_t i, std::int32_t j) {
            return Vec2f{pixel_m * static_cast<float>(i), pixel_m * static_cast<float>(j)};
        };
        display.shown_m = {place(x, y), place(x + width, y + height)};
        EXPECT_LE(draw(*world, display).last, height - 1);
        const auto shade = [width, height, pixels](std::int32_t i, std::int32_t j) {
            const auto at = static_cast<std::size_t>((height - 1 - j) * ((width + 1) / 2) + i / 2);
            return pixels[at] >> (i % 2 == 0 ? 4 : 0) & 0x0F;
        };
        return std::function<int(std::int32_t, std::int32_t)>(shade);
    };
    const auto whole = picture_of(0, 0, columns, rows);
    const Vec2<std::int32_t> corners[] = {{-3, -5}, {7, 3}, {columns - 9, rows - 4}};
    for (const Vec2<std::int32_t> corner : corners) {
        const auto part = picture_of(corner.x, corner.y, 41, 37);
        for (std::int32_t j = 0; j < 37; ++j) {
            for (std::int32_t i = 0; i < 41; ++i) {
                const std::int32_t x = corner.x + i;
                const std::int32_t y = corner.y + j;
                const bool inside = 0 <= x && x < columns && 0 <= y && y < rows;
                ASSERT_EQ(part(i, j), inside ? whole(x, y) : Display().solid) << x << ' ' << y;
            }
        }
    }
}

/// A pixel is what its centre is in, to the nearest 256th of a cell: also if its place is none.
TEST(Display, CentresAreRoundedToTheNearest) {
    TestWorld<float> world(small_def());
    world->step(0.01F);
    const float unit_m = small_def().cell_m / 256.0F;
    std::uint8_t pixels[2] = {};
    Display display;
    display.width = 3;
    display.height = 1;
    display.pixels = pixels;
    for (const float off : {-0.25F, 0.0F, 0.25F}) {
        display.shown_m = {{(off - 10.0F) * unit_m, 0.1F}, {(off + 10.0F) * unit_m, 0.2F}};
        pixels[0] = pixels[1] = 0x77;
        draw(*world, display);
        EXPECT_EQ(pixels[0], display.solid << 4) << "the middle one is on the tank's edge " << off;
        EXPECT_EQ(pixels[1], 0x07);
    }
}

/// A centre on a body's edge is the body's.
TEST(Display, EdgesAreSolid) {
    TestWorld<float> world(small_def());
    put_static(*world, body_of(kSquare4cm, {0.2F, 0.1F}));
    expect_ok(world->fill({{0.1F, 0.04F}, {0.18F, 0.16F}}));
    world->step(0.01F);
    std::uint8_t pixel = 0;
    Display display;
    display.width = display.height = 1;
    display.pixels = &pixel;
    display.shown_m = {{0.17F, 0.09F}, {0.19F, 0.11F}};
    draw(*world, display);
    EXPECT_EQ(pixel, display.solid << 4);
    display.shown_m = {{0.15F, 0.09F}, {0.17F, 0.11F}};
    draw(*world, display);
    EXPECT_LE(pixel, display.liquid << 4) << "a cell before it";
}

TEST(Display, OfNoPlaceIsLeftAsItIs) {
    const WorldDef def = small_def();
    TestWorld<float> world(def);
    expect_ok(world->fill({{0.0F, 0.0F}, {0.2F, 0.1F}}));
    world->step(0.01F);
    std::vector<std::uint8_t> pixels(8 * 16, 0x33);
    const std::vector<std::uint8_t> before = pixels;
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float far = 2.0F * static_cast<float>(kMaxCells) * def.cell_m;
    const Box places[] = {{{0.0F, 0.0F}, {nan, 0.1F}}, {{0.2F, 0.0F}, {0.1F, 0.1F}},
                          {{0.0F, 0.0F}, {0.1F, far}}, {{0.0F, -far}, {0.1F, 0.1F}},
                          {{0.1F, 0.1F}, {0.1F, 0.1F}}, {{0.1F, 0.1F}, {0.1000001F, 0.2F}}};
    for (const Box& place : places) {
        Display display;
        display.width = 16;
        display.height = 16;
        display.pixels = pixels.data();
        display.shown_m = place;
        const ChangedRows rows = draw(*world, display);
        EXPECT_GT(rows.first, rows.last) << place.max_m.x << ' ' << place.max_m.y;
    }
    EXPECT_EQ(pixels, before);
}

/// The right edge of the widest display of the widest tank.
TEST(Display, ManyPixelsOverManyCells) {
    WorldDef def = small_def();
    def.capacity.cells_x = kMaxCells;
    def.capacity.window_cells = 66 * 26;
    TestWorld<float> world(def);
    const float right = static_cast<float>(kMaxCells) * def.cell_m;
    expect_ok(world->fill({{right - 0.16F, 0.0F}, {right, 0.1F}}));
    world->step(0.01F);
    std::vector<std::uint8_t> pixels(512 * 16, 0);
    Display display;
    display.width = 1024;
    display.height = 16;
    display.pixels = pixels.data();
    draw(*world, display);
    const auto last = pixels.begin() + 512 * 15;
    EXPECT_EQ(*(last + 511) & 0x0F, display.liquid);
    EXPECT_EQ(std::count(last, last + 511, 0), 511);
}

/// A shade is kept while it is no further off than it has to be, and a solid's is none of liquid.
TEST(Display, KeepsAShadeThatIsNearEnough) {
    TestWorld<float> world(small_def());
    expect_ok(world->fill({{0.0F, 0.0F}, {0.2F, 0.1F}}));
    world->step(0.01F);
    std::vector<std::uint8_t> pixels(16 * 8, 0);
    Display display;
    display.width = 16;
    display.height = 16;
    display.pixels = pixels.data();
    display.liquid = 8;
    display.solid = 9;
    display.hysteresis = 0;
    draw(*world, display);
    const std::size_t last = pixels.size() - 8;  // the lower left pixel is amid liquid
    EXPECT_EQ(pixels[last] >> 4, 8);
    for (const int off : {7, 9}) {
        pixels[last] = static_cast<std::uint8_t>((pixels[last] & 0x0F) | off << 4);
        display.hysteresis = 0;
        EXPECT_EQ(draw(*world, display).last, 15) << off;
        EXPECT_EQ(pixels[last] >> 4, 8) << off;
        pixels[last] = static_cast<std::uint8_t>((pixels[last] & 0x0F) | off << 4);
        display.hysteresis = 200;  // of 256 a shade, beyond the half
        EXPECT_EQ(draw(*world, display).last, off == 7 ? -1 : 15) << off;
        EXPECT_EQ(pixels[last] >> 4, off == 7 ? 7 : 8) << off;
    }
}

TEST(BodyName, TellsBodiesApart) {
    TestWorld<float> world(small_def());
    TestWorld<float> elsewhere(small_def());
    const BodyId first = put_static(*world, body_of(kSquare4cm, {0.1F, 0.1F}));
    const BodyId second = put_static(*world, body_of(kSquare4cm, {0.2F, 0.1F}));
    const BodyId other = put_static(*elsewhere, body_of(kSquare4cm, {0.1F, 0.1F}));
    BodyId again;
    expect_ok(world->body_in_slot(first.slot, &again));
    EXPECT_TRUE(first == again);
    EXPECT_FALSE(first != again);
    EXPECT_TRUE(first != second);
    EXPECT_TRUE(first != other) << "another world's";
    expect_ok(world->remove_body(first));
    again = put_static(*world, body_of(kSquare4cm, {0.1F, 0.1F}));
    EXPECT_EQ(again.slot, first.slot);
    EXPECT_TRUE(first != again);
}

}  // namespace
}  // namespace weir
