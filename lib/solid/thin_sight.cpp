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
    std::int32_t known[4] = {-1, -1, -1, -1};  // an edge comes once a cell
    std::uint32_t looks = 0;
    for_each_wall_edge(thin, s, i - 1, j - 1, i + 1, j + 1, [&](const WallEdge& edge) {
        if (edge.from == known[0] || edge.from == known[1] || edge.from == known[2] ||
            edge.from == known[3]) {
            return;
        }
        known[looks++ % 4] = edge.from;
        const Vec2<Real> a = thin.vertex[edge.from];
        const Vec2<Real> b = thin.vertex[edge.to];
        const bool left = is_left_of(point, a, b);
        const auto look = [&](std::uint32_t bit, Vec2<Real> face) {
            if ((seen & bit) != 0 && is_left_of(face, a, b) != left &&
                cross_edge(point, face, a, b).found) {
                seen &= ~bit;
            }
        };
        for (std::uint32_t node = 0; node < 4; ++node) {
            const auto across = static_cast<std::int32_t>(node & 1U);
            const auto up = static_cast<std::int32_t>(node >> 1U);
            look(1U << node, {static_cast<Real>(i + across),
                              static_cast<Real>(upper + up) - kHalf});
            look(16U << node, {static_cast<Real>(right + across) - kHalf,
                               static_cast<Real>(j + up)});
        }
    });
    return seen;
}

#define WEIR_INSTANTIATE(Real) \
    template std::uint32_t seen_faces(const ThinWalls<Real>&, const GridShape&, Vec2<Real>);
WEIR_FOR_EACH_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
