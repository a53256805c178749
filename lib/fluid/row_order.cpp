#include "fluid/row_order.hpp"

namespace weir {

namespace {

/// So many particles are looked at together.
constexpr std::int32_t kTogether = 64;

/// One of so many is asked, in one of so many groups.
constexpr std::int32_t kSampled = 4;

/// More rows than they have to span.
constexpr std::int32_t kMixed = 3;

template <class Real>
std::int32_t row_of(const Particles<Real>& particles, std::int32_t k) {
    return static_cast<std::int32_t>(Real(particles.position[k].y));
}

/// Groups that are asked.
constexpr std::int32_t asked_of(std::int32_t count) {
    return count / (kTogether * kSampled);
}

/// Rows that particles together span, beyond one, summed over the groups that are asked.
template <class Real>
std::int64_t spanned(const Particles<Real>& particles, Work work) {
    std::int64_t rows[kMostPieces] = {};
    constexpr std::int32_t kApart = kTogether * kSampled;
    const Part groups{0, asked_of(particles.count)};
    work.share(groups, kTogether / kSampled, 1, [&](const Part& some, std::int32_t piece) {
        for (std::int32_t k = kApart * some.first; k < kApart * some.end; k += kApart) {
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

/// So many groups of rows are ordered each by itself: always, since the order follows from it.
constexpr std::int32_t kGroups = 4;

/// Rows that follow each other, and the places of the pool that their particles take.
struct Groups {
    Part rows[kGroups];
    Part places[kGroups];

    std::int32_t of_row(std::int32_t row) const {
        std::int32_t group = 0;
        for (std::int32_t k = 1; k < kGroups; ++k) {
            group += row >= rows[k].first ? 1 : 0;
        }
        return group;
    }
};

/// Counts rows, and says where in the pool each begins and ends. Groups are as large as each other,
/// to within a row.
template <class Real>
Groups find_places(const Part& rows, const Particles<Real>& particles, std::int32_t* next,
                   std::int32_t* end) {
    const std::int32_t count = rows.end - rows.first;
    for (std::int32_t row = 0; row < count; ++row) {
        end[row] = 0;
    }
    for (std::int32_t k = 0; k < particles.count; ++k) {
        ++end[row_of(particles, k) - rows.first];
    }
    Groups groups;
    std::int32_t group = 0;
    std::int32_t first = 0;
    for (std::int32_t row = 0; row < count; ++row) {
        next[row] = first;
        first += end[row];
        end[row] = first;
        if (group + 1 < kGroups && first >= particles.count / kGroups * (group + 1)) {
            groups.rows[group].end = row + 1;
            groups.places[group].end = first;
            ++group;
            groups.rows[group].first = row + 1;
            groups.places[group].first = first;
        }
    }
    groups.rows[group].end = count;
    groups.places[group].end = first;
    for (++group; group < kGroups; ++group) {
        groups.rows[group] = {count, count};
        groups.places[group] = {first, first};
    }
    return groups;
}

/// Whoever stands in the part of another bucket is swapped there (American flag sort: McIlroy,
/// Bostic & McIlroy 1993). bucket(k): of particle k.
template <class Real, class Bucket>
void swap_home(const Part& buckets, std::int32_t* next, const std::int32_t* end,
               Particles<Real>& particles, const Bucket& bucket) {
    for (std::int32_t b = buckets.first; b < buckets.end; ++b) {
        while (next[b] < end[b]) {
            const std::int32_t k = next[b];
            const std::int32_t home = bucket(k);
            if (home != b) {
                particles.swap(k, next[home]);
            }
            ++next[home];
        }
    }
}

/// First particles go into their rows' group, then into their rows.
template <class Real>
void sort_by_row(const Part& rows, std::int32_t* next, std::int32_t* end,
                 Particles<Real>& particles, Work work) {
    constexpr std::int32_t kCost = 4;
    const Groups groups = find_places(rows, particles, next, end);
    const auto row = [&](std::int32_t k) { return row_of(particles, k) - rows.first; };
    const auto each_group = [&](const auto& body) {
        work.share({0, kGroups}, particles.count / kGroups * kCost, 1,
                   [&](const Part& some, std::int32_t) {
                       for (std::int32_t group = some.first; group < some.end; ++group) {
                           body(group);
                       }
                   });
    };
    std::int32_t strange[kGroups];  // those of other groups from here on
    std::int32_t strange_end[kGroups];
    each_group([&](std::int32_t group) {
        const Part own = groups.rows[group];
        std::int32_t k = groups.places[group].first;
        std::int32_t last = groups.places[group].end;
        strange_end[group] = last;
        while (k < last) {
            const std::int32_t here = row(k);
            if (here >= own.first && here < own.end) {
                ++k;
            } else {
                particles.swap(k, --last);
            }
        }
        strange[group] = last;
    });
    swap_home({0, kGroups}, strange, strange_end, particles,
              [&](std::int32_t k) { return groups.of_row(row(k)); });
    each_group([&](std::int32_t group) {
        swap_home(groups.rows[group], next, end, particles, row);
    });
}

}  // namespace

template <class Real>
void keep_row_order(const Part& rows, ArrayView<std::int32_t> scratch,
                    Particles<Real>& particles, Work work) {
    const std::int32_t groups = asked_of(particles.count);
    const std::int32_t count = rows.end - rows.first;
    const std::int32_t least = count * kTogether / maximum(particles.count, 1);
    if (2 * count <= scratch.size &&
        spanned(particles, work) > static_cast<std::int64_t>(kMixed + least) * groups) {
        sort_by_row(rows, scratch.data, scratch.data + count, particles, work);
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
