"""From actions between -1 and 1 to the motors of a robot."""

from typing import Any

import numpy as np

from .. import UsageError


class Control:
    """Actions of one run's robot.

    kind "joint": a speed a joint of the arm, then the gripper's. kind "tool": velocity (3) and
    angular velocity (3) of the tool in the world, then the gripper's speed. 1 is the most: `speed`
    rad/s a joint, `reach` m/s and `turn` rad/s of the tool, `grip` m/s of the gripper.
    """

    speed, reach, turn, grip = 0.6, 0.25, 1.0, 0.05

    def __init__(self, run: Any, kind: str):
        if kind not in ("joint", "tool"):
            raise UsageError(f"action is {kind!r}, expected joint or tool")
        self.run, self.kind = run, kind
        self.gripper = run.gripper_joint
        self.arm = np.array([i for i in range(len(run.joint_names)) if i != self.gripper])
        self.lower, self.upper = run.joint_lower, run.joint_upper
        self.size = (len(self.arm) if kind == "joint" else 6) + (self.gripper >= 0)
        self.begin()

    def begin(self) -> None:
        """After each reset: the gripper holds what it has."""
        self.opening = float(self.run.joint_positions[self.gripper]) if self.gripper >= 0 else 0.0

    def apply(self, action: np.ndarray, seconds: float) -> None:
        """Targets for the next `seconds`."""
        action = np.clip(np.nan_to_num(np.asarray(action, dtype=float)), -1.0, 1.0)
        speeds = np.full(len(self.run.joint_names), np.nan)
        arm = action[:len(self.arm)] * self.speed if self.kind == "joint" else self.joint_speeds(action)
        # A joint stops before its limit instead of running into it.
        now = self.run.joint_positions[self.arm]
        room_up = np.maximum(self.upper[self.arm] - now, 0.0) / seconds
        room_down = np.maximum(now - self.lower[self.arm], 0.0) / seconds
        speeds[self.arm] = np.clip(arm, -room_down, room_up)
        self.run.set_joint_velocities(speeds)
        if self.gripper >= 0:
            self.opening = float(np.clip(self.opening + action[-1] * self.grip * seconds,
                                         self.lower[self.gripper], self.upper[self.gripper]))
            targets = np.full(len(self.run.joint_names), np.nan)
            targets[self.gripper] = self.opening
            self.run.set_joint_positions(targets)

    def joint_speeds(self, action: np.ndarray) -> np.ndarray:
        """Damped least squares: near a singular pose the tool is slower, and no joint runs away."""
        damping, radian = 0.03, 0.2
        twist = np.concatenate([action[:3] * self.reach, action[3:6] * self.turn * radian])
        jacobian = self.run.tool_jacobian()[:, self.arm] * [[1], [1], [1], [radian], [radian], [radian]]
        square = jacobian @ jacobian.T + damping**2 * np.eye(6)
        speeds = jacobian.T @ np.linalg.solve(square, twist)
        most = np.abs(speeds).max() / 1.5
        return speeds / most if most > 1.0 else speeds
