// Random scenes: every one has to stay finite, whole, inside, and within its energy.
#include <algorithm>
#include <exception>

#include "cases.hpp"
#include "random_scene.hpp"

namespace stability {

using weir::BodyId;
using weir::Status;
using weir::Vec2f;

namespace {

struct Outcome {
    Tally tally;
    std::string refused;  ///< not empty: the scene could not be set up
    std::int32_t solids = 0;
    std::int32_t polygons_refused = 0;
};

template <class Real>
class Play {
public:
    explicit Play(const RandomScene& scene)
        : scene_(scene), random_(~scene.seed), tank_(scene.def) {}

    Outcome run() {
        if (!scene_.solids_late) {
            add_solids();
        }
        for (const weir::Box& box : scene_.liquid) {
            tank_.fill(box.min_m.x, box.min_m.y, box.max_m.x, box.max_m.y);
        }
        if (scene_.solids_late) {
            add_solids();
        }
        // The paper's contour moves walls by up to half a cell; compressible liquid springs back.
        const bool moved = scene_.scheme.contour == weir::Contour::mid_edge;
        if (tank_.tally().solids && (moved || scene_.scheme.elastic())) {
            tank_.count_compression();
        }
        for (std::int32_t k = 0; k < scene_.steps; ++k) {
            disturb();
            const float share = 1.0F + random_.uniform(-scene_.jitter, scene_.jitter);
            tank_.step(scene_.dt_s * share);
        }
        outcome_.tally = tank_.tally();
        return outcome_;
    }

private:
    /// A polygon that touches itself by chance, or lies outside, is refused: that is an answer.
    void add_solids() {
        for (const Polygon& solid : scene_.solids) {
            try {
                const BodyId id = solid.moving ? tank_.add_moving(solid.ring, solid.at,
                                                                  solid.velocity, solid.spin,
                                                                  solid.restitution)
                                               : tank_.add_static(solid.ring, solid.at, 0.0F,
                                                                  solid.restitution);
                ++outcome_.solids;
                if (solid.moving) {
                    moving_.push_back({id, solid});
                }
            } catch (const std::exception&) {
                ++outcome_.polygons_refused;
            }
        }
    }

    void disturb() {
        if (scene_.gravity_changes && random_.chance(0.1F)) {
            tank_.set_gravity({random_.uniform(-30.0F, 30.0F), random_.uniform(-30.0F, 30.0F)});
            tank_.count_compression();  // what was below may be above
        }
        const auto& size = scene_.def.capacity;
        for (auto& one : moving_) {
            if (!random_.chance(0.05F)) {
                continue;
            }
            const Vec2f velocity{random_.uniform(-30.0F, 30.0F), random_.uniform(-30.0F, 30.0F)};
            Vec2f at{random_.uniform(-3.0F, static_cast<float>(size.cells_x) + 3.0F),
                     random_.uniform(-3.0F, static_cast<float>(size.cells_y) + 3.0F)};
            float angle = random_.uniform(-100.0F, 100.0F);
            if (!one.second.teleports) {
                weir::Motion now;
                if (tank_.world().motion(one.first, &now) != Status::ok) {
                    continue;
                }
                at = {now.position_m.x / kCell, now.position_m.y / kCell};
                angle = now.angle_rad;
            }
            tank_.move(one.first, at, velocity, angle, random_.uniform(-9.0F, 9.0F));
        }
    }

    const RandomScene& scene_;
    Random random_;
    Tank<Real> tank_;
    std::vector<std::pair<BodyId, Polygon>> moving_;
    Outcome outcome_;
};

Outcome play_in(const RandomScene& scene, Scalar scalar) {
    switch (scalar) {
        case Scalar::usual: break;
        case Scalar::single: return Play<float>(scene).run();
        case Scalar::twice: return Play<double>(scene).run();
        case Scalar::fixed: return Play<weir::Fixed>(scene).run();
        case Scalar::small_fixed: return Play<weir::SmallFixed>(scene).run();
    }
    return scene.is_double ? Play<double>(scene).run() : Play<float>(scene).run();
}

Outcome play(const RandomScene& scene, Scalar scalar) {
    try {
        return play_in(scene, scalar);
    } catch (const std::exception& error) {
        Outcome outcome;
        outcome.refused = error.what();
        return outcome;
    }
}

/// Between solids that touch and in corners a particle may be set back from one into the other;
/// one that flies fast gets further in. More than this is a leak.
constexpr double kDeepest = 0.5;

/// Solids that stood before the liquid came, tame settings, and steps cut as `cfl` wants.
bool limits_depth(const RandomScene& scene, const Tally& tally) {
    return scene.solids_stand() && scene.scheme.contour == weir::Contour::interpolated &&
           tally.slowed == 0 && scene.tame;
}

/// Of what was put in, but for rounding and the order in which places and velocities are known.
constexpr double kMostEnergy = 1.0001;

/// The same of what was there when gravity last turned: jets that have to climb from then on gain.
constexpr double kMostEnergyOfTurn = 1.01;

/// What a whole campaign of scenes came to.
struct Campaign {
    std::int32_t scenes = 0;
    std::int32_t broken = 0;
    std::int32_t refused = 0;
    std::int32_t over_energy = 0;
    std::int32_t too_deep = 0;
    std::int32_t deeper_than_a_corner = 0;
    std::int32_t energy_checked = 0;
    std::int32_t depth_checked = 0;
    std::int32_t solids = 0;
    std::int32_t polygons_refused = 0;
    std::int64_t steps = 0;
    std::int64_t substeps = 0;
    std::int64_t removed = 0;
    std::int32_t removed_at_rest = 0;  ///< scenes with removals though no solid moved
    double worst_energy = 0.0;
    std::int32_t over_energy_of_turn = 0;
    double worst_energy_of_turn = 0.0;
    double deepest = 0.0;
    double deepest_thin = 0.0;

