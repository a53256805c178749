// The world: liquid, solids and the tank around them, in memory that the caller hands over.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "weir/config.hpp"
#include "weir/contact.hpp"
#include "weir/diagnostics.hpp"
#include "weir/features.hpp"
#include "weir/force.hpp"
#include "weir/memory.hpp"
#include "weir/report.hpp"
#include "weir/status.hpp"
#include "weir/storage.hpp"
#include "weir/types.hpp"

namespace weir {

namespace detail {
template <class Real>
struct WorldState;
}

/// A tank of liquid and solids. `Real` is the arithmetic inside; the face is the same for each.
///
/// A zero-initialised World is not a world yet: until `init` succeeds every call answers
/// `Status::not_initialised` and a step does nothing. A World never allocates and owns no
/// resource: it may be thrown away at any time. A copy is another name for the same world in the
/// same memory; `save` keeps a state.
///
/// Set-up calls check everything first and change nothing when they refuse.
template <class Real>
class World {
public:
    /// Takes the caller's memory, which must outlive the world, and lays an empty tank in it.
    /// @param bytes at least `world_bytes<Real>(def.capacity)`, at a multiple of `world_alignment`.
    /// A definition that is a constant links only what it asks for (weir/features.hpp).
    WEIR_ALWAYS_INLINE Status init(const WorldDef& def, void* memory, std::size_t bytes) {
        return init_with(detail::features_of<Real>(def), def, memory, bytes);
    }

    /// The same for an array of bytes, or what has data() and size(): a std::array of them.
    template <class Room, std::enable_if_t<sizeof(detail::ElementOf<Room>) == 1, int> = 0>
    WEIR_ALWAYS_INLINE Status init(const WorldDef& def, Room& memory) {
        return init(def, detail::first_of(memory), detail::size_of(memory));
    }

    /// A solid that never moves; it is rasterized once. Liquid found inside it is pushed out, and
    /// pressed together around it until it has lifted what lies over it: of the room that 10 × 10
    /// cells take amid a pool 7 % is missing a second later, as if a moving body were led in
    /// (`move_body`); with an equation of state nearly all, and a third 10 s later. If its place is
    /// drained first (`drain`) none is.
    Status add_static_body(const BodyDef& def, BodyId* id);
    /// A solid that moves as told; it is rasterized again in each step in which it moved. It may
    /// come in from outside the tank, where other bodies are refused.
    Status add_moving_body(const BodyDef& def, BodyId* id);
    /// A solid that gravity and the liquid move, and that meets the tank's walls, bodies of all
    /// kinds and its like; otherwise a moving body. Where two surfaces meet the larger restitution
    /// and the larger friction count, at the tank's walls too; conveyors take it along.
    /// Bodies that are in each other are moved apart, by at most 1/16 cell in a substep. There is
    /// room for 6 points of contact a body, which all bodies share; of more the nearest count.
    /// A body smaller than 2.4 cells is braked in its turning by the liquid that it is in. One
    /// below two cells, or much thinner than one, the grid shows in part or not at all: liquid
    /// lifts it as it should, but flows through it. So thin hulls hold nothing, and
    /// `Capacity::wall_edges` is not for free bodies.
    /// `def.hold` puts it on a hinge or a rail, which are part of the solve: a water wheel of any
    /// density is stable. Other joints, and whatever else moves bodies, are for a physics engine
    /// (`examples/box2d`).
    /// Any density is stable with Pressure::projection, down to about a tenth of the liquid's with
    /// the other. What is over 40 times as heavy as what it lies on wants steps below 1/60 s.
    /// Wants `capacity.two_way`; not in `SmallFixed` (`Status::free_body_in_small_world`).
    Status add_free_body(const BodyDef& def, BodyId* id);
    /// Places a moving body and sets its velocity and spin, which it keeps until told otherwise.
    /// Another position than it had is a leap, which presses together the liquid that was there:
    /// over and over again it destroys the liquid's volume. Who knows only positions calls
    /// `move_body` before each step. A blow to a free body: what `motion` says of it, with an
    /// impulse over `mass` added to its velocity, as often as wanted: the same place is no leap.
    Status set_motion(BodyId id, const Motion& motion);
    /// Leads a moving body there within the next step, which is to be of dt_s: it gets the velocity
    /// and the spin, the shorter way round, that take it there. After that step it stands still
    /// unless it is led on. A free body moves as told through that step, and keeps its velocity
    /// after it: a caller that holds one, or has found that something the world does not know
    /// stopped it, leads it before each step in which it is not free.
    /// What is further than a body can go in dt_s (`kMaxSpeed`, in fixed point `kMaxSpeedFixed` and
    /// `kMaxSpeedSmallFixed`) it goes as far as it can: lead it on, or ask `motion` where it is.
    Status move_body(BodyId id, Vec2f position_m, float angle_rad, float dt_s);
    /// Where a body is now, after the steps that were taken.
    Status motion(BodyId id, Motion* motion) const;
    /// From now on: a belt that is switched on, a floor that becomes slippery. Any kind of body.
    /// It wakes who sleeps, also if nothing is different: call it when something is.
    Status set_surface(BodyId id, const Surface& surface);
    Status remove_body(BodyId id);

