// Work that can be left off and taken up again. A substep is walked from its top at each slice:
// what is done is passed over, the loop that was left off goes on, what follows waits.
#pragma once

#include <cstdint>

#include "weir/parallel.hpp"

namespace weir {

/// Items first … end − 1 of a loop.
struct Part {
    std::int32_t first = 0;
    std::int32_t end = 0;

    bool empty() const { return first == end; }
};

/// More than this is left by no slice; `step` makes as many as it needs.
inline constexpr std::int32_t kMostWork = 0x7FFFFFFF;

/// What an item of that cost comes to if it turns out to take so much more. Saturates.
inline std::int32_t cost_with(std::int32_t cost, std::int32_t more) {
    return more < kMostWork - cost ? cost + more : kMostWork;
}

/// How far a walk has come, and how much of it may still be done now. Its unit is one cell or one
/// particle looked at by one loop.
class Progress {
public:
    /// From the top of another walk.
    void begin() { left_ = done_ = position_ = at_ = 0; }
    /// From the top of the same walk, with so much to spend.
    void resume(std::int32_t budget) {
        left_ = budget;
        at_ = 0;
    }
    /// From the top of a walk that does nothing but add up what it would do at most: `left` falls
    /// from kMostWork by all of it, and no further than 2³² − 1.
    void foresee() {
        begin();
        left_ = kMostWork;
        done_ = -1;
    }
    bool foreseeing() const { return done_ < 0; }
    /// The most that a single item of that walk costs.
    std::int32_t largest_item() const { return position_; }
    /// Whether the walk that has just come to its end left nothing off.
    bool complete() const { return done_ == at_; }
    /// Negative by what the last item took beyond the budget.
    std::int32_t left() const { return left_; }

    /// What may be done of the next loop, so many items of such a cost: none if it is done, or has
    /// to wait. At least one item is done as long as anything is left to spend.
    Part next(std::int32_t items, std::int32_t cost);
    /// What turned out to cost more than was said.
    void spend(std::int32_t cost);
    /// What a walk that only adds up could not know.
    void expect(std::int32_t items, std::int32_t cost);

#if WEIR_PARALLEL
    ParallelFor parallel_for = nullptr;  ///< null: nobody shares
#endif

private:
    Part next_of_many(std::int32_t items, std::int32_t cost);

    std::int32_t left_ = 0;
    std::int32_t done_ = 0;      ///< loops
    std::int32_t position_ = 0;  ///< items of the next one
    std::int32_t at_ = 0;        ///< loops that this walk has come to
};

/// So many pieces a loop is cut into for threads, at most.
inline constexpr std::int32_t kMostPieces = WEIR_PARALLEL ? 32 : 1;

/// What a stage is handed. The default does everything at once.
///
/// A stage asks in the same order whenever it is walked, and does nothing but what it is given:
/// what stands between its loops is asked for by `once`, and what has to be known later is stored.
class Work {
public:
    Work() = default;
    explicit Work(Progress& progress) : progress_(&progress) {}

    Part take(std::int32_t items, std::int32_t cost) const;
    bool once(std::int32_t cost) const;

    /// Does a part that was taken: body(piece of it, its number), in pieces of whole `grain`s of
    /// items, at the same time where there are threads for it, and in one otherwise. The result
    /// must not depend on where it is cut.
    template <class Body>
    void share(const Part& part, std::int32_t cost, std::int32_t grain, const Body& body) const;
    /// The same where a piece reads what the pieces beside it write: first every second, then the
    /// others. A grain is then more items than a piece looks beyond its ends.
    template <class Body>
    void share_in_turn(const Part& part, std::int32_t cost, std::int32_t grain,
                       const Body& body) const;
    /// Into how many pieces `share` cuts so many items.
    std::int32_t pieces(std::int32_t items, std::int32_t cost, std::int32_t grain) const;
    std::int32_t left() const { return progress_ != nullptr ? progress_->left() : 0; }
    bool foreseeing() const { return progress_ != nullptr && progress_->foreseeing(); }
    void expect(std::int32_t items, std::int32_t cost) const { progress_->expect(items, cost); }
    void spend(std::int32_t cost) const {
        if (progress_ != nullptr) {
            progress_->spend(cost);
        }
    }

private:
    template <class Body>
    void share_every(std::int32_t step, const Part& part, std::int32_t cost, std::int32_t grain,
                     const Body& body) const;

    Progress* progress_ = nullptr;
};

#if WEIR_PARALLEL
/// Piece `k` of so many of a part, in whole grains.
inline Part piece_of(const Part& part, std::int32_t grain, std::int32_t pieces, std::int32_t k) {
    const std::int32_t grains = (part.end - part.first + grain - 1) / grain;
    const auto at = [&](std::int32_t n) {
        const auto grains_before =
            static_cast<std::int32_t>(static_cast<std::int64_t>(grains) * n / pieces);
        const std::int32_t item = part.first + grain * grains_before;
        return item < part.end ? item : part.end;
    };
    return {at(k), at(k + 1)};
}

/// Every `step`th piece, then the others.
template <class Body>
void Work::share_every(std::int32_t step, const Part& part, std::int32_t cost, std::int32_t grain,
                       const Body& body) const {
    struct Job {
        const Body& body;
        Part part;
        std::int32_t grain;
        std::int32_t pieces;
        std::int32_t first;
        std::int32_t step;
    };
    const std::int32_t count = pieces(part.end - part.first, cost, grain);
    if (count <= 1) {
        if (!part.empty()) {
            body(part, 0);
        }
        return;
    }
    Job job{body, part, grain, count, 0, step};
    for (; job.first < step; ++job.first) {
        progress_->parallel_for(
            [](void* context, std::int32_t k) {
                const Job& of = *static_cast<const Job*>(context);
                const std::int32_t piece = of.first + of.step * k;
                of.body(piece_of(of.part, of.grain, of.pieces, piece), piece);
            },
            &job, (count - job.first + step - 1) / step);
    }
}
template <class Body>
void Work::share(const Part& part, std::int32_t cost, std::int32_t grain, const Body& body) const {
    share_every(1, part, cost, grain, body);
}
template <class Body>
void Work::share_in_turn(const Part& part, std::int32_t cost, std::int32_t grain,
                         const Body& body) const {
    share_every(2, part, cost, grain, body);
}
#else
template <class Body>
void Work::share(const Part& part, std::int32_t, std::int32_t, const Body& body) const {
    body(part, 0);
}
template <class Body>
void Work::share_in_turn(const Part& part, std::int32_t, std::int32_t, const Body& body) const {
    body(part, 0);
}
#endif

}  // namespace weir
