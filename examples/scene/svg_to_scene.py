#!/usr/bin/python3
"""Turns a drawing (SVG) into a C++ header of constants: a tank, solids, moving bodies and liquid.

The page is the tank. Every visible shape is a static solid: what its filling and its pen stroke
cover. Two groups mean something else, named by id, Inkscape label or class: shapes in `liquid`
are filled with particles, shapes in `moving` move. A drawing without `liquid` gets headroom and a
block of liquid above it, so any icon or logo makes a scene. A shape that covers the whole page is a
background and ignored. Text, bitmaps, markers, clip paths, masks and the gaps of dashed strokes
are not taken. Walls thinner than a cell hold liquid; where there are any the scene takes longer.

Attributes on the root element (all optional; Inkscape's XML editor sets them):
  data-cells="96"               grid cells along the page's longer side
  data-page-width-m="1.28"      width of the page in metres. Without it, a page in mm, cm, in, pt or
                                pc has its true size; one in pixels is 1 m along its longer side
  data-gravity="0 -9.81"        m/s^2, y up, each at most 1000
  data-dt="0.0166667"           seconds per frame, at most 1
  data-steps="300"              frames worth showing
  data-particles-per-cell="4"   1, 4, 9 or 16

Attributes on shapes and groups inside `moving`; they hold for everything inside, innermost first:
  data-velocity="vx vy"         m/s, y up
  data-spin="w"                 rad/s, counter-clockwise
  data-path="x,y x,y ..."       points in page units that the pivot visits in a closed loop at
                                constant speed, or "#id" of a drawn path (which then is no solid)
  data-period="s"               seconds for one loop; needed with data-path
  data-pivot="x y"              page units; default: the centroid of the body
Shapes under one element that carries such an attribute, or else under one child of `moving`, are
one body.

Exit status: 0, or 2 with a message if the drawing cannot become a scene.
"""

import argparse
import os
import sys

sys.dont_write_bytecode = True  # builds leave the source folder as it is

from scene_builder import MAX_CELLS, Options, build_scene, build_scene_for_particles  # noqa: E402
from scene_header import header_text  # noqa: E402
from svg_reader import DrawingError, read_drawing  # noqa: E402


def within(kind, low, high):
    """An argparse type: an int or float in a range."""
    def parse(text):
        value = kind(text)
        if not low <= value <= high:
            raise argparse.ArgumentTypeError(f"must be {low} .. {high}")
        return value
    return parse


def parse_arguments(arguments):
    """The command line."""
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("drawing", metavar="SCENE.svg", help="also .svgz")
    parser.add_argument("header", metavar="OUT.hpp", help="'-' writes to standard output")
    parser.add_argument("--tolerance-cells", type=within(float, 0.001, 1.0),
                        default=0.1, metavar="T",
                        help="largest distance of polygons from curves, in cells (default 0.1)")
    size = parser.add_mutually_exclusive_group()
    size.add_argument("--cells", type=within(int, 4, MAX_CELLS), default=0, metavar="N",
                      help="cells along the longer side; overrides data-cells")
    size.add_argument("--particles", type=within(int, 1, 10_000_000), default=0, metavar="N",
                      help="choose the finest grid that needs at most N particles")
    parser.add_argument("--min-opacity", type=within(float, 0.0, 1.0), default=0.0, metavar="A",
                        help="ignore fainter shapes, such as shadows (default 0)")
    parser.add_argument("--margin", type=within(float, 0.0, 4.0), default=0.0, metavar="M",
                        help="room on either side, as a share of the page's width (default 0): "
                        "lets liquid run past a drawing that fills its page")
    parser.add_argument("--name", help="the scene's name (default: the file's)")
    parser.add_argument("--include", default="scene.hpp", metavar="PATH",
                        help="how the header includes scene.hpp")
    return parser.parse_args(arguments)


def summary(scene):
    """One paragraph for people."""
    polygons = scene.solids + [b.rings for b in scene.moving]
    vertices = [sum(map(len, rings)) for rings in polygons]
    return (f"{scene.name}: {scene.cells_x} x {scene.cells_y} cells of {scene.cell_m:.4g} m; "
            f"{len(scene.solids)} solid(s) and {len(scene.moving)} moving, "
            f"{sum(vertices)} vertices, at most {max(vertices, default=0)} in one, "
            f"{sum(len(rings) - 1 for rings in polygons)} hole(s); "
            f"liquid {scene.liquid_cells2:.1f} cells^2, at most {scene.max_particles} particles.")


def main(arguments=None):
    """Runs the converter; returns the exit status."""
    args = parse_arguments(arguments)
    name = args.name or os.path.splitext(os.path.basename(args.drawing))[0]
    options = Options(args.tolerance_cells, args.cells, args.min_opacity, args.margin)
    drawing = None
    try:
        drawing = read_drawing(args.drawing)
        if args.particles:
            scene = build_scene_for_particles(drawing, name, options, args.particles)
        else:
            scene = build_scene(drawing, name, options)
        text = header_text(scene, os.path.basename(args.drawing), args.include)
        if args.header == "-":
            sys.stdout.write(text)
        else:
            with open(args.header, "w", encoding="ascii") as file:
                file.write(text)
    except (DrawingError, OSError, RecursionError) as error:
        for notice in drawing.notices if drawing else []:  # may be why: it is all text, say
            print(f"notice: {notice}", file=sys.stderr)
        if isinstance(error, RecursionError):
            error = f"{args.drawing} has groups too deep in each other"
        print(f"svg_to_scene: {error}", file=sys.stderr)
        return 2
    for notice in scene.notices:
        print(f"notice: {notice}", file=sys.stderr)
    print(summary(scene), file=sys.stderr)
    return 0


if __name__ == "__main__":
    sys.exit(main())
