// Pairs {mass, momentum} and {velocity, change} lie where they are free: those of the v faces of a
// scatter and of the u faces of a gather in the grid's scratch, the others over the fields of
// the other component, which are written after, or were read before.
#include "step/transfer_lanes.hpp"

#include <cstring>

#include "fluid/extent_lanes.hpp"
#include "math/four_lanes.hpp"
#include "step/scatter.hpp"
#include "step/thin_transfer.hpp"
#include "step/transfer_wide.hpp"
#include "step/wide_faces.hpp"

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
    if (const WideFaces* wide = wide_faces()) {
        k = wide->unpack_pairs(pairs, k, part.end, first, second);
    }
    k = unpack_pairs<FourLanes>(pairs, k, part.end, first, second);
    for (; k < part.end; ++k) {
        first[k] = pairs[2 * k];
        second[k] = pairs[2 * k + 1];
    }
}

void pack(const float* first, const float* second, const Part& part, float* pairs) {
    std::int32_t k = part.first;
    if (const WideFaces* wide = wide_faces()) {
        k = wide->pack_pairs(first, second, k, part.end, pairs);
    }
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

/// The same sums where some do not see all of their faces.
void scatter_past(const ThinWalls<float>& thin, const GridShape& s,
                  const Particles<float>& particles, const Part& part,
                  const Pairs<float>& pairs) {
    for_each_beside(
        particles, part, thin, s, [&](const Part& some) { scatter(particles, some, pairs); },
        [&](std::int32_t k) {
            const Vec2<float> x = particles.position[k];
            const Vec2<float> v = particles.velocity[k];
            const std::uint32_t seen = seen_faces(thin, s, x);
            const auto give = [&](float* pair, const Stencil<float>& at, float speed,
                                  std::uint32_t faces) {
                scatter_weighed<float>(pair, nullptr, pair + 1, s.stride, at, 1.0F, speed, faces,
                                       2);
            };
            give(pairs.u, stencil_u(s, x), v.x, seen & kAllFour);
            give(pairs.v, stencil_v(s, x), v.y, seen >> 4U);
        });
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

/// What particles give to some rows of the arrays.
void scatter_between(const Vec2<float>* position, const Vec2<float>* velocity, std::int32_t count,
                     const Part& rows, const Pairs<float>& pairs) {
#if WEIR_HAS_WIDE_LANES
    if (has_wide_lanes()) {
        scatter_between_wide(&position->x, &velocity->x, count, pairs, rows.first, rows.end);
        return;
    }
#endif
    scatter_all<FourLanes>(&position->x, &velocity->x, count, pairs,
                           RowsBetween(pairs, rows.first, rows.end));
}

/// The same of particles that not all give to them.
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
    scatter_between(position, velocity, count, rows, pairs);
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
            if (span.low >= low - 2.0F && span.high < high) {
                scatter_between(particles.position + block.first,
                                particles.velocity + block.first, block.end - block.first, rows,
                                pairs);
            } else {
                scatter_to_some(particles, block, rows, pairs);
            }
        }
    }
    scatter_inside();
}

/// Rows as they are cut into pieces for threads.
struct Cuts {
    std::int32_t pieces = 0;
    std::int32_t at[kMostPieces + 1] = {};
};

/// Cuts rows where as much is to be done below as above it takes, to within a few rows. Where too
/// many particles are looked at from both sides of a cut: no pieces. `span`: rows that particles
/// together lie in.
Cuts cut_rows(const Span* spans, std::int32_t blocks, float span, const GridShape& s,
              std::int32_t pieces) {
    constexpr std::int32_t kSteps = 64;  // from the lowest row to the highest
    float found[kSteps] = {};
    const float rows_a_step = static_cast<float>(s.ny + 2) / static_cast<float>(kSteps);
    const float scale = 0.5F / rows_a_step;
    const float lowest = 2.0F * static_cast<float>(s.j0 - 1);
    for (std::int32_t b = 0; b < blocks; ++b) {
        const float middle = scale * (spans[b].low + spans[b].high - lowest);
        found[clamp(static_cast<std::int32_t>(middle), 0, kSteps - 1)] += 1.0F;
    }
    // A cell that anything is given to takes as long as a particle.
    const float cells = rows_a_step * static_cast<float>(s.nx) / static_cast<float>(kTogether);
    float all = 0.0F;
    for (const float here : found) {
        all += here > 0.0F ? here + cells : 0.0F;
    }
    Cuts cuts;
    cuts.at[0] = s.j0;
    float again = 0.0F;
    float below = 0.0F;
    std::int32_t piece = 1;
    for (std::int32_t step = 0; step < kSteps && piece < pieces; ++step) {
        const float here = found[step] > 0.0F ? found[step] + cells : 0.0F;
        for (; piece < pieces; ++piece) {
            const float least = all * static_cast<float>(piece) / static_cast<float>(pieces);
            if (below + here < least) {
                break;
            }
            const float part = static_cast<float>(step) + (least - below) / here;
            cuts.at[piece] = s.j0 + static_cast<std::int32_t>(rows_a_step * part);
            again += found[step] / rows_a_step * (span + 2.0F);
        }
        below += here;
    }
    cuts.at[pieces] = s.j0 + s.ny + 2;
    const bool few = piece == pieces && 4.0F * again < static_cast<float>(blocks);
    cuts.pieces = few ? pieces : 0;
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
            const Extent<float> places = extent_of_places(
                particles.position + first, minimum(kTogether, particles.count - first));
            spans[b] = {places.low.y, places.high.y};
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
    Cuts cuts = cut_rows(spans, blocks, span, s, pieces);
    if (cuts.pieces == 0 && pieces > 2) {
        cuts = cut_rows(spans, blocks, span, s, 2);
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

void scatter_in_lanes(const Particles<float>& particles, const ThinWalls<float>* thin,
                      StaggeredGrid<float>& grid, Work work) {
    const GridShape& s = grid.shape;
    const Pairs<float> pairs{grid.as_pairs(grid.v), grid.pairs, s.stride, s.i0};
    each_row(work, s, [&](const Part& entries) {
        const std::size_t bytes =
            2 * static_cast<std::size_t>(entries.end - entries.first) * sizeof(float);
        std::memset(pairs.u + 2 * entries.first, 0, bytes);
        std::memset(pairs.v + 2 * entries.first, 0, bytes);
    });
    const Part part = work.take(particles.count, 1);
    bool done = thin != nullptr;
    if (thin != nullptr) {
        scatter_past(*thin, s, particles, part, pairs);
    }
#if WEIR_PARALLEL
    if (!done && part.first == 0 && part.end == particles.count) {
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
