#include "grid/diffuse.hpp"

#include "grid/diffuse_lanes.hpp"

namespace weir {

template <class Real>
void diffuse(const GridShape& s, const FaceShare<Real>& share, std::int32_t first_i,
             std::int32_t first_j, const Part& rows, Real amount, std::int32_t from,
             const VelocityOf<Real>* field, VelocityOf<Real>* out) {
    const bool along_x = share.back == 1;
    // The face before the one on the seam has cells that lie two beyond it: its image has not.
    const std::int32_t period = share.back * (along_x ? s.nx : s.ny);
    for (std::int32_t j = maximum(first_j, rows.first); j < rows.end; ++j) {
        const std::int32_t row = s.index(0, j);
        const auto one = [&](std::int32_t i) {
            const std::int32_t face = row + i;
            const Real own = share.at(face);
            if (!(own > Real(0))) {
                return;
            }
            const Real here = field[face];
            const bool on_seam = (along_x ? i : j) == 0;
            const auto pull = [&](std::int32_t neighbour) {
                const bool beyond = on_seam && neighbour == face - share.back;
                const Real other = share.at(beyond ? neighbour + period : neighbour);
                const Real difference = field[neighbour] - here;
                return other < own ? difference * (other / own) : difference;
            };
            const Real sum = (pull(face - 1) + pull(face + 1)) +
                             (pull(face - s.stride) + pull(face + s.stride));
            out[face] = changed<Real>(field[face], here + amount * sum, from);
        };
        std::int32_t i = first_i;
        if constexpr (kHasLanes<Real>) {
            if (along_x && i == 0) {
                one(i++);
            }
            if (share.light == nullptr && (along_x || j > 0)) {
                i = diffuse_lanes(share, s.stride, amount, field, row + i, row + s.nx, out) - row;
            }
        }
        for (; i < s.nx; ++i) {
            one(i);
        }
    }
}

#define WEIR_INSTANTIATE(Real)                                                          \
    template void diffuse(const GridShape&, const FaceShare<Real>&, std::int32_t,       \
                          std::int32_t, const Part&, Real, std::int32_t,                \
                          const VelocityOf<Real>*, VelocityOf<Real>*);
WEIR_FOR_EACH_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
