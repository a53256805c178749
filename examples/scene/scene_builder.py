"""A drawing becomes a scene: page to tank, shapes to static solids, moving bodies and liquid."""

import math
from dataclasses import dataclass, field, replace

import numpy
from shapely import vectorized
from shapely.affinity import affine_transform
from shapely.geometry import box

from scene_geometry import (clean_polygons, finished_rings, polygon_of, thin_wall_edges, to_float32,
                            united)
from scene_motion import (NUMBER, Motion, body_key, fractions_of, guide_ids, length_of, motion_of,
                          role_and_depth)
from svg_outline import area_on_page, has_dashes, has_paint, is_line, is_shown
from svg_reader import DrawingError

DEFAULT_CELLS = 96
MAX_CELLS = 4096
# What the library takes (weir/config.hpp). Said here, before two builds have been waited for.
LEAST_CELLS = 4
CELL_RANGE_M = (1e-6, 1e3)
MAX_GRAVITY = 1000.0
MAX_STEP_S = 1.0
MAX_SPIN = 1e4
MAX_SPEED_CELLS = 1e6
PARTICLES_PER_CELL = (1, 4, 9, 16)
MAX_WALL_EDGES = 65000
BACKGROUND_SHARE = 0.99  # a filling that covers this share of the page is paper, not a solid
HEADROOM_SHARE = 0.6  # of the page's height, added above a drawing without liquid
DEFAULT_LIQUID_SHARE = 0.3  # of the page's height: the block that pours over the drawing
MAX_BODY_VERTICES = 16384  # holes included, and 3 more for each: the library's limit


@dataclass
class Options:
    """What the command line may override."""

    tolerance_cells: float = 0.1
    cells: int = 0  # 0: the drawing's data-cells, or the default
    min_opacity: float = 0.0
    margin: float = 0.0  # share of the page's width added on either side


@dataclass
class Body:
    """One polygon that moves; rings relative to the pivot."""

    rings: list
    motion: Motion
    position: tuple
    fractions: list


@dataclass
class SceneData:
    """Everything the header states; metres, y up."""

    name: str
    cells_x: int
    cells_y: int
    cell_m: float
    gravity: tuple
    dt_s: float
    steps: int
    particles_per_cell: int
    solids: list = field(default_factory=list)
    moving: list = field(default_factory=list)
    liquid: list = field(default_factory=list)
    max_particles: int = 0
    wall_edges: int = 0
    liquid_cells2: float = 0.0
    notices: list = field(default_factory=list)


def root_numbers(drawing, name, default, count=1, low=-math.inf, high=math.inf):
    """Numbers from an attribute of the root element, checked against their range."""
    text = drawing.attributes.get(name)
    if text is None:
        return default
    values = [float(v) for v in NUMBER.findall(text)]
    if len(values) != count or not all(low <= v <= high for v in values):
        raise DrawingError(f"{name} must be {count} number(s) from {low} to {high}, is {text!r}")
    return values[0] if count == 1 else tuple(values)


