#!/usr/bin/python3
"""Tests of examples/scene: moving bodies, the command line, and the header as C++ sees it.

Run: /usr/bin/python3 -m unittest discover -s tests/scene
"""

import gzip
import math
import os
import struct
import subprocess
import sys
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

from scene_case import EXAMPLES, NAMESPACES, PAGE, SceneTest  # noqa: E402

from shapely.geometry import box  # noqa: E402

import scene_builder  # noqa: E402
import scene_header  # noqa: E402
from scene_geometry import polygon_of  # noqa: E402
from svg_reader import DrawingError, read_drawing  # noqa: E402

STRICT = ["-std=c++17", "-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Wdouble-promotion",
          "-Wshadow", "-Werror"]


class MovingTest(SceneTest):
    """Groups named moving."""

    BAR = '<rect x="40" y="40" width="20" height="10" {}/>'

    def only_body(self, body, **rest):
        scene = self.scene(body, **rest)
        self.assertEqual(scene.solids, [])
        self.assertEqual(len(scene.moving), 1)
        return scene.moving[0]

    def test_group_by_id_label_and_class(self):
        for name in ('id="moving"', 'inkscape:label="Moving"', 'class="fast moving"'):
            body = self.only_body(f"<g {name}><g>{self.BAR.format('')}</g></g>")
            self.assert_same_area(polygon_of(body.rings), box(-0.1, -0.05, 0.1, 0.05))
            self.assertAlmostEqual(body.position[0], 0.5, places=6)
            self.assertAlmostEqual(body.position[1], 0.55, places=6)

    def test_attributes_inherit_innermost_first(self):
        body = self.only_body('<g id="moving" data-spin="1"><g data-velocity="0.5 -2">'
                              + self.BAR.format('data-spin="-3.5"') + "</g></g>")
        self.assertEqual((body.motion.velocity, body.motion.spin), ((0.5, -2.0), -3.5))

    def test_pivot_in_page_units(self):
        body = self.only_body('<g id="moving" transform="translate(5,0)">'
                              + self.BAR.format('data-pivot="45 50"') + "</g>")
        self.assertAlmostEqual(body.position[1], 0.5, places=6)
        self.assert_same_area(polygon_of(body.rings), box(0.0, 0.0, 0.2, 0.1))

    def test_path_inline_and_by_id(self):
        inline = self.BAR.format('data-path="50,45 50,25 90,25" data-period="3"')
        by_id = ('<path id="track" stroke="red" fill="none" d="M50,45 V25 H90"/>'
                 + self.BAR.format('data-path="#track" data-period="3"'))
        for drawn in (inline, by_id):
            body = self.only_body(f'<g id="moving">{drawn}</g>')
            self.assertEqual(len(body.motion.path), 3)
            for point, expected in zip(body.motion.path, ((0.5, 0.55), (0.5, 0.75), (0.9, 0.75))):
                self.assertLess(math.dist(point, expected), 1e-9)
            loop = 0.2 + 0.4 + math.hypot(0.4, 0.2)
            self.assertAlmostEqual(body.fractions[2], 0.6 / loop)

    def test_shapes_of_a_group_are_one_body(self):
        wheel = ('<g data-spin="1" data-pivot="50 50"><rect x="48" y="30" width="4" height="40"/>'
                 '<rect x="30" y="48" width="40" height="4"/></g>')
        body = self.only_body(f'<g id="moving">{wheel}</g>')
        self.assertEqual(len(body.rings[0]), 12)
        two = self.scene(f'<g id="moving" data-spin="1">{self.BAR.format("")}'
                         '<rect x="80" y="80" width="5" height="5"/></g>')
        self.assertEqual(len({b.position for b in two.moving}), 2)

    def test_elements_with_own_motion_are_bodies_of_their_own(self):
        scene = self.scene('<g id="moving"><g>' + self.BAR.format('data-spin="1"')
                           + '<rect x="80" y="80" width="5" height="5" data-spin="2"/></g></g>')
        self.assertEqual(sorted(b.motion.spin for b in scene.moving), [1.0, 2.0])
        self.assertEqual(len({b.position for b in scene.moving}), 2)

    def test_moving_bodies_are_not_clipped(self):
        body = self.only_body('<g id="moving"><rect x="-20" y="50" width="40" height="10"/></g>')
        self.assertAlmostEqual(polygon_of(body.rings).area, 0.04, places=6)

    def test_bad_motion_is_refused(self):
        for bad in ('data-velocity="1"', 'data-spin="fast"', 'data-path="1,1 2,2"',
                    'data-path="#gone" data-period="1"', 'data-pivot="1 2 3"',
                    'data-path="1,1 2,2" data-period="0"', 'data-path="1,1" data-period="1"',
                    'data-velocity="1 1" data-path="1,1 2,2" data-period="1"',
                    'data-spin="-10001"', 'data-velocity="0 20001"',  # what the library refuses
                    'data-path="1,1 99,99" data-period="1e-4"'):
            with self.assertRaises(DrawingError, msg=bad):
                self.scene(f'<g id="moving">{self.BAR.format(bad)}</g>')


