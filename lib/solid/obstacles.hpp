// What stops free bodies: the tank's walls, other bodies, and each other.
//
// At the top of a substep the points are listed at which a free body is before something, or may be
// at the end of the substep. The impulses at these points are unknowns beside the pressures: they
// are found by the same sweeps (projected Gauss-Seidel: each point in turn gets what makes it stop,
// and gives back what turns out to have been too much), so that the pressure neither takes a body
// to fall that something holds, nor one to stay that is let go.
#pragma once

#include "grid/borders.hpp"
#include "solid/body_load.hpp"
#include "solid/body_force.hpp"
#include "solid/contacts.hpp"

namespace weir {

/// What a push along one direction at a point does to the two bodies, through a substep.
template <class Real>
struct HeldWay {
    Face<Real> own;       ///< angular impulse per push
    Face<Real> other;
    Face<Real> yielding;  ///< speed per push
    Face<Real> told;      ///< speed of the other one if it does as told
};

/// In place of the first film's number.
inline constexpr std::int32_t kFilmsNotLaid = -2;

/// Films lie in gaps up to this, cells: by then there is room for liquid to come in.
template <class Real>
inline constexpr Face<Real> kWidestFilm = Face<Real>(2);

/// A point of a free body before something.
template <class Real>
struct Meeting {
    Vec2<Face<Real>> at;
    Vec2<Face<Real>> normal;  ///< towards the free body
    Face<Real> gap;           ///< between them when the substep began, negative inside, cells
    Face<Real> leaves;        ///< no slower than this, as it was thrown back; 0: it may stay
    Face<Real> push;          ///< impulse along the normal so far, never negative
    Face<Real> rub;           ///< and along the surface
    std::uint16_t slot;
    std::uint16_t other;      ///< kNoBody: the tank
    std::int32_t next_film = -1;  ///< number of the next one with a film, negative: none
    std::int32_t film_cell = 0;         ///< whose pressure that film has,
    Face<Real> beyond = Face<Real>(0);  ///< and so much more, as it lies elsewhere
    Impulse<Real> film{};               ///< what it does to the free body, per pressure,
    Impulse<Real> besides{};            ///< and whatever that is
    HeldWay<Real> ahead{};       ///< along the normal
    HeldWay<Real> aside{};       ///< along the surface, the normal's right
    bool other_is_free = false;

    Vec2<Face<Real>> side() const { return {normal.y, -normal.x}; }
};
static_assert(sizeof(Meeting<float>) <= kMeetingBytes<float>, "raise kMeetingBytes");
static_assert(sizeof(Meeting<double>) <= kMeetingBytes<double>, "raise kMeetingBytes");

/// What a point got per second of the last substep: where it is found again it begins with that, or
/// what lies on each other would have to be weighed anew each time.
template <class Real>
struct Push {
    Vec2<Face<Real>> arm;  ///< from the free body's centre of mass
    Face<Real> push;
    Face<Real> rub;
    Face<Real> slot;       ///< and 1; 0: no more of them
    Face<Real> other;
};
static_assert(sizeof(Push<float>) <= kPushBytes<float>, "raise kPushBytes");
static_assert(sizeof(Push<double>) <= kPushBytes<double>, "raise kPushBytes");

/// Those of a substep, in the order of the bodies' slots; the lists stand behind the bodies' loads.
template <class Real>
struct Meetings {
    Meeting<Real>* entry;
    std::int32_t* used;
    std::int32_t* first_film;  ///< number of the first one with a film, negative: none, or not laid
    Push<Real>* before;  ///< of the last substep; there is room for one more
    std::byte* levers;   ///< stand behind them (solid/body_levers.hpp)
    std::int32_t room;

