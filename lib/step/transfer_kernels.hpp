// The loops of both transfers, for any number of groups of four lanes: a particle a group, or two
// where one number of each component is enough. Compiled once for each set of lanes, also for
// processors that not every user has: what is included here must not be shared with other files.
#pragma once

#include <cstddef>
#include <cstdint>

namespace weir {

/// So many particles go through the parts of a transfer together. In a gather one particle alone
/// takes ninety cycles from its place to its next one: more than a processor looks ahead.
inline constexpr std::int32_t kRun = 64;

/// Between the parts: of as many particles as there are groups all on u, then all on v.
struct Run {
    std::uint32_t base[2 * kRun];  ///< of stencils, before what first_u and first_v add
    float weight[kRun][4];         ///< fx and fy
    float found[kRun][4];          ///< velocity along the way and change
    float left[kRun][2];           ///< places
};

/// Two fields of pairs, side by side for each face: {mass, momentum} or {velocity, change}.
template <class Float>
struct Pairs {
    Float* u;
    Float* v;
    std::int32_t stride;
    std::int32_t column = 0;  ///< of the tank's, with which the stored part of each row begins

    std::ptrdiff_t up() const { return 2 * static_cast<std::ptrdiff_t>(stride); }
    /// Where the bases of a run count from.
    Float* first_u() const { return u + 2; }
    Float* first_v() const { return v + up(); }
};

/// Numbers of two fields side by side → the two fields, as long as enough are left before `end`;
/// returns the next one to do.
template <class L>
inline std::int32_t unpack_pairs(const float* pairs, std::int32_t k, std::int32_t end,
                                 float* first, float* second) {
    for (; k + L::kLanes <= end; k += L::kLanes) {
        const auto a = L::load(pairs + 2 * k);
        const auto b = L::load(pairs + 2 * k + L::kLanes);
        L::store(first + k, L::every_second(a, b));
        L::store(second + k, L::every_other(a, b));
    }
    return k;
}

template <class L>
inline std::int32_t pack_pairs(const float* first, const float* second, std::int32_t k,
                               std::int32_t end, float* pairs) {
    for (; k + L::kLanes <= end; k += L::kLanes) {
        const auto a = L::load(first + k);
        const auto b = L::load(second + k);
        const auto low = L::template shuffle<0, 4, 1, 5>(a, b);
        const auto high = L::template shuffle<2, 6, 3, 7>(a, b);
        L::store_in_turn(pairs + 2 * k, low, high);
    }
    return k;
}

/// What a gather of some particles is told; lengths in cells.
struct GatherTask {
    Pairs<const float> pairs;
    float* position;
    float* velocity;
    std::int32_t count;
    float size[2];     ///< of the tank
    float gap;         ///< kWallGap
    float limit;       ///< cells/s
    float flip_ratio;
    float dt;
    /// Moves particle k, which is too fast or leaves the tank; `found`: velocity along the way,
    /// change.
    void (*move_one)(void* context, std::int32_t k, const float* found);
    void* context;
    float* left;  ///< the places that particles come from are left there; null: nobody asks
};

/// The largest components of the velocities of those that nothing was in the way of, and of what
/// carried them, cells/s.
struct Gathered {
    float speed;
    float along;
};

/// Both stencils of particles, two a group.
template <class L>
inline void find_stencils(std::int32_t stride, const float* position, std::int32_t count,
                          Run& run) {
    const auto factors = L::pairs_of_shorts(1, stride);
    for (std::int32_t k = 0; k < count; k += 2 * L::kGroups) {
        const auto x = k + 2 * L::kGroups <= count
                           ? L::load(position + 2 * k)
                           : L::load_some(position + 2 * k, 2 * (count - k));
        const auto on_u = x + L::repeat(0.0F, 0.5F, 0.0F, 0.5F);
        const auto on_v = x + L::repeat(0.5F, 0.0F, 0.5F, 0.0F);
        const auto node_u = L::whole(on_u);
        const auto node_v = L::whole(on_v);
        const auto f_u = on_u - L::floats(node_u);
        const auto f_v = on_v - L::floats(node_v);
        const auto bases = L::sums_of_products(node_u, node_v, factors);
        L::store_kinds(run.base + 2 * k, bases);
        L::store_kinds(run.weight[k], f_u, f_v);
    }
}

/// The second part of a gather: bilinear values of velocity and change on both kinds of faces.
template <class L>
inline void sample_run(const Pairs<const float>& pairs, std::int32_t count, Run& run) {
    const float* const first_u = pairs.first_u();
    const float* const first_v = pairs.first_v();
    const std::ptrdiff_t up = pairs.up();
    for (std::int32_t k = 0; k < count; k += L::kGroups) {
        const auto f = L::load(run.weight[k]);
        const auto fx = L::template shuffle<0, 0, 2, 2>(f, f);
        const auto fy = L::template shuffle<1, 1, 3, 3>(f, f);
        const std::uint32_t* const base = run.base + 2 * k;
        const auto below = L::load_rows(first_u, first_v, base);
        const auto above = L::load_rows(first_u + up, first_v + up, base);
        const auto low_left = L::template shuffle<0, 1, 4, 5>(below.a, below.b);
        const auto high_left = L::template shuffle<0, 1, 4, 5>(above.a, above.b);
        const auto low_slope = L::template shuffle<2, 3, 6, 7>(below.a, below.b) - low_left;
        const auto high_slope = L::template shuffle<2, 3, 6, 7>(above.a, above.b) - high_left;
        const auto low = low_left + fx * low_slope;
        const auto high = high_left + fx * high_slope;
        const auto value = low + fy * (high - low);
        L::store(run.found[k], value);
    }
}

/// `Gathered`, lane by lane.
template <class L>
struct Fastest {
    typename L::Floats speed = L::all(0.0F);
    typename L::Floats along = L::all(0.0F);

