// Where packed particles stand on a grid of packed faces, in bytes from the first face.
#pragma once

#include "fluid/particles.hpp"
#include "math/packed_arithmetic.hpp"

namespace weir {

namespace packed {

using Real = SmallFixed;
using Speed = VelocityOf<Real>;
using Place = PositionOf<Real>;

static_assert(sizeof(Place) == 2 && sizeof(Speed) == 2, "the loops below know these formats");
static_assert(Real(Place::of_raw(1)).raw == 256, "places are 256ths");
static_assert(Real(Speed::of_raw(1)).raw == 512, "velocities are 128ths");
static_assert(Stored<Real>::particle_mass == 2, "256 units of mass a particle");

static_assert(kLittleEndian, "x stands first");

/// From the faces of a kind to the corners of the cells that they are in the middle of.
template <bool OnU>
inline constexpr std::uint32_t kHalf = OnU ? 128U << 16U : 128U;

/// What there is of a face and around it, in bytes from where it will be blended.
struct FacesAround {
    std::ptrdiff_t now;
    std::ptrdiff_t was;
    std::ptrdiff_t lower;
    std::ptrdiff_t upper;
    std::ptrdiff_t diagonal;  ///< of the cell behind it
    std::ptrdiff_t before;    ///< of that before it
};

/// What the four faces around a point get, 256ths that add up to 256.
struct Weights {
    std::int32_t lower_left;
    std::int32_t lower_right;
    std::int32_t upper_left;
    std::int32_t upper_right;
};

inline Weights weights_of(std::uint32_t at) {
    const std::int32_t fx = low_byte(at);
    const std::int32_t fy = low_byte(at >> 16U);
    const std::int32_t both = (fx * fy + 128) >> 8;
    const std::int32_t upper = fy - both;
    return {256 - fx - upper, fx - both, upper, both};
}

inline constexpr std::int32_t kSpeedBytes = sizeof(Speed);
static_assert(sizeof(Real) == 2 * kSpeedBytes, "momenta are twice as far apart");

/// An array's entry so many bytes further on.
template <class Number>
inline Number* further(Number* from, std::ptrdiff_t bytes) {
    return reinterpret_cast<Number*>(reinterpret_cast<char*>(from) + bytes);
}
template <class Number>
inline const Number* further(const Number* from, std::ptrdiff_t bytes) {
    return reinterpret_cast<const Number*>(reinterpret_cast<const char*>(from) + bytes);
}

/// Between two arrays in the caller's memory.
inline std::ptrdiff_t bytes_between(const Speed* from, const Speed* to) {
    return reinterpret_cast<const char*>(to) - reinterpret_cast<const char*>(from);
}

/// The first of those faces, in bytes of velocities from the first one of the kind; `row`: bytes.
inline std::int32_t base_of(std::uint32_t at, std::int32_t row) {
    return static_cast<std::int32_t>(at >> 24U) * row + low_byte(at >> 8U) * kSpeedBytes;
}

/// The same as a place.
template <class Number>
inline Number* first_face(Number* first, std::uint32_t at, std::int32_t row) {
    Number* in_row = whole(further(first, static_cast<std::int32_t>(at >> 24U) * row));
    return further(in_row, low_byte(at >> 8U) * kSpeedBytes);
}

/// Particles with numbers from below 0 up to 0, told by the bytes to the end of the arrays: a
/// single register leads through both of them and says where they end.
struct Strip {
    static constexpr std::ptrdiff_t kStep = 4;
    char* places;
    char* velocities;
    std::ptrdiff_t first;

    explicit Strip(const Particles<Real>& particles)
        : places(whole(reinterpret_cast<char*>(particles.position + particles.count))),
          velocities(whole(reinterpret_cast<char*>(particles.velocity + particles.count))),
          first(-particles.count * kStep) {}

    std::uint32_t word(std::ptrdiff_t at) const { return word_at(places + at); }
    Vec2<Place>& place(std::ptrdiff_t at) const {
        return *reinterpret_cast<Vec2<Place>*>(places + at);
    }
    Vec2<Speed>& velocity(std::ptrdiff_t at) const {
        return *reinterpret_cast<Vec2<Speed>*>(velocities + at);
    }
};
static_assert(sizeof(Vec2<Place>) == Strip::kStep && sizeof(Vec2<Speed>) == Strip::kStep);

}  // namespace packed

}  // namespace weir
