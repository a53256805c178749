"""One drawn shape -> the area it covers, as a shapely geometry in page pixels (y down)."""

import math

from shapely.affinity import affine_transform
from shapely.geometry import LinearRing, LineString, MultiPolygon, Point, Polygon
from shapely.ops import polygonize, unary_union
from shapely.validation import make_valid
from svgelements import Arc, Close, Color, CubicBezier, Move, QuadraticBezier

from svg_reader import DrawingError, length_px

CAPS = {"round": 1, "butt": 2, "square": 3}
JOINS = {"round": 1, "miter": 2, "bevel": 3}
MAX_CURVE_SEGMENTS = 4096  # for one curve; a page-sized circle at 0.001 cell needs fewer


def fraction(text, default=1.0):
    """An opacity: a number or a percentage."""
    try:
        text = str(text).strip()
        return float(text[:-1]) / 100.0 if text.endswith("%") else float(text)
    except ValueError:
        return default


def opacity(shape, kind):
    """0..1: the group opacities multiplied, times fill-opacity or stroke-opacity."""
    product = fraction(shape.attribute(kind + "-opacity", "1"))
    for attributes in shape.chain:
        product *= fraction(attributes.get("opacity", "1"))
    return product


def is_shown(shape):
    """False below display:none, in definitions, or where hidden."""
    if any(a.get("display", "").strip() == "none" for a in shape.chain):
        return False
    return shape.attribute("visibility", "visible") not in ("hidden", "collapse")


def has_paint(shape, kind, min_opacity):
    """Whether 'fill' or 'stroke' leaves a mark on the page."""
    paint = shape.attribute(kind, "black" if kind == "fill" else "none").lower()
    if paint in ("none", "transparent") or opacity(shape, kind) <= min_opacity:
        return False
    if paint.startswith("url("):
        return not paint.rstrip().endswith(")none") and not paint.endswith(" none")
    try:
        return Color(paint).alpha != 0
    except (ValueError, TypeError):
        return True


def has_dashes(shape, min_opacity):
    """Whether its pen stroke has gaps."""
    pattern = shape.attribute("stroke-dasharray", "none").lower()
    lengths = [fraction(length, 1.0) for length in pattern.replace(",", " ").split()]
    return pattern != "none" and any(lengths) and has_paint(shape, "stroke", min_opacity)


def is_line(shape):
    """Whether a shape is one straight line: filling it, as is the default, covers nothing."""
    segments = shape.element.segments(transformed=False)
    drawn = [s for s in segments if not isinstance(s, Move)]
    return len(drawn) == 1 and not isinstance(drawn[0], (Arc, CubicBezier, QuadraticBezier))


def curve_steps(segment, tolerance):
    """Chords needed so that none is further than the tolerance from the curve."""
    if isinstance(segment, Arc):
        radius = max(abs(segment.rx), abs(segment.ry))
        if radius <= tolerance:
            return 4
        step = 2.0 * math.acos(1.0 - tolerance / radius)
        steps = abs(segment.sweep) / step
    elif isinstance(segment, CubicBezier):
        p = (segment.start, segment.control1, segment.control2, segment.end)
        bend = max(math.hypot(p[i].x - 2 * p[i + 1].x + p[i + 2].x,
                              p[i].y - 2 * p[i + 1].y + p[i + 2].y) for i in (0, 1))
        steps = math.sqrt(0.75 * bend / tolerance)  # |B''| <= 6 bend, chord error <= |B''|/8n^2
    else:
        p = (segment.start, segment.control, segment.end)
        bend = math.hypot(p[0].x - 2 * p[1].x + p[2].x, p[0].y - 2 * p[1].y + p[2].y)
        steps = math.sqrt(0.25 * bend / tolerance)
    return min(MAX_CURVE_SEGMENTS, max(1, math.ceil(steps)))


def flatten(segments, tolerance):
    """Polylines of a path.

    Args:
        segments: svgelements path segments.
        tolerance: largest distance between curve and chord, in the units of the segments.
    Returns:
        A list of (points, closed).
    """
    lines, points, closed = [], [], False

    def finish():
        if len(points) > 1:
            lines.append((list(points), closed))
        points.clear()

    for segment in segments:
        if isinstance(segment, Move):
            finish()
        elif isinstance(segment, Close):
            closed = True
        if segment.end is None:
            continue
        if isinstance(segment, (Arc, CubicBezier, QuadraticBezier)):
            steps = curve_steps(segment, tolerance)
            points.extend((segment.point(i / steps).x, segment.point(i / steps).y)
                          for i in range(1, steps))
        points.append((segment.end.x, segment.end.y))
        if closed:  # what follows without a Move starts where the closed part started
            finish()
            points.append((segment.end.x, segment.end.y))
            closed = False
    finish()
    if any(not (math.isfinite(x) and math.isfinite(y)) for line, _ in lines for x, y in line):
        raise DrawingError("a shape has coordinates that are not finite numbers")
    return lines


