// What each stage of a step took.
#pragma once

#include "base/work.hpp"
#include "weir/config.hpp"
#include "weir/report.hpp"

namespace weir {

/// Adds ticks and work since the last call to a stage.
class StageClock {
public:
    StageClock(TickFunction ticks, Work work, StepReport& report)
        : ticks_(ticks), work_(work), report_(report), last_(ticks != nullptr ? ticks() : 0),
          left_(work.left()) {}

    void charge(Stage stage) {
        const std::int32_t left = work_.left();
        std::uint32_t& sum = report_.work[static_cast<std::int32_t>(stage)];
        const std::uint32_t more =
            static_cast<std::uint32_t>(left_) - static_cast<std::uint32_t>(left);
        sum = more < ~sum ? sum + more : ~0U;  // many substeps of a large tank
        left_ = left;
        if (ticks_ != nullptr) {
            const std::uint64_t now = ticks_();
            report_.ticks[static_cast<std::int32_t>(stage)] += now - last_;
            last_ = now;
        }
    }

private:
    TickFunction ticks_;
    Work work_;
    StepReport& report_;
    std::uint64_t last_;
    std::int32_t left_;
};

}  // namespace weir
