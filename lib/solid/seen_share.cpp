// A row of a face's kernel is seen but for what edges hide: between places where an edge, or the
// shadow of an edge's end, crosses it. These go through the kernel on straight lines, so what is
// seen of a row times its weight is a cubic between the heights where one begins or ends; two Gauss
// points each give its integral.
#include "solid/seen_share.hpp"

namespace weir {

namespace {

constexpr std::int32_t kMostEdges = 12;
constexpr std::int32_t kMostPlaces = 14;   // of a row, its ends among them
constexpr std::int32_t kMostHeights = 32;  // its lowest and highest row among them

/// An edge as a face sees it.
template <class Real>
struct EdgeAround {
    const WallEdge* record;
    Vec2<Real> a;
    Vec2<Real> b;
    bool face_on_left;

    bool hides(Vec2<Real> place) const {
        const Product<Real> zero{};
        return is_left_of(place, a, b) != face_on_left &&
               (cross(place, a) >= zero) != (cross(place, b) >= zero);
    }
};

/// A face's kernel, two cells wide and high, and the edges in it. Places are seen from the face.
template <class Real>
struct Kernel {
    Vec2<Real> face;
    Real left;   ///< −1, or the tank's wall
    Real right;
    Real tank_height;
    EdgeAround<Real> edge[kMostEdges];
    std::int32_t edges = 0;

    Kernel(const ThinWalls<Real>& thin, const GridShape& s, Vec2<Real> face_)
        : face(face_), left(maximum(Real(-1), Real(0) - face.x)),
          right(minimum(Real(1), static_cast<Real>(s.nx) - face.x)),
          tank_height(static_cast<Real>(s.ny)) {
        const std::int32_t i = floor_to_int(face.x);
        const std::int32_t j = floor_to_int(face.y);
        for_each_wall_edge(thin, s, i - 1, j - 1, i + 1, j + 1, [&](const WallEdge& record) {
            const Vec2<Real> a = thin.vertex[record.from] - face;
            const Vec2<Real> b = thin.vertex[record.to] - face;
            if (minimum(a.x, b.x) < right && maximum(a.x, b.x) > left &&
                minimum(a.y, b.y) < Real(1) && maximum(a.y, b.y) > Real(-1)) {
                add({&record, a, b, is_left_of(Vec2<Real>{}, a, b)});
            }
        });
    }

    bool hides(Vec2<Real> place) const {
        for (std::int32_t k = 0; k < edges; ++k) {
            if (edge[k].hides(place)) {
                return true;
            }
        }
        return false;
    }

private:
    /// In their bodies' order, each once: of more than there is room for always the same ones.
    void add(const EdgeAround<Real>& one) {
        std::int32_t place = edges;
        while (place > 0 && goes_before(*one.record, *edge[place - 1].record)) {
            --place;
        }
        if (place == kMostEdges ||
            (place > 0 && !goes_before(*edge[place - 1].record, *one.record))) {
            return;
        }
        edges = minimum(edges + 1, kMostEdges);
        for (std::int32_t k = edges - 1; k > place; --k) {
            edge[k] = edge[k - 1];
        }
        edge[place] = one;
    }
};

/// Numbers in order. What there is no room for is left out.
template <class Real, std::int32_t kMost>
struct Sorted {
    Real at[kMost];
    std::int32_t count = 0;

