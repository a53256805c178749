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
    scatter_all<FourLanes>(position, velocity, count, pairs, EveryRow());
}

#if WEIR_PARALLEL

/// What particles give to u faces, or to v faces.
void scatter_kind(const Particles<float>& particles, bool on_u, const Pairs<float>& pairs) {
    const float* position = &particles.position->x;
    const float* velocity = &particles.velocity->x;
#if WEIR_HAS_WIDE_LANES
    if (has_wide_lanes()) {
        scatter_component_wide(position, velocity, particles.count, pairs, on_u);
        return;
    }
#endif
    const auto some = on_u ? scatter_component<FourLanes, true>
                           : scatter_component<FourLanes, false>;
    some(position, velocity, particles.count, pairs);
}

/// Particles that follow each other in the pool are looked at together: their lowest and highest
/// place say which rows they give to.
constexpr std::int32_t kTogether = kRun;

/// Of two pieces, and of each of more: two rows about a cut are done twice.
constexpr std::int32_t kLeastRows = 24;
constexpr std::int32_t kRowsOfEach = 40;

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

/// What some particles, of which not all give to rows first … end − 1 of the arrays, give to them.
void scatter_to_some(const Particles<float>& particles, const Part& block, const Part& rows,
                     const Pairs<float>& pairs) {
    const auto low = static_cast<float>(rows.first) - 2.0F;
    const auto high = static_cast<float>(rows.end);
    Vec2<float> position[kTogether];
    Vec2<float> velocity[kTogether];
    std::int32_t count = 0;
    for (std::int32_t k = block.first; k < block.end; ++k) {  // no branch: it would be guessed
        const float y = particles.position[k].y;
        position[count] = particles.position[k];
        velocity[count] = particles.velocity[k];
        count += static_cast<std::int32_t>(y >= low) & static_cast<std::int32_t>(y < high);
    }
#if WEIR_HAS_WIDE_LANES
    if (has_wide_lanes()) {
        scatter_between_wide(&position->x, &velocity->x, count, pairs, rows.first, rows.end);
        return;
    }
#endif
    scatter_all<FourLanes>(&position->x, &velocity->x, count, pairs,
                           RowsBetween(pairs, rows.first, rows.end));
}

/// Everything that particles give to some rows of the arrays, in the pool's order: the same sums
/// as if all rows were done at once.
void scatter_to_rows(const Particles<float>& particles, const Span* spans, const Part& rows,
                     const Pairs<float>& pairs) {
    const auto low = static_cast<float>(rows.first);
    const auto high = static_cast<float>(rows.end);
    Part inside{0, 0};  // particles that follow each other and give to no other row
    const auto scatter_inside = [&] {
        if (!inside.empty()) {
            scatter(particles, inside, pairs);
        }
    };
    // A particle in row j of the cells gives to rows j … j + 2 of the arrays.
    for (std::int32_t k = 0; k < particles.count; k += kTogether) {
        const Span& span = spans[k / kTogether];
        const Part block{k, minimum(k + kTogether, particles.count)};
        if (span.high < low - 2.0F || span.low >= high) {
            continue;
        }
        if (span.low >= low && span.high < high - 2.0F) {
            if (inside.end != block.first) {
                scatter_inside();
                inside.first = block.first;
            }
            inside.end = block.end;
        } else {
            scatter_inside();
            inside = {};
            scatter_to_some(particles, block, rows, pairs);
        }
    }
    scatter_inside();
}

/// Rows as they are cut into pieces for threads.
struct Cuts {
    std::int32_t pieces = 0;
    std::int32_t at[kMostPieces + 1] = {};
};

/// Cuts rows where as many particles are below as above it takes, to within a few rows. Where too
/// many particles are looked at from both sides of a cut: no pieces.
Cuts cut_rows(const Span* spans, std::int32_t blocks, float span, const Part& rows,
              std::int32_t pieces) {
    constexpr std::int32_t kSteps = 64;  // from the lowest row to the highest
    std::int32_t found[kSteps] = {};
    const float rows_a_step =
        static_cast<float>(rows.end - rows.first) / static_cast<float>(kSteps);
    const float scale = 0.5F / rows_a_step;
    const float lowest = 2.0F * static_cast<float>(rows.first - 1);
    for (std::int32_t b = 0; b < blocks; ++b) {
        const float middle = scale * (spans[b].low + spans[b].high - lowest);
        ++found[clamp(static_cast<std::int32_t>(middle), 0, kSteps - 1)];
    }
    Cuts cuts;
    float again = 0.0F;
    std::int32_t piece = 1;
    std::int32_t below = 0;
    for (std::int32_t step = 0; step < kSteps; ++step) {
        below += found[step];
        for (; piece < pieces && below * pieces >= blocks * piece; ++piece) {
            const std::int32_t over = below - blocks * piece / pieces;
            const auto here = static_cast<float>(found[step]);
            const float rows_below =
                rows_a_step * (static_cast<float>(step + 1) - static_cast<float>(over) / here);
            cuts.at[piece] = rows.first + static_cast<std::int32_t>(rows_below);
            again += here / rows_a_step * (span + 2.0F);
        }
    }
    cuts.at[0] = rows.first;
    cuts.at[pieces] = rows.end;
    cuts.pieces = 4.0F * again < static_cast<float>(blocks) ? pieces : 0;
    return cuts;
}

/// Looks at all particles, and where rows are best cut if they are to be done side by side.
Cuts find_cuts(const Particles<float>& particles, const GridShape& s, Work work,
               ArrayView<float> scratch) {
    const std::int32_t blocks = (particles.count + kTogether - 1) / kTogether;
    const std::int32_t height = s.ny + 2;
    if (2 * blocks > scratch.size || height < kLeastRows) {
        return {};
    }
    auto* spans = reinterpret_cast<Span*>(scratch.data);
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
    // As many for each of two threads.
    const std::int32_t pieces = clamp(height / kRowsOfEach / 2, 1, kMostPieces / 2) * 2;
    const float span = all / static_cast<float>(blocks);
    Cuts cuts = cut_rows(spans, blocks, span, {s.j0, s.j0 + height}, pieces);
    if (cuts.pieces == 0 && pieces > 2) {
        cuts = cut_rows(spans, blocks, span, {s.j0, s.j0 + height}, 2);
    }
    return cuts;
}

/// By rows instead of particle by particle, or by kinds of faces. False: it was not worth it,
/// nothing was done.
bool scatter_side_by_side(const Particles<float>& particles, const StaggeredGrid<float>& grid,
                          Work work, const Pairs<float>& pairs) {
    constexpr std::int32_t kCost = 4;  // units a particle: it takes as long as so many cells
    if (work.pieces(particles.count, kCost, kTogether) <= 1) {
        return false;
    }
    const Cuts cuts = find_cuts(particles, grid.shape, work, grid.spans);
    const auto* spans = reinterpret_cast<const Span*>(grid.spans.data);
    if (cuts.pieces == 0) {
        work.share({0, 2}, particles.count, 1, [&](const Part& kinds, std::int32_t) {
            for (std::int32_t kind = kinds.first; kind < kinds.end; ++kind) {
                scatter_kind(particles, kind == 0, pairs);
            }
        });
        return true;
    }
    work.share({0, cuts.pieces}, particles.count, 1, [&](const Part& some, std::int32_t) {
        for (std::int32_t k = some.first; k < some.end; ++k) {
            scatter_to_rows(particles, spans, {cuts.at[k], cuts.at[k + 1]}, pairs);
        }
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
