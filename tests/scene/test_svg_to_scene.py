#!/usr/bin/python3
"""Tests of examples/scene/svg_to_scene.py: page, shapes and the polygons they become.

Run: /usr/bin/python3 -m unittest discover -s tests/scene
"""

import math
import os
import struct
import sys
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

from scene_case import CELL, PAGE, SceneTest  # noqa: E402

from shapely.geometry import LinearRing, Point, Polygon, box  # noqa: E402
from shapely.ops import unary_union  # noqa: E402

from scene_geometry import finished_rings, polygon_of, tidy_ring  # noqa: E402


class PageTest(SceneTest):
    """Page, units, grid."""

    def test_physical_units_are_metres_with_y_up(self):
        for unit, side in (("mm", 1000), ("cm", 100), ("in", 1000 / 25.4)):
            page = f'width="{side}{unit}" height="{side}{unit}" viewBox="0 0 100 100"'
            shape = self.solid('<rect x="20" y="10" width="30" height="5"/>', page=page)
            self.assert_same_area(shape, box(0.2, 0.85, 0.5, 0.9))

    def test_pixels_scale_the_longer_side_to_one_metre(self):
        shape = self.solid('<rect x="0" y="0" width="100" height="50"/>',
                           page='width="200" height="100px"', liquid='<g id="liquid"/>'
                           '<rect class="liquid" width="9" height="9" x="150"/>')
        self.assert_same_area(shape, box(0.0, 0.25, 0.5, 0.5))

        scene = self.scene("", page='width="100" height="200"',
                           liquid='<circle r="9" id="liquid"/>')
        self.assertAlmostEqual(scene.cell_m * scene.cells_y, 1.0, places=6)

    def test_page_width_attribute_overrides(self):
        scene = self.scene("", page=PAGE + ' data-page-width-m="2.5"')
        self.assertAlmostEqual(scene.cell_m, 2.5 / 50, places=7)

    def test_view_box_with_offset_and_scale(self):
        page = 'width="1000mm" height="500mm" viewBox="-50 100 2000 1000"'
        shape = self.solid('<rect x="150" y="300" width="400" height="200"/>', page=page,
                           liquid='<rect id="liquid" x="0" y="1000" width="50" height="50"/>')
        self.assert_same_area(shape, box(0.1, 0.3, 0.3, 0.4))

    def test_missing_height_follows_from_view_box(self):
        scene = self.scene("", page='width="1000mm" viewBox="0 0 200 100" data-cells="40"')
        self.assertEqual((scene.cells_x, scene.cells_y), (40, 20))

    def test_grid_attributes_and_override(self):
        page = PAGE + (' data-gravity="1 -2.5" data-dt="0.01" data-steps="77" '
                       'data-particles-per-cell="9"')
        scene = self.scene("", page=page)
        self.assertEqual((scene.cells_x, scene.gravity, scene.dt_s, scene.steps,
                          scene.particles_per_cell), (50, (1.0, -2.5), 0.01, 77, 9))
        self.assertEqual(scene.max_particles, 25 * 9)
        self.assertEqual(self.scene("", page=page, cells=20).cells_x, 20)

    def test_shorter_side_in_whole_cells_with_notice(self):
        page = 'width="1000mm" height="488mm" data-cells="50"'
        scene = self.scene("", page=page)
        self.assertEqual(scene.cells_y, 24)
        self.assertTrue(any("whole cells" in n for n in scene.notices))

    def test_solids_are_clipped_to_the_tank(self):
        shape = self.solid('<rect x="90" y="90" width="300" height="300"/>')
        self.assert_same_area(shape, box(0.9, 0.0, 1.0, 0.1))

    def test_drawing_without_liquid_gets_headroom(self):
        scene = self.scene('<rect x="20" y="50" width="60" height="50"/>', liquid="")
        self.assertEqual((scene.cells_x, scene.cells_y), (31, 50))
        self.assert_same_area(polygon_of(scene.solids[0]), box(0.2, 0.0, 0.8, 0.5))
        block = polygon_of(scene.liquid[0])
        self.assertGreater(block.bounds[1], 1.0)
        self.assertGreater(scene.max_particles, 500)
        self.assertTrue(any("liquid" in n for n in scene.notices))

    def test_margin_makes_room_on_both_sides(self):
        shape = self.solid('<rect x="0" y="50" width="100" height="50"/>', margin=0.25)
        self.assert_same_area(shape, box(0.25, 0.0, 1.25, 0.5))


