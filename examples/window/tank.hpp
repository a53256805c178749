// The tank that is played with: what the library is asked for in a frame, and nothing of windows.
#pragma once

#include <cstdint>
#include <vector>

#include "weir/weir.hpp"

inline constexpr float kCell = 0.01F;
inline constexpr int kCellsX = 160;
inline constexpr int kCellsY = 90;
inline constexpr weir::Vec2f kSize{kCell * kCellsX, kCell * kCellsY};  // m
inline constexpr float kFrame = 1.0F / 60.0F;

struct Solid {
    std::vector<weir::Vec2f> ring;  ///< m, seen from the body's origin each vertex is in sight
    weir::BodyId id;
    bool fixed = false;
    bool loose = false;  ///< a hand can take it
};

/// What the player does in a frame.
struct Hand {
    weir::Vec2f at_m;
    bool holds = false;   ///< the body that was nearest when the hand closed
    bool pours = false;
    bool drinks = false;
    float lean_rad = 0.0F;  ///< of the tank
};

class Tank {
public:
    Tank();
    void step(const Hand& hand);
    void start_again();

    const std::vector<Solid>& solids() const { return solids_; }
    weir::Motion motion(const Solid& solid) const;
    const weir::World<float>& world() const { return world_; }
    std::int32_t poured() const { return poured_; }
    /// Index in `solids()` of what the hand holds; −1: nothing.
    int held() const { return held_; }

private:
    void add(const std::vector<weir::Vec2f>& ring, weir::Vec2f at_m, weir::Hold hold);
    void add_fixed(const std::vector<weir::Vec2f>& ring, weir::Vec2f at_m);
    void carry(weir::Vec2f to_m);
    void pour(weir::Vec2f at_m);
    int nearest(weir::Vec2f at_m) const;

    struct alignas(weir::world_alignment) Line {
        std::byte bytes[weir::world_alignment];
    };
    std::vector<Line> memory_;
    weir::World<float> world_{};
    std::vector<std::byte> start_;
    std::vector<Solid> solids_;
    int held_ = -1;
    std::int32_t poured_ = 0;
    std::uint32_t dice_ = 1;
};
