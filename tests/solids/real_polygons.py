#!/usr/bin/python3
"""Polygons that nobody here drew, from installed Debian packages, for real_geometry.cpp:

    real_polygons.py coast|letters|icons [COUNT]

coast: every polygon of the low-resolution coastline (gmt-gshhg-low): land, lakes as its holes,
islands in lakes, ponds in those. letters: all letters of two fonts (fonts-dejavu-core,
fonts-quicksand). icons: COUNT drawings of adwaita-icon-theme.

Writes `polygon NAME RINGS SOUND`, then per ring `ring COUNT` and its vertices, one a line. SOUND is
1 if shapely finds every ring simple and all of them apart. Coordinates are exact in single
precision.
"""

import glob
import os
import sys
import unicodedata
import warnings

from shapely.geometry import LinearRing, MultiPolygon, Point, Polygon
from shapely.ops import unary_union
from shapely.prepared import prep
from shapely.strtree import STRtree
from shapely.validation import make_valid

warnings.simplefilter("ignore")  # shapely 1.8 announces 2.0

HERE = os.path.dirname(os.path.abspath(__file__))
COAST = "/usr/share/gmt-gshhg/binned_GSHHS_l.nc"
FONTS = ("/usr/share/fonts/truetype/dejavu/DejaVuSerif.ttf",
         "/usr/share/fonts/truetype/quicksand/Quicksand-Regular.ttf")
ICONS = "/usr/share/icons/Adwaita/scalable/*/*.svg"
BIN = 65535  # units of a bin's side
PLACES_PER_HOLE = 3  # as the library counts them
MOST_PLACES = 16384  # kMaxBodyVertices
CLOSED = 4  # a segment that does not leave its bin


def offenders(rings):
    """Numbers of rings that are not simple, touch another one, or are holes outside: a body's
    polygon has none."""
    bad = {i for i, r in enumerate(rings) if len(set(r)) < 3 or not LinearRing(r).is_simple}
    if 0 in bad:
        return bad
    lines = [LinearRing(r) if i not in bad else Point(r[0]) for i, r in enumerate(rings)]
    number = {id(line): i for i, line in enumerate(lines)}
    outline = prep(lines[0])
    bad |= {i for i, line in enumerate(lines) if i > 0 and outline.intersects(line)}
    tree = STRtree(lines[1:])
    for i, line in enumerate(lines[1:], 1):
        near = [h if hasattr(h, "geom_type") else lines[1 + h] for h in tree.query(line)]
        bad |= {max(i, number[id(h)]) for h in near if h is not line and h.intersects(line)}
    outer = prep(Polygon(rings[0]))
    bad |= {i for i, r in enumerate(rings) if i > 0 and not outer.contains(Point(r[0]))}
    if not bad and not Polygon(rings[0], rings[1:]).is_valid:
        bad = {0}  # a hole in a hole
    return bad


def write(name, rings):
    """One polygon, outer ring first; vertices are pairs of numbers. Returns its offenders."""
    bad = offenders(rings)
    print("polygon", name, len(rings), int(not bad))
    for ring in rings:
        print("ring", len(ring))
        print("\n".join(f"{x:.9g} {y:.9g}" for x, y in ring))
    return bad


def write_mended(name, rings, bad):
    """An unsound or too large polygon once more: without holes that offend or, from the smallest
    on, are too many, which then come as polygons of their own; without an outer ring that crosses
    itself, of which the parts come."""
    holes = sorted((r for i, r in enumerate(rings) if i > 0 and i not in bad),
                   key=lambda r: Polygon(r).area)
    alone = [r for i, r in enumerate(rings) if i > 0 and i in bad]
    places = sum(len(r) + PLACES_PER_HOLE for r in [rings[0], *holes])
    while places > MOST_PLACES:
        places -= len(holes[0]) + PLACES_PER_HOLE
        alone.append(holes.pop(0))
    if 0 not in bad:
        write(f"{name}_mended", [rings[0], *holes])
    else:
        alone += [rings[0], *holes]
    for k, ring in enumerate(alone):
        if write(f"{name}_ring_{k}", [ring]):
            shrunk = make_valid(Polygon(ring)).buffer(-2, join_style=2)
            for j, part in enumerate(rings_of(shrunk, 1)):
                write(f"{name}_ring_{k}_part_{j}", part)


