#!/usr/bin/python3
"""The check itself: each kind of offence, planted in a small tree, is found."""

import os
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import check_layers  # noqa: E402

GOOD = {"lib/math/a.hpp": '#include "base/b.hpp"\n#include <cstdint>\n', "lib/base/b.hpp": ""}


class OffenceTest(unittest.TestCase):
    def found(self, files):
        with tempfile.TemporaryDirectory() as root:
            for path, text in {**GOOD, **files}.items():
                full = os.path.join(root, path)
                os.makedirs(os.path.dirname(full), exist_ok=True)
                with open(full, "w", encoding="utf-8") as file:
                    file.write(text)
            return list(check_layers.offences(root))

    def expect(self, files, *words):
        found = "\n".join(self.found(files))
        for word in words:
            self.assertIn(word, found)

    def test_a_good_tree_has_none(self):
        self.assertEqual(self.found({}), [])

    def test_upward(self):
        self.expect({"lib/base/b.hpp": '#include "math/a.hpp"\n'}, "base may not include math",
                    "cycle")

    def test_cycle_between_neighbours(self):
        self.expect({"lib/fluid/f.hpp": '#include "solid/s.hpp"\n',
                     "lib/solid/s.hpp": '#include "fluid/f.hpp"\n'}, "lib/fluid: part of a cycle")

    def test_libc_and_containers(self):
        for header in ("cmath", "vector", "string", "iostream", "cstdlib", "functional"):
            self.expect({"lib/math/a.hpp": f"#include <{header}>\n"}, f"<{header}>")

    def test_library_includes_port(self):
        self.expect({"lib/world/w.cpp": '#include "port/port.hpp"\n'}, "no folder port")

    def test_public_header_includes_private(self):
        self.expect({"lib/include/weir/w.hpp": '#include "math/a.hpp"\n'}, "users do not have")

    def test_port_includes_private(self):
        self.expect({"port/template/p.cpp": '#include "math/a.hpp"\n'}, "public headers only")

    def test_extensions(self):
        for text in ("x = __builtin_ctz(y);", '__asm__("" : "+r"(x));', "int* __restrict p;",
                     "using L = float __attribute__((vector_size(16)));",
                     "#if WEIR_GNU_COMPILER\n#else\n__int128 x;\n#endif",
                     "#if !WEIR_GNU_COMPILER\n__int128 x;\n#endif",
                     "#if WEIR_HAS_LANES\n#endif\n__int128 x;"):
            self.expect({"lib/math/m.hpp": text + "\n"}, "MSVC does not know it")
            self.expect({"port/host/p.cpp": text + "\n"}, "MSVC does not know it")
        for condition in ("WEIR_HAS_LANES", "defined(__ARM_ARCH_6M__)", "WEIR_GNU_COMPILER"):
            self.assertEqual(self.found({
                "lib/math/m.hpp": f"#if {condition}\nx = __builtin_ctz(y);\n#endif\n",
                "port/cortex_m/p.cpp": "asm volatile();\n"}), [])

    def test_lengths(self):
        body = "void f() {\n" + "    g();\n" * 79 + "}\n"
        self.expect({"lib/math/m.cpp": "namespace weir {\n" + body + "}\n"}, "81 lines")
        self.expect({"lib/math/m.cpp": "\n" * 401}, "401 lines")
        self.expect({"lib/math/m.cpp": "x" * 101}, "101 columns")

    def test_lengths_at_the_limit(self):
        body = "void f() {\n" + "    g();\n" * 78 + "}\n"
        self.assertEqual(self.found({"lib/math/m.cpp": body + "x" * 100}), [])


if __name__ == "__main__":
    unittest.main()
