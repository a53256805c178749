// Pairs {mass, momentum} and {velocity, change} lie where they are free: those of the v faces of a
// scatter and of the u faces of a gather in the grid's scratch, the others over the fields of
// the other component, which are written after, or were read before.
#include "step/transfer_lanes.hpp"

#include <cstring>

#include "step/stencil_lanes.hpp"

namespace weir {

#if WEIR_HAS_LANES

namespace {

inline void add(float* to, Lanes what) {
    store_lanes(to, load_lanes(to) + what);
}

/// Runs over all rows, ghost rows included, as the work allows.
template <class Visit>
void each_row(Work work, const GridShape& s, const Visit& visit) {
    const Part all = work.take(s.ny + 2, s.nx + 2);
    work.share(all, s.nx + 2, 1, [&](const Part& rows, std::int32_t) {
        for_each_run(s, rows, visit);
    });
}

/// Numbers of two fields side by side → the two fields.
void unpack(const float* pairs, const Part& part, float* first, float* second) {
    std::int32_t k = part.first;
    for (; k + 4 <= part.end; k += 4) {
        const Lanes a = load_lanes(pairs + 2 * k);
        const Lanes b = load_lanes(pairs + 2 * k + 4);
        store_lanes(first + k, shuffle<0, 2, 4, 6>(a, b));
        store_lanes(second + k, shuffle<1, 3, 5, 7>(a, b));
    }
    for (; k < part.end; ++k) {
        first[k] = pairs[2 * k];
        second[k] = pairs[2 * k + 1];
    }
}

void pack(const float* first, const float* second, const Part& part, float* pairs) {
    std::int32_t k = part.first;
    for (; k + 4 <= part.end; k += 4) {
        const Lanes a = load_lanes(first + k);
        const Lanes b = load_lanes(second + k);
        store_lanes(pairs + 2 * k, shuffle<0, 4, 1, 5>(a, b));
        store_lanes(pairs + 2 * k + 4, shuffle<2, 6, 3, 7>(a, b));
    }
    for (; k < part.end; ++k) {
        pairs[2 * k] = first[k];
        pairs[2 * k + 1] = second[k];
    }
}

/// What a particle adds to the four rows of its stencils.
struct Contribution {
    StencilPair at;
    Lanes lower_u;
    Lanes upper_u;
    Lanes lower_v;
    Lanes upper_v;
};

inline Contribution contribution(const float* position, const float* velocities,
                                 const Strides& strides) {
    const StencilPair at = stencils(strides, load_pair(position));
    const Lanes one = all_lanes(1.0F);
    const Lanes w1 = at.fx * at.fy;
    const Lanes right = at.fx - w1;
    const Lanes upper = at.fy - w1;
    const Lanes w0 = (one - at.fx) - upper;
    // Each weight once as it is and once with the velocity: mass, momentum.
    const Lanes given = shuffle<0, 4, 1, 5>(one, load_pair(velocities));
    const Lanes left_lower = w0 * given;
    const Lanes right_lower = right * given;
    const Lanes left_upper = upper * given;
    const Lanes right_upper = w1 * given;
    return {at, shuffle<0, 1, 4, 5>(left_lower, right_lower),
            shuffle<0, 1, 4, 5>(left_upper, right_upper),
            shuffle<2, 3, 6, 7>(left_lower, right_lower),
            shuffle<2, 3, 6, 7>(left_upper, right_upper)};
}

void scatter_all(const Particles<float>& particles, const Part& part, std::int32_t stride,
                 float* pairs_u, float* pairs_v) {
    const Strides strides(stride);
    const Vec2<float>* position = particles.position;
    const Vec2<float>* velocity = particles.velocity;
    pairs_u = strides.of_u(pairs_u);
    pairs_v = strides.of_v(pairs_v);
    for (std::int32_t k = part.first; k < part.end; ++k) {
        const Contribution c = contribution(&position[k].x, &velocity[k].x, strides);
        float* u = pairs_u + 2 * static_cast<std::size_t>(c.at.u);
        float* w = pairs_v + 2 * static_cast<std::size_t>(c.at.v);
        add(u, c.lower_u);
        add(u + strides.up, c.upper_u);
        add(w, c.lower_v);
        add(w + strides.up, c.upper_v);
    }
}

#if WEIR_PARALLEL

/// Particles that follow each other in the pool are looked at together: their lowest and highest
/// place say which rows they give to.
constexpr std::int32_t kTogether = 64;

/// Rows that particles together may span on the average, if rows are to be done side by side.
constexpr float kWidestSpan = 12.0F;

struct Span {
    float low;
    float high;
};

Span span_of(const Vec2<float>* position, std::int32_t count) {
    Span span{position[0].y, position[0].y};
    for (std::int32_t k = 1; k < count; ++k) {
        span.low = minimum(span.low, position[k].y);
        span.high = maximum(span.high, position[k].y);
    }
    return span;
}

/// Everything that particles give to some rows of the arrays, in the pool's order: the same sums
/// as if all rows were done at once.
void scatter_to_rows(const Particles<float>& particles, const Span* spans, const Part& rows,
                     std::int32_t stride, float* pairs_u, float* pairs_v) {
    const auto low = static_cast<float>(rows.first);
    const auto high = static_cast<float>(rows.end);
    const std::int32_t first = rows.first * stride;
    const std::int32_t end = rows.end * stride;
    const Strides strides(stride);
    // A particle in row j of the cells gives to rows j … j + 2 of the arrays.
    for (std::int32_t k = 0; k < particles.count; k += kTogether) {
        const Span& span = spans[k / kTogether];
        const Part block{k, minimum(k + kTogether, particles.count)};
        if (span.high < low - 2.0F || span.low >= high) {
            continue;
        }
        if (span.low >= low && span.high < high - 2.0F) {
            scatter_all(particles, block, stride, pairs_u, pairs_v);
            continue;
        }
        for (std::int32_t n = block.first; n < block.end; ++n) {
            const float y = particles.position[n].y;
            if (y < low - 2.0F || y >= high) {
                continue;
            }
            const Contribution c =
                contribution(&particles.position[n].x, &particles.velocity[n].x, strides);
            const auto give = [&](float* pairs, std::int32_t entry, Lanes what) {
                if (entry >= first && entry < end) {
                    add(pairs + 2 * entry, what);
                }
            };
            const std::int32_t u = static_cast<std::int32_t>(c.at.u) + 1;
            const std::int32_t v = static_cast<std::int32_t>(c.at.v) + stride;
            give(pairs_u, u, c.lower_u);
            give(pairs_u, u + stride, c.upper_u);
            give(pairs_v, v, c.lower_v);
            give(pairs_v, v + stride, c.upper_v);
        }
    }
}

/// Row by row instead of particle by particle. False: it was not worth it, nothing was done.
bool scatter_side_by_side(const Particles<float>& particles, const StaggeredGrid<float>& grid,
                          Work work, float* pairs_u, float* pairs_v) {
    constexpr std::int32_t kLeastRows = 24;  // two are done by both neighbours
    constexpr std::int32_t kCost = 4;  // units a particle: it takes as long as so many cells
    const GridShape& s = grid.shape;
    const std::int32_t blocks = (particles.count + kTogether - 1) / kTogether;
    const Part rows{0, s.ny + 2};
    const std::int32_t cost = particles.count / rows.end * kCost;
    if (2 * blocks > grid.spans.size ||
        work.pieces(rows.end, cost, kLeastRows) <= 1) {
        return false;
    }
    auto* spans = reinterpret_cast<Span*>(grid.spans.data);
    float wide[kMostPieces] = {};
    work.share({0, blocks}, kTogether, 1, [&](const Part& some, std::int32_t piece) {
        for (std::int32_t b = some.first; b < some.end; ++b) {
            const std::int32_t first = b * kTogether;
            spans[b] = span_of(particles.position + first,
                               minimum(kTogether, particles.count - first));
            wide[piece] += spans[b].high - spans[b].low;
        }
    });
    float all = 0.0F;
    for (const float some : wide) {
        all += some;
    }
    if (all > kWidestSpan * static_cast<float>(blocks)) {
        return false;
    }
    work.share(rows, cost, kLeastRows, [&](const Part& some, std::int32_t) {
        scatter_to_rows(particles, spans, some, s.stride, pairs_u, pairs_v);
    });
    return true;
}

#endif

}  // namespace

void scatter_in_lanes(const Particles<float>& particles, StaggeredGrid<float>& grid, Work work) {
    const GridShape& s = grid.shape;
    float* pairs_u = grid.v;
    float* pairs_v = grid.pairs;
    each_row(work, s, [&](const Part& entries) {
        const std::size_t bytes =
            2 * static_cast<std::size_t>(entries.end - entries.first) * sizeof(float);
        std::memset(pairs_u + 2 * entries.first, 0, bytes);
        std::memset(pairs_v + 2 * entries.first, 0, bytes);
    });
    const Part part = work.take(particles.count, 1);
    bool done = false;
#if WEIR_PARALLEL
    if (part.first == 0 && part.end == particles.count) {
        done = scatter_side_by_side(particles, grid, work, pairs_u, pairs_v);
    }
#endif
    if (!done) {
        scatter_all(particles, part, s.stride, pairs_u, pairs_v);
    }
    each_row(work, s, [&](const Part& entries) {
        unpack(pairs_u, entries, grid.mass_u, grid.u);
    });
    each_row(work, s, [&](const Part& entries) {
        unpack(pairs_v, entries, grid.mass_v, grid.v);
    });
}

void pair_fields(StaggeredGrid<float>& grid, Work work) {
    each_row(work, grid.shape, [&](const Part& entries) {
        pack(grid.u, grid.mass_u, entries, grid.pairs);
    });
    each_row(work, grid.shape, [&](const Part& entries) {
        pack(grid.v, grid.mass_v, entries, grid.u);
    });
}

#endif

}  // namespace weir