    static float largest(typename L::Floats of) {
        float most = 0.0F;
        for (std::int32_t lane = 0; lane < 4 * L::kGroups; ++lane) {
            most = most < of[lane] ? of[lane] : most;
        }
        return most;
    }
};

/// The third part: particles move, two a group, unless something is in the way of one of them.
/// The places that they come from are left in the run where nobody asks: sooner than told.
template <class L>
inline void move_run(const GatherTask& task, std::int32_t first, std::int32_t count,
                     Run& run, Fastest<L>& fastest) {
    const auto lowest = L::all(task.gap);
    const auto highest =
        L::repeat(task.size[0], task.size[1], task.size[0], task.size[1]) - lowest;
    float* const x = task.position + 2 * first;
    float* const v = task.velocity + 2 * first;
    float* const left = task.left != nullptr ? task.left + 2 * first : run.left[0];
    const auto one_by_one = [&](std::int32_t k, std::int32_t end) {
        for (; k < end; ++k) {
            left[2 * k] = x[2 * k];
            left[2 * k + 1] = x[2 * k + 1];
            constexpr std::int32_t kOnV = 2 * L::kGroups;
            const float* const pair = run.found[k / L::kGroups * L::kGroups] + k % L::kGroups * 2;
            const float found[4] = {pair[0], pair[kOnV], pair[1], pair[kOnV + 1]};
            task.move_one(task.context, first + k, found);
        }
    };
    std::int32_t k = 0;
    for (; k + 2 * L::kGroups <= count; k += 2 * L::kGroups) {
        const auto a = L::load(run.found[k]);
        const auto b = L::load(run.found[k + L::kGroups]);
        const auto along = L::first_of_kinds(a, b);
        const auto faster =
            L::all(task.flip_ratio) * L::load(v + 2 * k) + L::second_of_kinds(a, b);
        const auto speed = L::absolute(faster);
        const auto way = L::absolute(along);
        const auto from = L::load(x + 2 * k);
        const auto moved = from + L::all(task.dt) * along;
        L::store(left + 2 * k, from);
        // A way that is no number is lost in the maximum, but it leads nowhere.
        if (L::all_true((L::maximum(speed, way) <= L::all(task.limit)) & (moved >= lowest) &
                        (moved <= highest))) {
            fastest.speed = L::maximum(fastest.speed, speed);
            fastest.along = L::maximum(fastest.along, way);
            L::store(x + 2 * k, moved);
            L::store(v + 2 * k, faster);
        } else {
            one_by_one(k, k + 2 * L::kGroups);
        }
    }
    one_by_one(k, count);
}

/// Moves particles.
template <class L>
inline Gathered gather_all(const GatherTask& task) {
    Run run;
    Fastest<L> fastest;
    for (std::int32_t first = 0; first < task.count; first += kRun) {
        const std::int32_t count = task.count - first < kRun ? task.count - first : kRun;
        find_stencils<L>(task.pairs.stride, task.position + 2 * first, count, run);
        sample_run<L>(task.pairs, count, run);
        move_run<L>(task, first, count, run, fastest);
    }
    return {fastest.largest(fastest.speed), fastest.largest(fastest.along)};
}

/// What particles, one a group, add to rows of their stencils: mass and momentum of the left face,
/// then of the right one.
template <class L>
struct Contribution {
    typename L::Rows lower;
    typename L::Rows upper;
};

/// `given`: 1 and the velocity, each as often as there are fx and fy.
template <class L>
inline Contribution<L> contribution(const float* weights, typename L::Floats given) {
    const auto f = L::load(weights);
    const auto fx = L::template shuffle<0, 0, 2, 2>(f, f);
    const auto fy = L::template shuffle<1, 1, 3, 3>(f, f);
    const auto one = L::all(1.0F);
    const auto w1 = fx * fy;
    const auto right = fx - w1;
    const auto upper = fy - w1;
    const auto w0 = (one - fx) - upper;
    const auto left_lower = w0 * given;
    const auto right_lower = right * given;
    const auto left_upper = upper * given;
    const auto right_upper = w1 * given;
    return {{L::template shuffle<0, 1, 4, 5>(left_lower, right_lower),
             L::template shuffle<2, 3, 6, 7>(left_lower, right_lower)},
            {L::template shuffle<0, 1, 4, 5>(left_upper, right_upper),
             L::template shuffle<2, 3, 6, 7>(left_upper, right_upper)}};
}

/// All rows of the arrays are added to.
struct EveryRow {
    static float* u(float* pair) { return pair; }
    static float* v(float* pair) { return pair; }
};

/// Rows first … end − 1 of the arrays are added to; what others would get goes nowhere.
class RowsBetween {
public:
    RowsBetween(const Pairs<float>& pairs, std::int32_t first, std::int32_t end)
        : first_u_(pairs.u + first * pairs.up() + 2 * pairs.column),
          first_v_(pairs.v + first * pairs.up() + 2 * pairs.column),
          numbers_(static_cast<std::size_t>((end - first) * pairs.up())) {}

