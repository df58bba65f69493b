"""What can be called has a docstring, and stands in the stubs as the module has it."""

import ast
import inspect
import os
import unittest

import pedicel
from pedicel import _core

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

    def test_the_package_names_what_it_has(self):
        for name in pedicel.__all__:
            self.assertTrue(hasattr(pedicel, name), name)


if __name__ == "__main__":
    unittest.main()
