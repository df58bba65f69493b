"""The experiments that come with the program are whole, and a diagnosis names what is hidden in them."""

import unittest

import pedicel


class ShippedTest(unittest.TestCase):
    def named(self, name, cause):
        """The one cause of a shipped experiment's verdict."""
        folder = pedicel.asset(f"experiments/{name}")
        good = pedicel.validate(folder)
        self.assertTrue(good, good.text)
        verdict = pedicel.diagnose(folder)
        self.assertEqual((verdict.verdict, verdict.names), ("named", [cause]), verdict.data)
        return verdict.causes[0].parameters

    def test_a_held_plant_relaxes(self):
        found = self.named("held_plant", "relaxation")
        self.assertAlmostEqual(found["fraction"].value, 0.25, delta=0.01)
        self.assertAlmostEqual(found["time"].value, 0.6, delta=0.05)

    def test_a_stem_slides_on_the_robot(self):
        found = self.named("robot_at_plant", "contact_friction")
        self.assertAlmostEqual(found["coefficient"].value, 0.25, delta=0.01)


if __name__ == "__main__":
    unittest.main()