    explicit Meetings(const BodyTable<Real>& table)
        : room(kMeetingsPerBody * table.capacity) {
        const auto loads = static_cast<std::size_t>(load_records<Real>(table.capacity));
        const auto pushes = static_cast<std::size_t>(room + 1);
        std::byte* at = reinterpret_cast<std::byte*>(table.load);
        at += detail::block_bytes(kBodyLoadBytes<Real>, loads);
        before = reinterpret_cast<Push<Real>*>(at);
        at += detail::block_bytes(kPushBytes<Real>, pushes);
        used = reinterpret_cast<std::int32_t*>(at);
        first_film = used + 1;
        entry = reinterpret_cast<Meeting<Real>*>(at + kMeetingBytes<Real>);
        levers = at + detail::block_bytes(kMeetingBytes<Real>, pushes);
    }
    static bool of_one_face(const Meeting<Real>& a, const Meeting<Real>& b) {
        return a.slot == b.slot && a.other == b.other && a.normal.x == b.normal.x &&
               a.normal.y == b.normal.y;
    }
    /// Calls visit(meetings, their number) for one point after the other, or for two of one face.
    template <class Visit>
    void for_each_face(Visit visit) const {
        for (Meeting<Real>* at = begin(); at != end();) {
            const bool both = at + 1 != end() && of_one_face(at[0], at[1]);
            visit(at, both ? 2 : 1);
            at += both ? 2 : 1;
        }
    }
    /// The same from the last one to the first.
    template <class Visit>
    void for_each_face_back(Visit visit) const {
        for (Meeting<Real>* at = end(); at != begin();) {
            const bool both = at - 1 != begin() && of_one_face(at[-1], at[-2]);
            at -= both ? 2 : 1;
            visit(at, both ? 2 : 1);
        }
    }
    /// Calls visit(meeting) for those with a film.
    template <class Visit>
    void for_each_film(Visit visit) const {
        for (std::int32_t k = *first_film; k >= 0; k = entry[k].next_film) {
            visit(entry[k]);
        }
    }
    /// The same for those of a body.
    template <class Visit>
    void for_each_film_of(std::uint16_t slot, Visit visit) const {
        for (std::int32_t k = *first_film; k >= 0 && entry[k].slot <= slot;
             k = entry[k].next_film) {
            if (entry[k].slot == slot || entry[k].other == slot) {
                visit(entry[k]);
            }
        }
    }
    /// Whether there is one between a body and another free one.
    bool has_film_between(std::uint16_t slot) const {
        bool has = false;
        for_each_film_of(slot, [&](const Meeting<Real>& film) { has = has || film.other_is_free; });
        return has;
    }
    Meeting<Real>* begin() const { return entry; }
    Meeting<Real>* end() const { return entry + *used; }
};

/// What is done to the free body at a point, as either of the two bodies there feels it.
template <class Real>
Impulse<Real> felt_by(const BodyTable<Real>& table, std::uint16_t slot,
                      const Meeting<Real>& meeting, const Impulse<Real>& done) {
    if (slot == meeting.slot) {
        return done;
    }
    const Vec2<Face<Real>> arm = table.load[meeting.slot].at - table.load[slot].at;
    return {Face<Real>(-1) * done.linear, -(done.angular + cross(arm, done.linear))};
}

template <class Real>
struct Obstacles {
    const GridShape& tank;
    const Borders<Real>& borders;
    const BodyTable<Real>& bodies;
    const Walls<Real>& walls;
    Vec2<Face<Real>> fall;  ///< gravity × dt
    Face<Real> dt;
    Face<Real> led_dt;      ///< for so long other bodies have moved on in this substep
};

template <class Real>
bool is_free_body(const BodyTable<Real>& table, std::int32_t slot) {
    return table.body[slot].kind == BodyKind::moving && table.load[slot].is_free();
}

/// The tank's wall with that inward normal.
template <class Real>
const SurfaceLaw<Real>& wall_law(const Borders<Real>& borders, Vec2<Face<Real>> inward) {
    if (inward.x != Face<Real>(0)) {
        return inward.x > Face<Real>(0) ? borders.left : borders.right;
    }
    return inward.y > Face<Real>(0) ? borders.bottom : borders.top;
}

/// The surface that a free body meets there.
template <class Real>
const SurfaceLaw<Real>& law_before(const Obstacles<Real>& obstacles, std::uint16_t other,
                                   Vec2<Face<Real>> normal) {
    return other == kNoBody ? wall_law(obstacles.borders, normal)
                            : obstacles.bodies.body[other].surface;
}

/// Whether any of its points may be within a distance of the tank's walls.
template <class Real>
bool near_walls(const GridShape& s, const Body<Real>& body, Real distance) {
    const Real r = body.radius + distance;
    return body.position.x < r || body.position.y < r ||
           body.position.x + r > static_cast<Real>(s.nx) ||
           body.position.y + r > static_cast<Real>(s.ny);
}

/// Lists the substep's points, given `load.unpressed`. Where there is no room for more, those that
/// are further away are left out.
/// @return the cost: a look at each other body for each free one, at the vertices of those that
///         come near, and both numbers of vertices multiplied for pieces that do.
template <class Real>
std::int32_t find_meetings(const Obstacles<Real>& obstacles);

/// The most that can cost, wherever the bodies are.
template <class Real>
std::int32_t most_looks(const BodyTable<Real>& table);

/// So often the points are gone through before the pressure, again before each of its cycles,
/// after each half sweep, and after it.
inline constexpr std::int32_t kRoundsBefore = 8;
inline constexpr std::int32_t kRoundsBetween = 1;
inline constexpr std::int32_t kRoundsAfter = 12;
/// And so often when bodies are moved apart.
inline constexpr std::int32_t kRoundsOfParting = 4;

/// Goes through the points so often: adds to `load.change` what lets no point come nearer to an
/// obstacle than it may, and takes back what was too much; the same to `load.stopped`.
template <class Real>
void stop(const Obstacles<Real>& obstacles, std::int32_t rounds);

/// Begins with what the points got in the last substep. Returns the cost: looks at what is kept,
/// mostly one a point.
template <class Real>
std::int32_t recall(const Obstacles<Real>& obstacles);
/// Keeps what they got in this one, and tells of it as contacts.
template <class Real>
void remember(const Obstacles<Real>& obstacles, Contacts<Real>& contacts);

/// After all velocities are known: `load.change` becomes what moves bodies apart that would be in
/// each other at the end of the substep, cells and radians. No velocity comes of it.
template <class Real>
void part(const Obstacles<Real>& obstacles);

}  // namespace weir
