#include "fluid/row_order.hpp"

namespace weir {

namespace {

/// So many particles are looked at together.
constexpr std::int32_t kTogether = 64;

/// One of so many is asked.
constexpr std::int32_t kSampled = 4;

/// More rows than they have to span.
constexpr std::int32_t kMixed = 3;

template <class Real>
std::int32_t row_of(const Particles<Real>& particles, std::int32_t k) {
    return static_cast<std::int32_t>(Real(particles.position[k].y));
}

/// Rows that particles together span, beyond one, summed over the pool.
template <class Real>
std::int64_t spanned(const Particles<Real>& particles, Work work) {
    std::int64_t rows[kMostPieces] = {};
    const Part blocks{0, particles.count / kTogether};
    work.share(blocks, kTogether / kSampled, 1, [&](const Part& some, std::int32_t piece) {
        for (std::int32_t k = kTogether * some.first; k < kTogether * some.end; k += kTogether) {
            auto low = particles.position[k].y;
            auto high = low;
            for (std::int32_t n = k + kSampled; n < k + kTogether; n += kSampled) {
                low = minimum(low, particles.position[n].y);
                high = maximum(high, particles.position[n].y);
            }
            rows[piece] +=
                static_cast<std::int32_t>(Real(high)) - static_cast<std::int32_t>(Real(low));
        }
    });
    std::int64_t all = 0;
    for (const std::int64_t some : rows) {
        all += some;
    }
    return all;
}

/// Whoever stands in another row's part is swapped there (American flag sort: McIlroy, Bostic &
/// McIlroy 1993).
template <class Real>
void sort_by_row(const Part& rows, std::int32_t* next, std::int32_t* end,
                 Particles<Real>& particles) {
    const std::int32_t count = rows.end - rows.first;
    for (std::int32_t row = 0; row < count; ++row) {
        end[row] = 0;
    }
    for (std::int32_t k = 0; k < particles.count; ++k) {
        ++end[row_of(particles, k) - rows.first];
    }
    std::int32_t first = 0;
    for (std::int32_t row = 0; row < count; ++row) {
        next[row] = first;
        first += end[row];
        end[row] = first;
    }
    for (std::int32_t row = 0; row < count; ++row) {
        while (next[row] < end[row]) {
            const std::int32_t k = next[row];
            const std::int32_t home = row_of(particles, k) - rows.first;
            if (home != row) {
                particles.swap(k, next[home]);
            }
            ++next[home];
        }
    }
}

}  // namespace

template <class Real>
void keep_row_order(const Part& rows, ArrayView<std::int32_t> scratch,
                    Particles<Real>& particles, Work work) {
    const std::int32_t blocks = particles.count / kTogether;
    const std::int32_t count = rows.end - rows.first;
    const std::int32_t least = count * kTogether / maximum(particles.count, 1);
    if (2 * count <= scratch.size &&
        spanned(particles, work) > static_cast<std::int64_t>(kMixed + least) * blocks) {
        sort_by_row(rows, scratch.data, scratch.data + count, particles);
    }
}

template <class Real>
const detail::RowOrder<Real>& detail::row_order() {
    static constexpr RowOrder<Real> kStage{keep_row_order<Real>};
    return kStage;
}

#define WEIR_INSTANTIATE(Real) \
    template const detail::RowOrder<Real>& detail::row_order<Real>();\
    template void keep_row_order(const Part&, ArrayView<std::int32_t>, Particles<Real>&, \
                                 Work);
WEIR_FOR_EACH_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
