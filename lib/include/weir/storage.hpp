// How a world keeps its numbers: as they are computed, or, for `World<SmallFixed>`, in as few bits
// as each quantity bears.
#pragma once

#include "weir/fixed.hpp"

namespace weir {

/// A number kept in 8 or 16 bits, raw · 2^−Fraction. Reads as a SmallFixed; writing rounds to the
/// nearest and saturates.
template <class Bits, int Fraction>
struct Packed {
    Bits raw = 0;

    constexpr Packed() = default;
    WEIR_ALWAYS_INLINE static constexpr Packed of_raw(Bits bits) {
        Packed value;
        value.raw = bits;
        return value;
    }
    constexpr explicit Packed(SmallFixed value)
        : raw(packed((value.raw + kHalf + (value.raw >> 31)) >> kShift)) {}
    constexpr Packed& operator=(SmallFixed value) { return *this = Packed(value); }
    template <class Number, std::enable_if_t<std::is_arithmetic<Number>::value, int> = 0>
    constexpr explicit Packed(Number value) : Packed(SmallFixed(value)) {}

    WEIR_ALWAYS_INLINE constexpr operator SmallFixed() const {  // NOLINT
        return SmallFixed::of_raw(static_cast<std::int32_t>(raw) * (1 << kShift));
    }
    constexpr explicit operator float() const {
        return static_cast<float>(static_cast<SmallFixed>(*this));
    }
    constexpr explicit operator double() const {
        return static_cast<double>(static_cast<SmallFixed>(*this));
    }
    constexpr explicit operator std::int32_t() const {
        return static_cast<std::int32_t>(static_cast<SmallFixed>(*this));
    }

private:
    static constexpr int kShift = 16 - Fraction;
    static constexpr std::int32_t kHalf = 1 << (kShift - 1);
    static constexpr bool kSigned = std::is_signed<Bits>::value;
    static constexpr std::int32_t kMost = (1 << (8 * sizeof(Bits) - (kSigned ? 1 : 0))) - 1;
    static constexpr std::int32_t kLeast = kSigned ? -kMost - 1 : 0;

    static constexpr Bits packed(std::int32_t value) {
        return static_cast<Bits>(value > kMost ? kMost : (value < kLeast ? kLeast : value));
    }
};

/// The number of a body, 0 … 254, or 0xFFFF for none, in a byte.
struct ShortSlot {
    std::uint8_t raw = 0xFF;

    constexpr ShortSlot& operator=(std::uint16_t slot) {
        raw = static_cast<std::uint8_t>(slot < 0xFF ? slot : 0xFF);
        return *this;
    }
    constexpr operator std::uint16_t() const {  // NOLINT
        return raw == 0xFF ? std::uint16_t{0xFFFF} : raw;
    }
};

/// What a world of that arithmetic keeps its fields in.
template <class Real>
struct Stored {
    using Position = Real;  ///< of a particle, cells
    using Velocity = Real;  ///< of a particle or a face, cells/s; a face's mass; scratch
    using Density = Real;   ///< of a cell, 1 = full
    using Level = Real;     ///< of the surface over a cell's centre, cells
    using Distance = Real;  ///< to the nearest solid at a node, cells
    using Share = Real;     ///< what solids leave open, 0 … 1
    using Slot = std::uint16_t;  ///< of the nearest body
    /// Velocities of faces take the lower halves of what their momentum stood in, and the pressure
    /// stage's scratch the upper ones.
    static constexpr bool shares_momentum = false;
    static constexpr bool coarse = false;  ///< places are known to 1/256 of a cell
    static constexpr int particle_mass = 1;  ///< on faces: 2 saves a bit of a velocity's format
};

/// 8 bytes a particle and 18 a cell (25 with static solids, 28 with moving ones, or for one body 24
/// and 26): positions to 1/256 of a cell, velocities to 1/128 cell/s below 256 cells/s, so a
/// world of at most 255 × 255 cells.
template <>
struct Stored<SmallFixed> {
    using Position = Packed<std::uint16_t, 8>;
    using Velocity = Packed<std::int16_t, 7>;
    using Density = Packed<std::uint8_t, 7>;
    using Level = Packed<std::int8_t, 6>;
    using Distance = Packed<std::int16_t, 8>;
    using Share = Packed<std::uint8_t, 7>;
    using Slot = ShortSlot;
    static constexpr bool shares_momentum = true;
    static constexpr bool coarse = true;
    static constexpr int particle_mass = 2;
};

template <class Real>
using PositionOf = typename Stored<Real>::Position;
template <class Real>
using VelocityOf = typename Stored<Real>::Velocity;
template <class Real>
using DensityOf = typename Stored<Real>::Density;
template <class Real>
using LevelOf = typename Stored<Real>::Level;
template <class Real>
using DistanceOf = typename Stored<Real>::Distance;
template <class Real>
using SlotOf = typename Stored<Real>::Slot;
template <class Real>
using ShareOf = typename Stored<Real>::Share;

}  // namespace weir