    /// What the liquid did to a body in the last step. Wants `capacity.two_way`. Whoever moves a
    /// body by it from step to step is stable only if the body is heavier than the liquid that it
    /// takes along; `add_free_body` knows no such limit. Momentum that the method itself loses or
    /// gains is shared out to the tank and to bodies that are not free, without gravity to free
    /// ones, too, so that sums are right.
    Status force(BodyId id, BodyForce* force) const;
    /// And to the tank: pressure on its walls, particles that hit them, drag of those without slip.
    /// The sum over tank and bodies is what gravity gave to the liquid less what its momentum
    /// changed by, to 1e-6 of the liquid's weight, except in substeps in which liquid touched
    /// nothing, or free bodies alone. `Fixed` and `SmallFixed` keep it in whole numbers, of which
    /// none is lost, and tell them rounded; what would be nobody's there is the tank's.
    Status tank_force(BodyForce* force) const;
    /// What a body weighs. Wants `capacity.two_way`.
    Status mass(BodyId id, BodyMass* mass) const;

    /// Fills a box with particles on a lattice, leaving out what is inside solids.
    /// All or nothing: refuses if not every particle has room. A box takes about its area over
    /// cell_m² times `particles_per_cell`; one that holds no point of the lattice adds 0, and is
    /// ok. A box that reaches beyond the tank is refused (`Status::box_outside_domain`). Particles
    /// that are there already stay, so where there is liquid there is twice as much then, and room
    /// is asked for as `add_particle` does: an inlet may be a small box that is filled each step.
    /// @param added number of particles, may be null; with `Status::no_free_particle` how many it
    /// would have been.
    Status fill(const Box& box_m, std::int32_t* added = nullptr, Liquid kind = Liquid::first);
    /// Particles in the same place with the same velocity stay together for ever: an inlet spreads
    /// them, or gives them a speed. Where liquid stood all around in the last step, the pressure is
    /// asked for the room of what is added: an inlet beneath the surface lifts it. At a time four
    /// cells' worth in a place, in eight places more than four cells apart; for what is more, room
    /// is asked wherever liquid is too dense, for 128 substeps. Not by an equation of state: there
    /// that presses together what is there, which takes tens of seconds to spread; so does all that
    /// is added in a tank that is full, in still liquid without gravity and, in SmallFixed, with an
    /// equation of state.
    /// Rates, of an inlet or an outlet, go by `StepReport::dt_s`: a step may simulate less than it
    /// was asked for.
    Status add_particle(Vec2f position_m, Vec2f velocity_mps, Liquid kind = Liquid::first);
    /// Removes the particle at that place in the views; the last particle takes its place. After
    /// `let_regions_sleep` a sleeper's place is taken by another sleeper, whose own the last takes.
    Status remove_particle(std::int32_t index);
    /// Removes what is in a box: an outlet, a cup that is drunk from. Looks at each particle once.
    /// Of this box and those below what reaches beyond the tank is cut off.
    /// @param removed number of particles, may be null.
    /// @param of of one liquid alone, here and below: a skimmer that takes the oil.
    Status drain(const Box& box_m, std::int32_t* removed = nullptr, Liquids of = Liquids::all);
    /// How much liquid is in a box, where, and how fast: a scale under a cup, a flow meter in a
    /// pipe, the current that carries a leaf. Looks at each particle once.
    Status liquid_in(const Box& box_m, LiquidIn* found, Liquids of = Liquids::all) const;
    /// Brings what is in a box nearer to a velocity, by a share 0 … 1 of the difference: a kick
    /// (1), a fan or a finger (0.1 before each step). Velocity zero over the whole tank calms it,
    /// by a rate r with share r · dt, wakes nobody and keeps nobody awake. Looks at each particle
    /// once.
    Status stir(const Box& box_m, Vec2f velocity_mps, float share, Liquids of = Liquids::all);
    /// Gives what is in a box a number of the caller's, which stays with each particle wherever it
    /// goes in the tank and in the views: dye, whose it is, what the game says of it. 0 at first.
    /// It changes nothing else. Wants `capacity.particle_tags`. Looks at each particle once.
    Status tag(const Box& box_m, std::uint8_t tag, Liquids of = Liquids::all);
    /// The same for the particle at that place in the views; the newest is the last one.
    Status tag_particle(std::int32_t index, std::uint8_t tag);

