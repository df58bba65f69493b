"""Gymnasium's Env, VectorEnv and spaces where it is installed; else the same by interface."""

from typing import Any, Dict as Map, Optional, Tuple

import numpy as np

try:
    import gymnasium
    from gymnasium import Env
    from gymnasium.spaces import Box, Dict, Space
    from gymnasium.vector import VectorEnv

    try:
        from gymnasium.vector import AutoresetMode
    except ImportError:  # before 1.1
        AutoresetMode = None
except ImportError:
    gymnasium = None
    from .spaces import Box, Dict, Space

    AutoresetMode = None

    class _Seeded:
        """Random numbers of an environment."""

        _np_random: Optional[np.random.Generator] = None
        _np_random_seed: Optional[int] = None

        def _seed(self, seed: Optional[int]) -> None:
            if seed is not None and (not isinstance(seed, (int, np.integer)) or seed < 0):
                raise ValueError(f"seed is {seed!r}, expected a whole number from 0 on")
            sequence = np.random.SeedSequence(None if seed is None else int(seed))
            self._np_random = np.random.Generator(np.random.PCG64(sequence))
            self._np_random_seed = sequence.entropy

        @property
        def np_random(self) -> np.random.Generator:
            if self._np_random is None:
                self._seed(None)
            return self._np_random

        @np_random.setter
        def np_random(self, value: np.random.Generator) -> None:
            self._np_random, self._np_random_seed = value, -1

        @property
        def np_random_seed(self) -> Optional[int]:
            if self._np_random_seed is None:
                self._seed(None)
            return self._np_random_seed

    class Env(_Seeded):
        """gymnasium.Env by interface."""

        metadata: Map[str, Any] = {"render_modes": []}
        render_mode: Optional[str] = None
        spec: Any = None
        observation_space: Space
        action_space: Space

        def reset(self, *, seed: Optional[int] = None, options: Optional[Map[str, Any]] = None):
            if seed is not None:
                self._seed(seed)

        def step(self, action: Any) -> Tuple[Any, float, bool, bool, Map[str, Any]]:
            raise NotImplementedError

        def render(self):
            raise NotImplementedError

        def close(self) -> None:
            pass

        @property
        def unwrapped(self) -> "Env":
            return self

        def has_wrapper_attr(self, name: str) -> bool:
            return hasattr(self, name)

        def get_wrapper_attr(self, name: str) -> Any:
            return getattr(self, name)

        def set_wrapper_attr(self, name: str, value: Any, *, force: bool = True) -> bool:
            if force or hasattr(self, name):
                setattr(self, name, value)
                return True
            return False

        def __enter__(self) -> "Env":
            return self

        def __exit__(self, *_: Any) -> bool:
            self.close()
            return False

        def __str__(self) -> str:
            return f"<{type(self).__name__} instance>"

    class VectorEnv(_Seeded):
        """gymnasium.vector.VectorEnv by interface."""

        metadata: Map[str, Any] = {}
        spec: Any = None
        render_mode: Optional[str] = None
        closed = False
        num_envs: int
        observation_space: Space
        action_space: Space
        single_observation_space: Space
        single_action_space: Space

        def reset(self, *, seed=None, options=None):
            if isinstance(seed, (int, np.integer)):
                self._seed(int(seed))

        def step(self, actions: Any):
            raise NotImplementedError

        def render(self):
            raise NotImplementedError

        def close_extras(self, **kwargs: Any) -> None:
            pass

        def close(self, **kwargs: Any) -> None:
            if not self.closed:
                self.close_extras(**kwargs)
                self.closed = True

        @property
        def unwrapped(self) -> "VectorEnv":
            return self


#: Names of the autoreset modes, as Gymnasium has them.
MODES = ("NextStep", "SameStep", "Disabled")


def autoreset_mode(name: str) -> Any:
    """What metadata["autoreset_mode"] holds: Gymnasium's enumerator, or its name."""
    if name not in MODES:
        raise ValueError(f"autoreset_mode is {name!r}, expected one of: {', '.join(MODES)}")
    return AutoresetMode(name) if AutoresetMode else name


def batched(space: Space, count: int) -> Space:
    """A space of so many at once."""
    if isinstance(space, Dict):
        return Dict({name: batched(one, count) for name, one in space.spaces.items()})
    shape = (count,) + tuple(1 for _ in space.shape)
    return Box(np.tile(space.low[None], shape), np.tile(space.high[None], shape), dtype=space.dtype)