class ToolTest(SceneTest):
    """The command line and the header."""

    def test_bad_input_exits_2(self):
        empty = self.write("", liquid="")
        cases = {empty: "empty", self.path("missing.svg"): "cannot read"}
        for name, text in (("a.svg", "not xml"), ("b.svg", "<html/>"), ("c.svg", "<svg"),
                           ("d.svg", f"<svg {NAMESPACES}><rect width='1' height='1'/></svg>")):
            with open(self.path(name), "w", encoding="utf-8") as file:
                file.write(text)
            cases[self.path(name)] = "page size" if name == "d.svg" else "not an SVG"
        for path, message in cases.items():
            result = self.run_tool(path, self.path("out.hpp"))
            self.assertEqual(result.returncode, 2, path)
            self.assertIn(message, result.stderr)
            self.assertNotIn("Traceback", result.stderr)
            self.assertFalse(os.path.exists(self.path("out.hpp")))

    def test_bad_root_attributes_exit_2(self):
        for bad in ('data-gravity="down"', 'data-gravity="0 -1001"', 'data-dt="0"', 'data-dt="1.5"',
                    'data-steps="0"', 'data-particles-per-cell="5"', 'data-particles-per-cell="25"',
                    'data-page-width-m="-1"', 'data-page-width-m="9e5"'):
            result = self.run_tool(self.write("", page=PAGE + " " + bad), "-")
            self.assertEqual(result.returncode, 2, bad)
            self.assertIn(bad.split("=")[0], result.stderr)

    def test_tank_that_the_library_would_refuse_exits_2(self):
        result = self.run_tool(self.write("", page='width="1000" height="20"'), "-")
        self.assertEqual(result.returncode, 2)
        self.assertIn("96 x 2 cells", result.stderr)

    def test_groups_too_deep_for_the_reader_exit_2(self):
        deep = "<g>" * 2000 + '<rect width="9" height="9"/>' + "</g>" * 2000
        result = self.run_tool(self.write(deep), "-")
        self.assertEqual(result.returncode, 2)
        self.assertIn("too deep", result.stderr)
        self.assertNotIn("Traceback", result.stderr)

    def test_what_was_left_out_is_said_of_an_empty_drawing_too(self):
        result = self.run_tool(self.write("<text y='50'>WEIR</text>", liquid=""), "-")
        self.assertEqual(result.returncode, 2)
        self.assertIn("convert text to paths", result.stderr)

    def test_compressed_drawing_and_summary(self):
        with open(self.write('<circle cx="50" cy="50" r="20"/>'), "rb") as file:
            data = gzip.compress(file.read())
        with open(self.path("zipped.svgz"), "wb") as file:
            file.write(data)
        result = self.run_tool(self.path("zipped.svgz"), "-")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("zipped: 50 x 50 cells", result.stderr)
        self.assertIn("at most 100 particles", result.stderr)

    def test_particle_budget_is_kept_and_used(self):
        drawing = os.path.join(EXAMPLES, "scenes", "dam_break.svg")
        result = self.run_tool(drawing, "-", "--particles", "1500")
        count = int(result.stderr.rsplit("at most ", 1)[1].split()[0])
        self.assertTrue(1350 <= count <= 1500, result.stderr)

    def test_float_literals_round_trip(self):
        for value in (0.1, 1 / 3, -9.81, 1e-30, 16777217.0, 5.0, 0.0, -0.0, 1e10, 123456.789):
            text = scene_header.literal(value)
            self.assertTrue(text.endswith("f") and ("." in text or "e" in text), text)
            rounded = struct.unpack("f", struct.pack("f", value))[0]
            self.assertEqual(struct.unpack("f", struct.pack("f", float(text[:-1])))[0], rounded)

    def test_header_compiles_and_states_the_scene(self):
        body = ('<rect x="50" y="50" width="20" height="20"/><g id="moving">'
                '<rect x="40" y="10" width="10" height="10" data-spin="0.1"/>'
                '<rect x="80" y="80" width="4" height="4" data-path="82,82 82,62" '
                'data-period="2"/></g>')
        result = self.run_tool(self.write(body), self.path("out.hpp"), "--name", "a\"b")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.compile_and_run('''
            static_assert(kScene.cells_x == 50 && kScene.cells_y == 50);
            static_assert(kScene.solid_count == 1 && kScene.moving_count == 2);
            static_assert(scene::body_count(kScene) == 3);
            static_assert(kScene.total_vertices == 12 && kScene.max_vertices == 4);
            static_assert(kScene.max_particles == 100 && kScene.liquid_count == 1);
            static_assert(kScene.cell_m == 0.02f && kScene.dt_s == 1.0f / 60.0f);
            static_assert(kScene.moving[0].spin_radps == 0.1f);
            static_assert(kScene.moving[1].path_count == 2);
            int main() { return 0; }''')

    def test_holes_reach_the_header(self):
        frame = ('<path fill-rule="evenodd" d="M20,20 h40 v40 h-40 z M30,30 h10 v10 h-10 z '
                 'M45,30 h10 v10 h-10 z"/>')
        result = self.run_tool(self.write(frame), self.path("out.hpp"))
        self.assertEqual(result.returncode, 0, result.stderr)
        self.compile_and_run('''
            #include "scene_outline.hpp"
            constexpr const scene::Shape& frame = kScene.solids[0];
            static_assert(kScene.solid_count == 1 && kScene.max_holes == 2);
            static_assert(kScene.total_vertices == 12 + 3 * 2 && kScene.max_vertices == 12);
            static_assert(frame.rings == 3 && frame.count == 12);
            static_assert(scene::ring_begin(frame, 0) == 0 && scene::ring_end(frame, 0) == 4);
            static_assert(scene::ring_begin(frame, 2) == 8 && scene::ring_end(frame, 2) == 12);
            int main() { return scene::one_line(frame).size() == 12 + 2 * 2 ? 0 : 1; }''')

    def test_header_without_solids_compiles(self):
        result = self.run_tool(self.write(""), self.path("out.hpp"))
        self.assertEqual(result.returncode, 0, result.stderr)
        self.compile_and_run("static_assert(kScene.solids == nullptr && kScene.moving_count == 0);"
                             " int main() { return 0; }")

    def test_motion_follows_the_path_and_turns(self):
        self.run_tool(self.write('<g id="moving"><rect x="40" y="40" width="20" height="10" '
                                 'data-path="50,45 50,25 90,25" data-period="3" '
                                 'data-spin="-2"/></g>'), self.path("out.hpp"))
        self.compile_and_run('''
            #include <cmath>
            bool near(float a, double b) { return std::fabs(static_cast<double>(a) - b) < 2e-5; }
            int main() {
                const scene::Moving& body = kScene.moving[0];
                const double loop = 0.6 + std::sqrt(0.2);
                const double time = 3.0 * 0.1 / loop;  // half-way up the first leg
                scene::Motion m = scene::motion_at(body, 1, static_cast<float>(time));
                if (!near(m.position_m.x_m, 0.5) || !near(m.position_m.y_m, 0.65)) return 1;
                if (!near(m.velocity_mps.y_m, loop / 3) || !near(m.velocity_mps.x_m, 0)) return 2;
                if (!near(m.angle_rad, -2 * time) || !near(m.spin_radps, -2)) return 3;
                m = scene::motion_at(body, 2, 1.5f);  // once around
                if (!near(m.position_m.x_m, 0.5) || !near(m.position_m.y_m, 0.55)) return 4;
                m = scene::motion_at(body, 1, static_cast<float>(3 - 1.5 * std::sqrt(0.2) / loop));
                if (!near(m.position_m.x_m, 0.7) || !near(m.position_m.y_m, 0.65)) return 5;
                if (m.velocity_mps.x_m >= 0 || m.velocity_mps.y_m >= 0) return 6;
                // Steps stay even however long it runs.
                const float dt = 1.0f / 60.0f;
                const unsigned steps[] = {0u, 1000u, 100000000u};
                for (unsigned k : steps) {
                    const float a = scene::motion_at(body, k, dt).angle_rad;
                    float d = scene::motion_at(body, k + 1, dt).angle_rad - a;
                    if (d > 3.0f) d -= 6.2831853f;
                    if (!near(d, -2.0 / 60.0)) return 7;
                }
                scene::Moving line{};
                line.velocity_mps = {2.0f, -1.0f};
                m = scene::motion_at(line, 30, 0.1f);
                return near(m.position_m.x_m, 6) && near(m.position_m.y_m, -3) ? 0 : 8;
            }''')

    def compile_and_run(self, code):
        source = self.path("use.cpp")
        with open(source, "w", encoding="utf-8") as file:
            file.write('#include "out.hpp"\n#include "scene_motion.hpp"\n' + code)
        program = self.path("use")
        command = ["g++", *STRICT, "-I", os.path.join(EXAMPLES, "scene"), source, "-o", program]
        result = subprocess.run(command, capture_output=True, text=True, check=False)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(subprocess.run([program], check=False).returncode, 0)

    def test_default_scenes(self):
        # The first two fit small microcontrollers: their particle counts are a promise.
        for name, most in (("dam_break", 2000), ("pendant", 800), ("waterfall", 12000)):
            drawing = read_drawing(os.path.join(EXAMPLES, "scenes", name + ".svg"))
            scene = scene_builder.build_scene(drawing, name, scene_builder.Options())
            self.assertEqual(scene.cells_x, int(drawing.attributes["data-cells"]))
            self.assertTrue(0.25 * most < scene.max_particles <= most, name)
            self.assertEqual([n for n in scene.notices if "stroke" not in n], [], name)


if __name__ == "__main__":
    unittest.main()
