// Stage: part particles that have met, in packed worlds. Where two are at one place with one
// velocity nothing parts them any more. Slow liquid rounds its particles together like that: a
// tank that a hand holds still would show a fifth of its particles after two hours.
#pragma once

#include "math/packed_arithmetic.hpp"
#include "step/free_words.hpp"
#include "step/simulation.hpp"

namespace weir {

/// A look through the tank takes its cells in groups of four beside each other, and a substep in
/// eight for each: particles meet seldom, and each group is looked for among all of them.
inline constexpr std::uint32_t kMeetingWidth = 4;
inline constexpr std::uint32_t kMeetingEvery = 8;

/// So many of a group are compared with each other. A full cell holds four or so.
inline constexpr std::int32_t kMostMet = 24;

inline std::uint32_t groups_in_row(const GridShape& tank) {
    return (static_cast<std::uint32_t>(tank.nx) + kMeetingWidth - 1) / kMeetingWidth;
}

/// How many substeps a look takes, at most.
inline std::uint32_t most_looking(const GridShape& tank) {
    return kMeetingEvery * groups_in_row(tank) * static_cast<std::uint32_t>(tank.ny);
}

/// To be called where something stirs the liquid. What nobody stirs is left alone, as parting
/// particles keeps it from coming to rest.
template <class Real>
void look_for_met(Simulation<Real>& simulation) {
    if constexpr (Stored<Real>::coarse) {
        std::uint32_t& left = simulation.look.substeps_left;
        left = left > 0 ? left : most_looking(simulation.layers.shape);
    }
}

namespace packed {

/// The numbers of a group's particles. They outlive a slice where the pressure's scratch is free.
class Group {
public:
    Group(const PressureFields<SmallFixed>& fields, const GridShape& tank)
        : words_(free_words(fields, tank)) {}

    void clear() const { put_word(words_.data, 0); }
    std::int32_t count() const { return static_cast<std::int32_t>(word_at(words_.data)); }
    std::int32_t operator[](std::int32_t n) const {
        return static_cast<std::int32_t>(word_at(words_.data + n + 1));
    }
    void add(std::int32_t number) const {
        const std::int32_t n = count();
        if (n < minimum(kMostMet, words_.size - 1)) {
            put_word(words_.data + n + 1, static_cast<std::uint32_t>(number));
            put_word(words_.data, static_cast<std::uint32_t>(n + 1));
        }
    }

private:
    FreeWords words_;
};

/// What a place's word has of its group.
inline constexpr std::uint32_t kGroupBits = 0xFF00FC00U;
static_assert(kMeetingWidth == 4, "as the bits say");

inline std::uint32_t word_of_group(std::uint32_t group, std::uint32_t in_row) {
    return group % in_row * kMeetingWidth << 8U | group / in_row << 24U;
}

/// A 32nd of a cell, towards the middle of its cell, and across gravity, which gives it nothing.
inline void step_aside(Vec2<SmallFixed> gravity, Vec2<PositionOf<SmallFixed>>& place) {
    constexpr std::int32_t kWay = 8;
    auto& part = absolute(gravity.x) < absolute(gravity.y) ? place.x : place.y;
    part.raw = static_cast<std::uint16_t>(part.raw + ((part.raw & 128) == 0 ? kWay : -kWay));
}

/// It does not matter who stays, as nothing tells them apart. Beside solids all stay.
template <bool Solids>
void part(const Group& group, Simulation<SmallFixed>& simulation) {
    const Particles<SmallFixed>& particles = simulation.particles;
    const Walls<SmallFixed>& walls = simulation.layers.walls;
    for (std::int32_t a = 0; a < group.count(); ++a) {
        const std::uint32_t place = word_at(particles.position + group[a]);
        for (std::int32_t b = a + 1; b < group.count(); ++b) {
            Vec2<PositionOf<SmallFixed>>& other = particles.position[group[b]];
            if (word_at(&other) == place && word_at(particles.velocity + group[a]) ==
                                                word_at(particles.velocity + group[b])) {
                const std::int32_t c =
                    simulation.layers.shape.index(other.x.raw >> 8, other.y.raw >> 8);
                if (!Solids || !walls.active || walls.cell_case[c] == 0) {
                    step_aside(simulation.settings.gravity, other);
                }
            }
        }
    }
}

}  // namespace packed

template <bool Solids, class Real>
void part_met(Simulation<Real>& simulation, Work work) {
    if constexpr (Stored<Real>::coarse) {
        std::uint32_t& left = simulation.look.substeps_left;
        if (work.once(1)) {
            const Walls<Real>& walls = simulation.layers.walls;
            if (Solids && walls.active && walls.moving != nullptr) {
                look_for_met(simulation);
            }
            left -= left > 0 ? 1 : 0;
        }
        if (left % kMeetingEvery != kMeetingEvery - 1 && !work.foreseeing()) {
            return;
        }
        const GridShape& tank = simulation.layers.shape;
        const packed::Group group(simulation.pressure, tank);
        if (work.once(1)) {
            group.clear();
        }
        const std::uint32_t wanted =
            packed::word_of_group(left / kMeetingEvery, groups_in_row(tank));
        const Vec2<PositionOf<Real>>* const places = simulation.particles.position;
        const Part some = work.take(simulation.particles.count, 1);
        for (const auto* at = places + some.first; at < places + some.end; ++at) {
            if (((word_at(at) ^ wanted) & packed::kGroupBits) == 0) {
                group.add(static_cast<std::int32_t>(at - places));
            }
        }
        if (work.once(kMostMet * kMostMet / 2)) {
            packed::part<Solids>(group, simulation);
        }
    }
}

}  // namespace weir
