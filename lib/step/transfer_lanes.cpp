// Pairs {mass, momentum} and {velocity, change} lie where they are free: those of the v faces of a
// scatter and of the u faces of a gather in the grid's scratch, the others over the fields of
// the other component, which are written after, or were read before.
#include "step/transfer_lanes.hpp"

#include <cstring>

#include "math/four_lanes.hpp"
#include "step/transfer_wide.hpp"

namespace weir {

#if WEIR_HAS_LANES

namespace {

/// Runs over all rows, ghost rows included, as the work allows.
template <class Visit>
void each_row(Work work, const GridShape& s, const Visit& visit) {
    const Part all = work.take(s.ny + 2, s.nx + 2);
    work.share(all, s.nx + 2, 1, [&](const Part& rows, std::int32_t) {
        for_each_run(s, rows, visit);
    });
}

void unpack(const float* pairs, const Part& part, float* first, float* second) {
    std::int32_t k = part.first;
#if WEIR_HAS_WIDE_LANES
    if (has_wide_lanes()) {
        k = unpack_wide(pairs, k, part.end, first, second);
    }
#endif
    k = unpack_pairs<FourLanes>(pairs, k, part.end, first, second);
    for (; k < part.end; ++k) {
        first[k] = pairs[2 * k];
        second[k] = pairs[2 * k + 1];
    }
}

void pack(const float* first, const float* second, const Part& part, float* pairs) {
    std::int32_t k = part.first;
#if WEIR_HAS_WIDE_LANES
    if (has_wide_lanes()) {
        k = pack_wide(first, second, k, part.end, pairs);
    }
#endif
    k = pack_pairs<FourLanes>(first, second, k, part.end, pairs);
    for (; k < part.end; ++k) {
        pairs[2 * k] = first[k];
        pairs[2 * k + 1] = second[k];
    }
}

void scatter(const Particles<float>& particles, const Part& part, const Pairs<float>& pairs) {
    const float* position = &particles.position->x + 2 * part.first;
    const float* velocity = &particles.velocity->x + 2 * part.first;
    const std::int32_t count = part.end - part.first;
#if WEIR_HAS_WIDE_LANES
    if (has_wide_lanes()) {
        scatter_wide(position, velocity, count, pairs);
        return;
    }
#endif
    scatter_all<FourLanes>(position, velocity, count, pairs);
}

#if WEIR_PARALLEL

/// Particles that follow each other in the pool are looked at together: their lowest and highest
/// place say which rows they give to.
constexpr std::int32_t kTogether = kRun;

/// Rows that particles together may span on the average, if rows are to be done side by side.
constexpr float kWidestSpan = 12.0F;

struct Span {
    float low;
    float high;
};

Span span_of(const Vec2<float>* position, std::int32_t count) {
    Span span{position[0].y, position[0].y};
    std::int32_t k = 0;
    if (count >= 4) {  // two particles four numbers
        Lanes low = load_lanes(&position->x);
        Lanes high = low;
        Lanes low_too = low;
        Lanes high_too = low;
        for (; k + 4 <= count; k += 4) {
            const Lanes one = load_lanes(&position[k].x);
            const Lanes other = load_lanes(&position[k + 2].x);
            low = minimum(low, one);
            high = maximum(high, one);
            low_too = minimum(low_too, other);
            high_too = maximum(high_too, other);
        }
        low = minimum(low, low_too);
        high = maximum(high, high_too);
        span = {minimum(low[1], low[3]), maximum(high[1], high[3])};
    }
    for (; k < count; ++k) {
        span.low = minimum(span.low, position[k].y);
        span.high = maximum(span.high, position[k].y);
    }
    return span;
}

/// What some particles, of which not all are to be asked, give to entries of the arrays.
void scatter_to_some(const Particles<float>& particles, const Part& block, const Part& rows,
                     const Pairs<float>& pairs) {
    const std::ptrdiff_t first = static_cast<std::ptrdiff_t>(rows.first) * pairs.stride;
    const std::ptrdiff_t end = static_cast<std::ptrdiff_t>(rows.end) * pairs.stride;
    const auto low = static_cast<float>(rows.first) - 2.0F;
    const auto high = static_cast<float>(rows.end);
    const auto give = [&](float* field, std::ptrdiff_t entry, Lanes what) {
        if (entry >= first && entry < end) {
            FourLanes::add_group<0>(field + 2 * entry, what);
        }
    };
    const Vec2<float>* position = particles.position + block.first;
    Run run;
    find_stencils<FourLanes>(pairs.stride, &position->x, block.end - block.first, run);
    for (std::int32_t k = 0; k < block.end - block.first; ++k) {
        if (position[k].y < low || position[k].y >= high) {
            continue;
        }
        const Contribution<FourLanes> what = contribution<FourLanes>(
            run.weight[k], load_pair(&particles.velocity[block.first + k].x));
        const std::ptrdiff_t u = static_cast<std::ptrdiff_t>(run.u[k]) + 1;
        const std::ptrdiff_t v = static_cast<std::ptrdiff_t>(run.v[k]) + pairs.stride;
        give(pairs.u, u, what.lower_u);
        give(pairs.u, u + pairs.stride, what.upper_u);
        give(pairs.v, v, what.lower_v);
        give(pairs.v, v + pairs.stride, what.upper_v);
    }
}

/// Everything that particles give to some rows of the arrays, in the pool's order: the same sums
/// as if all rows were done at once.
void scatter_to_rows(const Particles<float>& particles, const Span* spans, const Part& rows,
                     const Pairs<float>& pairs) {
    const auto low = static_cast<float>(rows.first);
    const auto high = static_cast<float>(rows.end);
    // A particle in row j of the cells gives to rows j … j + 2 of the arrays.
    for (std::int32_t k = 0; k < particles.count; k += kTogether) {
        const Span& span = spans[k / kTogether];
        const Part block{k, minimum(k + kTogether, particles.count)};
        if (span.high < low - 2.0F || span.low >= high) {
            continue;
        }
        if (span.low >= low && span.high < high - 2.0F) {
            scatter(particles, block, pairs);
        } else {
            scatter_to_some(particles, block, rows, pairs);
        }
    }
}

/// Row by row instead of particle by particle. False: it was not worth it, nothing was done.
bool scatter_side_by_side(const Particles<float>& particles, const StaggeredGrid<float>& grid,
                          Work work, const Pairs<float>& pairs) {
    constexpr std::int32_t kCost = 4;  // units a particle: it takes as long as so many cells
    const GridShape& s = grid.shape;
    const std::int32_t blocks = (particles.count + kTogether - 1) / kTogether;
    const std::int32_t height = s.ny + 2;
    const Part rows{s.j0, s.j0 + height};
    // What lies about a border is looked at from both sides: two pieces if they are not too small,
    // more only of many rows.
    const std::int32_t least_rows = clamp(height / 2, 24, 40);
    const std::int32_t cost = particles.count / height * kCost;
    if (2 * blocks > grid.spans.size || work.pieces(height, cost, least_rows) <= 1) {
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
    work.share(rows, cost, least_rows, [&](const Part& some, std::int32_t) {
        scatter_to_rows(particles, spans, some, pairs);
    });
    return true;
}

#endif

}  // namespace

void scatter_in_lanes(const Particles<float>& particles, StaggeredGrid<float>& grid, Work work) {
    const GridShape& s = grid.shape;
    const Pairs<float> pairs{grid.as_pairs(grid.v), grid.pairs, s.stride};
    each_row(work, s, [&](const Part& entries) {
        const std::size_t bytes =
            2 * static_cast<std::size_t>(entries.end - entries.first) * sizeof(float);
        std::memset(pairs.u + 2 * entries.first, 0, bytes);
        std::memset(pairs.v + 2 * entries.first, 0, bytes);
    });
    const Part part = work.take(particles.count, 1);
    bool done = false;
#if WEIR_PARALLEL
    if (part.first == 0 && part.end == particles.count) {
        done = scatter_side_by_side(particles, grid, work, pairs);
    }
#endif
    if (!done) {
        scatter(particles, part, pairs);
    }
    each_row(work, s, [&](const Part& entries) {
        unpack(pairs.u, entries, grid.mass_u, grid.u);
    });
    each_row(work, s, [&](const Part& entries) {
        unpack(pairs.v, entries, grid.mass_v, grid.v);
    });
}

void pair_fields(StaggeredGrid<float>& grid, Work work) {
    each_row(work, grid.shape, [&](const Part& entries) {
        pack(grid.u, grid.mass_u, entries, grid.pairs);
    });
    each_row(work, grid.shape, [&](const Part& entries) {
        pack(grid.v, grid.mass_v, entries, grid.as_pairs(grid.u));
    });
}

#endif

}  // namespace weir
