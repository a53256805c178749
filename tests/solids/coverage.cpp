// R2: area and centroid of polygons on the grid, exact coverage and what the contour lines enclose,
// against the shoelace formula.
#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "node_field.hpp"
#include "problems.hpp"
#include "weir/geometry.hpp"

namespace solids {

namespace {

using Vec = weir::Vec2<double>;

struct Moments {
    double area = 0.0;
    Vec centroid;
};

Moments shoelace(const Points& ring) {
    Moments m;
    const Vec o = ring[0];
    for (std::size_t k = 0; k < ring.size(); ++k) {
        const Vec a = ring[k] - o;
        const Vec b = ring[(k + 1) % ring.size()] - o;
        m.area += 0.5 * weir::cross(a, b);
        m.centroid = m.centroid + (weir::cross(a, b) / 6.0) * (a + b);
    }
    m.centroid = o + (1.0 / m.area) * m.centroid;
    return m;
}

Points star(double radius) {
    Points points;
    for (int k = 0; k < 10; ++k) {
        const double r = k % 2 == 0 ? radius : 0.4 * radius;
        points.push_back({r * std::cos(0.2 * M_PI * k), r * std::sin(0.2 * M_PI * k)});
    }
    return points;
}

std::vector<Points> shapes(double r) {
    std::vector<Points> all;
    for (int corners = 3; corners <= 8; ++corners) {
        all.push_back(regular_polygon(corners, r, {}, 0.0));
    }
    all.push_back(star(r));
    const double h = 0.7 * r;
    all.push_back({{-h, -h}, {h, -h}, {h, 0.0}, {0.0, 0.0}, {0.0, h}, {-h, h}});
    all.push_back({{-r, -0.05 * r}, {r, -0.05 * r}, {r, 0.05 * r}, {-r, 0.05 * r}});
    return all;
}

std::vector<weir::Vec2f> placed(const Points& shape, double angle, Vec at) {
    std::vector<weir::Vec2f> out;
    for (const Vec p : shape) {
        const Vec turned{std::cos(angle) * p.x - std::sin(angle) * p.y,
                         std::sin(angle) * p.x + std::cos(angle) * p.y};
        out.push_back(weir::convert<float>(at + turned));
    }
    return out;
}

/// What the library is given: rounding the vertices is no error of the coverage. (In one loop with
/// the rounding, g++ 12 takes both conversions for none.)
Points widened(const std::vector<weir::Vec2f>& given) {
    Points out;
    for (const weir::Vec2f p : given) {
        out.push_back(weir::convert<double>(p));
    }
    return out;
}

/// Sums in double; the centroid of a cell's share is its centre but for what the edges cut.
Moments of_shares(const std::vector<float>& share, int cells) {
    Moments m;
    for (int j = 0; j < cells; ++j) {
        for (int i = 0; i < cells; ++i) {
            const auto a = static_cast<double>(share[static_cast<std::size_t>(j * cells + i)]);
            m.area += a;
            m.centroid = m.centroid + a * Vec{i + 0.5, j + 0.5};
        }
    }
    m.centroid = (1.0 / m.area) * m.centroid;
    return m;
}

std::vector<float> contour_shares(const Points& ring, int cells) {
    NodeGrid<float> grid(cells);
    grid.draw(ring);
    std::vector<float> share;
    for (int j = 0; j < cells; ++j) {
        for (int i = 0; i < cells; ++i) {
            float corner[4];
            grid.corners(i, j, corner);
            share.push_back(1.0F - weir::open_area(corner));
        }
    }
    return share;
}

struct Error {
    double squares = 0.0;
    double most = 0.0;
    double centroid = 0.0;
    int count = 0;

    void add(const Moments& is, const Moments& should_be) {
        const double e = std::abs(is.area / should_be.area - 1.0);
        squares += e * e;
        most = std::max(most, e);
        const Vec off = is.centroid - should_be.centroid;
        centroid += weir::dot(off, off);
        ++count;
    }
    double rms() const { return std::sqrt(squares / count); }
    double centroid_rms() const { return std::sqrt(centroid / count); }
};

}  // namespace

void coverage(Report& report, const Effort&) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (const int r : {2, 4, 8, 16, 32, 64}) {
        Error exact;
        Error slivers;
        Error contour;
        bool ok = true;
        const int cells = 2 * r + 6;
        for (const Points& shape : shapes(r)) {
            for (int turn = 0; turn < 20; ++turn) {
                const Vec at{r + 2.5 + unit(random), r + 2.5 + unit(random)};
                const std::vector<weir::Vec2f> given =
                    placed(shape, 2.0 * M_PI * unit(random), at);
                const Points ring = widened(given);
                std::vector<float> share(static_cast<std::size_t>(cells * cells));
                ok = ok && weir::cover_cells({given.data(), static_cast<std::int32_t>(given.size())},
                                             {}, cells, cells, share.data()) == weir::Status::ok;
                const Moments should_be = shoelace(ring);
                const bool sliver = ring.size() == 4 && should_be.area < 0.5 * r * r;
                (sliver ? slivers : exact).add(of_shares(share, cells), should_be);
                if (r <= 16 && !sliver) {
                    contour.add(of_shares(contour_shares(ring, cells), cells), should_be);
                }
            }
        }
        const std::string name = "R2.radius_" + std::to_string(r);
        report.holds(name + ".accepted", ok);
        report.at_most(name + ".coverage.area_max", exact.most, "1", 1e-6);
        report.at_most(name + ".coverage.sliver_area_max", slivers.most, "1", 1e-6);
        if (r >= 8) {
            report.at_most(name + ".coverage.centroid_rms", exact.centroid_rms(), "cells", 0.003);
        }
        report.figure(name + ".coverage.sliver_centroid_rms", slivers.centroid_rms(), "cells");
        if (r <= 16) {
            report.figure(name + ".contour.area_rms", contour.rms(), "1");
            report.figure(name + ".contour.centroid_rms", contour.centroid_rms(), "cells");
        }
    }
}

}  // namespace solids
