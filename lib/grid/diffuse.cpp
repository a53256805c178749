#include "grid/diffuse.hpp"

#include "grid/diffuse_lanes.hpp"

namespace weir {

namespace {

/// What is partly empty is known where its particles are, not where its face is: it hardly rubs.
template <class Real>
Real cube(Real volume) {
    return (volume * volume) * volume;
}

/// What pulls on a face, and by how much of it each of its four neighbours does.
template <class Real>
struct PulledFace {
    const GridShape& s;
    const Rubbing<Real>& faces;
    const Rubbing<Real>& other;
    std::int32_t face;
    std::int32_t image;  ///< from the face before it along its own axis to that one's image
    Real own;

    std::int32_t image_of(std::int32_t neighbour) const {
        return neighbour == face - faces.share.back ? neighbour + image : neighbour;
    }
    Real part_of(Real mass) const { return mass < own ? mass / own : Real(1); }
    Real difference(std::int32_t neighbour) const {
        return Real(faces.field[neighbour]) - Real(faces.field[face]);
    }

    /// Whether the stress' second part adds up to none: all of the six cells around are half full,
    /// and of the faces that pull none has less volume or is lighter.
    bool is_amid() const {
        const DensityOf<Real>* const density = faces.share.density;
        const std::int32_t back = faces.share.back;
        const std::int32_t side = other.share.back;
        constexpr Real kHalf = Real(kHalfFull);
        const auto half_full = [&](std::int32_t cell) {
            return !(Real(density[cell]) < kHalf) && !(Real(density[cell - side]) < kHalf) &&
                   !(Real(density[cell + side]) < kHalf);
        };
        return half_full(face) && half_full(face - back) &&
               !(faces.share.volume(face + back) < Real(1)) &&
               !(faces.share.volume(image_of(face - back)) < Real(1)) &&
               (Stored<Real>::shares_momentum || faces.share.light == nullptr || is_lightest());
    }

    bool is_lightest() const {
        const VelocityOf<Real>* const own_light = faces.share.light;
        const VelocityOf<Real>* const other_light = other.share.light;
        const std::int32_t back = faces.share.back;
        const std::int32_t side = other.share.back;
        const Real here = own_light[face];
        const auto heavier = [&](const VelocityOf<Real>* light, std::int32_t low,
                                 std::int32_t high) {
            return !(here < Real(light[low])) && !(here < Real(light[high]));
        };
        return heavier(own_light, image_of(face - back), face + back) &&
               heavier(own_light, face - side, face + side) &&
               heavier(other_light, face - back, face) &&
               heavier(other_light, face + side - back, face + side);
    }

    /// Σ over the four neighbours of what they pull, amid liquid: the Laplacian's. Only by solids
    /// one may hold less.
    Real laplacian() const {
        const auto pull = [&](std::int32_t neighbour) {
            const Real towards = difference(neighbour);
            return faces.share.open == nullptr
                       ? towards
                       : towards * part_of(faces.share.at(image_of(neighbour)));
        };
        return (pull(face - 1) + pull(face + 1)) + (pull(face - s.stride) + pull(face + s.stride));
    }

    /// The same of the stress, each by the least mass of the four faces that it is between.
    Real stress(bool low_wall, bool high_wall) const {
        const std::int32_t back = faces.share.back;
        const std::int32_t side = other.share.back;
        struct Beside {
            Real velocity;
            Real volume;
            Real mass;
        };
        const auto look = [&](std::int32_t at) {
            const Real volume = other.share.volume(at);
            const Real mass = volume > Real(0) ? other.share.mass_of(at, volume) : Real(0);
            return Beside{Real(other.field[at]), volume, mass};
        };
        const Beside near = look(face);
        const Beside near_back = look(face - back);
        const Beside far = look(face + side);
        const Beside far_back = look(face + side - back);
        const Real own_volume = faces.share.volume(face);
        const auto pull = [&](std::int32_t neighbour, const Beside& plus, const Beside& minus,
                              bool wall) {
            const std::int32_t at = image_of(neighbour);
            const Real mass = faces.share.at(at);
            if (wall) {
                return difference(neighbour) * part_of(mass);
            }
            const Real least = minimum(minimum(own_volume, faces.share.volume(at)),
                                       minimum(plus.volume, minus.volume));
            if (!(least > Real(0))) {
                return Real(0);
            }
            const Real lesser = minimum(mass, minimum(plus.mass, minus.mass));
            const Real turning = plus.velocity - minus.velocity;
            return (difference(neighbour) + turning) * (cube(least) * part_of(lesser));
        };
        return (pull(face - back, far_back, near_back, false) +
                pull(face + back, near, far, false)) +
               (pull(face - side, near_back, near, low_wall) +
                pull(face + side, far, far_back, high_wall));
    }
};

}  // namespace

template <class Real>
void diffuse(const GridShape& s, const Rubbing<Real>& faces, const Rubbing<Real>& other,
             const Part& rows, Real amount, std::int32_t from, VelocityOf<Real>* out) {
    const FaceShare<Real>& share = faces.share;
    const bool along_x = share.back == 1;
    // The face before the one on the seam has cells that lie two beyond it: its image has not.
    const std::int32_t period = share.back * (along_x ? s.nx : s.ny);
    const std::int32_t last = (along_x ? s.ny : s.nx) - 1;
    for (std::int32_t j = maximum(faces.first_j, rows.first); j < rows.end; ++j) {
        const std::int32_t row = s.index(0, j);
        const auto one = [&](std::int32_t i) {
            const std::int32_t face = row + i;
            const Real own = share.at(face);
            if (!(own > Real(0))) {
                return;
            }
            const bool on_seam = (along_x ? i : j) == 0;
            const PulledFace<Real> pulled{s, faces, other, face, on_seam ? period : 0, own};
            const std::int32_t aside = along_x ? j : i;
            const Real sum = pulled.is_amid()
                                 ? pulled.laplacian()
                                 : pulled.stress(faces.between_walls && aside == 0,
                                                 faces.between_walls && aside == last);
            out[face] = changed<Real>(faces.field[face], Real(faces.field[face]) + amount * sum,
                                      from);
        };
        std::int32_t i = faces.first_i;
        if constexpr (kHasLanes<Real>) {
            if (along_x && i == 0) {
                one(i++);
            }
            if (share.light == nullptr && (along_x || j > 0)) {
                i = diffuse_lanes(share, s.stride, amount, faces.field, row + i, row + s.nx, out,
                                  [&](std::int32_t face) { one(face - row); }) - row;
            }
        }
        for (; i < s.nx; ++i) {
            one(i);
        }
    }
}

#define WEIR_INSTANTIATE(Real)                                                             \
    template void diffuse(const GridShape&, const Rubbing<Real>&, const Rubbing<Real>&,    \
                          const Part&, Real, std::int32_t, VelocityOf<Real>*);
WEIR_FOR_EACH_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
