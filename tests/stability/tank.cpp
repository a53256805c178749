#include "tank.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "contour/marching_squares.hpp"
#include "math/vec2.hpp"
#include "measure/tank_def.hpp"
#include "world/world_state.hpp"

namespace stability {

using weir::BodyId;
using weir::Clamped;
using weir::Status;
using weir::StepReport;
using weir::Vec2;
using weir::Vec2f;

namespace {

void require(Status status) {
    if (status != Status::ok) {
        throw Refused(status);
    }
}

}  // namespace

std::string Scheme::name() const {
    std::string text = elastic() ? "eos" : "projection";
    return contour == weir::Contour::mid_edge ? text + ".mid_edge" : text;
}

weir::WorldDef tank_def(const Scheme& scheme, std::int32_t cells_x, std::int32_t cells_y,
                        std::int32_t particles, std::int32_t bodies, std::int32_t vertices) {
    weir::WorldDef def = measure::tank_def(cells_x, cells_y, particles, bodies, vertices);
    def.cell_m = kCell;
    def.pressure = scheme.pressure;
    def.contour = scheme.contour;
    def.sound_speed_mps = scheme.elastic() ? 10.0F : 0.0F;
    def.max_substeps = 32;
    return def;
}

template <class Real>
Tank<Real>::Tank(const weir::WorldDef& def, unsigned char dirt)
    : def_(def),
      memory_(measure::memory_for<Real>(def)),
      gravity_mps2_(def.gravity_mps2) {
    std::memset(memory_.data(), dirt, memory_.size());
    require(world_.init(def, memory_.data(), memory_.size()));
    to_cells_ = static_cast<double>(world_.velocity_scale()) / static_cast<double>(def.cell_m);
}

template <class Real>
std::int32_t Tank<Real>::fill(float x0, float y0, float x1, float y1) {
    std::int32_t added = 0;
    const double before = energy();
    require(world_.fill({to_m({x0, y0}), to_m({x1, y1})}, &added));
    expected_ += added;
    put_in_ += energy() - before;
    return added;
}

template <class Real>
void Tank<Real>::fill_moving(float x0, float y0, float x1, float y1, Vec2f velocity) {
    const float per_axis = std::sqrt(static_cast<float>(def_.particles_per_cell));
    const auto count = [&](float from, float to) {
        return static_cast<int>((to - from) * per_axis);
    };
    for (int b = 0; b < count(y0, y1); ++b) {
        for (int a = 0; a < count(x0, x1); ++a) {
            add({x0 + (static_cast<float>(a) + 0.5F) / per_axis,
                 y0 + (static_cast<float>(b) + 0.5F) / per_axis},
                velocity);
        }
    }
}

template <class Real>
void Tank<Real>::add(Vec2f at, Vec2f velocity) {
    require(world_.add_particle(to_m(at), to_m(velocity)));
    put_in_ += energy_of(expected_++);
}

template <class Real>
void Tank<Real>::remove(std::int32_t index) {
    require(world_.remove_particle(index));
    --expected_;
    energy_from_now();
}

template <class Real>
BodyId Tank<Real>::add_body(const Ring& ring, const weir::Motion& motion, float restitution,
                            bool moving) {
    Ring metres;
    for (const Vec2f p : ring) {
        metres.push_back(to_m(p));
    }
    weir::BodyDef def;
    def.polygon = {metres.data(), static_cast<std::int32_t>(metres.size())};
    def.motion = motion;
    def.surface.restitution = restitution;
    BodyId id;
    require(moving ? world_.add_moving_body(def, &id) : world_.add_static_body(def, &id));
    tally_.solids = true;
    return id;
}

template <class Real>
BodyId Tank<Real>::add_static(const Ring& ring, Vec2f at, float angle_rad, float restitution) {
    return add_body(ring, {to_m(at), angle_rad, {}, 0.0F}, restitution, false);
}

template <class Real>
BodyId Tank<Real>::add_moving(const Ring& ring, Vec2f at, Vec2f velocity, float spin,
                              float restitution) {
    return add_body(ring, {to_m(at), 0.0F, to_m(velocity), spin}, restitution, true);
}

template <class Real>
void Tank<Real>::move(BodyId id, Vec2f at, Vec2f velocity, float angle, float spin) {
    require(world_.set_motion(id, {to_m(at), angle, to_m(velocity), spin}));
}

template <class Real>
void Tank<Real>::set_gravity(Vec2f gravity_mps2) {
    lost_ += put_in_ - energy() - stored_energy();
    require(world_.set_gravity(gravity_mps2));
    gravity_mps2_ = gravity_mps2;
    energy_from_now();
}

/// What has flown into a cell is given back: p² / 2ρc², more where a cell is thin, which takes less
/// flow to the same pressure, and where sound was made slower than asked for.
template <class Real>
double Tank<Real>::stored_energy() const {
    if (def_.pressure != weir::Pressure::equation_of_state) {
        return 0.0;
    }
    const auto pressure = world_.pressure();
    const auto density = world_.density();
    const auto& state =
        *reinterpret_cast<const weir::detail::WorldState<Real>*>(memory_.data());
    const double sound = to_cells_ * static_cast<double>(state.simulation.pressure.sound_speed);
    if (!(sound > 0.0)) {  // there was no step yet
        return 0.0;
    }
    const double cell_m = static_cast<double>(def_.cell_m);
    const double to_speed = static_cast<double>(world_.pressure_scale()) / (sound * cell_m * cell_m);
    double sum = 0.0;
    for (std::int32_t j = 0; j < pressure.rows; ++j) {
        for (std::int32_t i = 0; i < pressure.columns; ++i) {
            const double speed = to_speed * static_cast<double>(pressure.at(i, j));
            const double full = std::min(1.0, static_cast<double>(density.at(i, j)));
            sum += full > 0.0 ? 0.5 * speed * speed / full * def_.particles_per_cell : 0.0;
        }
    }
    return sum;
}

template <class Real>
double Tank<Real>::fall(Vec2<double> x) const {
    return static_cast<double>(gravity_mps2_.x / def_.cell_m) * x.x +
           static_cast<double>(gravity_mps2_.y / def_.cell_m) * x.y;
}

/// Of the tank: where liquid ends up.
template <class Real>
Vec2<double> Tank<Real>::lowest_corner() const {
    return {gravity_mps2_.x > 0.0F ? static_cast<double>(world_.cells_x()) : 0.0,
            gravity_mps2_.y > 0.0F ? static_cast<double>(world_.cells_y()) : 0.0};
}

/// Were all liquid still and nowhere too dense: cells are filled from the deepest on.
template <class Real>
typename Tank<Real>::AtRest Tank<Real>::at_rest() const {
    std::vector<std::pair<double, double>> cells;  // (gravity times centre, room)
    for (std::int32_t j = 0; j < def_.capacity.cells_y; ++j) {
        for (std::int32_t i = 0; i < def_.capacity.cells_x; ++i) {
            cells.emplace_back(fall({i + 0.5, j + 0.5}), open_share(i, j));
        }
    }
    std::sort(cells.rbegin(), cells.rend());
    const double corner = fall(lowest_corner());
    double left = static_cast<double>(expected_) / def_.particles_per_cell;
    AtRest rest{cells.front().first, 0.0};
    for (std::size_t k = 0; k < cells.size() && left > 0.0; ++k) {
        rest.surface = cells[k].first;
        rest.energy += std::min(left, cells[k].second) * def_.particles_per_cell *
                       (corner - cells[k].first);
        left -= cells[k].second;
    }
    return rest;
}

template <class Real>
double Tank<Real>::open_share(std::int32_t i, std::int32_t j) const {
    if (!tally_.solids) {
        return 1.0;
    }
    const auto solid = world_.signed_distance();
    const auto at = [&](std::int32_t column, std::int32_t row) {
        return static_cast<Look<Real>>(solid.at(column, row));
    };
    const Look<Real> corner[4] = {at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)};
    return static_cast<double>(weir::open_area(corner));
}

