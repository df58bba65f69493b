#!/usr/bin/python3
"""Each file includes what its room links and no more; a made-up tree shows that faults are seen."""

import sys
import tempfile
import unittest
from pathlib import Path

sys.dont_write_bytecode = True
ROOT = Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "tools"))

from house_checks import circles, links, source  # noqa: E402
from prose_checks.rooms import all_rooms, rooms_of  # noqa: E402

TREE = {
    "engine/core/CMakeLists.txt": "pedicel_headers(pedicel_core)\n",
    "engine/core/check.h": "",
    "engine/io/CMakeLists.txt": "pedicel_headers(pedicel_io PUBLIC pedicel_core)\n",
    "engine/io/csv.h": '#include "engine/core/check.h"\n',
    "engine/world/CMakeLists.txt":
        "pedicel_library(pedicel_world ALONE COLD\n  SOURCES\n    pedicel_io.cpp  # pedicel_io)\n"
        "  PUBLIC pedicel_core Eigen3::Eigen)\ntarget_link_libraries(pedicel_world INTERFACE pedicel_io)\n",
    "engine/world/world.h": '#include "engine/core/check.h"\n#include <vector>\n',
    "engine/world/deep/state.h": '#include "engine/world/world.h"\n',
    "plugins/plant/CMakeLists.txt":
        "pedicel_library(pedicel_plant SOURCES a.cpp PRIVATE pedicel_world PkgConfig::HWY)\n",
    "plugins/plant/plant.h": "",
    "plugins/plant/plant.cpp":
        '#include "hwy/highway.h"\n#include "engine/world/deep/state.h"\n#include "engine/core/check.h"\n'
        '#include "engine/io/csv.h"\n',
    "app/run/CMakeLists.txt": "pedicel_library(pedicel_run SOURCES a.cpp PUBLIC pedicel_plant)\n"
                              "if(LATER)\n  target_link_libraries(pedicel_run PRIVATE pedicel_core)\nendif()\n",
    "app/run/run.h": '#include "plugins/plant/plant.h"\n',
    "app/run/run.cpp": '#include "app/run/run.h"\n#include "engine/core/check.h"\n',
    "app/python/CMakeLists.txt": "pybind11_add_module(pedicel_python MODULE a.cpp)\n"
                                 "target_link_libraries(pedicel_python PRIVATE pedicel_run)\n",
    "app/python/module.cpp": '#include "app/run/run.h"\n',
    "app/CMakeLists.txt": "if(A)\n  add_executable(pedicel main.cpp)\n  target_link_libraries(pedicel PRIVATE pedicel_run)\nendif()\n",
    "app/main.cpp": '#include "app/run/run.h"\n#include "plugins/plant/plant.h"\n',
}


class Tree(unittest.TestCase):
    """The tree above in a folder, some of its files written anew."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name)
        self.write(TREE)

    def write(self, files):
        for path, text in files.items():
            (self.root / path).parent.mkdir(parents=True, exist_ok=True)
            (self.root / path).write_text(text, encoding="utf-8")

    def faults(self):
        texts = {path: (self.root / path).read_text(encoding="utf-8") for path in source.files(self.root)}
        return links.check(texts, all_rooms(self.root))


class Links(Tree):
    def sees(self, path, text, said, line=1):
        self.write({path: text})
        self.assertEqual(self.faults(), [(path, line, said)])

    def test_what_is_linked_may_be_included(self):
        self.assertEqual(self.faults(), [])

    def test_a_room_that_is_not_linked(self):
        self.sees("engine/io/csv.h", '\n// #include "engine/world/a.h"\n#  include "engine/world/world.h"\n',
                  "includes engine/world/world.h, which is a header of the room engine/world that engine/io does not "
                  "link; expected a header of a room that it links", 3)

    def test_a_room_that_one_in_between_links_for_itself(self):
        self.sees("app/run/run.cpp", "#include <engine/world/deep/state.h>\n",
                  "includes engine/world/deep/state.h, which is a header of the room engine/world that app/run does not "
                  "link; expected a header of a room that it links")

    def test_a_room_that_is_passed_on_and_not_linked(self):
        self.sees("engine/world/deep/state.h", '#include "engine/io/csv.h"\n',
                  "includes engine/io/csv.h, which is a header of the room engine/io that engine/world does not "
                  "link; expected a header of a room that it links")

    def test_a_file_that_is_no_header_or_is_not_there(self):
        self.sees("app/main.cpp", '#include "app/run/gone.h"\n', "includes app/run/gone.h, which is not there")
        self.sees("app/main.cpp", '#include "app/run/run.cpp"\n', "includes app/run/run.cpp; expected a header")

    def test_an_include_by_another_way(self):
        for name in ("run.h", "../run/run.h", "tests/support/places.h"):
            self.sees("app/run/run.cpp", f'#include "{name}"\n',
                      f'includes "{name}"; expected its place in the tree from app, engine or plugins on')

    def test_nothing_goes_up(self):
        self.write({"plugins/plant/plant.h": ""})
        self.sees("plugins/plant/plant.h", '#include "app/run/run.h"\n',
                  "includes app/run/run.h; expected nothing above plugins")
        self.write({"plugins/plant/plant.h": ""})
        self.sees("engine/core/check.h", '#include "plugins/plant/plant.h"\n',
                  "includes plugins/plant/plant.h; expected nothing above engine")

    def test_no_link_goes_up(self):
        for visibility in ("PUBLIC", "PRIVATE", "INTERFACE"):
            self.sees("engine/core/CMakeLists.txt",
                      f"pedicel_headers(pedicel_core)\ntarget_link_libraries(pedicel_core {visibility} pedicel_plant)\n",
                      "links plugins/plant; expected nothing above engine")

    def test_a_file_without_a_room(self):
        self.sees("plugins/lonely/a.cpp", "", "stands in no room; expected a CMakeLists.txt above it that makes one")


class Rooms(Tree):
    def test_libraries_and_what_they_link(self):
        self.assertEqual(rooms_of(self.root), {
            "engine/core": set(), "engine/io": {"engine/core"}, "engine/world": {"engine/core", "engine/io"},
            "plugins/plant": {"engine/world"}, "app/run": {"plugins/plant", "engine/core"}})

    def test_what_is_passed_on(self):
        rooms = all_rooms(self.root)
        self.assertEqual(rooms["engine/world"].links, {"engine/core"})
        self.assertEqual(rooms["engine/world"].passes_on, {"engine/core", "engine/io"})
        self.assertEqual(rooms["app/run"].passes_on, {"plugins/plant"})
        self.assertEqual(rooms["app"].links, {"app/run"})

    def test_a_circle(self):
        self.assertEqual(circles.check(all_rooms(self.root)), [])
        self.write({"engine/core/CMakeLists.txt": "pedicel_headers(pedicel_core PUBLIC pedicel_world)\n"})
        self.assertEqual(
            circles.check(all_rooms(self.root)),
            [("engine/core/CMakeLists.txt", 1, "rooms in a circle: engine/core -> engine/world -> engine/core")],
        )


class TheTree(unittest.TestCase):
    def test_its_rooms(self):
        rooms = all_rooms(ROOT)
        self.assertGreater(len(rooms), 60)
        texts = {path: (ROOT / path).read_text(encoding="utf-8") for path in source.files(ROOT)}
        self.assertEqual(links.check(texts, rooms), [])


if __name__ == "__main__":
    unittest.main()