    /// As a sensor tells it: what `init` would refuse as too strong is limited along each axis and
    /// answered with ok, and the next step's report says so (`Clamped::gravity`). What is not
    /// finite is refused, gravity stays as it was, and that report says so, too.
    Status set_gravity(Vec2f gravity_mps2);

    /// From now on: honey that melts, or sets in the cold. In the range of
    /// `WorldDef::viscosity_m2ps`; 0 costs nothing again. What a world can do is linked by its
    /// definition: one without viscosity answers `Status::viscosity_missing` to all but 0.
    /// Another value than there is wakes who sleeps: round what a sensor tells before each step.
    /// Snapshots take it along, to any world of the same definition.
    Status set_viscosity(float viscosity_m2ps);
    /// The same for `WorldDef::surface_tension_m3ps2`: soap in water. A world that was defined
    /// without any answers `Status::surface_tension_missing` to all but 0.
    Status set_surface_tension(float tension_m3ps2);
    /// The same for `WorldDef::walls`: a floor that ices over, a side that becomes a belt. Every
    /// world may get any. Of regions that sleep those at the walls that change wake.
    Status set_walls(const TankWalls& walls);

    /// From now on liquid that lies apart from all other falls asleep by itself while the rest goes
    /// on: once nothing in it was faster than `def.sleep` says it is passed over, at next to no
    /// cost, `after_s` to twice that later. It wakes when gravity changes by more than
    /// `sleep.gravity_mps2`, when other liquid or a moving body comes within 4 cells, when a body
    /// is added, moved or removed there, or a particle. Apart is what 4 to 7 empty cells part, as
    /// it stands to the lines of every fourth cell; a thinner wall does not. Particles keep no
    /// place in the views then. Not linked unless called. Wants `capacity.sleeping_regions`.
    Status let_regions_sleep();

    /// Simulates dt_s seconds, at most 1 (SmallFixed with a `top_speed_mps`: what 255 cells take at
    /// that speed, rounded down to a power of two). Never fails: see StepReport for what was
    /// clamped. A step that was begun is finished first.
    /// @param rung of the ladder, 0 … kRungs − 1: what to leave off so as to be done in time.
    StepReport step(float dt_s, std::int32_t rung = 0);

    /// The same in slices: begins a step, which `advance` carries out. However it is cut, the
    /// result is `step`'s, to the bit. Until it is done nothing else may change the world: such
    /// calls answer `Status::step_in_progress` and change nothing, and so do `liquid_in`,
    /// `work_bound`, `diagnose` and `save`. Views may be looked at, and show the liquid on its way;
    /// `restore` drops the step.
    /// @param report filled while the step goes on; must live until it is done.
    Status begin_step(float dt_s, StepReport* report, std::int32_t rung = 0);
    /// Goes on with the step for that much work: a unit is a cell or a particle that one loop
    /// looks at. The slice ends with the first loop item that reaches it: a row of cells, the
    /// tank's border, a particle or a block of them (32, SmallFixed 16, 512 where float has SIMD
    /// lanes), all the moving bodies' nodes. At least one is done. True: the step is done, or there
    /// is none.
    /// A slice costs what 150 units do, however little it does (10,000 instructions on a
    /// Cortex-M0): in slices of 50 units a step takes four times as long as at once, of 800 a
    /// fifth more, of 1,600 a tenth. 800 or more are sensible.
    bool advance(std::int32_t work);
    /// What the next step can cost at most, known before it begins.
    Status work_bound(float dt_s, WorkBound* bound, std::int32_t rung = 0) const;
    /// The lowest rung on which the next step is sure to need no more than that; the last one if
    /// none is. It follows from the world and the numbers alone, so a run can be repeated. Ticks
    /// over work of the steps before (`StepReport`), in slices of the same size, tell how much a
    /// frame has time for.
    std::int32_t rung_within(float dt_s, std::int64_t work) const;

