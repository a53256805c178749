#include "geometry/moments.hpp"

#include "math/vec2.hpp"

namespace weir {

// By Green's theorem about the first vertex, ring by ring.
template <class Real>
Moments<Real> moments_of(const Outline<Real>& outline) {
    using Number = Face<Real>;
    const Vec2<Number> origin = convert<Number>(outline.vertex[0]);
    Number area = Number(0);
    Vec2<Number> first;
    Number second = Number(0);
    for (std::int32_t ring = 0; ring < outline.rings; ++ring) {
        Number ring_area = Number(0);
        Vec2<Number> ring_first;
        Number ring_second = Number(0);
        Vec2<Number> a = convert<Number>(outline.vertex[outline.end_of(ring) - 1]) - origin;
        for (std::int32_t k = outline.begin_of(ring); k < outline.end_of(ring); ++k) {
            const Vec2<Number> b = convert<Number>(outline.vertex[k]) - origin;
            const Number turn = cross(a, b);
            ring_area += turn;
            ring_first = ring_first + turn * (a + b);
            ring_second += turn * (dot(a, a) + dot(a, b) + dot(b, b));
            a = b;
        }
        const bool counts = (ring == 0) == (ring_area > Number(0));
        const Number sign = counts ? Number(0.5) : Number(-0.5);
        area += sign * ring_area;
        first = first + (sign / Number(3)) * ring_first;
        second += (sign / Number(6)) * ring_second;
    }
    Moments<Real> moments;
    moments.area = area;
    const Vec2<Number> offset = (Number(1) / area) * first;
    moments.centroid = origin + offset;
    moments.inertia = second - area * dot(offset, offset);
    return moments;
}

#define WEIR_INSTANTIATE(Real) \
    template Moments<Real> moments_of(const Outline<Real>&);
WEIR_FOR_EACH_NUMBER(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
