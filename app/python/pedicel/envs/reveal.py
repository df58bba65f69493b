"""pedicel/Reveal-v0: push stems and leaves aside until a hidden fruit is seen."""

from typing import Any, Dict, List

import numpy as np

from .env import PedicelEnv
from .task import Task


class RevealTask(Task):
    """Push what hides the fruit aside, and load no stalk beyond its limit.

    State: joints and their speeds, the tool's pose, time left, tool to fruit (m). Then the share of the
    fruit that the camera sees, the largest stalk margin, the force at the gripper (N), and twelve
    places along the plant that hides it (m, from the tool). The episode terminates when the camera
    has seen `wanted` of the fruit for half a second, or when a stalk's margin passes `limit`.
    """

    scene = "environments/reveal.scene.yaml"
    camera = "watch"
    seconds = 8.0
    vary = "environments/reveal.vary.yaml"
    wanted, limit, held = 0.6, 0.8, 5  #: 1, 1, actions

    def prepare(self) -> None:
        run = self.run
        self.hand = [i for i, name in enumerate(run.touching_names)
                     if "finger" in name or "gripper" in name or "hand" in name]
        self.fruit_name = run.fruit_names[0]
        # What hides it: every organ but those that carry it.
        self.hiding = np.flatnonzero([name not in ("bush/truss", "bush/stem") for name in run.segment_names])
        self.places = self.hiding[np.linspace(0, len(self.hiding) - 1, 12).round().astype(int)]
        self.seen = 0.0

    def begin(self, random: np.random.Generator, options: Dict[str, Any]) -> None:
        self.seen = self.first = self.run.visible_share(self.fruit_name, self.camera)
        self.lasted, self.peak, self.away = 0, 0.0, self.distance()
        self.revealed = self.overloaded = False

    def distance(self) -> float:
        """From the tool to what hides the fruit, m."""
        away = self.run.positions[self.hiding] - self.run.tool_pose[:3]
        return float(np.linalg.norm(away, axis=1).min())

    def hand_force(self) -> float:
        return float(np.linalg.norm(self.run.link_forces[self.hand].sum(axis=0)))

    def margin(self) -> float:
        return float(self.run.stalk_margins.max())

    def state(self) -> List[Any]:
        tool = self.run.tool_pose[:3]
        return self.robot_state() + [self.run.fruit_positions[0] - tool, [self.seen], [self.margin()],
                                     [min(self.hand_force(), 50.0)],
                                     self.run.positions[self.places] - tool]

    def judge(self, action: np.ndarray) -> bool:
        before, self.seen = self.seen, self.run.visible_share(self.fruit_name, self.camera)
        self.lasted = self.lasted + 1 if self.seen >= self.wanted else 0
        self.revealed = self.lasted >= self.held
        margin = self.margin()
        strained, self.peak = max(0.0, margin - self.peak), max(self.peak, margin)
        self.overloaded = margin > self.limit
        before_away, self.away = self.away, self.distance()
        self.terms = {
            "time": -0.02,
            "approach": 2.0 * (before_away - self.away),
            "more_seen": 2.0 * (self.seen - before),
            "revealed": 10.0 if self.revealed else 0.0,
            "strained": -1.0 * strained,
            "overloaded": -5.0 if self.overloaded else 0.0,
            "effort": -0.01 * float(np.mean(np.square(np.clip(action, -1, 1)))),
        }
        return self.revealed or self.overloaded

    def info(self) -> Dict[str, Any]:
        return {"is_success": self.revealed, "seen": self.seen, "overloaded": self.overloaded,
                "peak_margin": self.peak}


class RevealEnv(PedicelEnv):
    """pedicel/Reveal-v0."""

    task_type = RevealTask


RevealEnv.__doc__ = f"pedicel/Reveal-v0.\n\n{RevealTask.__doc__}"