    /// Where the particles are, in cells: multiply by `cell_m`. Valid until the next call that
    /// adds, removes or steps. Empty before init.
    View<Vec2<PositionOf<Real>>> particle_positions() const;
    /// Their velocities, cells per second, or with `top_speed_mps` in a unit of SmallFixed's own:
    /// multiply by `velocity_scale()` for m/s.
    View<Vec2<VelocityOf<Real>>> particle_velocities() const;
    float velocity_scale() const;
    /// Which liquid they belong to. Empty if the world has no room for a second one.
    View<Liquid> particle_kinds() const;
    /// Their tags. Empty without `capacity.particle_tags`.
    View<std::uint8_t> particle_tags() const;
    /// What bodies met in the last step, one entry for each body and what it met: splashes, thuds.
    /// In the order of the first blows. Of two free bodies the one that was added to the lower slot
    /// has the entry. Empty without `capacity.contacts`, and while a step goes on. A body that was
    /// removed since is still named.
    View<Contact> contacts() const;
    /// Pressure at cell centres from the last substep, in the solver's own unit: multiply by
    /// `pressure_scale()` for p / ρ in m²/s², ρ the first liquid's. Columns and rows are cells.
    FieldView<Real> pressure() const;
    float pressure_scale() const;
    /// How full each cell is, 1 = at rest, as of the last substep's beginning. After `restore`, and
    /// after particles were added or removed, as they stand now: the first look then costs about as
    /// much as a scatter.
    FieldView<DensityOf<Real>> density() const;
    /// Signed distance to the nearest solid at the grid's nodes, cells; negative inside, outside
    /// at most `kFarFromSolids`. Contour::mid_edge: −½ and ½, the binary matrix. Empty if the
    /// world has no room for bodies.
    FieldView<DistanceOf<Real>> signed_distance() const;

    /// Mass, momentum, energies, volume and what is left of the divergence. Costs about as much
    /// as a scatter, twice that in packed worlds; changes no state, and no view but
    /// `signed_distance()` of bodies that were put elsewhere. What only the grid can tell, from the
    /// volume on, is 0 where `Capacity::window_cells` do not hold all particles, together with
    /// the pressures of the last step.
    Status diagnose(Diagnostics* diagnostics);

    /// Copies all that decides the future into the caller's memory, which may stand anywhere.
    /// @param bytes `snapshot_bytes<Real>(capacity)` always suffice.
    /// @param written bytes that were used, may be null. Refused: nothing is written.
    Status save(void* memory, std::size_t bytes, std::size_t* written = nullptr) const;
    /// Goes back to a snapshot, from this world or another of the same definition, in this run of
    /// the program or before: all steps from there on have the same bits. Refuses what is
    /// truncated, damaged or of another kind, whatever its bytes are, and leaves the world as it
    /// was. Bodies that were placed since the last step are seen where they are. Names of bodies
    /// hold the place of the world in memory: in one that lies elsewhere ask for the new ones
    /// (`body_in_slot`). There are no contacts until the next step. Both worlds or none must have
    /// let regions sleep (else `Status::snapshot_of_other_definition`).
    Status restore(const void* snapshot, std::size_t bytes);
    /// The name of the body in that slot of the table, 0 … capacity.bodies − 1.
    Status body_in_slot(std::int32_t slot, BodyId* id) const;

    float cell_m() const;
    std::int32_t cells_x() const;
    std::int32_t cells_y() const;

    /// 64-bit hash of everything that decides the future: equal states, equal hashes, on every
    /// machine. Only the turns of what is done every few substeps are left out, so that what is at
    /// rest keeps its hash. 0 before init.
    std::uint64_t state_hash() const;

private:
    using State = detail::WorldState<Real>;

    Status init_with(const detail::Features<Real>& features, const WorldDef& def, void* memory,
                     std::size_t bytes);

    State* state_ = nullptr;  // at the head of the caller's memory
};

/// Value of `signed_distance` where no solid is near, cells.
inline constexpr float kFarFromSolids = 1.5F;

extern template class World<float>;
extern template class World<double>;
extern template class World<Fixed>;
extern template class World<SmallFixed>;

}  // namespace weir
