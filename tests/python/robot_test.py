"""The robot does what Python tells it: targets, torques, the tool's pose."""

import unittest

import numpy as np

import pedicel
from given import PULL_UP, Case


class RobotTest(Case):
    def setUp(self):
        super().setUp()
        self.sim = pedicel.Simulation(PULL_UP)
        self.gripper = self.sim.gripper_joint
        self.arm = [i for i in range(len(self.sim.joint_names)) if i != self.gripper]

    def test_positions_are_reached_and_kept(self):
        sim = self.sim
        target = sim.joint_positions.copy()
        target[self.arm[0]] += 0.1
        target[self.arm[1]] -= 0.05
        sim.set_joint_positions(target)
        sim.step(240)
        self.assertLess(np.abs(sim.joint_positions - target).max(), 2e-3)

    def test_velocities_are_held(self):
        sim = self.sim
        start = sim.joint_positions[self.arm[0]]
        name = sim.joint_names[self.arm[0]]
        sim.set_joint_velocities({name: 0.2})
        sim.step(120)
        self.assertAlmostEqual(sim.joint_velocities[self.arm[0]], 0.2, delta=0.01)
        self.assertAlmostEqual(sim.joint_positions[self.arm[0]] - start, 0.1, delta=0.01)
        # Joints that were told nothing stay.
        other = self.arm[2]
        self.assertLess(abs(sim.joint_velocities[other]), 0.02)

    def test_a_torque_is_what_the_motor_applies(self):
        sim = self.sim
        last = self.arm[-1]
        sim.set_joint_torques({sim.joint_names[last]: 0.05})
        sim.step(10)
        self.assertAlmostEqual(sim.joint_torques[last], 0.05, delta=1e-6)

    def test_the_scenes_program_runs_until_a_target_comes(self):
        led, free = pedicel.Simulation(PULL_UP), pedicel.Simulation(PULL_UP)
        free.step(120)
        led.set_joint_velocities(np.zeros(len(led.joint_names)))
        led.step(120)
        self.assertGreater(np.linalg.norm(free.tool_pose[:3] - led.tool_pose[:3]), 0.02)
        self.assertLess(np.abs(led.joint_velocities[self.arm]).max(), 1e-3)

    def test_the_tool_goes_where_inverse_kinematics_says(self):
        sim = self.sim
        position = sim.tool_pose[:3] + [0.0, 0.03, 0.02]
        orientation = sim.tool_pose[3:].copy()
        found = sim.reach(position, orientation)
        self.assertTrue(found.reached, found.sentence)
        sim.go_to(found.joints)
        sim.step(600)
        self.assertLess(np.linalg.norm(sim.tool_pose[:3] - position), 2e-3)
        self.assertGreater(abs(np.dot(sim.tool_pose[3:], orientation)), 0.9999)

    def test_what_is_out_of_reach_is_said(self):
        with self.assertRaisesRegex(pedicel.UsageError, "finite"):
            self.sim.reach([float("nan"), 0.0, 0.0])
        found = self.sim.reach([5.0, 0.0, 0.0])
        self.assertFalse(found.reached)
        self.assertIn("unreachable", found.sentence)

    def test_the_jacobian_is_the_tools_velocity(self):
        sim = self.sim
        sim.set_joint_velocities(np.where(np.arange(len(sim.joint_names)) == self.gripper, 0.0, 0.2))
        sim.step(60)
        before, jacobian, speed = sim.tool_pose[:3].copy(), sim.tool_jacobian(), sim.joint_velocities.copy()
        sim.step(1)
        moved = (sim.tool_pose[:3] - before) / sim.dt
        self.assertTrue(np.allclose(jacobian[:3] @ speed, moved, atol=0.02), (jacobian[:3] @ speed, moved))

    def test_limits_are_those_of_the_file(self):
        sim = self.sim
        self.assertTrue(np.all(sim.joint_lower < sim.joint_upper))
        self.assertTrue(np.all(sim.joint_speeds > 0))
        self.assertTrue(np.all(sim.joint_efforts > 0))
        target = {sim.joint_names[self.arm[1]]: float(sim.joint_upper[self.arm[1]]) + 5.0}
        sim.set_joint_positions(target)
        sim.step(5)
        self.assertLessEqual(sim.joint_positions[self.arm[1]], sim.joint_upper[self.arm[1]] + 1e-6)

    def test_unknown_joints_are_refused(self):
        with self.assertRaisesRegex(pedicel.UsageError, self.sim.joint_names[0]):
            self.sim.set_joint_positions({"elbow_of_nobody": 0.0})
        with self.assertRaisesRegex(pedicel.UsageError, "joints"):
            self.sim.set_joint_positions([0.0])


if __name__ == "__main__":
    unittest.main()
