"""Learning environments after Gymnasium's interface.

`make("pedicel/Harvest-v0")` and `make_vec("pedicel/Harvest-v0", 8)`; where Gymnasium is installed,
importing this also registers them with gymnasium.make.
"""

from typing import Any

from .harvest import HarvestEnv, HarvestTask
from .interface import Box, Dict, Env, VectorEnv, gymnasium
from .probe import ProbeEnv, ProbeTask
from .reveal import RevealEnv, RevealTask
from .task import Task
from .vector import PedicelVectorEnv

#: Environments by their names.
registry = {"pedicel/Harvest-v0": HarvestEnv, "pedicel/Reveal-v0": RevealEnv,
            "pedicel/Probe-v0": ProbeEnv}

__all__ = ["Box", "Dict", "Env", "HarvestEnv", "HarvestTask", "PedicelVectorEnv", "ProbeEnv",
           "ProbeTask", "RevealEnv", "RevealTask", "Task", "VectorEnv", "make", "make_vec", "registry"]


def _find(name: str):
    if name not in registry:
        raise ValueError(f"no environment {name!r}, expected one of: {', '.join(registry)}")
    return registry[name]


def make(name: str, **options: Any) -> Env:
    """An environment by its name; options as PedicelEnv has them."""
    return _find(name)(**options)


def make_vec(name: str, num_envs: int, **options: Any) -> VectorEnv:
    """So many of one kind, stepped on all cores; options as PedicelVectorEnv has them."""
    return PedicelVectorEnv(_find(name).task_type, num_envs, **options)


if gymnasium is not None:
    for _name in registry:
        if _name not in gymnasium.registry:
            gymnasium.register(
                id=_name, entry_point=_find(_name),
                vector_entry_point=lambda num_envs=1, _id=_name, **options: make_vec(
                    _id, num_envs, **options))
