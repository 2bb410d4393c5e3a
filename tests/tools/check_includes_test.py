"""tools/check_includes must fail on each thing it forbids, and name the place."""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

TOOL = Path(__file__).resolve().parents[2] / "tools" / "check_includes"


def check(files):
    """Runs the tool over a tree of these files; its exit code and what it printed."""
    with tempfile.TemporaryDirectory() as folder:
        for name, text in files.items():
            path = Path(folder) / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8")
        run = subprocess.run([sys.executable, TOOL, "--root", folder], capture_output=True,
                             text=True)
        return run.returncode, run.stdout + run.stderr


BASE = {"src/base/grid.hpp": "#pragma once\n"}


class CheckIncludes(unittest.TestCase):
    def passes(self, files):
        code, text = check(BASE | files)
        self.assertEqual(code, 0, text)
        return text

    def fails(self, files, *expected):
        code, text = check(BASE | files)
        self.assertEqual(code, 1, text)
        for part in expected:
            self.assertIn(part, text)

    def test_a_room_may_use_rooms_below_and_itself(self):
        self.passes({
            "src/noise/noise.hpp": '#pragma once\n#include <vector>\n#include "base/grid.hpp"\n',
            "src/noise/noise.cpp": '#include "noise/noise.hpp"\n',
            "tests/noise/noise_test.cpp": '#include "noise/noise.hpp"\n#include "helper.hpp"\n',
            "tests/noise/helper.hpp": "#pragma once\n",
            "src/noise/rows-inl.hpp": "#if defined(ROWS)\n#endif\n"})

    def test_a_room_may_not_use_a_room_above(self):
        above = {"src/sky/sun.hpp": "#pragma once\n"}
        self.fails(above | {"src/base/light.cpp": '// Light.\n#include "sky/sun.hpp"\n'},
                   "src/base/light.cpp:2: error:", "base is below sky")
        self.fails(above | {"src/base/light.cpp": '  #  include "sky/sun.hpp"\n'}, "light.cpp:1")
        for name in ("tests/base/light_test.cpp", "bench/base/light_bench.cpp"):
            self.fails(above | {name: '#include "sky/sun.hpp"\n'}, name, "base is below sky")

    def test_an_included_shader_exists(self):
        shader = {"src/shaders/noise/lattice.glsl": "uint hash(uint x);\n"}
        self.passes(shader | {"src/shaders/noise/noise.glsl": '#include "noise/lattice.glsl"\n'})
        self.fails(shader | {"src/shaders/noise/noise.glsl": '#include "noise/latice.glsl"\n'},
                   "noise.glsl:1", "does not exist in src/shaders")

    def test_the_c_interface_is_only_for_those_above_it(self):
        face = {"include/wold/wold.h": "int wold_version(void);\n"}
        self.passes(face | {"src/capi/api.cpp": '#include "wold/wold.h"\n'})
        self.fails(face | {"src/scene/scene.cpp": '#include "wold/wold.h"\n'}, "scene is below capi")

    def test_ours_stands_in_quotes_by_room_and_exists(self):
        self.fails({"src/noise/a.cpp": "#include <base/grid.hpp>\n"}, 'write "base/grid.hpp"')
        self.fails({"src/base/a.cpp": '#include "grid.hpp"\n'}, 'no "room/file.hpp"')
        self.fails({"src/base/a.cpp": '#include "../base/grid.hpp"\n'}, 'no "room/file.hpp"')
        self.fails({"src/base/a.cpp": '#include "fmt/format.h"\n'}, 'no "room/file.hpp"')
        self.fails({"src/base/a.cpp": '#include "base/gird.hpp"\n'}, "does not exist")

    def test_a_room_must_be_in_the_list(self):
        self.fails({"src/attic/a.cpp": "\n"}, "room 'attic' is not in the list")

    def test_headers_begin_with_pragma_once(self):
        self.fails({"src/base/a.hpp": "// A.\n#pragma once\n"}, "src/base/a.hpp:1: error:")
        self.fails({"src/base/a.hpp": ""}, "src/base/a.hpp:1: error:")

    def test_no_place_on_one_machine(self):
        place = "/ho" + "me/ann/x.png"  # in two parts, for this file is checked too
        self.fails({"src/base/a.cpp": f'auto f = "{place}";\n'}, "src/base/a.cpp:1: error:")
        self.fails({"docs/a.md": f"Look at {place}.\n"}, "docs/a.md:1: error:")
        self.fails({"README.md": f"({place})\n"}, "README.md:1: error:")
        self.fails({"tools/run": f"cd {place}\n"}, "tools/run:1: error:")
        self.fails({"tests/base/a_test.cpp": 'auto f = "/t' + 'mp/x.png";\n'}, "a_test.cpp:1: error:")
        self.passes({"docs/a.md": "https://example.org/ho" + "me/x and $OUT/work/x\n"})

    def test_a_long_file_is_a_warning(self):
        text = self.passes({"src/base/a.cpp": "\n" * 451})
        self.assertIn("src/base/a.cpp: warning: 451 lines", text)


if __name__ == "__main__":
    unittest.main()
