// Particles thrown at random polygons, up to four cells a step: thin, spiky, concave, overlapping,
// moving, spinning, put elsewhere. Nothing stays inside, nothing passes a closed wall, nothing is
// lost uncounted; the paper's mode beside it.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "math/vec2.hpp"
#include "measure/random.hpp"
#include "measure/tank_def.hpp"
#include "measure/world_memory.hpp"
#include "problems.hpp"
#include "weir/weir.hpp"

namespace solids {

namespace {

using measure::Random;
using weir::Vec2f;

constexpr float kCell = 0.02F;
constexpr float kFrame = 1.0F / 60.0F;
constexpr std::int32_t kCells = 40;
constexpr std::int32_t kThrown = 1000;
constexpr std::int32_t kSteps = 60;
constexpr std::int32_t kLastPlacing = 30;
/// What is inside is out after at most 33 substeps, two a step.
constexpr std::int32_t kLongestStay = 17;
/// A contour shows corners to half a cell.
constexpr double kTolerance = 0.5;

struct Shape {
    std::vector<Vec2f> ring;  ///< cells, own frame
    bool open = false;
    bool divides = false;  ///< an open line from wall to wall
    bool moving = false;
    bool placed = false;   ///< is put elsewhere now and then
    weir::Motion motion;   ///< m
    weir::BodyId id;
};

struct Counts {
    std::int64_t thrown = 0;
    std::int64_t inside = 0;
    std::int64_t wrong_side = 0;
    std::int64_t unaccounted = 0;
    std::int64_t removed = 0;
    std::int32_t longest = 0;
    std::int32_t cut_short = 0;  ///< scenes, by a refusal
};

std::vector<Vec2f> random_ring(Random& random) {
    std::vector<Vec2f> ring;
    const float size = random.uniform(1.5F, 8.0F);
    switch (random.integer(0, 4)) {
        case 0: {  // a plate
            const float half = random.uniform(0.02F, 0.7F);
            return {{-size, -half}, {size, -half}, {size, half}, {-size, half}};
        }
        case 1: {  // a spike
            return {{0, -random.uniform(0.3F, 2.0F)}, {2 * size, 0}, {0, random.uniform(0.3F, 2.0F)}};
        }
        case 2: {  // a star
            const std::int32_t tips = random.integer(3, 8);
            for (std::int32_t k = 0; k < 2 * tips; ++k) {
                const float angle = 3.14159265F * static_cast<float>(k) / static_cast<float>(tips);
                const float r = (k % 2 == 0 ? 1.0F : random.uniform(0.2F, 0.6F)) * size;
                ring.push_back({r * std::cos(angle), r * std::sin(angle)});
            }
            return ring;
        }
        case 3: {  // an L
            const float arm = random.uniform(0.3F, 2.5F);
            return {{0, 0}, {size, 0}, {size, arm}, {arm, arm}, {arm, size}, {0, size}};
        }
        default: {  // a blob
            const std::int32_t corners = random.integer(3, 12);
            for (std::int32_t k = 0; k < corners; ++k) {
                const float angle =
                    6.2831853F * (static_cast<float>(k) + random.uniform(-0.3F, 0.3F)) /
                    static_cast<float>(corners);
                const float r = random.uniform(0.5F, 1.0F) * size;
                ring.push_back({r * std::cos(angle), r * std::sin(angle)});
            }
            return ring;
        }
    }
}

Vec2f random_place(Random& random) {
    return {random.uniform(4.0F, kCells - 4.0F) * kCell, random.uniform(4.0F, kCells - 4.0F) * kCell};
}

Shape random_shape(Random& random, bool divided) {
    Shape shape;
    shape.ring = random_ring(random);
    shape.moving = random.chance(0.6F);
    shape.motion.position_m = random_place(random);
    shape.motion.angle_rad = random.uniform(-3.0F, 3.0F);
    if (shape.moving) {
        const float speed = 0.5F * kCell / kFrame;
        shape.motion.velocity_mps = {random.uniform(-speed, speed), random.uniform(-speed, speed)};
        shape.motion.spin_radps = random.chance(0.5F) ? random.uniform(-6.0F, 6.0F) : 0.0F;
        shape.placed = !divided && random.chance(0.4F);
    }
    return shape;
}

/// A bent line from below the tank to above it.
Shape divider(Random& random) {
    Shape shape;
    shape.open = true;
    shape.divides = true;
    shape.moving = random.chance(0.5F);
    for (std::int32_t k = 0; k <= 8; ++k) {
        shape.ring.push_back({random.uniform(-2.0F, 2.0F), -48.0F + 12.0F * static_cast<float>(k)});
    }
    shape.motion.position_m = {0.5F * kCells * kCell, 0.5F * kCells * kCell};
    if (shape.moving) {
        shape.motion.velocity_mps = {random.uniform(-0.2F, 0.2F) * kCell / kFrame, 0.0F};
        shape.motion.spin_radps = random.uniform(-0.5F, 0.5F);
    }
    return shape;
}

Vec2f in_frame(const weir::Motion& motion, Vec2f cells) {
    const float x = cells.x - motion.position_m.x / kCell;
    const float y = cells.y - motion.position_m.y / kCell;
    const float c = std::cos(motion.angle_rad);
    const float s = std::sin(motion.angle_rad);
    return {c * x + s * y, c * y - s * x};
}

/// Depth of a point within a ring, 0 outside.
double depth_in(const std::vector<Vec2f>& ring, Vec2f p) {
    bool inside = false;
    double nearest = 1.0e9;
    for (std::size_t k = 0, last = ring.size() - 1; k < ring.size(); last = k++) {
        const double ax = static_cast<double>(ring[last].x);
        const double ay = static_cast<double>(ring[last].y);
        const double dx = static_cast<double>(ring[k].x) - ax;
        const double dy = static_cast<double>(ring[k].y) - ay;
        const double px = static_cast<double>(p.x) - ax;
        const double py = static_cast<double>(p.y) - ay;
        const double t = std::clamp((px * dx + py * dy) / (dx * dx + dy * dy), 0.0, 1.0);
        nearest = std::min(nearest, std::hypot(px - t * dx, py - t * dy));
        if ((ring[k].y > p.y) != (ring[last].y > p.y) && px < py / dy * dx) {
            inside = !inside;
        }
    }
    return inside ? nearest : 0.0;
}

/// On which side of a dividing line a point is.
bool left_of(const Shape& line, const weir::Motion& motion, Vec2f cells) {
    const Vec2f p = in_frame(motion, cells);
    std::size_t k = 0;
    while (k + 2 < line.ring.size() && line.ring[k + 1].y < p.y) {
        ++k;
    }
    const Vec2f a = line.ring[k];
    const Vec2f b = line.ring[k + 1];
    return p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x);
}

template <class Real>
class Scene {
public:
    Scene(std::uint64_t seed, weir::Contour contour) : random_(seed) {
        divided_ = random_.chance(0.4F);
        weir::WorldDef def = measure::tank_def(kCells, kCells, kThrown, 8, 256);
        def.cell_m = kCell;
        def.capacity.wall_edges = kThinWalls<Real> ? 6000 : 0;
        def.contour = contour;
        def.gravity_mps2 = {0.0F, random_.chance(0.5F) ? -9.81F : 0.0F};
        def.flip_ratio = 1.0F;
        def.cfl = 2.0F;
        def.max_substeps = 2;
        memory_ = measure::memory_for<Real>(def);
        ready_ = world_.init(def, memory_.data(), memory_.size()) == weir::Status::ok;
        const std::int32_t bodies = random_.integer(2, 5);
        if (divided_) {
            add(divider(random_));
        }
        for (std::int32_t k = 0; k < bodies; ++k) {
            add(random_shape(random_, divided_));
        }
    }

