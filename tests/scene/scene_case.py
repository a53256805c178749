"""What the tests of the converter share: a page to draw on and ways to convert it."""

import os
import shutil
import subprocess
import sys
import tempfile
import unittest

HERE = os.path.dirname(os.path.abspath(__file__))
EXAMPLES = os.path.join(HERE, "..", "..", "examples")
TOOL = os.path.join(EXAMPLES, "scene", "svg_to_scene.py")
sys.dont_write_bytecode = True
sys.path.insert(0, os.path.join(EXAMPLES, "scene"))

from shapely.ops import unary_union  # noqa: E402

import scene_builder  # noqa: E402
from scene_geometry import polygon_of  # noqa: E402
from svg_reader import read_drawing  # noqa: E402

NAMESPACES = ('xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" '
              'xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape"')
# A page of 100 x 100 units that is 1 m x 1 m on 50 x 50 cells, with liquid so that it stays so.
PAGE = 'width="1000mm" height="1000mm" viewBox="0 0 100 100" data-cells="50"'
LIQUID = '<g id="liquid"><rect x="0" y="0" width="10" height="10"/></g>'
CELL = 0.02


class SceneTest(unittest.TestCase):
    """Helpers."""

    def setUp(self):
        self.folder = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, self.folder)

    def path(self, name):
        return os.path.join(self.folder, name)

    def write(self, body, page=PAGE, liquid=LIQUID):
        with open(self.path("drawing.svg"), "w", encoding="utf-8") as file:
            file.write(f"<svg {NAMESPACES} {page}>{body}{liquid}</svg>")
        return self.path("drawing.svg")

    def scene(self, body, page=PAGE, liquid=LIQUID, **options):
        drawing = read_drawing(self.write(body, page, liquid))
        return scene_builder.build_scene(drawing, "test", scene_builder.Options(**options))

    def solid(self, body, **rest):
        """The union of all static solids."""
        return unary_union([polygon_of(r) for r in self.scene(body, **rest).solids])

    def assert_same_area(self, shape, expected, slack=1e-6):
        """The two differ by no more area than the slack (m^2)."""
        self.assertLess(shape.symmetric_difference(expected).area, slack)

    def run_tool(self, *arguments):
        return subprocess.run([sys.executable, TOOL, *arguments], capture_output=True, text=True,
                              check=False)