    float* u(float* pair) const { return at(pair, first_u_, nowhere_[0]); }
    float* v(float* pair) const { return at(pair, first_v_, nowhere_[1]); }

private:
    float* at(float* pair, float* first, float* nowhere) const {
        return static_cast<std::size_t>(pair - first) < numbers_ ? pair : nowhere;
    }

    float* first_u_;
    float* first_v_;
    std::size_t numbers_;
    mutable float nowhere_[2][4] = {};
};

/// Adds mass and momentum of particles, in their order, to some rows.
template <class L, class Rows>
inline void scatter_all(const float* position, const float* velocity, std::int32_t count,
                        const Pairs<float>& pairs, const Rows& rows) {
    Run run;
    const std::ptrdiff_t up = pairs.up();
    float* const first_u = pairs.first_u();
    float* const first_v = pairs.first_v();
    const auto add = [&](std::int32_t k, const Contribution<L>& what, auto group) {
        const std::uint32_t* const base = run.base + 2 * k + group;
        float* const u = first_u + 2 * static_cast<std::size_t>(base[0]);
        float* const v = first_v + 2 * static_cast<std::size_t>(base[L::kGroups]);
        L::template add_rows<group>(rows.u(u), rows.v(v), what.lower);
        L::template add_rows<group>(rows.u(u + up), rows.v(v + up), what.upper);
    };
    for (std::int32_t first = 0; first < count; first += kRun) {
        const std::int32_t some = count - first < kRun ? count - first : kRun;
        const float* const v = velocity + 2 * first;
        find_stencils<L>(pairs.stride, position + 2 * first, some, run);
        std::int32_t k = 0;
        for (; k + L::kGroups <= some; k += L::kGroups) {
            const auto what = contribution<L>(run.weight[k], L::ones_before_kinds(v + 2 * k));
            L::each_group([&](auto group) { add(k, what, group); });
        }
        if (k < some) {
            const float last[4] = {v[2 * k], v[2 * k + 1]};
            add(k, contribution<L>(run.weight[k], L::ones_before_kinds(last)), L::kFirstGroup);
        }
    }
}

/// Adds what particles give to faces of one kind, in their order: the same sums. Two particles a
/// group.
template <class L, bool OnU>
inline void scatter_component(const float* position, const float* velocity, std::int32_t count,
                              const Pairs<float>& pairs) {
    constexpr std::int32_t kStep = 2 * L::kGroups;
    Run run;
    float* const weights = run.weight[0];
    float* const faces = OnU ? pairs.first_u() : pairs.first_v();
    const std::ptrdiff_t up = pairs.up();
    const auto factors = L::pairs_of_shorts(1, pairs.stride);
    const auto middle =
        OnU ? L::repeat(0.0F, 0.5F, 0.0F, 0.5F) : L::repeat(0.5F, 0.0F, 0.5F, 0.0F);
    const auto add = [&](std::int32_t k, const Contribution<L>& what, auto group, bool both) {
        float* const a = faces + 2 * static_cast<std::size_t>(run.base[k + 2 * group]);
        L::template add_group<group>(a, what.lower.a);
        L::template add_group<group>(a + up, what.upper.a);
        if (both) {
            float* const b = faces + 2 * static_cast<std::size_t>(run.base[k + 2 * group + 1]);
            L::template add_group<group>(b, what.lower.b);
            L::template add_group<group>(b + up, what.upper.b);
        }
    };
    const auto given = [&](std::int32_t k, typename L::Floats velocities) {
        const auto of_kind = OnU ? L::template shuffle<0, 2, 0, 2>(velocities, velocities)
                                 : L::template shuffle<1, 3, 1, 3>(velocities, velocities);
        return contribution<L>(weights + 2 * k,
                               L::template shuffle<0, 4, 1, 5>(L::all(1.0F), of_kind));
    };
    for (std::int32_t first = 0; first < count; first += kRun) {
        const std::int32_t some = count - first < kRun ? count - first : kRun;
        const float* const x = position + 2 * first;
        const float* const v = velocity + 2 * first;
        const auto load = [&](const float* from, std::int32_t k) {
            return k + kStep <= some ? L::load(from + 2 * k)
                                     : L::load_some(from + 2 * k, 2 * (some - k));
        };
        for (std::int32_t k = 0; k < some; k += kStep) {
            const auto at = load(x, k) + middle;
            const auto node = L::whole(at);
            L::store(weights + 2 * k, at - L::floats(node));
            L::store_halves(run.base + k, run.base + kRun + k,
                            L::sums_of_products(node, node, factors));
        }
        std::int32_t k = 0;
        for (; k + kStep <= some; k += kStep) {
            const Contribution<L> what = given(k, L::load(v + 2 * k));
            L::each_group([&](auto group) { add(k, what, group, true); });
        }
        if (k < some) {
            const Contribution<L> what = given(k, load(v, k));
            L::each_group([&](auto group) {
                if (k + 2 * group < some) {
                    add(k, what, group, k + 2 * group + 1 < some);
                }
            });
        }
    }
}

}  // namespace weir
