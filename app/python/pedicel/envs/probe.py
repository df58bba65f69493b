"""pedicel/Probe-v0: push a stem, and say how stiff it is."""

from typing import Any, Dict, List

import numpy as np

from .env import PedicelEnv
from .task import Task


class ProbeTask(Task):
    """Push the stem with the tool, feel the force, and say Young's modulus.

    The last two actions are the estimate and the word: the estimate -1 is 5e6 Pa and +1 is 5e8 Pa,
    evenly in the logarithm; a word above 0 says it, and the episode terminates. The reward is then
    5 - 5 |ln(estimate / truth)|; before it every action costs 0.01.

    State: joints and their speeds, the tool's pose, time left, the force of the stem on the tool
    (N, 3), tool to stem (m), and how far the stem has moved at its middle and its tip (m).
    """

    scene = "environments/probe.scene.yaml"
    camera = "side"
    seconds = 10.0
    extra_actions = 2
    vary = "environments/probe.vary.yaml"
    low, high = 5.0e6, 5.0e8  #: Pa

    def prepare(self) -> None:
        run = self.run
        self.hand = [i for i, name in enumerate(run.touching_names)
                     if "finger" in name or "gripper" in name]
        self.stem = np.flatnonzero([name == "stem/stem" for name in run.segment_names])
        self.said = None

    def begin(self, random: np.random.Generator, options: Dict[str, Any]) -> None:
        self.start = self.run.positions[self.stem].copy()
        key = next(k for k in self.run.parameters if k.endswith("material.youngs_modulus"))
        self.truth = self.run.parameters[key].value
        self.said = None

    def force(self) -> np.ndarray:
        """Of the stem on the gripper, N, world."""
        return self.run.link_forces[self.hand].sum(axis=0)

    def nearest(self) -> np.ndarray:
        away = self.run.positions[self.stem] - self.run.tool_pose[:3]
        return away[np.argmin(np.linalg.norm(away, axis=1))]

    def state(self) -> List[Any]:
        moved = self.run.positions[self.stem] - self.start
        return self.robot_state() + [np.clip(self.force(), -50, 50), self.nearest(),
                                     moved[len(moved) // 2], moved[-1]]

    def estimate(self, action: np.ndarray) -> float:
        share = 0.5 * (float(np.clip(action[-2], -1, 1)) + 1.0)
        return self.low * (self.high / self.low) ** share

    def judge(self, action: np.ndarray) -> bool:
        self.terms = {"time": -0.01, "estimate": 0.0}
        if not action[-1] > 0:
            return False
        self.said = self.estimate(action)
        self.terms["estimate"] = 5.0 - 5.0 * abs(np.log(self.said / self.truth))
        return True

    def info(self) -> Dict[str, Any]:
        said = self.said if self.said is not None else float("nan")
        return {"is_success": bool(abs(np.log(said / self.truth)) < 0.1), "estimate": said,
                "youngs_modulus": self.truth}


class ProbeEnv(PedicelEnv):
    """pedicel/Probe-v0."""

    task_type = ProbeTask


ProbeEnv.__doc__ = f"pedicel/Probe-v0.\n\n{ProbeTask.__doc__}"