    void run(Counts& counts) {
        throw_particles();
        const std::int32_t thrown = world_.particle_positions().size;
        counts.thrown += thrown;
        const std::int32_t left = left_count();
        std::int32_t removed = 0;
        for (std::int32_t step = 0; step < kSteps && ready_; ++step) {
            move(step);
            const weir::StepReport report = world_.step(kFrame);
            removed += report.particles_removed_stuck;
            counts.unaccounted += std::abs(thrown - removed - report.particles);
            look_inside(report.particles_removed_stuck, counts);
        }
        counts.removed += removed;
        counts.cut_short += ready_ ? 0 : 1;
        if (divided_) {
            const std::int32_t now = left_count();
            const std::int32_t right = world_.particle_positions().size - now;
            counts.wrong_side += std::max(0, now - left) + std::max(0, right - (thrown - left));
        }
    }

private:
    void add(Shape shape) {
        std::vector<Vec2f> metres;
        for (const Vec2f& vertex : shape.ring) {
            metres.push_back({vertex.x * kCell, vertex.y * kCell});
        }
        weir::BodyDef def;
        def.polygon = {metres.data(), static_cast<std::int32_t>(metres.size())};
        def.open = shape.open;
        def.motion = shape.motion;
        def.surface.restitution = random_.uniform(0.0F, 1.0F);
        const weir::Status added = shape.moving ? world_.add_moving_body(def, &shape.id)
                                                : world_.add_static_body(def, &shape.id);
        if (added == weir::Status::ok) {
            shapes_.push_back(shape);
        } else if (shape.open) {
            divided_ = false;
        }
    }

    void throw_particles() {
        for (std::int32_t k = 0; k < kThrown; ++k) {
            const float speed = random_.uniform(0.0F, 4.0F) * kCell / kFrame;
            const float angle = random_.uniform(0.0F, 6.2831853F);
            const Vec2f at{random_.uniform(0.1F, kCells - 0.1F) * kCell,
                           random_.uniform(0.1F, kCells - 0.1F) * kCell};
            const weir::Status added =
                world_.add_particle(at, {speed * std::cos(angle), speed * std::sin(angle)});
            ready_ = ready_ && (added == weir::Status::ok ||
                                added == weir::Status::particle_inside_solid);
        }
    }

