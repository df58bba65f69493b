"""Many environments with one call: a task in each of several worlds."""

from typing import Any, Dict, List, Optional, Sequence, Tuple, Type, Union

import numpy as np

from .. import Worlds, asset
from .interface import VectorEnv, autoreset_mode, batched
from .task import Task


class PedicelVectorEnv(VectorEnv):
    """gymnasium.vector.VectorEnv of a task; the worlds step on all cores.

    autoreset_mode NextStep: a world that ended begins anew with the next step(), whose action it
    ignores. SameStep: at once, with the last observation and info in info["final_obs"] and
    info["final_info"]. Disabled: by reset(options={"reset_mask": ...}).
    """

    metadata: Dict[str, Any] = {"render_modes": ["rgb_array"], "render_fps": 10}

    def __init__(self, task_type: Type[Task], num_envs: int, *, threads: int = 0,
                 autoreset: str = "NextStep", render_mode: Optional[str] = None,
                 scene: Optional[str] = None, **options: Any):
        if render_mode not in (None, "rgb_array"):
            raise ValueError(f"render_mode is {render_mode!r}, expected rgb_array or None")
        self.render_mode, self.num_envs, self.autoreset = render_mode, num_envs, autoreset
        self.metadata = dict(self.metadata, autoreset_mode=autoreset_mode(autoreset))
        self.worlds = Worlds(scene or asset(task_type.scene), num_envs, threads=threads)
        self.tasks: List[Task] = [task_type(self.worlds[w], **options) for w in range(num_envs)]
        for task in self.tasks:
            task.begin_here(np.random.default_rng(0), {})
        self.single_observation_space, self.single_action_space = self.tasks[0].spaces()
        self.observation_space = batched(self.single_observation_space, num_envs)
        self.action_space = batched(self.single_action_space, num_envs)
        self.randoms = [np.random.default_rng() for _ in range(num_envs)]
        self.ended = np.zeros(num_envs, dtype=bool)

    def reset(self, *, seed: Union[None, int, Sequence[Optional[int]]] = None,
              options: Optional[Dict[str, Any]] = None) -> Tuple[Any, Dict[str, Any]]:
        options = dict(options or {})
        mask = np.asarray(options.pop("reset_mask", np.ones(self.num_envs, dtype=bool)))
        if mask.shape != (self.num_envs,) or mask.dtype != bool or not mask.any():
            raise ValueError(f"reset_mask: expected {self.num_envs} bools, one of them true")
        super().reset(seed=seed if isinstance(seed, (int, np.integer)) else None)
        self._seed_worlds(seed)
        infos: Dict[str, Any] = {}
        for w in np.flatnonzero(mask):
            self.tasks[w].reset(self.randoms[w], options)
            self._add_info(infos, w, self.tasks[w].all_info())
        self.ended[mask] = False
        return self._observations(), infos

    def _seed_worlds(self, seed: Union[None, int, Sequence[Optional[int]]]) -> None:
        if seed is None:
            return
        seeds = [seed + w for w in range(self.num_envs)] if np.isscalar(seed) else list(seed)
        if len(seeds) != self.num_envs:
            raise ValueError(f"seed: has {len(seeds)} seeds, expected {self.num_envs}")
        for w, one in enumerate(seeds):
            if one is not None:
                self.randoms[w] = np.random.Generator(np.random.PCG64(np.random.SeedSequence(int(one))))

    def step(self, actions: Any):
        actions = np.asarray(actions)
        if actions.shape != self.action_space.shape:
            raise ValueError(f"actions have shape {actions.shape}, expected {self.action_space.shape}")
        begins = self.ended & (self.autoreset == "NextStep")
        steps = ~self.ended
        if self.autoreset == "Disabled" and self.ended.any():
            raise ValueError("a world has ended, expected reset(options={'reset_mask': ...}) before step()")
        for w in np.flatnonzero(steps):
            self.tasks[w].act(actions[w])
        self._pass_period(steps)
        rewards = np.zeros(self.num_envs)
        terminated, truncated = np.zeros(self.num_envs, dtype=bool), np.zeros(self.num_envs, dtype=bool)
        infos: Dict[str, Any] = {}
        failed = self.worlds.failed
        for w in np.flatnonzero(steps):
            rewards[w], terminated[w], truncated[w] = self.tasks[w].outcome(actions[w])
            truncated[w] |= failed[w]
            self._add_info(infos, w, self.tasks[w].all_info())
        for w in np.flatnonzero(begins):
            self.tasks[w].reset(self.randoms[w], None)
            self._add_info(infos, w, self.tasks[w].all_info())
        self.ended = terminated | truncated
        if self.autoreset == "SameStep" and self.ended.any():
            self._begin_ended(infos)
        return self._observations(), rewards, terminated, truncated, infos

    def _pass_period(self, steps: np.ndarray) -> None:
        """The steps of an action, in parts where one comes late."""
        left, acting = self.tasks[0].steps_of_action, np.flatnonzero(steps)
        while left and len(acting):
            part = min([left] + [self.tasks[w].due() for w in acting])
            self.worlds.step(part, steps)
            for w in acting:
                self.tasks[w].passed(part)
            left -= part

    def _begin_ended(self, infos: Dict[str, Any]) -> None:
        last = np.full(self.num_envs, None, dtype=object)
        final: Dict[str, Any] = {}
        for w in np.flatnonzero(self.ended):
            last[w] = self.tasks[w].observe()
            self._add_info(final, w, self.tasks[w].all_info())
            self.tasks[w].reset(self.randoms[w], None)
            self._add_info(infos, w, self.tasks[w].all_info())
        infos["final_obs"], infos["_final_obs"] = last, self.ended.copy()
        infos["final_info"], infos["_final_info"] = final, self.ended.copy()
        self.ended = np.zeros(self.num_envs, dtype=bool)

    def _observations(self) -> Any:
        all_of = [task.observe() for task in self.tasks]
        if isinstance(all_of[0], dict):
            return {name: np.stack([one[name] for one in all_of]) for name in all_of[0]}
        return np.stack(all_of)

    def _add_info(self, infos: Dict[str, Any], world: int, info: Dict[str, Any]) -> None:
        """Arrays of all worlds by key, and under "_key" which worlds have it: as Gymnasium does."""
        for key, value in info.items():
            if isinstance(value, dict):
                self._add_info(infos.setdefault(key, {}), world, value)
            else:
                if key not in infos:
                    number = isinstance(value, (bool, int, float, np.number, np.bool_))
                    kind = np.asarray(value).dtype if number else object
                    infos[key] = np.zeros(self.num_envs, kind) if number else np.full(
                        self.num_envs, None, object)
                infos[key][world] = value
            infos.setdefault("_" + key, np.zeros(self.num_envs, dtype=bool))[world] = True

    def render(self):
        if self.render_mode is None:
            return None
        return tuple(task.picture(640, 480) for task in self.tasks)
