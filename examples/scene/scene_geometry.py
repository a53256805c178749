"""Clean-up of areas into the polygons that the simulation takes, all in metres, y up.

Out come simple polygons without holes, counter-clockwise, without repeated or collinear vertices,
whose coordinates are exact single-precision numbers.
"""

import math
import struct

from shapely.geometry import MultiPolygon, Polygon, box
from shapely.geometry.polygon import orient
from shapely.ops import unary_union
from shapely.validation import make_valid

from svg_outline import polygons_of

SLIVER_CELLS2 = 0.02  # smaller than any contour can show
MIN_EDGE_CELLS = 0.01
HAIRLINE_CELLS = 0.01  # gaps, spikes and threads narrower than this are closed or cut off
COLLINEAR_CELLS = 1e-3  # a vertex this close to its neighbours' chord says nothing
MAX_SPLITS = 2000


def to_float32(value):
    """The nearest single-precision number, never minus zero."""
    return struct.unpack("f", struct.pack("f", value))[0] + 0.0


def united(areas):
    """One valid geometry from many areas, lines and points dropped."""
    parts = [p for a in areas for p in polygons_of(make_valid(a))]
    return unary_union(parts) if parts else MultiPolygon()


def simplified(area, tolerance):
    """Fewer vertices within the tolerance, same topology, still valid."""
    return united([area.simplify(tolerance, preserve_topology=True)])


def without_hairlines(area, cell):
    """Closes gaps and cuts off spikes that single precision could not keep apart.

    Corners stay where they are: the offsets use mitred joins.
    """
    reach = 0.5 * HAIRLINE_CELLS * cell
    for distance in (reach, -2.0 * reach, reach):
        area = area.buffer(distance, join_style=2, mitre_limit=20.0)
    return area


def without_slivers(area, cell):
    """Drops polygons and fills holes too small to matter; returns the rest and how many."""
    limit = SLIVER_CELLS2 * cell * cell
    kept, dropped = [], 0
    for polygon in polygons_of(area):
        if polygon.area < limit:
            dropped += 1
            continue
        holes = [h for h in polygon.interiors if Polygon(h).area >= limit]
        dropped += len(polygon.interiors) - len(holes)
        kept.append(Polygon(polygon.exterior, holes))
    return kept, dropped


def halves(polygon, overlap):
    """Cuts a polygon through its largest hole.

    Args:
        polygon: has at least one hole.
        overlap: width of the band both halves keep; narrower holes narrow it.
    Returns:
        The parts on either side of the cut, their union being the polygon.
    """
    hole = max((Polygon(h) for h in polygon.interiors), key=lambda h: h.area)
    x0, y0, x1, y1 = hole.bounds
    left, bottom, right, top = polygon.bounds
    # The cut goes across the hole's longer side: there its end stays furthest from the cut.
    if x1 - x0 >= y1 - y0:
        centre, half = 0.5 * (x0 + x1), 0.5 * min(overlap, 0.5 * (x1 - x0))
        sides = (box(left, bottom, centre + half, top), box(centre - half, bottom, right, top))
    else:
        centre, half = 0.5 * (y0 + y1), 0.5 * min(overlap, 0.5 * (y1 - y0))
        sides = (box(left, bottom, right, centre + half), box(left, centre - half, right, top))
    return [p for side in sides for p in polygons_of(make_valid(polygon.intersection(side)))]


def split_holes(polygons, overlap):
    """Hole-free polygons whose union is that of the given ones."""
    done, waiting, splits = [], list(polygons), 0
    while waiting:
        polygon = waiting.pop()
        if not polygon.interiors:
            done.append(polygon)
            continue
        splits += 1
        if splits > MAX_SPLITS:
            raise RuntimeError("too many holes to split")
        waiting.extend(halves(polygon, overlap))
    return done


def distance_to_chord(a, b, c):
    """How far b is from the line a-c; from a if they coincide."""
    length = math.hypot(c[0] - a[0], c[1] - a[1])
    if length == 0.0:
        return math.hypot(b[0] - a[0], b[1] - a[1])
    return abs((c[0] - a[0]) * (b[1] - a[1]) - (c[1] - a[1]) * (b[0] - a[0])) / length


def tidy_ring(points, min_edge, flatness):
    """Removes repeated and collinear vertices from a closed ring (first point not repeated)."""
    ring = list(points)
    i, unchanged = 0, 0
    while len(ring) > 3 and unchanged < len(ring):
        i %= len(ring)
        a, b, c = ring[i - 1], ring[i], ring[(i + 1) % len(ring)]
        short = math.hypot(b[0] - a[0], b[1] - a[1]) < min_edge
        if short or distance_to_chord(a, b, c) < flatness:
            del ring[i]
            i, unchanged = max(0, i - 1), 0
        else:
            i, unchanged = i + 1, unchanged + 1
    return ring


def finished_ring(polygon, cell, origin=(0.0, 0.0)):
    """The vertices that go into the header.

    Args:
        polygon: simple, without holes.
        cell: cell size in metres.
        origin: subtracted from every vertex (the pivot of a moving body).
    Returns:
        A list of (x, y) in single precision, counter-clockwise, or None if nothing is left.
    """
    raw = [(x - origin[0], y - origin[1]) for x, y in orient(polygon).exterior.coords[:-1]]
    for strength in (1.0, 0.1, 0.01):  # removing vertices can make edges cross: then remove less
        ring = tidy_ring(raw, strength * MIN_EDGE_CELLS * cell, strength * COLLINEAR_CELLS * cell)
        ring = [(to_float32(x), to_float32(y)) for x, y in ring]
        tidy = Polygon(ring)
        if tidy.is_valid and tidy.area > 0.0:
            return ring if tidy.exterior.is_ccw else ring[::-1]
    # Rounding makes edges cross: keep the largest part, with its thinnest features cut off.
    part = max(polygons_of(make_valid(Polygon(raw))), key=lambda p: p.area, default=None)
    if part is None:
        return None
    part = without_hairlines(part, 10.0 * cell)
    part = max(polygons_of(part), key=lambda p: p.area, default=None)
    if part is None:
        return None
    ring = [(to_float32(x), to_float32(y)) for x, y in orient(part).exterior.coords[:-1]]
    return ring if Polygon(ring).is_valid else None


def clean_polygons(area, cell, tolerance, overlap, clip=None):
    """Area -> hole-free polygons.

    Args:
        area: any polygonal geometry, metres.
        cell: cell size in metres.
        tolerance: simplification tolerance in metres.
        overlap: width in metres by which parts of a split polygon overlap (0: exact seams).
        clip: geometry to stay inside, or None.
    Returns:
        (list of Polygon, number of slivers dropped).
    """
    area = simplified(without_hairlines(united([area]), cell), tolerance)
    if clip is not None:
        area = united([area.intersection(clip)])
    kept, dropped = without_slivers(area, cell)
    parts = split_holes(kept, overlap)
    limit = SLIVER_CELLS2 * cell * cell
    # With an overlap, what a cut leaves below the limit lies next to a part that covers it nearly.
    return [p for p in parts if p.area >= limit], dropped