    void move(std::int32_t step) {
        for (Shape& shape : shapes_) {
            if (shape.moving && step % 15 == 7) {
                weir::Motion motion;
                ready_ = ready_ && world_.motion(shape.id, &motion) == weir::Status::ok;
                motion.velocity_mps = {-motion.velocity_mps.x, -motion.velocity_mps.y};
                motion.spin_radps = -motion.spin_radps;
                ready_ = ready_ && world_.set_motion(shape.id, motion) == weir::Status::ok;
            }
            if (shape.placed && step <= kLastPlacing && step % 5 == 0) {
                weir::Motion motion = shape.motion;
                motion.position_m = random_place(random_);
                motion.angle_rad = random_.uniform(-3.0F, 3.0F);
                ready_ = ready_ && world_.set_motion(shape.id, motion) == weir::Status::ok;
            }
        }
    }

    Vec2f position(std::int32_t k) const {
        return weir::convert<float>(world_.particle_positions()[k]);
    }

    std::int32_t left_count() const {
        if (!divided_) {
            return 0;
        }
        weir::Motion motion;
        std::int32_t count = 0;
        if (world_.motion(shapes_[0].id, &motion) == weir::Status::ok) {
            for (std::int32_t k = 0; k < world_.particle_positions().size; ++k) {
                count += left_of(shapes_[0], motion, position(k)) ? 1 : 0;
            }
        }
        return count;
    }

    /// Counts who stays. After a removal particles have other numbers: all begin anew.
    void look_inside(std::int32_t removed, Counts& counts) {
        const std::int32_t count = world_.particle_positions().size;
        std::vector<double> depths(static_cast<std::size_t>(count), 0.0);
        for (const Shape& shape : shapes_) {
            weir::Motion motion;
            if (shape.open || world_.motion(shape.id, &motion) != weir::Status::ok) {
                continue;
            }
            for (std::int32_t k = 0; k < count; ++k) {
                double& depth = depths[static_cast<std::size_t>(k)];
                depth = std::max(depth, depth_in(shape.ring, in_frame(motion, position(k))));
            }
        }
        if (removed > 0 || inside_for_.size() != depths.size()) {
            inside_for_.assign(depths.size(), 0);
        }
        for (std::size_t k = 0; k < depths.size(); ++k) {
            inside_for_[k] = depths[k] > kTolerance ? inside_for_[k] + 1 : 0;
            counts.longest = std::max(counts.longest, inside_for_[k]);
            counts.inside += inside_for_[k] == kLongestStay + 1 ? 1 : 0;
        }
    }

    Random random_;
    measure::WorldMemory memory_;
    weir::World<Real> world_;
    std::vector<Shape> shapes_;
    std::vector<std::int32_t> inside_for_;  ///< steps, by particle
    bool divided_ = false;
    bool ready_ = false;
};

template <class Real>
void throw_at(Report& report, const std::string& name, weir::Contour contour,
              std::int32_t scenes) {
    Counts counts;
    for (std::int32_t scene = 0; scene < scenes; ++scene) {
        Scene<Real>(static_cast<std::uint64_t>(scene) + 1, contour).run(counts);
    }
    const auto none = [&](const char* what, std::int64_t count) {
        report.equals(name + what, static_cast<double>(count), "particles", 0.0);
    };
    const auto some = [&](const char* what, std::int64_t count) {
        report.figure(name + what, static_cast<double>(count), "particles");
    };
    some(".thrown", counts.thrown);
    some(".removed_and_counted", counts.removed);
    report.figure(name + ".longest_inside", counts.longest, "steps");
    if (contour == weir::Contour::mid_edge) {
        some(".inside_too_long", counts.inside);
    } else {
        none(".inside_too_long", counts.inside);
    }
    if (!kThinWalls<Real>) {
        report.skipped(name + ".wrong_side",
                       weir::status_text(weir::Status::small_fixed_has_no_thin_walls));
    } else if (contour == weir::Contour::mid_edge) {
        some(".wrong_side", counts.wrong_side);
    } else {
        none(".wrong_side", counts.wrong_side);
    }
    none(".unaccounted", counts.unaccounted);
    report.equals(name + ".cut_short", counts.cut_short, "scenes", 0.0);
}

}  // namespace

void torture(Report& report, const Effort& effort) {
    const std::int32_t scenes = effort.full ? 1000 : 40;
    in_scalar(report, effort.real, [&](auto zero) {
        using Real = decltype(zero);
        throw_at<Real>(report, "torture", weir::Contour::interpolated, scenes);
        throw_at<Real>(report, "torture.mid_edge", weir::Contour::mid_edge, scenes);
    });
}

}  // namespace solids
