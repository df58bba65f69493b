#!/usr/bin/python3
"""The checks of tools/house see what they are for: each is shown a made-up tree with one fault."""

import sys
import unittest
from pathlib import Path

sys.dont_write_bytecode = True
ROOT = Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "tools"))

from house_checks import depth, effect_names, members, names, public  # noqa: E402


class Depth(unittest.TestCase):
    @staticmethod
    def chain(headers):
        """A file above so many headers, each of which includes the next one."""
        texts = {Path(f"app/h{n}.h"): f'#include "app/h{n + 1}.h"\n#include <app.h>\n' for n in range(headers)}
        texts[Path(f"app/h{headers - 1}.h")] = '// #include "app/h0.h"\n'
        return texts | {Path("app/a.cpp"): '#include "app/h0.h"\n'}

    def test_the_longest_chain(self):
        texts = self.chain(4)
        texts[Path("app/h1.h")] += '#include "app/h3.h"\n'
        longest = depth.chains_of(texts)
        self.assertEqual(list(map(str, longest[Path("app/a.cpp")])), ["app/h0.h", "app/h1.h", "app/h2.h", "app/h3.h"])
        self.assertEqual(longest[Path("app/h3.h")], [])

    def test_one_too_many(self):
        self.assertEqual(depth.check(self.chain(depth.MOST)), [])
        for more in (1, 5):
            (path, line, said), = depth.check(self.chain(depth.MOST + more))
            self.assertEqual((path, line), (f"app/h{more - 1}.h", 1))
            self.assertTrue(said.startswith(f"a chain of {depth.MOST + 1} headers, expected at most {depth.MOST}: "), said)
            self.assertTrue(said.endswith(f" -> app/h{depth.MOST + more - 1}.h"), said)

    def test_a_circle_ends(self):
        circle = {Path("app/a.h"): '#include "app/b.h"\n', Path("app/b.h"): '#include "app/a.h"\n'}
        self.assertEqual(depth.check(circle), [])


class Public(unittest.TestCase):
    TEXTS = {Path("app/a.h"): '#include "app/b.h"\n#include <vector>\n', Path("app/b.h"): "", Path("app/c.cpp"): ""}

    def faults(self, *lines):
        found = public.check("\n".join(["# What is installed.", *lines]) + "\n", self.TEXTS)
        self.assertEqual({path for path, _, _ in found} - {public.LIST}, set())
        return [(line, said) for _, line, said in found]

    def test_a_list_in_order(self):
        self.assertEqual(self.faults("app/a.h", "app/b.h"), [])
        self.assertEqual(self.faults("app/b.h"), [])

    def test_what_is_not_closed_sorted_or_there(self):
        self.assertEqual(self.faults("app/a.h"), [(2, "app/a.h includes app/b.h, which is not listed")])
        self.assertEqual(self.faults("app/b.h", "app/a.h"),
                         [(3, "app/a.h after app/b.h; expected each once, in order")])
        self.assertEqual(self.faults("app/b.h", "app/b.h"),
                         [(3, "app/b.h after app/b.h; expected each once, in order")])
        self.assertEqual(self.faults("app/b.h", "app/c.cpp", "app/d.h"),
                         [(3, "app/c.cpp is no header of the program"), (4, "app/d.h is no header of the program")])

    def test_151_are_too_many(self):
        headers = [f"app/h{n}.h" for n in range(100, 251)]
        texts = {Path(header): "" for header in headers}
        self.assertEqual(public.check("\n".join(headers[:-1]), texts), [])
        self.assertEqual(public.check("\n".join(headers), texts),
                         [(public.LIST, 151, "151 public headers, expected at most 150")])


class Members(unittest.TestCase):
    HEADER = "namespace pedicel::shop {\nclass Shop {\n  Shop();\n  struct Part {};\n};\nstruct Till {};\n}\n"
    DEFINED = "namespace pedicel::shop {\nShop::Shop() : a_{1}, b_(Till::all()) {}\n}\n"

    def faults(self, text):
        return members.check({Path("app/shop.h"): self.HEADER, Path("app/shop.cpp"): self.DEFINED,
                              Path("app/till.cpp"): text})

    def test_a_class_in_two_files(self):
        for text in ("void Shop::f(int a) {}", "std::map<int, Till> Shop::f() const {}", "Shop::~Shop() = default;",
                     "const Till& Shop::operator[](int n) {}", "bool Shop::operator<(const Shop&) {}",
                     "Shop::Part::Part() {}", "Shop::Part* Shop::f() {}", "int pedicel::shop::Shop::f() {}"):
            with self.subTest(text):
                self.assertEqual(
                    self.faults("namespace pedicel {\nnamespace shop {\n" + text + "\n}\n}\n"),
                    [("app/shop.cpp", 2, "functions of pedicel::shop::Shop stand in app/till.cpp, too; expected one file")],
                )

    def test_what_only_looks_like_a_function_of_the_class(self):
        for text in ("Till::Till() {}", "Eigen::Vector3d f(Shop& s) {}", "Shop::Part f() {}", "// int Shop::f() {}",
                     "const Shop shop = Shop::open();", "void f() {\n  Shop::open();\n}", "void ImGui::f() {}",
                     "namespace other {\nvoid Others::f() {}\n}"):
            self.assertEqual(self.faults("namespace pedicel::shop {\n" + text + "\n}\n"), [], text)

    def test_classes_of_one_name_in_two_namespaces(self):
        other = "namespace pedicel::farm { struct Shop {}; }\nnamespace pedicel::farm {\nvoid Shop::f() {}\n}\n"
        self.assertEqual(self.faults(other), [])
        hidden = "namespace pedicel::shop {\nnamespace {\nstruct Shop {};\nvoid Shop::f() {}\n}\n}\n"
        self.assertEqual(self.faults(hidden), [])


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
