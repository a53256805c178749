#include "solid/thin_sight.hpp"

namespace weir {

template <class Real>
std::uint32_t seen_faces(const ThinWalls<Real>& thin, const GridShape& s, Vec2<Real> point) {
    constexpr Real kHalf = Real(0.5);
    const auto i = static_cast<std::int32_t>(point.x);
    const auto j = static_cast<std::int32_t>(point.y);
    const auto upper = static_cast<std::int32_t>(point.y + kHalf);  // of the u faces around it
    const auto right = static_cast<std::int32_t>(point.x + kHalf);  // of the v faces
    std::uint32_t seen = 0xFFU;
    for_each_wall_edge(thin, s, i - 1, j - 1, i + 1, j + 1, [&](const WallEdge& edge) {
        const Vec2<Real> a = thin.vertex[edge.from];
        const Vec2<Real> b = thin.vertex[edge.to];
        for (std::uint32_t node = 0; node < 4; ++node) {
            const auto across = static_cast<std::int32_t>(node & 1U);
            const auto up = static_cast<std::int32_t>(node >> 1U);
            const Vec2<Real> u{static_cast<Real>(i + across),
                               static_cast<Real>(upper + up) - kHalf};
            const Vec2<Real> v{static_cast<Real>(right + across) - kHalf,
                               static_cast<Real>(j + up)};
            if ((seen >> node & 1U) != 0 && cross_edge(point, u, a, b).found) {
                seen &= ~(1U << node);
            }
            if ((seen >> (4 + node) & 1U) != 0 && cross_edge(point, v, a, b).found) {
                seen &= ~(16U << node);
            }
        }
    });
    return seen;
}

#define WEIR_INSTANTIATE(Real) \
    template std::uint32_t seen_faces(const ThinWalls<Real>&, const GridShape&, Vec2<Real>);
WEIR_FOR_EACH_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
