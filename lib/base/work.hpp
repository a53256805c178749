// Work that can be left off and taken up again. A substep is walked from its top at each slice:
// what is done is passed over, the loop that was left off goes on, what follows waits.
#pragma once

#include <cstdint>

namespace weir {

/// Items first … end − 1 of a loop.
struct Part {
    std::int32_t first = 0;
    std::int32_t end = 0;

    bool empty() const { return first == end; }
};

/// How far a walk has come, and how much of it may still be done now. Its unit is one cell or one
/// particle looked at by one loop.
class Progress {
public:
    /// From the top of another walk.
    void begin() { *this = Progress(); }
    /// From the top of the same walk, with so much to spend.
    void resume(std::int32_t budget) {
        left_ = budget;
        at_ = 0;
    }
    /// Whether the walk that has just come to its end left nothing off.
    bool complete() const { return done_ == at_; }
    std::int32_t left() const { return left_; }

    /// What may be done of the next loop, so many items of such a cost: none if it is done, or has
    /// to wait. At least one item is done as long as anything is left to spend.
    Part next(std::int32_t items, std::int32_t cost);
    /// What turned out to cost more than was said.
    void spend(std::int32_t cost) { left_ -= cost < left_ ? cost : left_; }

private:
    std::int32_t left_ = 0;
    std::int32_t done_ = 0;      ///< loops
    std::int32_t position_ = 0;  ///< items of the next one
    std::int32_t at_ = 0;        ///< loops that this walk has come to
};

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
    void spend(std::int32_t cost) const {
        if (progress_ != nullptr) {
            progress_->spend(cost);
        }
    }

private:
    Progress* progress_ = nullptr;
};

}  // namespace weir
