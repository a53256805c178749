#include "lattice.hpp"

#include <cmath>

namespace accuracy {

namespace {

constexpr double kTurnDegrees = 17.3;
constexpr double kPi = 3.14159265358979323846;
constexpr Vector kShift{0.1873, 0.3391};  // of a cell; drawn once

}  // namespace

const char* lattice_name(Lattice lattice) {
    return lattice == Lattice::aligned ? "aligned"
                                       : lattice == Lattice::shifted ? "shifted" : "rotated";
}

Particles seed(Lattice lattice, Vector low, Vector high, const Region& region) {
    const double turn = lattice == Lattice::rotated ? kTurnDegrees * kPi / 180.0 : 0.0;
    const double c = std::cos(turn);
    const double s = std::sin(turn);
    const Vector origin = lattice == Lattice::aligned ? Vector{} : kShift;
    const double reach = std::hypot(high.x - low.x, high.y - low.y);
    const int most = static_cast<int>(std::ceil(reach / kSpacing)) + 2;
    // The lattice's own origin is the grid node next to the middle of the box.
    const Vector middle{std::floor(0.5 * (low.x + high.x)), std::floor(0.5 * (low.y + high.y))};
    Particles particles;
    for (int b = -most; b < most; ++b) {
        for (int a = -most; a < most; ++a) {
            const Vector at{kSpacing * (a + 0.5), kSpacing * (b + 0.5)};
            const Vector x = middle + origin + Vector{c * at.x - s * at.y, s * at.x + c * at.y};
            if (x.x >= low.x && x.x < high.x && x.y >= low.y && x.y < high.y && region(x)) {
                particles.push_back({x, {}});
            }
        }
    }
    return particles;
}

Particles seed_box(Lattice lattice, Vector low, Vector high) {
    return seed(lattice, {low.x + kWallGap, low.y + kWallGap}, high, [](Vector) { return true; });
}

Particles seed_disc(Lattice lattice, Vector centre, double radius) {
    const Vector arm{radius + 1.0, radius + 1.0};
    return seed(lattice, centre - arm, centre + arm, [&](Vector x) {
        return dot(x - centre, x - centre) < radius * radius;
    });
}

}  // namespace accuracy
