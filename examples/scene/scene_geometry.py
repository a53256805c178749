"""Clean-up of areas into the polygons that the simulation takes, all in metres, y up.

Out come simple polygons, with holes or without, whose rings have no repeated or collinear vertices
and coordinates that are exact single-precision numbers; outer rings run counter-clockwise.
"""

import math
import struct

from shapely.geometry import LineString, MultiPolygon, Polygon
from shapely.geometry.polygon import orient
from shapely.ops import unary_union
from shapely.validation import make_valid

from svg_outline import polygons_of

SLIVER_CELLS2 = 0.02  # smaller than any contour can show
MIN_EDGE_CELLS = 0.01
HAIRLINE_CELLS = 0.01  # gaps, spikes and threads narrower than this are closed or cut off
WALL_CELLS = 1.0  # narrower walls the grid may miss: the library wants room for their edges ...
THIN_CELLS = 1.5  # ... and then takes the edges of all that is narrower than this
THIN_SLACK_CELLS = 0.5
COLLINEAR_CELLS = 1e-3  # a vertex this close to its neighbours' chord says nothing


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
    return kept[::-1], dropped  # the last drawn first, as ever: results depend on the order


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


def rings_of(polygon):
    """The vertex lists of a polygon, the outer ring first, without repeated end points."""
    whole = orient(polygon)
    return [list(r.coords[:-1]) for r in (whole.exterior, *whole.interiors)]


def polygon_of(rings):
    """The polygon that vertex lists describe."""
    return Polygon(rings[0], rings[1:])


def tidied(raw, cell):
    """Vertex lists in single precision, rid of what says nothing; None if edges cross then."""
    for strength in (1.0, 0.1, 0.01):  # removing vertices can make edges cross: then remove less
        limits = strength * MIN_EDGE_CELLS * cell, strength * COLLINEAR_CELLS * cell
        rings = [[(to_float32(x), to_float32(y)) for x, y in tidy_ring(ring, *limits)]
                 for ring in raw]
        tidy = polygon_of(rings)
        if tidy.is_valid and tidy.area > 0.0:
            return rings
    return None


def finished_rings(polygon, cell, origin=(0.0, 0.0)):
    """The vertices that go into the header.

    Args:
        polygon: simple; it may have holes.
        cell: cell size in metres.
        origin: subtracted from every vertex (the pivot of a moving body).
    Returns:
        For each polygon its rings, lists of (x, y) in single precision: the outer one,
        counter-clockwise, then the holes, clockwise. Several where single precision parts what
        hangs together by less, as the halves of an eight do; none if nothing is left.
    """
    raw = [[(x - origin[0], y - origin[1]) for x, y in ring] for ring in rings_of(polygon)]
    whole = tidied(raw, cell)
    if whole:
        return [whole]
    rounded = polygon_of([[(to_float32(x), to_float32(y)) for x, y in ring] for ring in raw])
    parts, _ = without_slivers(make_valid(rounded), cell)
    return [rings for part in parts if (rings := tidied_part(part, cell))]


def tidied_part(part, cell):
    """Rings of a part; if its edges cross, of the largest of what its thinnest features leave."""
    rings = tidied(rings_of(part), cell)
    if rings:
        return rings
    part = max(polygons_of(without_hairlines(part, 10.0 * cell)), key=lambda p: p.area,
               default=None)
    if part is None:
        return None
    rings = [[(to_float32(x), to_float32(y)) for x, y in ring] for ring in rings_of(part)]
    return rings if polygon_of(rings).is_valid else None


def clean_polygons(area, cell, tolerance, clip=None):
    """Area -> polygons.

    Args:
        area: any polygonal geometry, metres.
        cell: cell size in metres.
        tolerance: simplification tolerance in metres.
        clip: geometry to stay inside, or None.
    Returns:
        (list of Polygon, number of slivers dropped).
    """
    area = simplified(without_hairlines(united([area]), cell), tolerance)
    if clip is not None:
        area = united([area.intersection(clip)])
    return without_slivers(area, cell)


def opened(polygon, reach, **join):
    """What discs of that radius within a polygon cover; corners stay with mitred joins."""
    return polygon.buffer(-reach, join_style=2).buffer(1.01 * reach, **join)


def thin_wall_edges(polygons, cell):
    """Room that the library wants for walls thinner than the grid shows; 0 if there are none.

    Sharp corners take room as well, but hold without, and are no reason for it.
    """
    has_walls, room = False, 0
    for polygon in polygons:
        walls = polygon.difference(opened(polygon, 0.5 * WALL_CELLS * cell, join_style=2))
        has_walls = has_walls or walls.area > WALL_CELLS ** 2 * cell ** 2
        narrow = polygon.difference(opened(polygon, 0.5 * THIN_CELLS * cell))
        near = narrow.buffer(THIN_SLACK_CELLS * cell)
        for ring in [polygon.exterior, *polygon.interiors]:
            for a, b in zip(ring.coords, ring.coords[1:]):
                if near.intersects(LineString([a, b])):  # 3 a cell, and 6 at either end
                    room += 3 * math.ceil(math.dist(a, b) / cell) + 12
    return room if has_walls else 0
