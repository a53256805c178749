#include "grid/diffuse.hpp"

namespace weir {

template <class Real>
void diffuse(const GridShape& s, const FaceShare<Real>& share, std::int32_t first_i,
             std::int32_t first_j, Real amount, const VelocityOf<Real>* field,
             VelocityOf<Real>* out) {
    const bool along_x = share.back == 1;
    // The face before the one on the seam has cells that lie two beyond it: its image has not.
    const std::int32_t period = share.back * (along_x ? s.nx : s.ny);
    for (std::int32_t j = first_j; j < s.ny; ++j) {
        for (std::int32_t i = first_i; i < s.nx; ++i) {
            const std::int32_t face = s.index(i, j);
            const Real own = share.at(face);
            if (!(own > Real(0))) {
                continue;
            }
            const Real here = field[face];
            const bool on_seam = (along_x ? i : j) == 0;
            const auto pull = [&](std::int32_t neighbour) {
                const bool beyond = on_seam && neighbour == face - share.back;
                const Real other = share.at(beyond ? neighbour + period : neighbour);
                const Real difference = field[neighbour] - here;
                return other < own ? difference * (other / own) : difference;
            };
            out[face] = here + amount * ((pull(face - 1) + pull(face + 1)) +
                                         (pull(face - s.stride) + pull(face + s.stride)));
        }
    }
}

template void diffuse(const GridShape&, const FaceShare<float>&, std::int32_t, std::int32_t, float,
                      const float*, float*);
template void diffuse(const GridShape&, const FaceShare<double>&, std::int32_t, std::int32_t,
                      double, const double*, double*);
template void diffuse(const GridShape&, const FaceShare<Fixed>&, std::int32_t, std::int32_t, Fixed,
                      const Fixed*, Fixed*);
template void diffuse(const GridShape&, const FaceShare<SmallFixed>&, std::int32_t, std::int32_t,
                      SmallFixed, const VelocityOf<SmallFixed>*, VelocityOf<SmallFixed>*);

}  // namespace weir
