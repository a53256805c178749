// Draws the tank with SDL.
#pragma once

#include <SDL.h>

#include <vector>

#include "tank.hpp"

inline constexpr int kPixels = 8;  ///< a cell's edge
inline constexpr int kViewWidth = kPixels * kCellsX;
inline constexpr int kViewHeight = kPixels * kCellsY;

/// The place in the tank that a pixel shows.
weir::Vec2f place_of(int x, int y);
/// The pixel that shows a place.
SDL_FPoint pixel_of(weir::Vec2f place_m);

class View {
public:
    explicit View(SDL_Renderer* renderer) : renderer_(renderer) {}
    void draw(const Tank& tank);
    /// What was drawn last, as a BMP file.
    bool save(const char* path) const;

private:
    void draw_liquid(const weir::World<float>& world);
    void draw_solid(const Solid& solid, const weir::Motion& at, SDL_Color colour);

    SDL_Renderer* renderer_;
    std::vector<std::vector<SDL_FRect>> drops_;  // by speed
};