    void take(const RandomScene& scene, const Outcome& outcome, bool tell) {
        const Tally& t = outcome.tally;
        ++scenes;
        steps += t.steps;
        substeps += t.substeps;
        solids += outcome.solids;
        polygons_refused += outcome.polygons_refused;
        const bool whole = t.whole() && t.reset == 0;
        broken += whole ? 0 : 1;
        removed += t.removed;
        const bool shut_in = scene.solids_stand() && t.removed > 0;
        removed_at_rest += shut_in ? 1 : 0;
        refused += outcome.refused.empty() ? 0 : 1;
        bool good = whole && outcome.refused.empty() && !shut_in;
        if (scene.energy_only_falls()) {
            const bool over = !(t.energy_of_all <= kMostEnergy);
            ++energy_checked;
            worst_energy = std::max(worst_energy, t.energy_of_all);
            worst_energy_of_turn = std::max(worst_energy_of_turn, t.energy_ratio);
            over_energy += over ? 1 : 0;
            over_energy_of_turn += t.energy_ratio <= kMostEnergy ? 0 : 1;
            good = good && !over && t.energy_ratio <= kMostEnergyOfTurn;
        }
        if (limits_depth(scene, t) && t.solids) {
            ++depth_checked;
            deepest = std::max(deepest, t.deepest);
            deepest_thin = std::max(deepest_thin, t.deepest_thin);
            deeper_than_a_corner += t.deepest > 0.15 ? 1 : 0;
            const bool deep = !(t.deepest <= kDeepest);
            too_deep += deep ? 1 : 0;
            good = good && !deep;
        }
        if (!good || tell) {
            describe(scene, outcome);
        }
    }

private:
    static void describe(const RandomScene& scene, const Outcome& outcome) {
        const Tally& t = outcome.tally;
        std::printf("  %s\n    %s NaN %lld, outside %lld, lost %lld, inconsistent %lld, "
                    "reset %lld, slowed %lld, energy %.6f%s, depth %.4f%s\n",
                    scene.text().c_str(), outcome.refused.c_str(),
                    static_cast<long long>(t.not_finite), static_cast<long long>(t.outside),
                    static_cast<long long>(t.lost), static_cast<long long>(t.inconsistent),
                    static_cast<long long>(t.reset), static_cast<long long>(t.slowed),
                    t.energy_ratio, scene.energy_only_falls() ? "" : "*", t.deepest,
                    limits_depth(scene, t) ? "" : "*");
    }
};

}  // namespace

void random_scenes(Report& report, const Effort& effort) {
    const std::int32_t count =
        effort.scenes > 0 ? effort.scenes : (effort.full ? 10000 : 300);
    Campaign campaign;
    if (effort.seed != 0 && effort.scenes == 0) {
        const RandomScene scene = random_scene(effort.seed);
        campaign.take(scene, play(scene, effort.scalar), true);
    } else {
        const std::uint64_t first = effort.seed != 0 ? effort.seed : 1;
        for (std::int32_t k = 0; k < count; ++k) {
            const RandomScene scene = random_scene(first + static_cast<std::uint64_t>(k));
            campaign.take(scene, play(scene, effort.scalar), false);
        }
    }
    const auto figure = [&](const char* name, double value) {
        report.figure(std::string("random.") + name, value, "1");
    };
    figure("scenes", campaign.scenes);
    figure("steps", static_cast<double>(campaign.steps));
    figure("substeps", static_cast<double>(campaign.substeps));
    figure("solids", campaign.solids);
    figure("polygons_refused", campaign.polygons_refused);
    figure("energy_checked", campaign.energy_checked);
    figure("depth_checked", campaign.depth_checked);
    report.equals("random.not_set_up", campaign.refused, "scenes", 0);
    report.equals("random.not_finite_lost_or_outside", campaign.broken, "scenes", 0);
    report.equals("random.removed_where_solids_stand", campaign.removed_at_rest, "scenes", 0);
    figure("particles_removed_between_moving_solids", static_cast<double>(campaign.removed));
    report.equals("random.energy_grew", campaign.over_energy, "scenes", 0);
    report.equals("random.deep_in_a_solid", campaign.too_deep, "scenes", 0);
    report.figure("random.worst_energy", campaign.worst_energy, "of put in");
    report.figure("random.energy_grew_since_a_turn", campaign.over_energy_of_turn, "scenes");
    report.at_most("random.worst_energy_since_a_turn", campaign.worst_energy_of_turn,
                   "of put in", kMostEnergyOfTurn);
    report.figure("random.deeper_than_0.15", campaign.deeper_than_a_corner, "scenes");
    report.figure("random.deepest", campaign.deepest, "cells");
    report.figure("random.deepest_in_thin_solids", campaign.deepest_thin, "cells");
}

}  // namespace stability
