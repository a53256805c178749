#!/usr/bin/python3
"""Tests of examples/picture: drawing, PNG and GIF files, errors."""

import os
import shutil
import struct
import subprocess
import tempfile
import unittest

HERE = os.path.dirname(os.path.abspath(__file__))
PICTURE = os.path.join(HERE, "..", "..", "examples", "picture")
STRICT = ["-std=c++17", "-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Wdouble-promotion",
          "-Wshadow", "-Werror"]


class PictureTest(unittest.TestCase):
    """Builds the library with its own CMakeLists.txt and runs picture_checks.cpp."""

    def setUp(self):
        self.folder = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, self.folder)

    def run_quietly(self, *command):
        result = subprocess.run(command, capture_output=True, text=True, check=False)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)

    def test_pictures(self):
        self.run_quietly("cmake", "-G", "Ninja", "-S", PICTURE, "-B", self.folder,
                         "-DCMAKE_CXX_FLAGS=-Werror")
        self.run_quietly("cmake", "--build", self.folder, "-j2")
        program = os.path.join(self.folder, "checks")
        self.run_quietly("g++", *STRICT, "-I", os.path.join(PICTURE, "include"),
                         os.path.join(HERE, "picture_checks.cpp"),
                         os.path.join(self.folder, "libweir_picture.a"), "-lpng", "-lgif",
                         "-o", program)
        self.run_quietly(program, self.folder)
        with open(os.path.join(self.folder, "still.png"), "rb") as file:
            data = file.read()
        self.assertEqual(data[:8], b"\x89PNG\r\n\x1a\n")
        self.assertEqual(struct.unpack(">II", data[16:24]), (40, 30))


if __name__ == "__main__":
    unittest.main()