def rings_of(area, grid):
    """Rings of each polygon of an area, on a lattice of 1 / grid."""
    for part in getattr(area, "geoms", [area]):
        if isinstance(part, Polygon) and not part.is_empty:
            rings = [[(round(x * grid) / grid, round(y * grid) / grid) for x, y in ring.coords[:-1]]
                     for ring in (part.exterior, *part.interiors)]
            rings = [r for r in rings if len(set(r)) > 2 and Polygon(r).area > 0.0]
            if rings:
                yield rings


def segments(data):
    """(polygon, level, closed, points) of each segment; points in units, 65535 to 10 degrees."""
    columns = int(data["N_bins_in_360_longitude_range"][0])
    rows = int(data["N_bins_in_180_degree_latitude_range"][0])
    first_segment = data["Id_of_first_segment_in_a_bin"][...]
    in_bin = data["N_segments_in_a_bin"][...]
    packed = data["Embedded_npts_levels_exit_entry_for_a_segment"][...]
    first_point = data["Id_of_first_point_in_a_segment"][...]
    ids = data["Id_of_GSHHS_ID"][...]
    ice = data["Embedded_ANT_flag"][...]
    dx = data["Relative_longitude_from_SW_corner_of_bin"][...].astype("uint16").astype(int)
    dy = data["Relative_latitude_from_SW_corner_of_bin"][...].astype("uint16").astype(int)
    for b in range(len(in_bin)):
        x0, y0 = (b % columns) * BIN, (rows - 1 - b // columns) * BIN
        for s in range(int(first_segment[b]), int(first_segment[b]) + int(in_bin[b])):
            info = int(packed[s])
            span = slice(int(first_point[s]), int(first_point[s]) + (info >> 9))
            points = [(x0 + int(x), y0 + int(y)) for x, y in zip(dx[span], dy[span])]
            yield (int(ids[s]), int(ice[s])), (info >> 6) & 7, ((info >> 3) & 7) == CLOSED, points


def joined(parts, around):
    """Closed rings from segments that end where the next one starts, at the border of a bin.

    A ring that comes back one turn further east goes around the pole, which becomes a part of it.
    """
    starts = {}
    for part in parts:
        starts.setdefault((part[0][0] % around, part[0][1]), []).append(part)
    while starts:
        key, waiting = next(iter(starts.items()))
        ring = list(waiting.pop())
        if not waiting:
            del starts[key]
        while True:
            here = (ring[-1][0] % around, ring[-1][1])
            waiting = starts.get(here)
            if not waiting:
                break
            part = waiting.pop()
            if not waiting:
                del starts[here]
            shift = ring[-1][0] - part[0][0]
            ring += [(x + shift, y) for x, y in part[1:]]
        if ring[0] != ring[-1]:
            ring += [(ring[-1][0], 0), (ring[0][0], 0)]
            yield ring
        else:
            yield ring[:-1]


def coast():
    """Land with its lakes, islands in lakes with their ponds."""
    import netCDF4
    data = netCDF4.Dataset(COAST)
    data.set_auto_maskandscale(False)
    around = BIN * int(data["N_bins_in_360_longitude_range"][0])
    parents = data["Id_of_parent_polygons"][...]
    rings, level, open_parts = {}, {}, {}
    for name, depth, closed, points in segments(data):
        level[name] = depth
        if closed:
            rings.setdefault(name, []).append(points[:-1] if points[0] == points[-1] else points)
        else:
            open_parts.setdefault(name, []).append(points)
    for name, parts in open_parts.items():
        rings.setdefault(name, []).extend(joined(parts, around))
    holes = {}
    for name, found in rings.items():
        if level[name] % 2 == 0:
            holes.setdefault(int(parents[name[0]]), []).extend(found)
    for name, found in sorted(rings.items()):
        if level[name] % 2 == 1:
            for k, outer in enumerate(found):
                inner = holes.get(name[0], []) if k == 0 else []
                x = outer[0][0]
                near = []
                turns = [t * around for t in (-1, 0, 1)]
                shape = prep(Polygon(outer).buffer(0)) if inner else None
                for hole in inner:  # a ring may be a turn away from what is in it
                    shift = next((t for t in turns if shape.contains(
                        Polygon([(px + t, py) for px, py in hole]).representative_point())), None)
                    if shift is not None:
                        near.append([(px + shift, py) for px, py in hole])
                rings_here = [[(px - x, py) for px, py in r] for r in [outer, *near]]
                title = f"coast_{name[0]}_{name[1]}_{k}"
                bad = write(title, rings_here)
                places = sum(len(r) + PLACES_PER_HOLE for r in rings_here)
                if bad or places > MOST_PLACES:
                    write_mended(title, rings_here, bad)


def flat_contours(glyph_set, name, pieces):
    """A glyph's contours with each curve in so many straight pieces."""
    from fontTools.pens.recordingPen import DecomposingRecordingPen
    from fontTools.pens.basePen import decomposeQuadraticSegment
    pen = DecomposingRecordingPen(glyph_set)
    glyph_set[name].draw(pen)
    contours = []
    for verb, points in pen.value:
        if verb == "moveTo":
            contours.append([points[0]])
        elif verb == "lineTo":
            contours[-1].append(points[0])
        elif verb == "qCurveTo":
            if points[-1] is None:  # no point on the curve: start half way between two
                middle = tuple(0.5 * (a + b) for a, b in zip(points[-2], points[0]))
                contours.append([middle])
                points = (*points[:-1], middle)
            for control, end in decomposeQuadraticSegment(points):
                a = contours[-1][-1]
                contours[-1] += [tuple((1 - t) ** 2 * p + 2 * t * (1 - t) * q + t * t * r
                                       for p, q, r in zip(a, control, end))
                                 for t in (k / pieces for k in range(1, pieces + 1))]
        elif verb == "curveTo":
            a = contours[-1][-1]
            contours[-1] += [tuple((1 - t) ** 3 * p + 3 * t * (1 - t) ** 2 * q +
                                   3 * t * t * (1 - t) * r + t ** 3 * s
                                   for p, q, r, s in zip(a, *points))
                             for t in (k / pieces for k in range(1, pieces + 1))]
    return [c for c in contours if len(set(c)) > 2]


def letters():
    """All letters that a font has; contours inside an odd number of others are holes."""
    from fontTools.ttLib import TTFont
    for path in FONTS:
        font = TTFont(path)
        glyph_set = font.getGlyphSet()
        family = os.path.basename(path).split(".")[0].split("-")[0]
        done = set()
        for code, name in sorted(font.getBestCmap().items()):
            if unicodedata.category(chr(code))[0] != "L" or name in done:
                continue
            done.add(name)
            area = MultiPolygon()
            for contour in flat_contours(glyph_set, name, 8):
                area = area.symmetric_difference(make_valid(Polygon(contour)))
            for k, rings in enumerate(rings_of(area, 64)):
                write(f"{family}_{code:04X}_{k}", rings)


def icons(count):
    """Drawings at equal distances in the list of all, of the filled kind."""
    sys.path.insert(0, os.path.join(HERE, "..", "..", "examples", "scene"))
    from svg_outline import area_on_page, has_paint, is_line, is_shown
    from svg_reader import read_drawing
    paths = sorted(glob.glob(ICONS))
    for path in paths[::max(1, len(paths) // count)][:count]:
        drawing = read_drawing(path)
        areas = [make_valid(area_on_page(s, 0.01, not has_paint(s, "fill", 0.0) or is_line(s)))
                 for s in drawing.shapes if is_shown(s)]
        name = os.path.basename(path).rsplit(".", 1)[0]
        whole = unary_union([a for a in areas if not a.is_empty])
        for k, rings in enumerate(rings_of(whole, 4096)):
            write(f"{name}_{k}", rings)


def main():
    kind = sys.argv[1]
    if kind == "icons":
        icons(int(sys.argv[2]))
    else:
        {"coast": coast, "letters": letters}[kind]()


if __name__ == "__main__":
    main()
