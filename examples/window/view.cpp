#include "view.hpp"

#include <algorithm>
#include <cmath>

namespace {

constexpr SDL_Color kSlow{30, 110, 210, 255};
constexpr SDL_Color kFast{225, 245, 255, 255};
constexpr SDL_Color kStone{120, 110, 100, 255};
constexpr SDL_Color kWood{205, 150, 85, 255};
constexpr SDL_Color kHeld{250, 210, 90, 255};
constexpr std::size_t kShades = 8;
constexpr float kFullSpeed = 2.0F;  // m/s

Uint8 blend(Uint8 from, Uint8 to, float share) {
    return static_cast<Uint8>(static_cast<float>(from) +
                              share * (static_cast<float>(to) - static_cast<float>(from)));
}

}  // namespace

weir::Vec2f place_of(int x, int y) {
    constexpr float kMetres = kCell / kPixels;
    return {kMetres * static_cast<float>(x), kSize.y - kMetres * static_cast<float>(y)};
}

SDL_FPoint pixel_of(weir::Vec2f place_m) {
    constexpr float kPerMetre = kPixels / kCell;
    return {kPerMetre * place_m.x, kPerMetre * (kSize.y - place_m.y)};
}

/// A small square for each particle, the paler the faster; one call for each shade.
void View::draw_liquid(const weir::World<float>& world) {
    constexpr float kEdge = 0.7F * kPixels;
    const auto places = world.particle_positions();
    const auto velocities = world.particle_velocities();
    const float to_shade = world.velocity_scale() / kFullSpeed * static_cast<float>(kShades);
    drops_.resize(kShades);
    for (auto& drops : drops_) {
        drops.clear();
    }
    for (std::int32_t k = 0; k < places.size; ++k) {
        const float speed = std::hypot(velocities[k].x, velocities[k].y);
        const auto shade = std::min(kShades - 1, static_cast<std::size_t>(to_shade * speed));
        const SDL_FPoint p = pixel_of({kCell * places[k].x, kCell * places[k].y});
        drops_[shade].push_back({p.x - 0.5F * kEdge, p.y - 0.5F * kEdge, kEdge, kEdge});
    }
    for (std::size_t k = 0; k < kShades; ++k) {
        const float share = static_cast<float>(k) / static_cast<float>(kShades - 1);
        SDL_SetRenderDrawColor(renderer_, blend(kSlow.r, kFast.r, share),
                               blend(kSlow.g, kFast.g, share), blend(kSlow.b, kFast.b, share), 255);
        SDL_RenderFillRectsF(renderer_, drops_[k].data(), static_cast<int>(drops_[k].size()));
    }
}

/// Triangles around the body's origin, from which each vertex is in sight.
void View::draw_solid(const Solid& solid, const weir::Motion& at, SDL_Color colour) {
    const float c = std::cos(at.angle_rad);
    const float s = std::sin(at.angle_rad);
    std::vector<SDL_Vertex> vertices{{pixel_of(at.position_m), colour, {0.0F, 0.0F}}};
    std::vector<int> corners;
    const auto count = static_cast<int>(solid.ring.size());
    for (int k = 0; k < count; ++k) {
        const weir::Vec2f p = solid.ring[static_cast<std::size_t>(k)];
        vertices.push_back({pixel_of({at.position_m.x + c * p.x - s * p.y,
                                      at.position_m.y + s * p.x + c * p.y}),
                            colour, {0.0F, 0.0F}});
        corners.insert(corners.end(), {0, k + 1, (k + 1) % count + 1});
    }
    SDL_RenderGeometry(renderer_, nullptr, vertices.data(), static_cast<int>(vertices.size()),
                       corners.data(), static_cast<int>(corners.size()));
}

void View::draw(const Tank& tank) {
    SDL_SetRenderDrawColor(renderer_, 16, 20, 28, 255);
    SDL_RenderClear(renderer_);
    draw_liquid(tank.world());
    const std::vector<Solid>& solids = tank.solids();
    for (std::size_t k = 0; k < solids.size(); ++k) {
        const SDL_Color colour = solids[k].fixed ? kStone : kWood;
        draw_solid(solids[k], tank.motion(solids[k]),
                   static_cast<int>(k) == tank.held() ? kHeld : colour);
    }
}

bool View::save(const char* path) const {
    SDL_Surface* const picture = SDL_CreateRGBSurfaceWithFormat(0, kViewWidth, kViewHeight, 32,
                                                                SDL_PIXELFORMAT_ARGB8888);
    const bool saved = picture != nullptr &&
                       SDL_RenderReadPixels(renderer_, nullptr, picture->format->format,
                                            picture->pixels, picture->pitch) == 0 &&
                       SDL_SaveBMP(picture, path) == 0;
    SDL_FreeSurface(picture);
    return saved;
}
