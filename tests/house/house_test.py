#!/usr/bin/python3
"""The checks of tools/house see what they are for: each is shown a made-up tree with one fault."""

import sys
import tempfile
import unittest
from pathlib import Path

sys.dont_write_bytecode = True
ROOT = Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "tools"))

from house_checks import circles, classes, effect_names, folders, names, source  # noqa: E402
from prose_checks.rooms import rooms_of  # noqa: E402


def class_of(count):
    """A class with so many functions, and with all that only looks like one."""
    functions = [
        "  Shop();",
        "  explicit Shop(int a) : a_(a), b_{a}, c_(b_) {}",
        "  bool operator==(const Shop&) const = default;",
        "  int one() const { if (a_) { return 1; } return 2; }",
        "  template <typename T>\n  void task(const std::function<void(T)>& t);",
    ]
    functions += [f"  void f{n}(int value = g({n}));" for n in range(count - len(functions))]
    return "\n".join([
        "/* class Old { void f(); }; */",
        "class Shop final : public Base<int> {", " public:", *functions[:3],
        "  // void not_one();",
        "  struct Inner {\n    void of_inner();\n    void of_inner_too() {}\n  };",
        "  using Call = void (*)(int);", "  friend void swap(Shop&, Shop&);",
        " private:", *functions[3:],
        "  std::function<void(int)> later_;", "  int a_ = f(3), b_{4};", '  const char* text_ = "void f();";',
        "};",
    ])


class Classes(unittest.TestCase):
    def test_functions_are_counted(self):
        counted = list(classes.functions_of(source.code_of(class_of(9))))
        self.assertEqual([(name, count) for _, name, count in counted], [("Shop", 9), ("Inner", 2)])

    def test_31_are_too_many(self):
        self.assertEqual(classes.check(class_of(30)), [])
        self.assertEqual(classes.check(class_of(31)), [(2, "Shop has 31 functions, expected at most 30")])


class Folders(unittest.TestCase):
    def test_26_files_are_too_many(self):
        paths = [Path(f"app/shop/part_{n}.cpp") for n in range(25)]
        headers = [Path(f"app/shop/part_{n}.h") for n in range(25)]
        self.assertEqual(folders.check(paths + headers), [])
        found = folders.check(paths + [Path("app/shop/more.cpp")])
        self.assertEqual(found, [("app/shop", 1, "26 .cpp files, expected at most 25")])

    def test_registries_may_have_more_and_exist(self):
        for registry in folders.REGISTRIES:
            self.assertTrue((ROOT / registry).is_dir(), registry)
            self.assertEqual(folders.check([Path(registry, f"{n}.cpp") for n in range(40)]), [])


class Circles(unittest.TestCase):
    def test_a_circle_of_libraries(self):
        with tempfile.TemporaryDirectory() as folder:
            for room, links in {"app/a": "pedicel_b", "app/b": "pedicel_c", "app/c": "", "app/d": "pedicel_a"}.items():
                (Path(folder) / room).mkdir(parents=True)
                text = f"pedicel_library(pedicel_{room[-1]}\n  SOURCES\n    x.cpp\n  PUBLIC {links})\n"
                (Path(folder) / room / "CMakeLists.txt").write_text(text, encoding="utf-8")
            self.assertEqual(circles.check(rooms_of(Path(folder))), [])
            text = "pedicel_library(pedicel_c\n  SOURCES\n    x.cpp\n  PUBLIC pedicel_a)\n"
            (Path(folder) / "app/c/CMakeLists.txt").write_text(text, encoding="utf-8")
            self.assertEqual(
                circles.check(rooms_of(Path(folder))),
                [("app/a/CMakeLists.txt", 1, "rooms in a circle: app/a -> app/b -> app/c -> app/a")],
            )


class Names(unittest.TestCase):
    def test_two_types_of_one_name(self):
        course = "namespace pedicel::shop {\nstruct Course {\n  int n = f({1});\n};\n}\n"
        for other in ("class Course : Base {};", "enum class Course { all };"):
            found = names.check({"app/a.h": course, "app/b.h": "namespace pedicel::shop { " + other + " }"})
            self.assertEqual(
                found, [("app/a.h", 1, "pedicel::shop::Course stands in app/b.h, too; expected one type a name")]
            )

    def test_what_others_do_not_see_may_share_a_name(self):
        course = "namespace pedicel::shop { struct Course {}; }"
        for other in (
            "namespace pedicel::shop { namespace { struct Course {}; } }",
            "namespace pedicel::shop { struct Course; }",
            "namespace pedicel::other { struct Course {}; }",
            "namespace pedicel::shop { struct Way { struct Course {}; }; }",
            "namespace pedicel::shop { void f() { struct Course {}; } }",
            "// namespace pedicel::shop { struct Course {}; }",
        ):
            self.assertEqual(names.check({"app/a.h": course, "app/b.cpp": other}), [], other)


class EffectNames(unittest.TestCase):
    @staticmethod
    def faults(path, text, own='d.name = "tool_pose";'):
        files = {"plugins/discrepancy/scene/effects/tool_pose.cpp": own,
                 "plugins/discrepancy/scene/effects/payload.cpp": 'd.name = "payload";', path: text}
        return effect_names.check({Path(name): said for name, said in files.items()})

    def test_a_name_elsewhere_is_a_fault(self):
        for text in ('\nif (name == "tool_pose") f();', '\nread("{name: tool_pose, offset: [0, 0, 0]}");'):
            self.assertEqual(
                self.faults("app/shop.cpp", text),
                [("app/shop.cpp", 2, "names the effect tool_pose; expected a field of its definition")],
            )
        self.assertEqual(len(self.faults("app/shop.cpp", 'f("payload");')), 1)

    def test_what_is_no_name_is_none(self):
        for text in ("// as tool_pose does", '#include "effects/tool_pose.h"', "state.tool_pose = 1;",
                     'say("a payload of 2 kg");', 'f("tool_poses");'):
            self.assertEqual(self.faults("app/shop.cpp", text), [], text)

    def test_names_that_are_something_else_stand_where_they_are_said_to(self):
        for path, name in effect_names.OTHERS:
            self.assertIn(f'"{name}"', (ROOT / path).read_text(encoding="utf-8"))
            self.assertEqual(self.faults(path, f'f("{name}");'), [])

    def test_somebody_tells_a_symptom(self):
        own = 'd.name = "tool_pose";\nd.speaks_for = {{"touch", 1}, {"slip", 2}};'
        found = self.faults("plugins/discrepancy/scene_procedure/tell.cpp", 'tell("touch");', own)
        self.assertEqual(
            found,
            [("plugins/discrepancy/scene/effects/tool_pose.cpp", 2, "the symptom slip is told nowhere")],
        )


if __name__ == "__main__":
    unittest.main()
