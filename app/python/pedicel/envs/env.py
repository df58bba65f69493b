"""One environment: a task in a simulation of its own."""

import warnings
from typing import Any, Dict, Optional, Type

import numpy as np

from .. import NoPictures, Simulation, Unstable, asset
from .interface import Env
from .task import Task


class PedicelEnv(Env):
    """gymnasium.Env of a task. Options of make(): action (tool, joint), observation (state, picture,
    mixed), picture_size (width, height), vary (None, a map, a file or a Variation), gentleness (what
    each N, N s, 1, J or organ of `info["gentleness"]` costs, by its name), render_mode, scene."""

    metadata = {"render_modes": ["rgb_array", "human"], "render_fps": 10}
    task_type: Type[Task] = Task

    def __init__(self, render_mode: Optional[str] = None, scene: Optional[str] = None, **options: Any):
        if render_mode not in (None, *self.metadata["render_modes"]):
            raise ValueError(f"render_mode is {render_mode!r}, expected one of: "
                             f"{', '.join(self.metadata['render_modes'])}")
        self.render_mode = render_mode
        self.simulation = Simulation(scene or asset(self.task_type.scene))
        self.task = self.task_type(self.simulation, **options)
        self.task.begin_here(np.random.default_rng(0), {})
        self.observation_space, self.action_space = self.task.spaces()
        self.metadata = dict(self.metadata, render_fps=round(1.0 / self.task.period))
        self._window, self._told = None, False

    def reset(self, *, seed: Optional[int] = None, options: Optional[Dict[str, Any]] = None):
        super().reset(seed=seed)
        self.task.reset(self.np_random, options)
        if self.render_mode == "human":
            self.render()
        return self.task.observe(), self.task.all_info()

    def step(self, action: Any):
        action = np.asarray(action)
        if action.shape != self.action_space.shape:
            raise ValueError(f"action has shape {action.shape}, expected {self.action_space.shape}")
        self.task.act(action)
        left, failed = self.task.steps_of_action, None
        try:
            while left:
                steps = min(left, self.task.due())
                self.simulation.step(steps)
                self.task.passed(steps)
                left -= steps
        except Unstable as fault:
            failed = str(fault)
        reward, terminated, truncated = self.task.outcome(action)
        info = self.task.all_info()
        if failed:
            # Nothing that the task asks for: the episode is cut off.
            info["error"], truncated = failed, True
        if self.render_mode == "human":
            self.render()
        return self.task.observe(), reward, terminated, truncated, info

    def render(self):
        if self.render_mode is None:
            return None
        picture = self.task.picture(640, 480)
        if self.render_mode == "rgb_array":
            return picture
        if self._window is None and not self._told:
            from .window import Window

            try:
                self._window = Window(type(self).__name__)
            except NoPictures as why:
                # An episode goes on without its window: what is learned does not depend on it.
                warnings.warn(f"{why}; nothing is shown", stacklevel=2)
                self._told = True
        if self._window is not None:
            self._window.show(picture)
        return None

    def close(self) -> None:
        if self._window is not None:
            self._window.close()
            self._window = None
