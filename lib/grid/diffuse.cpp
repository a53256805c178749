#include "grid/diffuse.hpp"

namespace weir {

template <class Real>
void diffuse(const GridShape& s, const LevelOf<Real>* level, std::int32_t back,
             std::int32_t first_i, std::int32_t first_j, Real amount, const VelocityOf<Real>* field,
             VelocityOf<Real>* out) {
    const auto wet = [&](std::int32_t face) {
        return level[face] > kEmptyLevel<Real> && level[face - back] > kEmptyLevel<Real>;
    };
    // The face before the one on the seam has cells that lie two beyond it: its image has not.
    const std::int32_t period = back * (back == 1 ? s.nx : s.ny);
    for (std::int32_t j = first_j; j < s.ny; ++j) {
        for (std::int32_t i = first_i; i < s.nx; ++i) {
            const std::int32_t face = s.index(i, j);
            if (!wet(face)) {
                continue;
            }
            const Real here = field[face];
            const bool on_seam = (back == 1 ? i : j) == 0;
            const auto pull = [&](std::int32_t neighbour) {
                const bool beyond = on_seam && neighbour == face - back;
                return wet(beyond ? neighbour + period : neighbour) ? field[neighbour] - here
                                                                    : Real(0);
            };
            out[face] = here + amount * ((pull(face - 1) + pull(face + 1)) +
                                         (pull(face - s.stride) + pull(face + s.stride)));
        }
    }
}

template void diffuse(const GridShape&, const float*, std::int32_t, std::int32_t, std::int32_t,
                      float, const float*, float*);
template void diffuse(const GridShape&, const double*, std::int32_t, std::int32_t, std::int32_t,
                      double, const double*, double*);
template void diffuse(const GridShape&, const Fixed*, std::int32_t, std::int32_t, std::int32_t,
                      Fixed, const Fixed*, Fixed*);
template void diffuse(const GridShape&, const LevelOf<SmallFixed>*, std::int32_t, std::int32_t,
                      std::int32_t, SmallFixed, const VelocityOf<SmallFixed>*,
                      VelocityOf<SmallFixed>*);

}  // namespace weir
