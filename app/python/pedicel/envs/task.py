"""What is asked of a robot in one world: observations, rewards, ends. Shared by Env and VectorEnv."""

from typing import Any, Dict, List, Optional, Tuple

import numpy as np

from .. import InvalidFile, UsageError, Variation, asset
from .control import Control
from .interface import Box
from .interface import Dict as DictSpace

OBSERVATIONS = ("state", "picture", "mixed")
#: What a run of gentleness_total is called, and what `gentleness` may put a price on.
HANDLING = ("peak_force", "impulse", "margin_used", "strain_energy", "touched", "broken")
LONGEST = 1.0  #: s, of a latency
TRIES = 20  #: draws of a scene that can stand


class Task:
    """Base of the tasks. A subclass gives scene, state, judge and, where it has them, extra actions."""

    scene = ""  #: below the assets
    camera = ""  #: of pictures
    seconds = 10.0  #: of an episode; then it is truncated
    period = 0.1  #: s, of an action
    extra_actions = 0
    vary: Optional[str] = None  #: file below the assets: what varies unless the caller says otherwise

    def __init__(self, run: Any, *, action: str = "tool", observation: str = "state",
                 picture_size: Tuple[int, int] = (96, 72), vary: Any = "default",
                 gentleness: Optional[Dict[str, float]] = None):
        if observation not in OBSERVATIONS:
            raise ValueError(f"observation is {observation!r}, expected one of: {', '.join(OBSERVATIONS)}")
        self.run, self.observation, self.picture_size = run, observation, checked_size(picture_size)
        self.prices = checked_prices(gentleness)
        self.control = Control(run, action)
        self.variation = variation_of(self.vary if vary == "default" else vary)
        self.steps_of_action = max(1, round(self.period / run.dt))
        self.period = self.steps_of_action * run.dt
        self.size = self.control.size + self.extra_actions
        self.settings: Dict[str, str] = {}
        self.terms: Dict[str, float] = {}
        self.late = 0  # steps after which an action takes effect
        self.waiting: List[Tuple[int, np.ndarray]] = []
        self.prepare()

    # What a subclass says.
    def prepare(self) -> None:
        """Once, after construction: indices of names."""

    def begin(self, random: np.random.Generator, options: Dict[str, Any]) -> None:
        """After each reset of the run."""

    def state(self) -> List[Any]:
        """Arrays that make the observed state, in a fixed order."""
        raise NotImplementedError

    def judge(self, action: np.ndarray) -> bool:
        """Sets self.terms (they add up to the reward); whether the episode has come to its end."""
        raise NotImplementedError

    def info(self) -> Dict[str, Any]:
        """More to be told with each step."""
        return {}

    # What all have in common.
    def spaces(self):
        """Single observation and action space."""
        spaces = {}
        if self.observation != "picture":
            size = len(self.flat_state())
            spaces["state"] = Box(-np.inf, np.inf, (size,), np.float32)
        if self.observation != "state":
            width, height = self.picture_size
            spaces["picture"] = Box(0, 255, (height, width, 3), np.uint8)
        space = DictSpace(spaces) if len(spaces) > 1 else next(iter(spaces.values()))
        return space, Box(-1.0, 1.0, (self.size,), np.float32)

    def reset(self, random: np.random.Generator, options: Optional[Dict[str, Any]]) -> None:
        """Draws what varies, and puts the world to its beginning."""
        options = dict(options or {})
        for tries_left in reversed(range(TRIES)):
            seed = int(random.integers(2**62))
            self.settings = dict(self.variation.draw(seed)) if self.variation else {}
            self.settings.update(options.get("settings", {}))
            scene = dict(self.settings)
            self.late = round(latency_of(scene.pop("env.latency", 0.0)) / self.run.dt)
            try:
                self.run.reset(seed % 2**31, scene)
                break
            except InvalidFile:  # a plant that cannot stand: another one is drawn
                if not self.variation or not tries_left:
                    raise
        self.begin_here(random, options)

    def begin_here(self, random: np.random.Generator, options: Dict[str, Any]) -> None:
        self.control.begin()
        self.elapsed = 0.0
        self.terms = {}
        self.waiting = []
        # Motors hold the arm from the first step on, whatever the scene's program was.
        self.control.apply(np.zeros(self.control.size), self.period)
        self.handled = self.run.gentleness_total
        self.begin(random, options)

    # Whoever steps the run calls act(), then due() before and passed() after every so many steps.
    def act(self, action: np.ndarray) -> None:
        self.waiting.append((self.late, np.array(action[:self.control.size])))

    def due(self) -> int:
        """Gives the motors what is due; steps until the next is."""
        while self.waiting and self.waiting[0][0] <= 0:
            self.control.apply(self.waiting.pop(0)[1], self.period)
        return self.waiting[0][0] if self.waiting else self.steps_of_action

    def passed(self, steps: int) -> None:
        self.waiting = [(left - steps, action) for left, action in self.waiting]

    def outcome(self, action: np.ndarray) -> Tuple[float, bool, bool]:
        """Reward, terminated and truncated, after the steps of an action."""
        self.elapsed += self.period
        ended = bool(self.judge(action))
        before, self.handled = self.handled, self.run.gentleness_total
        for name, price in self.prices.items():
            self.terms["gentle_" + name] = -price * float(self.handled[name] - before[name])
        return float(sum(self.terms.values())), ended, self.elapsed >= self.seconds - 1e-9

    def flat_state(self) -> np.ndarray:
        return np.concatenate([np.ravel(part) for part in self.state()]).astype(np.float32)

    def picture(self, width: int, height: int) -> np.ndarray:
        return self.run.render(self.camera, width, height)

    def observe(self) -> Any:
        parts = {}
        if self.observation != "picture":
            parts["state"] = self.flat_state()
        if self.observation != "state":
            parts["picture"] = self.run.camera(self.camera, *self.picture_size, fast=True).rgb
        return parts if len(parts) > 1 else next(iter(parts.values()))

    def all_info(self) -> Dict[str, Any]:
        return {"reward_terms": dict(self.terms), "time": self.run.time,
                "gentleness": self.run.gentleness_total, **self.info()}

    # What tasks ask for.
    def robot_state(self) -> List[np.ndarray]:
        run = self.run
        return [run.joint_positions, run.joint_velocities, run.tool_pose,
                [1.0 - self.elapsed / self.seconds]]


