// Exact area that a polygon covers of every cell: what an edge crosses in a row is added to the
// cell where it is crossed, and summed from the left (Levien 2016, "font-rs").
#include "geometry/polygon.hpp"

namespace weir {

namespace {

/// What rounding may leave to the right of a polygon.
constexpr double kNothing = 1.0 / 4194304.0;

void add(double more, float& sum) {
    sum = static_cast<float>(static_cast<double>(sum) + more);
}

/// A piece of an edge within one row, from left to right, x counted from the box's left side.
struct Piece {
    double from;
    double to;
    double rise;  ///< of the edge in this row, positive upwards
};

/// Adds what lies to the right of a piece, as differences along the row.
void add_piece(const Piece& piece, std::int32_t width, float* row) {
    const auto first = static_cast<std::int32_t>(piece.from);
    const double span = piece.to - piece.from;
    double above = 0.0;  // the part of the rise that is done
    double before = 0.0;
    for (std::int32_t i = first; i < width && static_cast<double>(i) <= piece.to; ++i) {
        const double left = maximum(piece.from, static_cast<double>(i));
        const double right = minimum(piece.to, static_cast<double>(i + 1));
        const bool last = !(static_cast<double>(i + 1) < piece.to);
        const double done = last ? piece.rise : piece.rise * ((right - piece.from) / span);
        // Of the rise in this cell, what is right of its middle is covered.
        const double middle = 0.5 * (left + right) - static_cast<double>(i);
        const double covered = above + (done - above) * (1.0 - middle);
        add(covered - before, row[i]);
        before = covered;
        above = done;
        if (last) {
            if (i + 1 < width) {
                add(above - before, row[i + 1]);
            }
            return;
        }
    }
}

/// Cuts a piece off at the box's sides. What is left of it counts as its left side.
void add_cut(Vec2<double> low, Vec2<double> high, double sign, std::int32_t width, float* row) {
    const bool leans_right = low.x <= high.x;
    const Vec2<double> a = leans_right ? low : high;
    const Vec2<double> b = leans_right ? high : low;
    const double rise = sign * (high.y - low.y);
    const double end = static_cast<double>(width);
    if (b.x <= 0.0) {
        add(rise, row[0]);
        return;
    }
    if (a.x >= end) {
        return;
    }
    const double span = b.x - a.x;
    const double from = maximum(a.x, 0.0);
    const double to = minimum(b.x, end);
    const double off_left = span > 0.0 ? rise * ((from - a.x) / span) : 0.0;
    const double inside = span > 0.0 ? rise * ((to - from) / span) : rise;
    add(off_left, row[0]);
    add_piece(Piece{from, to, inside}, width, row);
}

/// The part of an edge that lies in row j.
void add_edge(Vec2<double> from, Vec2<double> to, double sign, std::int32_t columns,
              std::int32_t j, float* row) {
    const bool rises = from.y < to.y;
    const double below = static_cast<double>(j);
    const Vec2<double> low = Vec2<double>{0.0, -below} + (rises ? from : to);
    const Vec2<double> high = Vec2<double>{0.0, -below} + (rises ? to : from);
    const double bottom = maximum(low.y, 0.0);
    const double top = minimum(high.y, 1.0);
    if (!(bottom < top)) {
        return;
    }
    const double slope = (high.x - low.x) / (high.y - low.y);
    const auto at = [&](double y) {
        const double x = y < high.y ? low.x + (y - low.y) * slope : high.x;
        return Vec2<double>{y > low.y ? x : low.x, y};
    };
    add_cut(at(bottom), at(top), rises ? -sign : sign, columns, row);
}

/// Vertex k of a ring, and the first one behind the last.
Vec2<double> vertex(View<Vec2f> ring, std::int32_t k) {
    return convert<double>(ring[k < ring.size ? k : 0]);
}

/// Counter-clockwise, the inside lies to the right of an edge that falls.
void add_ring(View<Vec2f> ring, double sign, std::int32_t columns, std::int32_t j, float* row) {
    const double turned = twice_area_in_double(ring) < 0.0 ? -sign : sign;
    for (std::int32_t k = 0; k < ring.size; ++k) {
        add_edge(vertex(ring, k), vertex(ring, k + 1), turned, columns, j, row);
    }
}

}  // namespace

Status cover_cells(View<Vec2f> polygon, View<View<Vec2f>> holes, std::int32_t columns,
                   std::int32_t rows, float* share) {
    const Status valid = check_polygon(polygon, holes);
    if (valid != Status::ok) {
        return valid;
    }
    if (share == nullptr) {
        return Status::output_missing;
    }
    for (std::int32_t j = 0; columns > 0 && j < rows; ++j) {
        float* row = share + static_cast<std::ptrdiff_t>(j) * columns;
        for (std::int32_t i = 0; i < columns; ++i) {
            row[i] = 0.0F;
        }
        add_ring(polygon, 1.0, columns, j, row);
        for (std::int32_t k = 0; k < holes.size; ++k) {
            add_ring(holes[k], -1.0, columns, j, row);
        }
        double sum = 0.0;
        for (std::int32_t i = 0; i < columns; ++i) {
            sum += static_cast<double>(row[i]);
            row[i] = sum > kNothing ? static_cast<float>(sum) : 0.0F;
        }
    }
    return Status::ok;
}

}  // namespace weir
