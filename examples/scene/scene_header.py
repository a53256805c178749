"""Writes a scene as a C++ header of constants (see scene.hpp for their meaning)."""

import itertools

from scene_geometry import to_float32

POINTS_PER_LINE = 3


def literal(value):
    """A float literal that reads back as exactly the nearest single-precision number."""
    text = f"{to_float32(value):.9g}"
    return text + ("f" if any(c in text for c in ".en") else ".0f")


def point(p):
    """A braced pair."""
    return "{" + literal(p[0]) + ", " + literal(p[1]) + "}"


def text_literal(text):
    """A C++ string literal, plain ASCII."""
    safe = "".join(c if c.isascii() and c.isprintable() and c not in '"\\?' else "_" for c in text)
    return '"' + safe + '"'


def array(type_name, name, items, per_line):
    """A constexpr array, or nothing if there are no items (C++ has no empty arrays)."""
    if not items:
        return ""
    lines = [", ".join(items[i:i + per_line]) for i in range(0, len(items), per_line)]
    return f"inline constexpr {type_name} {name}[] = {{\n    " + ",\n    ".join(lines) + ",\n};\n"


def shape(name, rings):
    """The vertices of a polygon, and the braces that refer to them."""
    points = [point(p) for ring in rings for p in ring]
    out = array("Point", name, points, POINTS_PER_LINE)
    if len(rings) == 1:
        return out, f"{{{name}, {len(points)}}}"
    ends = itertools.accumulate(map(len, rings))
    out += array("std::int32_t", name + "Ends", list(map(str, ends)), 12)
    return out, f"{{{name}, {len(points)}, {name}Ends, {len(rings)}}}"


def shapes(kind, polygons):
    """The vertices of each polygon and the table of polygons."""
    made = [shape(f"k{kind}{i}", rings) for i, rings in enumerate(polygons)]
    return "".join(m[0] for m in made) + array("Shape", f"k{kind}Shapes", [m[1] for m in made], 4)


def moving(bodies):
    """Vertices, paths and the table of moving bodies."""
    out, table = [], []
    for i, body in enumerate(bodies):
        points, braces = shape(f"kMoving{i}", body.rings)
        out.append(points)
        path, fractions = "nullptr", "nullptr"
        if body.motion.path:
            path, fractions = f"kPath{i}", f"kPathFraction{i}"
            out.append(array("Point", path, [point(p) for p in body.motion.path], POINTS_PER_LINE))
            out.append(array("float", fractions, [literal(f) for f in body.fractions], 6))
        table.append(f"{{{braces}, {point(body.position)}, "
                     f"{point(body.motion.velocity)}, {literal(body.motion.spin)},\n     {path}, "
                     f"{fractions}, {len(body.motion.path)}, {literal(body.motion.period)}}}")
    return "".join(out) + array("Moving", "kMovingBodies", table, 1)


def header_text(scene, source, include):
    """The whole header.

    Args:
        scene: a SceneData.
        source: the drawing's file name, for the first line.
        include: how the header includes scene.hpp.
    Returns:
        C++17 text.
    """
    polygons = scene.solids + [b.rings for b in scene.moving]
    counts = [sum(map(len, rings)) for rings in polygons]
    holes = [len(rings) - 1 for rings in polygons]

    def table(name, items):
        return f"{name if items else 'nullptr'}, {len(items)}"

    safe_source = text_literal(source)[1:-1]
    return f"""// Made from {safe_source} by svg_to_scene.py. Change the drawing, not this file.
#pragma once

#include "{include}"

namespace scene {{
namespace drawing {{

{shapes("Solid", scene.solids)}{moving(scene.moving)}{shapes("Liquid", scene.liquid)}
}}  // namespace drawing
}}  // namespace scene

inline constexpr scene::Scene kScene = {{
    {text_literal(scene.name)},
    {scene.cells_x},  // cells_x
    {scene.cells_y},  // cells_y
    {literal(scene.cell_m)},  // cell_m
    {point(scene.gravity)},  // gravity_mps2
    {literal(scene.dt_s)},  // dt_s
    {scene.steps},  // steps
    {scene.particles_per_cell},  // particles_per_cell
    {table("scene::drawing::kSolidShapes", scene.solids)},  // solids
    {table("scene::drawing::kMovingBodies", scene.moving)},  // moving
    {table("scene::drawing::kLiquidShapes", scene.liquid)},  // liquid
    {scene.max_particles},  // max_particles
    {sum(counts) + 3 * sum(holes)},  // total_vertices
    {max(counts, default=0)},  // max_vertices
    {max(holes, default=0)},  // max_holes
    {scene.wall_edges},  // wall_edges
}};
"""