/// What expands lifts what lies over it: its volume × the pressure of still liquid there.
template <class Real>
void Tank<Real>::count_compression() {
    world_.step(1.0e-8F);
    const auto density = world_.density();
    const AtRest rest = at_rest();
    double surface = rest.surface;
    for (const auto x : world_.particle_positions()) {
        surface = std::min(surface, fall(weir::convert<double>(x)));
    }
    for (std::int32_t j = 0; j < density.rows; ++j) {
        for (std::int32_t i = 0; i < density.columns; ++i) {
            const double over = static_cast<double>(density.at(i, j)) - 1.0;
            const double pressure = fall({i + 0.5, j + 0.5}) - surface;
            if (over > 1.0e-4 && pressure > 0.0) {  // rounding is none
                put_in_ += over * open_share(i, j) * def_.particles_per_cell * pressure;
            }
        }
    }
    put_in_ = std::max(put_in_, rest.energy);
}

/// What a report says must fit what was asked, what is there, and itself.
template <class Real>
bool Tank<Real>::consistent(const StepReport& r, float dt_s, double fastest) const {
    const bool usable = std::isfinite(dt_s) && dt_s >= 1.0e-9F;
    const float rounding = 1.0e-6F * dt_s + static_cast<float>(time_unit());
    const bool time = usable ? r.dt_s > 0.0F && r.dt_s <= dt_s + rounding && r.substeps >= 1 &&
                                   r.substeps <= def_.max_substeps
                             : r.dt_s == 0.0F && r.substeps == 0;
    const bool pause = dt_s == 0.0F;
    const bool shortened = !pause && (!usable || r.dt_s < dt_s - rounding);
    const bool flags = r.has(Clamped::time_step) == shortened &&
                       r.has(Clamped::speed) == (r.particles_slowed > 0) &&
                       r.has(Clamped::not_finite) == (r.particles_reset > 0) &&
                       !r.has(Clamped::not_initialised);
    const double reported = static_cast<double>(r.max_speed_mps) / static_cast<double>(def_.cell_m);
    return time && flags && r.particles == expected_ && std::isfinite(reported) &&
           fastest <= reported * 1.0001 + 1.0e-9;
}