def checked_size(size: Any) -> Tuple[int, int]:
    whole = isinstance(size, (tuple, list)) and all(isinstance(n, (int, np.integer)) for n in size)
    if not whole or len(size) != 2 or not all(1 <= n <= 8192 for n in size):
        raise ValueError(f"picture_size is {size!r}, expected (width, height), px, from 1 to 8192 each")
    return int(size[0]), int(size[1])


def checked_prices(prices: Optional[Dict[str, float]]) -> Dict[str, float]:
    for name, price in (prices or {}).items():
        if name not in HANDLING:
            raise ValueError(f"gentleness: no {name!r}, expected some of: {', '.join(HANDLING)}")
        if not 0.0 <= float(price) < np.inf:
            raise ValueError(f"gentleness: {name} costs {price!r}, expected a number from 0 on")
    return {name: float(price) for name, price in (prices or {}).items()}


def latency_of(value: Any) -> float:
    """s, of "env.latency": a number, or its text as a variation draws it."""
    try:
        latency = float(value)
    except (TypeError, ValueError):
        latency = np.nan
    if not 0.0 <= latency <= LONGEST:
        raise UsageError(f"env.latency is {value!r}, expected a number between 0 and {LONGEST:g} s")
    return latency


def variation_of(vary: Any) -> Optional[Variation]:
    """From None, a Variation, a file, or a map."""
    if vary is None or isinstance(vary, Variation):
        return vary
    if isinstance(vary, dict):
        import json

        return Variation.parse(json.dumps(vary))
    import os

    return Variation.read(vary if os.path.exists(vary) else asset(vary))
