// What a world with an equation of state has besides.
#include "pressure/equation_of_state.hpp"
#include "pressure/project.hpp"
#include "step/grid_update.hpp"

namespace weir {

namespace {

template <class Real>
void push(const Domain<Real>& domain, const Part& rows) {
    if (domain.walls.active) {
        project(domain.template face_weights<true, false>(), rows, domain.fields, domain.grid);
    } else {
        project(domain.template face_weights<false, false>(), rows, domain.fields, domain.grid);
    }
}

template <class Real>
constexpr detail::Elasticity<Real> stages() {
    detail::Elasticity<Real> all{follow_sound<Real>,     carry_pressure<Real>, compress<Real>,
                                 release_pressure<Real>, nullptr,              nullptr};
    if constexpr (Stored<Real>::coarse) {
        all.push = push<Real>;
        all.extrapolate = extrapolate_by_face<Real>;
    }
    return all;
}

}  // namespace

template <class Real>
const detail::Elasticity<Real>& detail::elasticity() {
    static constexpr Elasticity<Real> kStages = stages<Real>();
    return kStages;
}

#define WEIR_INSTANTIATE(Real) template const detail::Elasticity<Real>& detail::elasticity<Real>();
WEIR_FOR_EACH_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