template <class Real>
StepReport Tank<Real>::step(float dt_s) {
    const StepReport report = world_.step(dt_s);
    expected_ -= report.particles_removed_stuck;
    tally_.removed += report.particles_removed_stuck;
    const std::int32_t count = world_.particle_positions().size;
    const auto width = static_cast<Look<Real>>(world_.cells_x());
    const auto height = static_cast<Look<Real>>(world_.cells_y());
    double fastest = 0.0;
    bool all_finite = true;
    for (std::int32_t k = 0; k < count; ++k) {
        const Vec2<Look<Real>> x = position(k);
        const Vec2<double> v = velocity(k);
        const bool finite = weir::is_finite(x) && weir::is_finite(v);
        // False for a NaN. A periodic tank's lower side belongs to it.
        const bool inside = (x.x > 0 || (def_.periodic_x && x.x >= 0)) && x.x < width &&
                            (x.y > 0 || (def_.periodic_y && x.y >= 0)) && x.y < height;
        tally_.not_finite += finite ? 0 : 1;
        tally_.outside += inside ? 0 : 1;
        all_finite = all_finite && finite && inside;
        fastest = std::max({fastest, std::fabs(v.x), std::fabs(v.y)});
    }
    ++tally_.steps;
    tally_.substeps += report.substeps;
    tally_.lost += count == expected_ ? 0 : 1;
    tally_.reset += report.particles_reset;
    tally_.slowed += report.particles_slowed;
    tally_.clamped |= report.clamped;
    tally_.inconsistent += consistent(report, dt_s, fastest) ? 0 : 1;
    tally_.fastest = std::max(tally_.fastest, fastest);
    if (put_in_ > 0.0) {
        const auto take = [](double ratio, double& worst) {  // a NaN too
            worst = ratio <= worst ? worst : ratio;
        };
        take(share_of(put_in_), tally_.energy_ratio);
        take(share_of(put_in_ + lost_), tally_.energy_of_all);
    }
    if (tally_.solids && all_finite) {
        look_at_depths();
    }
    return report;
}

template <class Real>
void Tank<Real>::run(std::int32_t steps, float dt_s) {
    for (std::int32_t k = 0; k < steps; ++k) {
        step(dt_s);
    }
}

template <class Real>
double Tank<Real>::depth(Vec2<Look<Real>> x) const {
    const auto field = world_.signed_distance();
    const auto i = static_cast<std::int32_t>(x.x);
    const auto j = static_cast<std::int32_t>(x.y);
    const auto at = [&](std::int32_t column, std::int32_t row) {
        return static_cast<Look<Real>>(field.at(column, row));
    };
    const Look<Real> corner[4] = {at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)};
    const Vec2<Look<Real>> local{x.x - static_cast<Look<Real>>(i),
                                 x.y - static_cast<Look<Real>>(j)};
    if (*std::max_element(corner, corner + 4) > Look<Real>(0)) {
        return -static_cast<double>(weir::contour_hit(corner, local).distance);
    }
    const Look<Real> low = corner[0] + local.x * (corner[1] - corner[0]);
    const Look<Real> high = corner[3] + local.x * (corner[2] - corner[3]);
    return -static_cast<double>(low + local.y * (high - low));
}