class Builder:
    """Builds the scene for one grid resolution."""

    def __init__(self, drawing, name, options):
        self.drawing = drawing
        self.options = options
        self.notices = list(drawing.notices)
        self.shapes = self.visible_shapes()
        self.has_liquid = any(role == "liquid" for role, _, _, _ in self.shapes)
        self.page_width_m = drawing.width_px * drawing.metres_per_px
        self.margin_m = options.margin * self.page_width_m
        self.page_height_m = drawing.height_px * drawing.metres_per_px
        self.scene = self.empty_scene(name)
        self.cell = self.scene.cell_m
        self.tolerance = options.tolerance_cells * self.cell
        self.tank = box(0.0, 0.0, self.scene.cells_x * self.cell, self.scene.cells_y * self.cell)

    def visible_shapes(self):
        """(role, depth, shape, stroke) of every shape that leaves a mark."""
        guides = guide_ids(self.drawing.shapes)
        result, stroked = [], 0
        faint = self.options.min_opacity
        for shape in self.drawing.shapes:
            if not is_shown(shape) or shape.chain[-1].get("id") in guides:
                continue
            role, depth = role_and_depth(shape)
            if has_paint(shape, "fill", faint) and not is_line(shape):
                result.append((role, depth, shape, False))
            elif has_paint(shape, "stroke", faint):
                stroked += 1
                result.append((role, depth, shape, True))
        if stroked:
            self.notices.append(f"{stroked} unfilled shape(s): the pen stroke is the shape")
        dashed = sum(has_dashes(shape, faint) for _, _, shape, _ in result)
        if dashed:
            self.notices.append(f"{dashed} dashed stroke(s) are taken without their gaps")
        if not result:
            raise DrawingError("the drawing is empty: no visible filled or stroked shape")
        return result

    def empty_scene(self, name):
        """The grid and the numbers on the root element."""
        drawing = self.drawing
        width = self.page_width_m + 2.0 * self.margin_m
        height = self.page_height_m
        if not self.has_liquid:
            height *= 1.0 + HEADROOM_SHARE
            self.notices.append(
                f"nothing in a group 'liquid': {HEADROOM_SHARE:.0%} of the page's height is added "
                "on top, with a block of liquid in it")
        cells = self.options.cells or root_numbers(drawing, "data-cells", DEFAULT_CELLS,
                                                   low=LEAST_CELLS, high=MAX_CELLS)
        if cells != int(cells):
            raise DrawingError("data-cells must be a whole number")
        cell = to_float32(max(width, height) / cells)
        counts = [max(1, round(side / cell)) for side in (width, height)]
        lost = max(abs(side / cell - n) for side, n in zip((width, height), counts))
        if lost > 0.25:
            self.notices.append(f"the shorter side is rounded to whole cells, by {lost:.2f} cell")
        if min(counts) < LEAST_CELLS:
            raise DrawingError(f"the tank would have {counts[0]} x {counts[1]} cells, and wants "
                               f"{LEAST_CELLS} along each side: more data-cells, or another page")
        if not CELL_RANGE_M[0] <= cell <= CELL_RANGE_M[1]:
            raise DrawingError(f"cells would be {cell:.3g} m, and may be {CELL_RANGE_M[0]:g} to "
                               f"{CELL_RANGE_M[1]:g} m: state data-page-width-m")
        per_cell = root_numbers(drawing, "data-particles-per-cell", 4)
        if per_cell not in PARTICLES_PER_CELL:
            raise DrawingError("data-particles-per-cell must be 1, 4, 9 or 16")
        steps = root_numbers(drawing, "data-steps", 300, low=1, high=10_000_000)
        return SceneData(name, counts[0], counts[1], cell,
                         root_numbers(drawing, "data-gravity", (0.0, -9.81), 2,
                                      -MAX_GRAVITY, MAX_GRAVITY),
                         root_numbers(drawing, "data-dt", 1.0 / 60.0, 1, 1e-6, MAX_STEP_S),
                         int(steps), int(per_cell))

    def to_metres(self, x_px, y_px):
        """Page pixels, y down -> metres, y up, origin at the tank's bottom left corner."""
        scale = self.drawing.metres_per_px
        return self.margin_m + x_px * scale, self.page_height_m - y_px * scale

    def area(self, shape, stroke):
        """The area of a shape in metres."""
        scale = self.drawing.metres_per_px
        # Half of the tolerance is for flattening, half for simplification.
        area = area_on_page(shape, 0.5 * self.tolerance / scale, stroke)
        # United again: rounding in the transform can make edges that touch cross.
        return united([affine_transform(area, [scale, 0, 0, -scale, self.margin_m,
                                               self.page_height_m])])

    def is_background(self, area):
        """Whether a filling is as good as the whole page."""
        page = box(self.margin_m, 0.0, self.margin_m + self.page_width_m, self.page_height_m)
        return area.intersection(page).area >= BACKGROUND_SHARE * page.area

    def build(self):
        """Returns the SceneData."""
        solids, liquid, bodies, slivers = [], [], {}, 0
        for role, depth, shape, stroke in self.shapes:
            area = self.area(shape, stroke)
            if role == "liquid":
                liquid.append(area)
                continue
            if role == "solid" and self.is_background(area):
                self.notices.append(f"{shape.label()!r} covers the whole page: a background, no "
                                    "solid")
                continue
            if not stroke and has_paint(shape, "stroke", self.options.min_opacity):
                area = united([area, self.area(shape, True)])  # what is seen is what is solid
            if area.is_empty:
                continue
            if role == "moving":
                bodies.setdefault(body_key(shape, depth), (shape, []))[1].append(area)
            else:
                solids.append(area)
        slivers += self.add_solids(solids)
        for shape, areas in bodies.values():
            slivers += self.add_body(shape, areas)
        slivers += self.add_liquid(liquid)
        self.add_wall_edges()
        if slivers:
            self.notices.append(f"{slivers} part(s) or hole(s) below 0.02 cell^2 dropped")
        scene = self.scene
        if not scene.solids and not scene.moving and not self.has_liquid:
            raise DrawingError("the drawing is empty: nothing but a background or specks")
        scene.notices = self.notices
        return scene

    def finished(self, polygons, origin=(0.0, 0.0)):
        """The rings of each polygon."""
        finished = [rings for p in polygons for rings in finished_rings(p, self.cell, origin)]
        for rings in finished:
            if sum(map(len, rings)) + 3 * (len(rings) - 1) > MAX_BODY_VERTICES:
                raise DrawingError(f"a polygon has more than {MAX_BODY_VERTICES} vertices: raise "
                                   "--tolerance-cells")
        return finished

    def add_solids(self, areas):
        """Static solids: one union, cleaned."""
        polygons, slivers = clean_polygons(united(areas), self.cell, 0.5 * self.tolerance,
                                           self.tank)
        self.scene.solids = self.finished(polygons)
        self.solid_area = united(polygons)
        return slivers

    def add_body(self, shape, areas):
        """A moving body: not clipped, for it may come in from outside."""
        whole = united(areas)
        polygons, slivers = clean_polygons(whole, self.cell, 0.5 * self.tolerance)
        motion = motion_of(shape, self.drawing, self.to_metres,
                           0.5 * self.tolerance / self.drawing.metres_per_px)
        self.check_speed(shape, motion)
        pivot = motion.pivot or (whole.centroid.x, whole.centroid.y)
        # Rounded once: ring + position must be the place it was drawn at.
        pivot = (to_float32(pivot[0]), to_float32(pivot[1]))
        start = motion.path[0] if motion.path else pivot
        if math.dist(start, pivot) > self.cell:
            self.notices.append(f"{shape.label()!r} jumps from where it is drawn to its path")
        fractions = fractions_of(motion.path) if motion.path else []
        for rings in self.finished(polygons, pivot):
            self.scene.moving.append(Body(rings, motion, start, fractions))
        return slivers

    def check_speed(self, shape, motion):
        """Refuses what the library refuses."""
        fastest = max(map(abs, motion.velocity))
        if motion.path:
            fastest = length_of(motion.path) / motion.period
        if fastest > MAX_SPEED_CELLS * self.cell or abs(motion.spin) > MAX_SPIN:
            raise DrawingError(f"{shape.label()!r} is too fast: at most {MAX_SPEED_CELLS:g} cells "
                               f"(of {self.cell:.4g} m) and {MAX_SPIN:g} rad a second")

    def add_wall_edges(self):
        """What keeps strokes and plates tight that are thinner than the grid shows."""
        rings = self.scene.solids + [body.rings for body in self.scene.moving]
        edges = thin_wall_edges([polygon_of(r) for r in rings], self.cell)
        if edges > MAX_WALL_EDGES:
            edges = 0
            self.notices.append("thin walls are too long to be kept tight: draw them 1.5 cells "
                                "wide, or use fewer cells")
        self.scene.wall_edges = edges

    def add_liquid(self, areas):
        """Liquid, or the default block; and the number of lattice points in it."""
        scene = self.scene
        x1, y1 = self.tank.bounds[2:]
        if not self.has_liquid:
            # A block one cell clear of the walls: it falls freely.
            areas = [box(self.cell, y1 - self.cell - DEFAULT_LIQUID_SHARE * self.page_height_m,
                         x1 - self.cell, y1 - self.cell)]
        whole = united(areas)
        polygons, slivers = clean_polygons(whole, self.cell, 0.5 * self.tolerance, self.tank)
        scene.liquid = self.finished(polygons)
        free = united(polygons).difference(self.solid_area)
        scene.liquid_cells2 = free.area / self.cell ** 2
        scene.max_particles = self.lattice_points(united(polygons))
        if scene.max_particles == 0:
            self.notices.append("there is no liquid outside the solids")
        return slivers

    def lattice_points(self, liquid):
        """Upper bound on seeds: the liquid grows by a hair so that rounding cannot add any, and the
        solids shrink by a cell, within which the contour may differ from the outline."""
        if liquid.is_empty:
            return 0
        side = math.isqrt(self.scene.particles_per_cell)
        step = self.cell / side
        xs = (numpy.arange(self.scene.cells_x * side) + 0.5) * step
        ys = (numpy.arange(self.scene.cells_y * side) + 0.5) * step
        x, y = (a.ravel() for a in numpy.meshgrid(xs, ys))
        hair = 0.01 * self.cell
        inside = vectorized.contains(liquid.buffer(hair), x, y)
        shrunk = self.solid_area.buffer(-self.cell)
        if not shrunk.is_empty and inside.any():
            inside[inside] = ~vectorized.contains(shrunk, x[inside], y[inside])
        return int(inside.sum())


def build_scene(drawing, name, options):
    """The scene at the resolution that options or the drawing ask for."""
    return Builder(drawing, name, options).build()


def build_scene_for_particles(drawing, name, options, particles):
    """The finest scene that needs at most the given number of particles."""
    scene = build_scene(drawing, name, options)
    if scene.max_particles == 0:
        raise DrawingError("--particles: there is no liquid to count")
    # The count goes with the square of the resolution, but for what the boundary cuts: estimate,
    # then come down from a little above until it fits.
    estimate = max(scene.cells_x, scene.cells_y) * math.sqrt(particles / scene.max_particles)
    for cells in range(min(MAX_CELLS, int(1.03 * estimate) + 2), 3, -1):
        scene = build_scene(drawing, name, replace(options, cells=cells))
        if scene.max_particles <= particles:
            return scene
    raise DrawingError(f"--particles {particles} is too few for any grid")