class ShapeTest(SceneTest):
    """Which shapes count, and their geometry."""

    def test_nested_transforms(self):
        shape = self.solid('<g transform="translate(50,50)"><g transform="rotate(90) scale(2)">'
                           '<rect x="0" y="0" width="10" height="5"/></g></g>')
        self.assert_same_area(shape, box(0.4, 0.3, 0.5, 0.5))

    def test_circle_within_tolerance(self):
        for tolerance in (0.1, 0.01):
            shape = self.solid('<circle cx="50" cy="50" r="30"/>', tolerance_cells=tolerance)
            far = shape.hausdorff_distance(Point(0.5, 0.5).buffer(0.3, 400))
            self.assertLess(far, tolerance * CELL * 1.001)
            self.assertAlmostEqual(shape.area, math.pi * 0.09, delta=2 * math.pi * 0.3 * far)
            self.assertGreater(far, 0.02 * tolerance * CELL)  # and not finer than asked for

    def test_arc_path_and_bezier(self):
        disc = Point(0.5, 0.5).buffer(0.2, 400)
        arc = self.solid('<path d="M30,50 a20,20 0 1 1 40,0 a20,20 0 1 1 -40,0 z"/>')
        self.assertLess(arc.hausdorff_distance(disc), 0.1 * CELL)
        k = 20 * 0.5522847
        bezier = self.solid(f'<path d="M30,50 C30,{50 - k} {50 - k},30 50,30 S70,{50 - k} 70,50 '
                            f'S{50 + k},70 50,70 S30,{50 + k} 30,50"/>')
        self.assertLess(bezier.hausdorff_distance(disc), 0.12 * CELL)
        quadratic = self.solid('<path d="M10,90 Q50,10 90,90 Z"/>')
        self.assertAlmostEqual(quadratic.area, 2 / 3 * 0.8 * 0.4, delta=0.1 * CELL)

    def test_fill_rules(self):
        path = '<path fill-rule="{}" d="M10,10 h60 v60 h-60 z M30,30 h20 v20 h-20 z"/>'
        self.assertAlmostEqual(self.solid(path.format("nonzero")).area, 0.36, places=6)
        self.assertAlmostEqual(self.solid(path.format("evenodd")).area, 0.32, places=6)
        star = '<path style="fill-rule:{}" d="M50,10 L74,82 L12,38 L88,38 L26,82 Z"/>'
        whole, hollow = (self.solid(star.format(r)).area for r in ("nonzero", "evenodd"))
        self.assertGreater(whole, 1.3 * hollow)

    def test_hidden_shapes_are_ignored(self):
        rect = '<rect x="30" y="30" width="20" height="20" {}/>'
        for hidden in ('fill="none"', 'fill="transparent"', 'style="display:none"',
                       'visibility="hidden"', 'opacity="0"', 'fill-opacity="0"',
                       'style="fill:rgba(0,0,0,0)"', 'class="ghost"'):
            body = "<style>.ghost { display: none }</style>" + rect.format(hidden)
            self.assertEqual(self.scene(body).solids, [], hidden)
        for wrapper in ("defs", "symbol", "clipPath", "mask", "pattern", 'g display="none"',
                        'g opacity="0"', 'g visibility="hidden"'):
            body = f"<{wrapper}>{rect.format('')}</{wrapper.split()[0]}>"
            self.assertEqual(self.scene(body).solids, [], wrapper)
        self.assertEqual(len(self.scene(rect.format("")).solids), 1)

    def test_faint_shapes_on_request(self):
        rect = '<rect x="30" y="30" width="20" height="20" opacity="0.2"/>'
        self.assertEqual(len(self.scene(rect).solids), 1)
        self.assertEqual(len(self.scene(rect, min_opacity=0.3).solids), 0)

    def test_background_is_ignored_with_notice(self):
        scene = self.scene('<rect id="paper" width="100" height="99.5" fill="white"/>'
                           '<rect x="30" y="30" width="20" height="20"/>')
        self.assertEqual(len(scene.solids), 1)
        self.assertTrue(any("paper" in n for n in scene.notices))
        self.assertAlmostEqual(self.solid('<rect width="100" height="98"/>').area, 0.98, places=5)

    def test_stroke_of_unfilled_shape(self):
        shape = self.solid('<g transform="scale(2)"><line x1="10" y1="20" x2="40" y2="20" '
                           'stroke="red" stroke-width="3"/></g>')
        self.assert_same_area(shape, box(0.2, 0.57, 0.8, 0.63))
        ring = self.solid('<circle cx="50" cy="50" r="30" style="fill:none;stroke:#000;'
                          'stroke-width:6"/>')
        self.assertAlmostEqual(ring.area, math.pi * (0.33 ** 2 - 0.27 ** 2), delta=0.002)

    def test_dashes_are_taken_whole_with_notice(self):
        line = '<line x1="10" y1="50" x2="90" y2="50" stroke="red" stroke-width="4" {}/>'
        for pattern, said in (("10 5", True), ("10,5", True), ("none", False), ("0", False)):
            scene = self.scene(line.format(f'stroke-dasharray="{pattern}"'))
            self.assertEqual(len(scene.solids), 1)
            self.assertEqual(any("dashed" in n for n in scene.notices), said, pattern)

    def test_room_for_walls_thinner_than_a_cell(self):
        line = '<path d="M11 20 V81 H61 V20" fill="none" stroke="red" stroke-width="{}"/>'
        self.assertGreater(self.scene(line.format(1)).wall_edges, 3 * 2 * 86)  # both sides of it
        moving = f'<g id="moving" data-spin="1">{line.format(1)}</g>'
        self.assertGreater(self.scene(moving).wall_edges, 3 * 2 * 86)
        self.assertEqual(self.scene(line.format(4)).wall_edges, 0)
        self.assertEqual(self.scene('<path d="M20 90 L80 90 L50 40z"/>').wall_edges, 0)

    def test_stroke_widens_a_filled_solid_but_not_liquid(self):
        rect = '<rect x="40" y="40" width="20" height="20" stroke="#000" stroke-width="4"/>'
        self.assert_same_area(self.solid(rect), box(0.38, 0.38, 0.62, 0.62))
        scene = self.scene("", liquid=f'<g id="liquid">{rect}</g>')
        self.assert_same_area(polygon_of(scene.liquid[0]), box(0.4, 0.4, 0.6, 0.6))

    def test_use_before_and_after_definition_and_nested(self):
        body = ('<use xlink:href="#b" x="50"/><defs><rect id="a" width="10" height="10"/>'
                '<g id="b"><use href="#a" transform="translate(0,40)"/></g></defs>'
                '<use xlink:href="#a" x="20" y="20" transform="translate(1,0)"/>')
        expected = unary_union([box(0.5, 0.5, 0.6, 0.6), box(0.21, 0.7, 0.31, 0.8)])
        self.assert_same_area(self.solid(body), expected)

    def test_use_of_symbol_with_view_box(self):
        body = ('<symbol id="s" viewBox="0 0 10 10"><rect width="10" height="5"/></symbol>'
                '<use xlink:href="#s" x="20" y="40" width="20" height="20"/>')
        self.assert_same_area(self.solid(body), box(0.2, 0.5, 0.4, 0.6))

    def test_use_in_a_circle_ends(self):
        scene = self.scene('<g id="g"><rect width="30" height="30" y="50"/>'
                           '<use xlink:href="#g" x="1"/></g>')
        self.assertEqual(len(scene.solids), 1)
        self.assertTrue(any("circle" in n for n in scene.notices))

    def test_specks_are_dropped_with_notice(self):
        scene = self.scene('<rect x="50" y="50" width="0.2" height="0.2"/>')
        self.assertEqual(scene.solids, [])
        self.assertTrue(any("dropped" in n for n in scene.notices))


