"""Motion attributes of a drawing: data-velocity, data-spin, data-path, data-period, data-pivot.

Each counts for the shape or group that carries it and everything inside; the innermost one wins.
"""

import math
import re
from dataclasses import dataclass, field

from svg_outline import points_on_page
from svg_reader import INKSCAPE_LABEL, DrawingError

MOTION_ATTRIBUTES = ("data-velocity", "data-spin", "data-path", "data-pivot", "data-period")
ROLES = ("moving", "liquid")
NUMBER = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?")


@dataclass
class Motion:
    """How a body moves; metres and seconds, y up."""

    velocity: tuple = (0.0, 0.0)
    spin: float = 0.0
    path: list = field(default_factory=list)
    period: float = 0.0
    pivot: tuple = None


def numbers(text, count, name, shape):
    """Exactly count finite numbers (any even number above two if count is 0)."""
    values = [float(v) for v in NUMBER.findall(text)]
    rest = NUMBER.sub("", text).replace(",", "").strip()
    right = len(values) == count if count else len(values) >= 4 and len(values) % 2 == 0
    if rest or not right or not all(math.isfinite(v) for v in values):
        wanted = f"{count} number(s)" if count else "two or more points x,y"
        raise DrawingError(f"{name} of {shape.label()!r} must be {wanted}, is {text!r}")
    return values


def role_of(attributes):
    """'moving', 'liquid' or None for one element: by id, Inkscape label or class."""
    names = {attributes.get("id", "").lower(), attributes.get(INKSCAPE_LABEL, "").lower()}
    names.update(attributes.get("class", "").lower().split())
    return next((role for role in ROLES if role in names), None)


def role_and_depth(shape):
    """The innermost role around a shape and where in its chain that is named."""
    for depth in range(len(shape.chain) - 1, 0, -1):
        role = role_of(shape.chain[depth])
        if role:
            return role, depth
    return "solid", 0


def body_key(shape, depth):
    """Shapes with the same key are one body.

    A body is the innermost element below the `moving` group that carries motion attributes;
    without any, what the `moving` group directly contains.
    """
    for i in range(len(shape.chain) - 1, depth, -1):
        if any(name in shape.chain[i] for name in MOTION_ATTRIBUTES):
            return id(shape.chain[i])
    return id(shape.chain[min(depth + 1, len(shape.chain) - 1)])


def guide_ids(shapes):
    """Ids of drawn paths that serve as data-path and are no solids."""
    texts = [a.get("data-path", "") for s in shapes for a in s.chain]
    return {t.strip()[1:] for t in texts if t.strip().startswith("#")}


def path_points(text, shape, drawing, to_metres, tolerance_px):
    """The loop of a data-path in metres."""
    if text.startswith("#"):
        guide = drawing.by_id.get(text[1:])
        if guide is None:
            raise DrawingError(f"data-path of {shape.label()!r}: no shape has the id {text[1:]!r}")
        points = points_on_page(guide, tolerance_px)
    else:
        values = numbers(text, 0, "data-path", shape)
        points = [on_page(drawing, *p) for p in zip(values[::2], values[1::2])]
    points = [to_metres(*p) for p in points]
    loop = [p for i, p in enumerate(points) if i == 0 or math.dist(p, points[i - 1]) > 1e-9]
    if len(loop) > 1 and math.dist(loop[0], loop[-1]) < 1e-9:
        loop.pop()
    if len(loop) < 2:
        raise DrawingError(f"data-path of {shape.label()!r} needs two different points")
    return loop


def on_page(drawing, x, y):
    """Page user units (viewBox) -> pixels."""
    m = drawing.to_page
    return m.a * x + m.c * y + m.e, m.b * x + m.d * y + m.f


def length_of(path):
    """Of a closed loop."""
    return sum(math.dist(p, path[(i + 1) % len(path)]) for i, p in enumerate(path))


def fractions_of(path):
    """Share of the loop's length at which each point is reached."""
    lengths = [math.dist(p, path[(i + 1) % len(path)]) for i, p in enumerate(path)]
    total, run, result = sum(lengths), 0.0, []
    for length in lengths:
        result.append(run / total)
        run += length
    return result


def motion_of(shape, drawing, to_metres, tolerance_px):
    """Reads the motion attributes around a shape.

    Args:
        shape: a DrawnShape inside a `moving` group.
        drawing: for units and guide paths.
        to_metres: function (x_px, y_px) -> (x_m, y_m).
        tolerance_px: for flattening a guide path.
    Returns:
        A Motion.
    """
    motion = Motion()
    given = {name: shape.attribute(name) for name in MOTION_ATTRIBUTES}
    if given["data-velocity"] and given["data-path"]:
        raise DrawingError(f"{shape.label()!r} has both data-velocity and data-path: choose one")
    if given["data-velocity"]:
        motion.velocity = tuple(numbers(given["data-velocity"], 2, "data-velocity", shape))
    if given["data-spin"]:
        motion.spin = numbers(given["data-spin"], 1, "data-spin", shape)[0]
    if given["data-pivot"]:
        values = numbers(given["data-pivot"], 2, "data-pivot", shape)
        motion.pivot = to_metres(*on_page(drawing, *values))
    if given["data-path"]:
        motion.path = path_points(given["data-path"], shape, drawing, to_metres, tolerance_px)
        period = numbers(given["data-period"] or "", 1, "data-period", shape)[0]
        if not period > 0.0:
            raise DrawingError(f"data-period of {shape.label()!r} must be positive")
        motion.period = period
    return motion
