#include "base/work.hpp"

// Not inline: stages ask from some sixty places, and small boards have little room for code.

namespace weir {

namespace {

std::int32_t less(std::int32_t left, std::int64_t cost) {
    const std::int64_t now = left - cost;
    return now < -kMostWork ? -kMostWork : static_cast<std::int32_t>(now);
}

}  // namespace

void Progress::spend(std::int32_t cost) { left_ = less(left_, cost); }

void Progress::expect(std::int32_t items, std::int32_t cost) {
    left_ = less(left_, static_cast<std::int64_t>(items) * cost);
    position_ = items > 0 && cost > position_ ? cost : position_;
}

// Nearly all loops are done at once, with products of 32 bits.
Part Progress::next(std::int32_t items, std::int32_t cost) {
    if (at_ == done_ && left_ > 0 && items < 0x8000 && cost < 0x10000) {
        const std::int32_t first = position_;
        const std::int32_t left = left_ - (items - first) * cost;
        if (left >= 0) {
            left_ = left;
            position_ = 0;
            at_ = ++done_;
            return {first, items};
        }
    }
    return next_of_many(items, cost);
}

[[gnu::noinline]] Part Progress::next_of_many(std::int32_t items, std::int32_t cost) {
    if (at_++ != done_ || left_ <= 0) {
        if (foreseeing()) {
            expect(items, cost);
        }
        return {};
    }
    const std::int32_t first = position_;
    if (static_cast<std::int64_t>(items - first) * cost <= left_) {
        left_ -= (items - first) * cost;
        position_ = 0;
        ++done_;
        return {first, items};
    }
    const std::int32_t fitting = left_ / cost;
    const std::int32_t count = fitting > 0 ? fitting : 1;
    left_ -= count * cost;
    position_ = first + count;
    if (position_ == items) {
        position_ = 0;
        ++done_;
    }
    return {first, first + count};
}

Part Work::take(std::int32_t items, std::int32_t cost) const {
    return progress_ != nullptr ? progress_->next(items, cost) : Part{0, items};
}

#if WEIR_PARALLEL
std::int32_t Work::pieces(std::int32_t items, std::int32_t cost, std::int32_t grain) const {
    // A piece of less work than this, some microseconds, is done sooner than it is handed over.
    constexpr std::int64_t kLeastPiece = 1024;
    if (progress_ == nullptr || progress_->parallel_for == nullptr) {
        return 1;
    }
    const std::int64_t worth = static_cast<std::int64_t>(items) * cost / kLeastPiece;
    const std::int64_t grains = items / grain;
    const std::int64_t most = worth < grains ? worth : grains;
    return static_cast<std::int32_t>(most < kMostPieces ? most : kMostPieces);
}
#else
std::int32_t Work::pieces(std::int32_t, std::int32_t, std::int32_t) const { return 1; }
#endif

bool Work::once(std::int32_t cost) const { return !take(1, cost).empty(); }

}  // namespace weir