def winding_number(rings, x, y):
    """How often the rings go around a point (counter-clockwise in axes with y up)."""
    winding = 0
    for ring in rings:
        for (x0, y0), (x1, y1) in zip(ring, ring[1:] + ring[:1]):
            if (y0 <= y) != (y1 <= y):
                side = (x1 - x0) * (y - y0) - (x - x0) * (y1 - y0)
                if y1 > y0 and side > 0:
                    winding += 1
                elif y1 < y0 and side < 0:
                    winding -= 1
    return winding


def polygons_of(geometry):
    """The polygons in any geometry; lines and points have no area and are left out."""
    if geometry.is_empty:
        return []
    if isinstance(geometry, Polygon):
        return [geometry]
    return [p for part in getattr(geometry, "geoms", []) for p in polygons_of(part)]


def filled_area(lines, even_odd):
    """The area that filling closed or open polylines covers, under either fill rule."""
    rings = [points for points, _ in lines if len(set(points)) > 2]
    if not rings:
        return MultiPolygon()
    if len(rings) == 1 and Polygon(rings[0]).is_valid:
        return Polygon(rings[0])
    outlines = unary_union([LineString(r + r[:1]) for r in rings])
    inside = []
    for face in polygonize(outlines):
        point = face.representative_point()
        winding = winding_number(rings, point.x, point.y)
        if (winding % 2 == 1) if even_odd else (winding != 0):
            inside.append(face)
    return unary_union(inside) if inside else MultiPolygon()


def stroked_area(shape, lines, tolerance):
    """The area of a pen stroke; dashes are drawn through."""
    radius = 0.5 * length_px(shape.attribute("stroke-width", "1"), 1.0)
    if radius <= 0.0:
        return MultiPolygon()
    cap = CAPS.get(shape.attribute("stroke-linecap", "butt"), 2)
    join = JOINS.get(shape.attribute("stroke-linejoin", "miter"), 2)
    limit = max(1.0, fraction(shape.attribute("stroke-miterlimit", "4"), 4.0))
    step = 2.0 * math.acos(max(0.0, 1.0 - tolerance / radius))
    resolution = max(2, math.ceil(0.5 * math.pi / step))
    parts = []
    for points, closed in lines:
        if len(set(points)) == 1:
            parts.append(Point(points[0]).buffer(radius, resolution))
            continue
        line = LinearRing(points) if closed and len(set(points)) > 2 else LineString(points)
        parts.append(line.buffer(radius, resolution, cap_style=cap, join_style=join,
                                 mitre_limit=limit))
    return unary_union(parts) if parts else MultiPolygon()


def shape_lines(shape, tolerance_px):
    """Flattened path in the shape's own units, the tolerance there, and its transform."""
    m = shape.element.transform
    stretch = max(math.hypot(m.a, m.b), math.hypot(m.c, m.d), 1e-12)
    segments = shape.element.segments(transformed=False)
    return flatten(segments, tolerance_px / stretch), tolerance_px / stretch, m


def area_on_page(shape, tolerance_px, stroke):
    """The area of a shape.

    Args:
        shape: a DrawnShape.
        tolerance_px: flattening tolerance in page pixels.
        stroke: True for its pen stroke, False for its filling.
    Returns:
        A valid polygonal geometry in page pixels, possibly empty.
    """
    lines, tolerance, m = shape_lines(shape, tolerance_px)
    if stroke:
        area = stroked_area(shape, lines, tolerance)
    else:
        area = filled_area(lines, shape.attribute("fill-rule", "nonzero") == "evenodd")
    if area.is_empty:
        return area
    area = affine_transform(area, [m.a, m.c, m.b, m.d, m.e, m.f])
    return unary_union(polygons_of(make_valid(area)))


def points_on_page(shape, tolerance_px):
    """The first polyline of a guide path, in page pixels."""
    lines, _, m = shape_lines(shape, tolerance_px)
    if not lines:
        return []
    return [(m.a * x + m.c * y + m.e, m.b * x + m.d * y + m.f) for x, y in lines[0][0]]
