"""Writes a scene as a C++ header of constants (see scene.hpp for their meaning)."""

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


def shapes(kind, rings):
    """The vertices of each polygon and the table of polygons."""
    out = [array("Point", f"k{kind}{i}", [point(p) for p in ring], POINTS_PER_LINE)
           for i, ring in enumerate(rings)]
    table = [f"{{k{kind}{i}, {len(ring)}}}" for i, ring in enumerate(rings)]
    return "".join(out) + array("Shape", f"k{kind}Shapes", table, 4)


def moving(bodies):
    """Vertices, paths and the table of moving bodies."""
    out, table = [], []
    for i, body in enumerate(bodies):
        out.append(array("Point", f"kMoving{i}", [point(p) for p in body.ring], POINTS_PER_LINE))
        path, fractions = "nullptr", "nullptr"
        if body.motion.path:
            path, fractions = f"kPath{i}", f"kPathFraction{i}"
            out.append(array("Point", path, [point(p) for p in body.motion.path], POINTS_PER_LINE))
            out.append(array("float", fractions, [literal(f) for f in body.fractions], 6))
        table.append(f"{{{{kMoving{i}, {len(body.ring)}}}, {point(body.position)}, "
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
    counts = [len(ring) for ring in scene.solids] + [len(b.ring) for b in scene.moving]

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
    {sum(counts)},  // total_vertices
    {max(counts, default=0)},  // max_vertices
}};
"""