class PolygonTest(SceneTest):
    """What the simulation may rely on."""

    GRID_OF_HOLES = ('<path fill-rule="evenodd" d="M10,10 h80 v80 h-80 z '
                     + " ".join(f"M{x},{y} h8 v{h} h-8 z"
                                for x, y, h in ((15, 20, 8), (30, 15, 30), (50, 50, 8),
                                                (70, 20, 50), (20, 60, 25), (52, 20, 1))) + '"/>'
                     '<path d="M2,50 L98,50 L2,50.01 Z"/>')

    def test_holes_are_rings(self):
        scene = self.scene(self.GRID_OF_HOLES)
        self.assertEqual(len(scene.solids), 1)
        self.assertEqual(len(scene.solids[0]), 7)
        expected = 0.64 - 0.0008 * (8 + 30 + 8 + 50 + 25 + 1)
        self.assertAlmostEqual(polygon_of(scene.solids[0]).area, expected, delta=1e-5)

    def test_island_in_a_hole_is_a_polygon_of_its_own(self):
        scene = self.scene('<path fill-rule="evenodd" d="M10,10 h80 v80 h-80 z M20,20 h60 v60 h-60 '
                           'z M40,40 h20 v20 h-20 z"/>')
        self.assertEqual(sorted(len(rings) for rings in scene.solids), [1, 2])

    def test_liquid_with_a_hole(self):
        scene = self.scene("", liquid='<g id="liquid"><path fill-rule="evenodd" d="M10,10 h80 v80 '
                           'h-80 z M40,20 h20 v10 h-20 z"/></g>')
        self.assertEqual(len(scene.liquid), 1)
        self.assertAlmostEqual(polygon_of(scene.liquid[0]).area, 0.62, places=6)
        self.assertEqual(scene.max_particles, 6200)

    def test_output_is_simple_and_outer_rings_counter_clockwise(self):
        bodies = [self.GRID_OF_HOLES, '<path d="M10,10 L90,90 L90,10 L10,90 Z"/>',
                  '<circle cx="50" cy="50" r="30"/>',
                  '<path d="M10,10 h20 h20 h20 v0 v40 l0,0 h-60 z"/>']
        for body in bodies:
            solids = self.scene(body).solids
            self.assertTrue(all(polygon_of(rings).is_valid for rings in solids))
            for number, ring in ((n, r) for rings in solids for n, r in enumerate(rings)):
                self.assertGreaterEqual(len(ring), 3)
                self.assertEqual(LinearRing(ring).is_ccw, number == 0)
                for i, b in enumerate(ring):
                    a, c = ring[i - 1], ring[(i + 1) % len(ring)]
                    turn = (b[0] - a[0]) * (c[1] - b[1]) - (b[1] - a[1]) * (c[0] - b[0])
                    self.assertGreater(math.dist(a, b), 0.001 * CELL)
                    self.assertGreater(abs(turn), 1e-6 * CELL * CELL)
        self.assertEqual(len(self.scene(bodies[3]).solids[0][0]), 4)

    def test_hairline_spike_is_cut_off_and_gap_closed(self):
        scene = self.scene('<path d="M10,10 h60 v30 l12.3,7.7 l-12.3,-7.699 V40 h-60 z"/>'
                           '<rect x="10" y="40.005" width="60" height="29.995"/>')
        self.assertEqual(len(scene.solids), 1)
        self.assert_same_area(polygon_of(scene.solids[0]), box(0.1, 0.3, 0.7, 0.9), 2e-5)

    def test_tidy_ring(self):
        corners = [(0.0, 0.0), (2.0, 0.0), (2.0, 1.0), (0.0, 1.0)]
        untidy = [(0.0, 0.5)] + corners[:1] + [(1.0, 1e-6)] + corners[1:] + corners[3:]
        self.assertEqual(sorted(tidy_ring(untidy, 1e-3, 1e-4)), sorted(corners))
        (ring,), = finished_rings(Polygon(untidy[::-1]), 0.1, (1.0, 0.0))
        self.assertEqual(sorted(ring), sorted((x - 1.0, y) for x, y in corners))

    def test_overlapping_and_touching_shapes_are_one(self):
        scene = self.scene('<rect x="20" y="20" width="20" height="20"/>'
                           '<rect x="30" y="30" width="20" height="20"/>'
                           '<rect x="50" y="40" width="20" height="10"/>')
        self.assertEqual(len(scene.solids), 1)
        self.assertAlmostEqual(polygon_of(scene.solids[0]).area, 0.09, places=6)

    def test_both_halves_of_an_eight_are_solids(self):
        # Where they cross the halves hang together by what single precision does not know.
        area = self.solid('<path d="M50,50 L70,55 V50 L50,55 Z"/>', liquid='<g id="liquid">'
                          '<rect x="5" y="20" width="30" height="40"/></g>', page='width="100" '
                          'height="60" viewBox="0 0 100 60"').area
        self.assertAlmostEqual(area, 0.005, places=7)

    def test_coordinates_are_single_precision(self):
        for rings in self.scene('<circle cx="50" cy="50" r="31.4"/>').solids:
            for value in (v for ring in rings for p in ring for v in p):
                self.assertEqual(struct.unpack("f", struct.pack("f", value))[0], value)


if __name__ == "__main__":
    unittest.main()
