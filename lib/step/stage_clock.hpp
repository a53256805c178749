// Where a step's time goes.
#pragma once

#include "weir/config.hpp"
#include "weir/report.hpp"

namespace weir {

/// Adds the ticks since the last call to a stage.
class StageClock {
public:
    StageClock(TickFunction ticks, StepReport& report)
        : ticks_(ticks), report_(report), last_(ticks != nullptr ? ticks() : 0) {}

    void charge(Stage stage) {
        if (ticks_ != nullptr) {
            const std::uint64_t now = ticks_();
            report_.ticks[static_cast<std::int32_t>(stage)] += now - last_;
            last_ = now;
        }
    }

private:
    TickFunction ticks_;
    StepReport& report_;
    std::uint64_t last_;
};

}  // namespace weir
