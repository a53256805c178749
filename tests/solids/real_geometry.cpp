// Geometry that nobody here drew: every polygon of a coastline, all letters of two fonts, twenty
// drawings. Convex pieces have the polygon's area, are convex, and each point inside is in one.
#include <algorithm>
#include <cmath>
#include <random>

#include "geometry/bridges.hpp"
#include "geometry/convex_decomposition.hpp"
#include "geometry/ring_copy.hpp"
#include "measure/convex_piece.hpp"
#include "polygon_list.hpp"
#include "pour.hpp"
#include "problems.hpp"

namespace solids {

namespace {

using Point = weir::Vec2<double>;

/// A polygon as a body keeps it, in double.
struct Kept {
    std::vector<Point> vertex;
    std::vector<std::uint16_t> ring_end;

    weir::Outline<double> outline() const {
        return {vertex.data(), static_cast<std::int32_t>(vertex.size()),
                static_cast<std::int32_t>(ring_end.size()), ring_end.data()};
    }
    double twice_area() const {
        double sum = 0.0;
        weir::for_each_edge(outline(), [&](Point a, Point b) {
            sum += weir::cross(a - vertex[0], b - vertex[0]);
        });
        return sum;
    }
    bool holds(Point p) const {
        bool inside = false;
        weir::for_each_edge(outline(), [&](Point a, Point b) {
            if ((a.y > p.y) != (b.y > p.y) && (weir::turn(a, b, p) > 0.0) == (b.y > a.y)) {
                inside = !inside;
            }
        });
        return inside;
    }
};

Kept keep(const weir::BodyDef& def) {
    Kept kept;
    const weir::RingsOnGrid rings({def.polygon, def.holes});
    for (std::int32_t ring = 0; ring < rings.count(); ++ring) {
        weir::copy_ring(rings, ring, [&](weir::Vec2f v) {
            kept.vertex.push_back(weir::convert<double>(v));
        });
        kept.ring_end.push_back(static_cast<std::uint16_t>(kept.vertex.size()));
    }
    return kept;
}

/// What is wrong with the pieces of polygons, over a whole set.
struct Tally {
    int polygons = 0;
    int holed = 0;
    int pieces = 0;
    std::size_t vertices = 0;
    std::size_t most_vertices = 0;
    int refused_sound = 0;     // by check_polygon, though shapely finds them sound
    int accepted_unsound = 0;
    int not_cut = 0;
    double area_error = 0.0;   // relative, the worst
    double right_bend = 0.0;   // sine, the worst
    int points = 0;            // tried
    int points_wrong = 0;      // in no piece though inside, in two, or in one though outside
};

struct Pieces {
    std::vector<std::uint16_t> flat;
    std::int32_t used = 0;

