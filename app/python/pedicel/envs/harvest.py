"""pedicel/Harvest-v0: take one fruit off, harm nothing else, lay it into the tray."""

from typing import Any, Dict, List

import numpy as np

from .. import UsageError
from .env import PedicelEnv
from .task import Task


class HarvestTask(Task):
    """Grasp the wanted fruit, take it off its stalk, lay it into the tray.

    State: joints and their speeds, the tool's pose, time left, tool to fruit (m), tool to tray (m).
    Then the fruit's velocity, whether it is on, its stalk's margin, the largest margin of the others,
    what presses the fruit (N), the gripper's opening (m). The episode terminates when the fruit lies in the
    tray, when another fruit came off, or when the wanted one fell elsewhere.
    """

    scene = "environments/harvest.scene.yaml"
    camera = "front"
    seconds = 12.0
    vary = "environments/harvest.vary.yaml"

    def prepare(self) -> None:
        run = self.run
        self.tray = run.body_names.index("tray")
        self.fingers = [i for i, name in enumerate(run.touching_names) if "finger" in name]
        self.target = 0
        self.laid = self.harmed = self.fell = False

    def begin(self, random: np.random.Generator, options: Dict[str, Any]) -> None:
        names = self.run.fruit_names
        wanted = options.get("fruit", "truss/fruit_5")
        if wanted not in names:
            raise UsageError(f"fruit is {wanted!r}, expected one of: {', '.join(names)}")
        self.target = names.index(wanted)
        self.others = np.arange(len(names)) != self.target
        self.laid = self.harmed = self.fell = False
        self.peak = self.used_before = 0.0
        self.was_on = True
        self.potential = self.promise()

    def fruit(self) -> np.ndarray:
        return self.run.fruit_positions[self.target]

    def tray_place(self) -> np.ndarray:
        """Above the middle of the tray's floor, m."""
        return self.run.body_poses[self.tray, :3] + [0.0, 0.0, 0.05]

    def state(self) -> List[Any]:
        run, tool = self.run, self.run.tool_pose[:3]
        others = run.stalk_margins[self.others & run.fruit_attached]
        return self.robot_state() + [
            self.fruit() - tool, self.tray_place() - tool, run.fruit_velocities[self.target],
            [float(run.fruit_attached[self.target])], [run.stalk_margins[self.target]],
            [others.max() if len(others) else 0.0], [min(run.fruit_forces[self.target], 50.0)],
            [self.control.opening]]

    def promise(self) -> float:
        """A potential: nearer to the fruit, then, with the fruit, nearer to the tray. m."""
        to_fruit = np.linalg.norm(self.fruit() - self.run.tool_pose[:3])
        to_tray = np.linalg.norm(self.fruit() - self.tray_place())
        return -2.0 * float(min(to_fruit, 1.0)) - (0.0 if self.run.fruit_attached[self.target]
                                                   else float(min(to_tray, 1.0)))

    def is_in_tray(self) -> bool:
        away = self.fruit() - self.run.body_poses[self.tray, :3]
        return bool(abs(away[0]) < 0.12 and abs(away[1]) < 0.10 and 0.0 < away[2] < 0.06)

    def judge(self, action: np.ndarray) -> bool:
        run = self.run
        on = bool(run.fruit_attached[self.target])
        came_off = self.was_on and not on
        self.was_on = on
        promise = self.promise()
        shaped = 0.0 if came_off else promise - self.potential
        self.potential = promise
        slow = np.linalg.norm(run.fruit_velocities[self.target]) < 0.05
        self.laid = not on and self.is_in_tray() and bool(slow)
        self.harmed = bool((~run.fruit_attached[self.others]).any())
        self.fell = not on and not self.laid and bool(
            self.fruit()[2] < 0.03 and not self.is_in_tray())
        used = run.stalk_margins[self.others & run.fruit_attached]
        peak = max(self.peak, float(used.max()) if len(used) else 0.0)
        strained, self.peak = peak - self.peak, peak
        self.terms = {
            "approach": shaped,
            "detached": 2.0 if came_off else 0.0,
            "laid_down": 10.0 if self.laid else 0.0,
            "others_strained": -2.0 * strained,
            "others_broken": -5.0 if self.harmed else 0.0,
            "fell": -3.0 if self.fell else 0.0,
            "time": -0.01,
            "effort": -0.01 * float(np.mean(np.square(np.clip(action, -1, 1)))),
        }
        return self.laid or self.harmed or self.fell

    def info(self) -> Dict[str, Any]:
        return {"is_success": self.laid, "fruit": self.run.fruit_names[self.target],
                "detached": not bool(self.run.fruit_attached[self.target]), "harmed": self.harmed,
                "fell": self.fell, "others_peak_margin": self.peak}


class HarvestEnv(PedicelEnv):
    """pedicel/Harvest-v0."""

    task_type = HarvestTask


HarvestEnv.__doc__ = f"pedicel/Harvest-v0.\n\n{HarvestTask.__doc__}"