/// Whether the solid about the cell of a point has a node a cell or more inside it.
template <class Real>
bool Tank<Real>::thick_at(Vec2<Look<Real>> x) const {
    const auto field = world_.signed_distance();
    const auto first_i = std::max(0, static_cast<std::int32_t>(x.x) - 1);
    const auto first_j = std::max(0, static_cast<std::int32_t>(x.y) - 1);
    const auto last_i = std::min(field.columns - 1, static_cast<std::int32_t>(x.x) + 2);
    const auto last_j = std::min(field.rows - 1, static_cast<std::int32_t>(x.y) + 2);
    Look<Real> deepest = 0;
    for (std::int32_t j = first_j; j <= last_j; ++j) {
        for (std::int32_t i = first_i; i <= last_i; ++i) {
            deepest = std::min(deepest, static_cast<Look<Real>>(field.at(i, j)));
        }
    }
    // The paper's matrix knows inside from outside only.
    return deepest <= static_cast<Look<Real>>(def_.contour == weir::Contour::mid_edge ? -0.5 : -1);
}

template <class Real>
void Tank<Real>::look_at_depths() {
    for (std::int32_t k = 0; k < world_.particle_positions().size; ++k) {
        const Vec2<Look<Real>> x = position(k);
        const double deep = depth(x);
        if (deep > std::min(tally_.deepest, tally_.deepest_thin)) {
            double& worst = thick_at(x) ? tally_.deepest : tally_.deepest_thin;
            worst = std::max(worst, deep);
        }
    }
}

template <class Real>
double Tank<Real>::kinetic_energy() const {
    double sum = 0.0;
    for (std::int32_t k = 0; k < world_.particle_velocities().size; ++k) {
        const Vec2<double> v = velocity(k);
        sum += 0.5 * (v.x * v.x + v.y * v.y);
    }
    return sum;
}

template <class Real>
double Tank<Real>::energy_of(std::int32_t index) const {
    const Vec2<double> corner = lowest_corner();
    const auto x = weir::convert<double>(position(index));
    const Vec2<double> v = velocity(index);
    return 0.5 * (v.x * v.x + v.y * v.y) - fall({x.x - corner.x, x.y - corner.y});
}

template <class Real>
double Tank<Real>::energy() const {
    double sum = 0.0;
    for (std::int32_t k = 0; k < world_.particle_positions().size; ++k) {
        sum += energy_of(k);
    }
    return sum;
}

template <class Real>
double Tank<Real>::rounding_room() const {
    const double all = std::max(1, expected_);
    const double weight = std::fabs(fall({1.0, 0.0})) + std::fabs(fall({0.0, 1.0}));
    const double speed = std::sqrt(2.0 * std::max(0.0, put_in_ + lost_) / all);  // root mean square
    return all * (weight * place_unit() + speed * speed_unit());
}

template <class Real>
double Tank<Real>::mean_height() const {
    double sum = 0.0;
    for (const auto x : world_.particle_positions()) {
        sum += static_cast<double>(x.y);
    }
    return sum / std::max(1, expected_);
}

template <class Real>
double Tank<Real>::rms_speed() const {
    return std::sqrt(2.0 * kinetic_energy() / std::max(1, expected_));
}

template <class Real>
double Tank<Real>::depth_at_rest() const {
    return static_cast<double>(expected_) / (def_.particles_per_cell * world_.cells_x());
}

template <class Real>
double Tank<Real>::volume_error() const {
    return mean_height() / (0.5 * depth_at_rest()) - 1.0;
}

template <class Real>
double Tank<Real>::highest_density() const {
    const auto columns = static_cast<std::size_t>(world_.cells_x());
    std::vector<int> count(columns * static_cast<std::size_t>(world_.cells_y()));
    int most = 0;
    for (std::int32_t k = 0; k < world_.particle_positions().size; ++k) {
        const Vec2<Look<Real>> x = position(k);
        const std::size_t cell =
            static_cast<std::size_t>(x.y) * columns + static_cast<std::size_t>(x.x);
        most = std::max(most, ++count[cell]);
    }
    return static_cast<double>(most) / def_.particles_per_cell;
}

template class Tank<float>;
template class Tank<double>;
template class Tank<weir::Fixed>;
template class Tank<weir::SmallFixed>;

}  // namespace stability
