// A tank to play with, in a window:  window_tank [frames=N] [picture=FILE.bmp]
// With `frames` nobody has to watch: it needs no display, a hand that is written down below plays,
// and the last frame can be saved as a picture.
#include <SDL.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <thread>

#include "port/port.hpp"
#include "tank.hpp"
#include "view.hpp"

namespace {

constexpr float kLean = 0.1F;  ///< of a key that is pressed, radians

void require(bool done) {
    if (!done) {
        std::fprintf(stderr, "window_tank: %s\n", SDL_GetError());
        std::exit(1);
    }
}

struct Player {
    Hand hand;
    bool paused = false;
    bool starts_again = false;
    bool leaves = false;

    void take(const SDL_Event& event) {
        switch (event.type) {
            case SDL_QUIT: leaves = true; break;
            case SDL_MOUSEMOTION: hand.at_m = place_of(event.motion.x, event.motion.y); break;
            case SDL_MOUSEBUTTONDOWN:
            case SDL_MOUSEBUTTONUP: take_button(event.button); break;
            case SDL_KEYDOWN: take_key(event.key.keysym.sym); break;
            default: break;
        }
    }

private:
    void take_button(const SDL_MouseButtonEvent& button) {
        const bool pressed = button.state == SDL_PRESSED;
        hand.at_m = place_of(button.x, button.y);
        switch (button.button) {
            case SDL_BUTTON_LEFT: hand.holds = pressed; break;
            case SDL_BUTTON_RIGHT: hand.pours = pressed; break;
            case SDL_BUTTON_MIDDLE: hand.drinks = pressed; break;
            default: break;
        }
    }
    void take_key(SDL_Keycode key) {
        switch (key) {
            case SDLK_LEFT: hand.lean_rad -= kLean; break;
            case SDLK_RIGHT: hand.lean_rad += kLean; break;
            case SDLK_UP: hand.lean_rad = 0.0F; break;
            case SDLK_r: starts_again = true; break;
            case SDLK_p: paused = !paused; break;
            case SDLK_ESCAPE: leaves = true; break;
            default: break;
        }
    }
};

void push_button(Uint32 type, Uint8 button, weir::Vec2f at_m) {
    const SDL_FPoint p = pixel_of(at_m);
    SDL_Event event{};
    event.button.type = type;
    event.button.button = button;
    event.button.state = type == SDL_MOUSEBUTTONDOWN ? SDL_PRESSED : SDL_RELEASED;
    event.button.x = static_cast<int>(p.x);
    event.button.y = static_cast<int>(p.y);
    SDL_PushEvent(&event);
}

void push_motion(weir::Vec2f at_m) {
    const SDL_FPoint p = pixel_of(at_m);
    SDL_Event event{};
    event.motion.type = SDL_MOUSEMOTION;
    event.motion.x = static_cast<int>(p.x);
    event.motion.y = static_cast<int>(p.y);
    SDL_PushEvent(&event);
}

/// Takes the first crate over the wheel, holds it there, and pours the rest of the time.
void play(int frame, const Tank& tank) {
    constexpr weir::Vec2f kOver{1.2F, 0.7F};
    const weir::Vec2f crate = tank.motion(tank.solids()[2]).position_m;
    switch (frame) {
        case 10: push_button(SDL_MOUSEBUTTONDOWN, SDL_BUTTON_LEFT, crate); break;
        case 20: push_motion(kOver); break;
        case 90:
            std::printf("the crate was carried to %.2f %.2f m\n", static_cast<double>(crate.x),
                        static_cast<double>(crate.y));
            push_button(SDL_MOUSEBUTTONUP, SDL_BUTTON_LEFT, kOver);
            push_button(SDL_MOUSEBUTTONDOWN, SDL_BUTTON_RIGHT, kOver);
            break;
        default: break;
    }
}

/// The number after a word of the command line; 0 without it.
int number(const char* key) {
    char text[16];
    return port::argument(key, text, sizeof text) > 0 ? std::atoi(text) : 0;
}

using Window = std::unique_ptr<SDL_Window, decltype(&SDL_DestroyWindow)>;
using Renderer = std::unique_ptr<SDL_Renderer, decltype(&SDL_DestroyRenderer)>;

}  // namespace

int main(int, char**) {
    port::init();
    port::set_threads(static_cast<int>(std::clamp(std::thread::hardware_concurrency(), 1U, 4U)));
    const int frames = number("frames");
    const bool alone = frames > 0;
    if (alone) {
        SDL_setenv("SDL_VIDEODRIVER", "dummy", 1);
    }
    require(SDL_Init(SDL_INIT_VIDEO) == 0);
    const Window window(SDL_CreateWindow("Weir", SDL_WINDOWPOS_CENTERED, SDL_WINDOWPOS_CENTERED,
                                         kViewWidth, kViewHeight, 0),
                        SDL_DestroyWindow);
    require(window != nullptr);
    const Renderer renderer(
        SDL_CreateRenderer(window.get(), -1,
                           alone ? SDL_RENDERER_SOFTWARE : SDL_RENDERER_PRESENTVSYNC),
        SDL_DestroyRenderer);
    require(renderer != nullptr);

    Tank tank;
    View view(renderer.get());
    Player player;
    for (int frame = 0; !player.leaves && (!alone || frame < frames); ++frame) {
        if (alone) {
            play(frame, tank);
        }
        for (SDL_Event event; SDL_PollEvent(&event) != 0;) {
            player.take(event);
        }
        if (player.starts_again) {
            tank.start_again();
            player.starts_again = false;
        }
        if (!player.paused) {
            tank.step(player.hand);
        }
        view.draw(tank);
        SDL_RenderPresent(renderer.get());
    }
    if (alone) {
        std::printf("poured %d particles\n", static_cast<int>(tank.poured()));
    }
    char picture[256];
    const std::size_t length = port::argument("picture", picture, sizeof picture);
    require(length == 0 || (length < sizeof picture && view.save(picture)));
    return 0;
}