    template <class Visit>
    void for_each(Visit visit) const {
        for (std::int32_t at = 0; at < used; at += 1 + flat[static_cast<std::size_t>(at)]) {
            visit(flat.data() + at + 1, flat[static_cast<std::size_t>(at)]);
        }
    }
};

Pieces cut(const Kept& kept) {
    const weir::Outline<double> outline = kept.outline();
    const auto corners = static_cast<std::size_t>(weir::corner_count(outline));
    Pieces pieces;
    pieces.flat.resize(4 * (corners - 2));
    std::vector<std::uint16_t> scratch(5 * corners);
    pieces.used = weir::decompose(
        outline, {scratch.data(), static_cast<std::int32_t>(scratch.size())},
        {pieces.flat.data(), static_cast<std::int32_t>(pieces.flat.size())});
    return pieces;
}

void tally_pieces(const Kept& kept, const Pieces& pieces, Tally& tally) {
    double covered = 0.0;
    pieces.for_each([&](const std::uint16_t* piece, std::int32_t count) {
        ++tally.pieces;
        for (std::int32_t k = 0; k < count; ++k) {
            const Point a = kept.vertex[piece[k]];
            const Point b = kept.vertex[piece[(k + 1) % count]];
            const Point c = kept.vertex[piece[(k + 2) % count]];
            covered += weir::cross(a - kept.vertex[0], b - kept.vertex[0]);
            const double size = weir::length(b - a) * weir::length(c - b);
            tally.right_bend = std::max(tally.right_bend, -weir::cross(b - a, c - b) / size);
        }
    });
    const double whole = kept.twice_area();
    tally.area_error = std::max(tally.area_error, std::fabs(covered - whole) / whole);
}

void tally_points(const Kept& kept, const Pieces& pieces, std::mt19937& random, Tally& tally) {
    Point low = kept.vertex[0];
    Point high = low;
    for (const Point v : kept.vertex) {
        low = {std::min(low.x, v.x), std::min(low.y, v.y)};
        high = {std::max(high.x, v.x), std::max(high.y, v.y)};
    }
    std::uniform_real_distribution<double> share(0.0, 1.0);
    for (int k = 0; k < 20; ++k) {
        const Point p{low.x + share(random) * (high.x - low.x),
                      low.y + share(random) * (high.y - low.y)};
        int in = 0;
        pieces.for_each([&](const std::uint16_t* piece, std::int32_t count) {
            in += weir::inside_convex(kept.vertex.data(), piece, count, p) ? 1 : 0;
        });
        ++tally.points;
        tally.points_wrong += in == (kept.holds(p) ? 1 : 0) ? 0 : 1;
    }
}

Tally tally_all(const std::vector<ListedPolygon>& list) {
    Tally tally;
    std::mt19937 random(4);
    std::vector<weir::View<weir::Vec2f>> views;
    for (const ListedPolygon& polygon : list) {
        const weir::BodyDef def = body_of(polygon, views);
        ++tally.polygons;
        tally.holed += polygon.rings.size() > 1 ? 1 : 0;
        tally.vertices += polygon.vertices();
        tally.most_vertices = std::max(tally.most_vertices, polygon.vertices());
        weir::PolygonFault fault;
        const weir::Status status = weir::check_polygon(def.polygon, def.holes, &fault);
        if ((status == weir::Status::ok) != polygon.sound) {
            ++(polygon.sound ? tally.refused_sound : tally.accepted_unsound);
            std::printf("  %s: %s at %g %g\n", polygon.name.c_str(), weir::status_text(status),
                        static_cast<double>(fault.place_m.x), static_cast<double>(fault.place_m.y));
        }
        if (status != weir::Status::ok) {
            continue;
        }
        const Kept kept = keep(def);
        const Pieces pieces = cut(kept);
        if (pieces.used < 0) {
            ++tally.not_cut;
            continue;
        }
        tally_pieces(kept, pieces, tally);
        tally_points(kept, pieces, random, tally);
    }
    return tally;
}

void report_set(Report& report, const std::string& name, const std::vector<ListedPolygon>& list) {
    const Tally tally = tally_all(list);
    const std::string at = "real." + name + ".";
    report.figure(at + "polygons", tally.polygons, "1");
    report.figure(at + "with_holes", tally.holed, "1");
    report.figure(at + "vertices", static_cast<double>(tally.vertices), "1");
    report.figure(at + "most_vertices", static_cast<double>(tally.most_vertices), "1");
    report.figure(at + "pieces", tally.pieces, "1");
    report.equals(at + "sound_but_refused", tally.refused_sound, "1", 0);
    report.equals(at + "unsound_but_taken", tally.accepted_unsound, "1", 0);
    report.equals(at + "not_cut", tally.not_cut, "1", 0);
    report.at_most(at + "area_error", tally.area_error, "1", 1e-6);
    report.at_most(at + "right_bend_sine", tally.right_bend, "1", 1.01e-6);
    report.figure(at + "points_tried", tally.points, "1");
    report.equals(at + "points_in_wrong_pieces", tally.points_wrong, "1", 0);
}

/// Liquid over the polygons with most vertices, with holes and without.
template <class Real>
void report_pours(Report& report, const std::string& name, std::vector<ListedPolygon> list,
                  std::size_t most) {
    std::stable_sort(list.begin(), list.end(), [](const auto& a, const auto& b) {
        return a.vertices() > b.vertices();
    });
    PourResult sum;
    int poured = 0;
    for (const bool holed : {true, false}) {
        std::size_t done = 0;
        for (const ListedPolygon& polygon : list) {
            if (!polygon.sound || (polygon.rings.size() > 1) != holed || done == most) {
                continue;
            }
            const PourResult result = pour<Real>(polygon);
            if (result.inside > 0 || result.lost > 0) {
                std::printf("  %s: %d inside, %d lost, deepest %.3f cells\n", polygon.name.c_str(),
                            result.inside, result.lost, result.deepest);
            }
            sum.particles += result.particles;
            sum.inside += result.inside;
            sum.lost += result.lost;
            sum.deepest = std::max(sum.deepest, result.deepest);
            ++done;
            ++poured;
        }
    }
    const std::string at = "real." + name + ".poured_over.";
    report.figure(at + "polygons", poured, "1");
    report.figure(at + "particles", sum.particles, "1");
    report.equals(at + "trapped", sum.inside, "1", 0);
    report.equals(at + "unaccounted", sum.lost, "1", 0);
    report.figure(at + "deepest", sum.deepest, "cell");
}

}  // namespace

void real_geometry(Report& report, const Effort& effort) {
    const struct {
        const char* name;
        const char* arguments;
    } sets[] = {{"coast", "coast"}, {"letters", "letters"}, {"icons", "icons 20"}};
    for (const auto& set : sets) {
        const std::vector<ListedPolygon> list = list_polygons(set.arguments);
        if (effort.real == Scalar::single_precision) {
            report_set(report, set.name, list);
        }
        in_scalar(report, effort.real, [&](auto zero) {
            report_pours<decltype(zero)>(report, set.name, list, effort.full ? 10 : 2);
        });
    }
}

}  // namespace solids
