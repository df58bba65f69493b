"""What can be called has a docstring, and stands in the stubs as the module has it."""

import ast
import importlib.util
import inspect
import os
import re
import unittest

import pedicel
from pedicel import _core

ROOT = os.path.realpath(os.path.join(os.path.dirname(__file__), "../.."))
MANUAL = os.path.join(ROOT, "assets/manual")

#: What speaks for itself.
PLAIN = {"__init__"}


class StubsTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        path = os.path.join(os.path.dirname(pedicel.__file__), "_core.pyi")
        with open(path, encoding="utf-8") as file:
            cls.tree = ast.parse(file.read())
        cls.classes = {node.name: node for node in cls.tree.body if isinstance(node, ast.ClassDef)}

    def members(self, cls):
        return {n: m for n, m in vars(cls).items() if not n.startswith("_")}

    def test_the_stubs_have_every_member(self):
        for name, cls in inspect.getmembers(_core, inspect.isclass):
            there = {node.name for node in self.classes[name].body if isinstance(node, ast.FunctionDef)}
            self.assertEqual(set(self.members(cls)) - there, set(), name)

    def test_everything_has_a_docstring(self):
        for name, cls in inspect.getmembers(_core, inspect.isclass):
            self.assertTrue(inspect.getdoc(cls), name)
            for member, value in self.members(cls).items():
                doc = (inspect.getdoc(value) or "").split("\n", 1)
                says = doc[-1] if doc[0].startswith(member + "(") else doc[0]
                says = says if len(doc) > 1 or not doc[0].startswith(member + "(") else ""
                self.assertTrue(says.strip() or member in PLAIN, f"{name}.{member}")

    def test_arrays_say_shape_and_unit(self):
        for name in ("positions", "strains", "stalk_loads", "link_poses", "joint_torques", "energies"):
            doc = getattr(_core.Run, name).__doc__
            self.assertRegex(doc, r"^\([a-z0-9, ]+\), \S", name)
            self.assertIn("worlds", getattr(_core.Worlds, name).__doc__)

    def test_every_array_of_the_state_says_shape_and_unit(self):
        found = 0
        for name, member in vars(_core.Worlds).items():
            if isinstance(member, property) and hasattr(_core.Run, name):
                found += 1
                self.assertRegex(getattr(_core.Run, name).__doc__, r"^\([a-z0-9, ]+\), [^:]+: \S.*\.$", name)
        self.assertGreater(found, 20)

    @unittest.skipUnless(os.path.exists(MANUAL), "the manual's sources are not beside the test")
    def test_the_manuals_page_is_made_from_the_docstrings(self):
        spec = importlib.util.spec_from_file_location("make_page", os.path.join(ROOT, "app/python/make_page.py"))
        make_page = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(make_page)
        with open(os.path.join(MANUAL, "python_reference.md"), encoding="utf-8") as file:
            self.assertEqual(file.read(), make_page.page(), "app/python/make_page.py writes it anew")

    @unittest.skipUnless(os.path.exists(MANUAL), "the manual's sources are not beside the test")
    def test_the_manuals_table_of_arrays_is_that_of_the_module(self):
        with open(os.path.join(MANUAL, "python.md"), encoding="utf-8") as file:
            rows = dict(re.findall(r"^\| `(\w+)` \| ([\w, ]+ \| [\w/ ]+) \|$", file.read(), re.M))
        for name in rows:
            shape, unit = re.match(r"^\(([a-z0-9, ]+?),?\), ([^:]+):", getattr(_core.Run, name).__doc__).groups()
            self.assertEqual(rows[name], f"{shape} | {unit}", name)
        there = {n for n, m in vars(_core.Worlds).items() if isinstance(m, property) and hasattr(_core.Run, n)}
        self.assertEqual(set(rows), there)

    def test_the_package_names_what_it_has(self):
        for name in pedicel.__all__:
            self.assertTrue(hasattr(pedicel, name), name)


if __name__ == "__main__":
    unittest.main()