    [[gnu::noinline]] void add(Real x) {
        if (count == kMost) {
            return;
        }
        std::int32_t place = count++;
        for (; place > 0 && x < at[place - 1]; --place) {
            at[place] = at[place - 1];
        }
        at[place] = x;
    }
};

/// Integral of the hat function from −1 to x, −1 … 1.
template <class Real>
Real hat_integral(Real x) {
    constexpr Real kHalf = Real(0.5);
    const Real beyond = Real(1) - absolute(x);
    const Real part = kHalf * (beyond * beyond);
    return x < Real(0) ? part : Real(1) - part;
}

/// Calls visit(x) where an end's shadow crosses the row at a height, if it does in the kernel.
template <class Real, class Visit>
void for_shadow(Vec2<Real> end, Real y, Visit visit) {
    const bool behind = y < Real(0) ? end.y < Real(0) && y < end.y : end.y > Real(0) && y > end.y;
    if (behind && absolute(end.x * y) < absolute(end.y)) {
        visit(end.x * y / end.y);
    }
}

/// What the face sees of a row of the kernel, times the hat along it.
template <class Real>
Real seen_of_row(const Kernel<Real>& kernel, Real y) {
    Sorted<Real, kMostPlaces> places;
    places.add(kernel.left);
    places.add(kernel.right);
    const auto add = [&](Real x) {
        if (kernel.left < x && x < kernel.right) {
            places.add(x);
        }
    };
    for (std::int32_t k = 0; k < kernel.edges; ++k) {
        const Vec2<Real> a = kernel.edge[k].a;
        const Vec2<Real> b = kernel.edge[k].b;
        if ((a.y < y) != (b.y < y)) {
            add(a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x));
        }
        for_shadow(a, y, add);
        for_shadow(b, y, add);
    }
    Real seen = Real(0);
    Real before = hat_integral(kernel.left);
    for (std::int32_t k = 1; k < places.count; ++k) {
        const Real middle = Real(0.5) * (places.at[k - 1] + places.at[k]);
        const Real so_far = hat_integral(places.at[k]);
        seen += kernel.hides({middle, y}) ? Real(0) : so_far - before;
        before = so_far;
    }
    return seen;
}

/// Heights at which what is seen of a row, or its weight, changes in another way.
template <class Real>
struct Heights : Sorted<Real, kMostHeights> {
    explicit Heights(const Kernel<Real>& kernel) {
        const Real floor = Real(0) - kernel.face.y;
        const Real ceiling = kernel.tank_height - kernel.face.y;
        const auto add = [&](Real y) {
            if (Real(-1) < y && y < Real(1)) {
                this->add(y);
            }
        };
        const auto add_all = [&](Real y) {  // with its images beyond the tank's floor and ceiling
            add(y);
            add(floor + (floor - y));
            add(ceiling + (ceiling - y));
        };
        this->add(Real(-1));
        this->add(Real(0));
        this->add(Real(1));
        add(floor);
        add(ceiling);
        for (std::int32_t k = 0; k < kernel.edges; ++k) {
            const Vec2<Real> a = kernel.edge[k].a;
            const Vec2<Real> b = kernel.edge[k].b;
            const Real columns[] = {kernel.left, Real(0), kernel.right};
            for (const Real x : columns) {
                if ((a.x < x) != (b.x < x)) {
                    add_all(a.y + (x - a.x) / (b.x - a.x) * (b.y - a.y));
                }
            }
            const Vec2<Real> ends[] = {a, b};
            for (const Vec2<Real> end : ends) {
                add_all(end.y);
                for_shadow({end.y, end.x}, end.x < Real(0) ? kernel.left : kernel.right, add_all);
            }
        }
    }
};

}  // namespace

template <class Real>
Real seen_share(const ThinWalls<Real>& thin, const GridShape& s, Vec2<Real> face) {
    const Kernel<Real> kernel(thin, s, face);
    if (kernel.edges == 0) {
        return Real(1);
    }
    const Heights<Real> heights(kernel);
    constexpr Real kHalf = Real(0.5);
    const Real gauss = Real(0.57735027);  // two places, exact for cubics
    Real sum = Real(0);
    for (std::int32_t k = 0; k + 1 < heights.count; ++k) {
        const Real middle = kHalf * (heights.at[k] + heights.at[k + 1]);
        const Real half = kHalf * (heights.at[k + 1] - heights.at[k]);
        if (half == Real(0)) {
            continue;
        }
        const Real offsets[] = {middle - gauss * half, middle + gauss * half};
        for (const Real offset : offsets) {
            Real y = absolute(face.y + offset);
            y = y > kernel.tank_height ? kernel.tank_height + kernel.tank_height - y : y;
            sum += half * (Real(1) - absolute(offset)) * seen_of_row(kernel, y - face.y);
        }
    }
    return sum / (hat_integral(kernel.right) - hat_integral(kernel.left));
}

#define WEIR_INSTANTIATE(Real) \
    template Real seen_share(const ThinWalls<Real>&, const GridShape&, Vec2<Real>);
WEIR_FOR_EACH_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
