#include "solid/immersion.hpp"

#include "contour/marching_squares.hpp"
#include "geometry/outline.hpp"
#include "solid/at_rest.hpp"

namespace weir {

namespace {

/// Less than this share of a body's area, as corners of bodies of three cells and more, is lifted
/// and nothing else: the pressure beside it turns it, and it takes no liquid along.
constexpr double kMissed = 1.0 / 8.0;

/// So much of its weight that lifts at most: of light bodies corners matter less.
constexpr double kMostLift = 0.5;

/// A cell with less room than this tells nothing of the liquid.
constexpr double kLeastRoom = 1.0 / 16.0;

/// Most looks along an edge.
constexpr std::int32_t kMostLooks = 64;

/// Area of a body as the contour has it, cells².
template <class Real>
struct Shown {
    Face<Real> area = Face<Real>(0);
    Face<Real> shared = Face<Real>(0);  ///< of that, in cells where there is another one, too
};

template <class Real>
Shown<Real> shown_of(const Obstacles<Real>& obstacles, std::uint16_t slot) {
    const Walls<Real>& walls = obstacles.walls;
    const GridShape& s = obstacles.tank;
    const NodeBox box = cells_of(s, obstacles.bodies.body[slot].drawn);
    Shown<Real> shown;
    for (std::int32_t j = box.j0; j <= box.j1; ++j) {
        for (std::int32_t i = box.i0; i <= box.i1; ++i) {
            const std::int32_t c = s.index(i, j);
            const std::int32_t node[4] = {c, c + 1, c + s.stride + 1, c + s.stride};
            Real distance[4];
            std::int32_t inside = 0;
            std::int32_t own = 0;
            for (std::int32_t k = 0; k < 4; ++k) {
                distance[k] = walls.distance[node[k]];
                const bool in = distance[k] <= Real(0);
                inside += in ? 1 : 0;
                own += in && nearest_at(walls, node[k]) == slot ? 1 : 0;
            }
            if (own > 0) {
                const auto solid = static_cast<Face<Real>>(Real(1) - open_area(distance));
                const Face<Real> part =
                    solid * (static_cast<Face<Real>>(own) / static_cast<Face<Real>>(inside));
                shown.area += part;
                shown.shared += own < inside ? part : Face<Real>(0);
            }
        }
    }
    return shown;
}

/// The liquid along an outline.
template <class Real>
struct Around {
    using Number = Face<Real>;
    Number length = Number(0);  ///< of what there is room before
    Number wet = Number(0);     ///< of that, in liquid, by how dense that is
    Wide<Real> place{};         ///< summed over what is wet
    Wide<Real> stream{};
};

/// Adds a piece of outline: how full the cells around its middle are, and how fast.
template <class Real>
void look(const Obstacles<Real>& obstacles, const PressedCells<Real>& cells, Wide<Real> at,
          Face<Real> size, Around<Real>& around) {
    using Number = Face<Real>;
    const GridShape& s = obstacles.tank;
    const Wide<Real> corner{at.x - Number(0.5), at.y - Number(0.5)};
    const auto reaches = [](Number place, std::int32_t end) {
        return place >= Number(-1) && place < static_cast<Number>(end);
    };
    if (!reaches(corner.x, s.nx) || !reaches(corner.y, s.ny)) {
        return;  // who is led may be further away than whole numbers tell
    }
    const std::int32_t i0 = floor_to_int(corner.x);
    const std::int32_t j0 = floor_to_int(corner.y);
    const Number tx = corner.x - static_cast<Number>(i0);
    const Number ty = corner.y - static_cast<Number>(j0);
    for (std::int32_t k = 0; k < 4; ++k) {
        const std::int32_t i = i0 + (k & 1);
        const std::int32_t j = j0 + (k >> 1);
        if (i < 0 || i >= s.nx || j < 0 || j >= s.ny) {
            continue;
        }
        const std::int32_t c = s.index(i, j);
        if (!(Real(obstacles.walls.full_density[c]) > Real(kLeastRoom))) {
            continue;
        }
        const Number weight = size * ((k & 1) != 0 ? tx : Number(1) - tx) *
                              ((k >> 1) != 0 ? ty : Number(1) - ty);
        const auto full = static_cast<Number>(Real(cells.density[c]));
        const auto density = static_cast<Number>(density_at_rest(s, obstacles.walls, cells, c));
        const Number wet = (weight * clamp(full, Number(0), Number(1))) * density;
        const Wide<Real> twice{
            static_cast<Number>(Real(cells.u[c])) + static_cast<Number>(Real(cells.u[c + 1])),
            static_cast<Number>(Real(cells.v[c])) +
                static_cast<Number>(Real(cells.v[c + s.stride]))};
        around.length += weight;
        around.wet += wet;
        around.place = around.place + wet * at;
        around.stream = around.stream + (Number(0.5) * wet) * twice;
    }
}

template <class Real>
Around<Real> around_of(const Obstacles<Real>& obstacles, const PressedCells<Real>& cells,
                       std::uint16_t slot) {
    using Number = Face<Real>;
    Around<Real> around;
    const BodyTable<Real>& table = obstacles.bodies;
    for_each_edge(table.outline(table.body[slot]), [&](Vec2<Real> from, Vec2<Real> to) {
        const Wide<Real> start = convert<Number>(from);
        const Wide<Real> way = convert<Number>(to) - start;
        const Number size = length(way);
        const std::int32_t looks =
            minimum(1 + floor_to_int(minimum(size, Number(kMostLooks))), kMostLooks);
        const Number part = Number(1) / static_cast<Number>(looks);
        for (std::int32_t k = 0; k < looks; ++k) {
            const Number middle = part * (static_cast<Number>(k) + Number(0.5));
            look(obstacles, cells, start + middle * way, part * size, around);
        }
    });
    return around;
}

/// Lifts a body by so much liquid. It answers that before the next pressure, as it does blows.
template <class Real>
void lift(const BodyTable<Real>& table, Face<Real> liquid, Wide<Real> fall,
          BodyLoad<Real>& load) {
    const Wide<Real> push = (-liquid) * fall;
    load.blows.linear = load.blows.linear + push;
    receive_from_tank(table, push, load);
}

}  // namespace

template <class Real>
void immerse(const Obstacles<Real>& obstacles, const PressedCells<Real>& cells, std::uint16_t slot,
             Twist<Real>& twist) {
    using Number = Face<Real>;
    BodyLoad<Real>& load = obstacles.bodies.load[slot];
    load.ease = Number(1);
    // Beside what a body lies on the contour shows more of it than cells and films reach.
    const Number lifted = at_rest(obstacles, cells, slot, Turning::left_out)
                              .lifted(convert<Number>(cells.gravity_dt));
    const bool closed = lifted > Number(0);
    const bool beside = Meetings<Real>(obstacles.bodies).has_film_between(slot);
    Shown<Real> shown;
    if (!closed || beside) {
        shown = shown_of(obstacles, slot);
    }
    shown.area = closed ? lifted : shown.area;
    const Number missing = load.area - shown.area;
    // Which part of a cell is whose where bodies share it is a guess: that much may be there.
    const Number most = Number(kMissed) * load.area;
    const Number guessed = minimum(shown.shared, most);
    if (!(missing > guessed)) {
        return;
    }
    const Around<Real> around = around_of(obstacles, cells, slot);
    if (!(around.wet > Number(0))) {
        return;
    }
    const auto displaced = [&](Number but) {
        return (load.area / (load.area - but)) * maximum(missing - but, Number(0)) *
               (around.wet / around.length);
    };
    const Number carried = displaced(most);
    load.ease = load.mass / (load.mass + carried);
    lift(obstacles.bodies, minimum(displaced(guessed) - carried, Number(kMostLift) * load.mass),
         obstacles.fall, load);
    // Films beside another leave nothing that turns a body in liquid at rest.
    const Wide<Real> arm = closed && beside
                               ? Wide<Real>{}
                               : (Number(1) / around.wet) * around.place - load.at;
    const Twist<Real> turned =
        answer(load, Impulse<Real>{{}, cross(arm, (-carried) * obstacles.fall)});
    twist.velocity = twist.velocity + turned.velocity;
    twist.spin += turned.spin;
    const Number taken = minimum((Number(1) - load.ease) *
                                     square_root(length(obstacles.fall) * obstacles.dt),
                                 Number(1));
    const Wide<Real> stream = (Number(1) / around.wet) * around.stream;
    const Wide<Real> slowed = along_slides(load, taken * (stream - twist.velocity));
    twist.velocity = twist.velocity + slowed;
    twist.spin -= taken * twist.spin;
    receive_from_tank(obstacles.bodies, (load.mass + carried) * slowed, load);
}

#define WEIR_INSTANTIATE(Real)                                                        \
    template void immerse(const Obstacles<Real>&, const PressedCells<Real>&,          \
                          std::uint16_t, Twist<Real>&);
WEIR_FOR_EACH_ROOMY_SCALAR(WEIR_INSTANTIATE)
#undef WEIR_INSTANTIATE

}  // namespace weir
