"""Pedicel: robots handle plants.

`Simulation` runs a scene, `Worlds` many at once, `Plant` builds plants; `diagnose`, `fit`, `observe`
and `validate` work on measured data. SI units, Z up, quaternions x y z w. The manual's page on Python
explains it.
"""

import atexit

from . import _core
from ._core import CameraPicture, Event, Keypoint, Parameter, Plant, Reach, Run, Simulation, Thing, Variation, World, Worlds
from .errors import Diagnostic, Error, InvalidFile, NoPictures, Unstable, UsageError, WriteError
from .experiments import (Cause, Estimate, Fit, FittedParameter, Observed, Validation, Verdict, diagnose,
                          fit, observe, validate)
from .program import command

__version__: str = _core.version

# The thread that draws ends before the interpreter does.
atexit.register(_core.end_pictures)

__all__ = [
    "CameraPicture", "Cause", "Diagnostic", "Error", "Estimate", "Event", "Fit", "FittedParameter", "InvalidFile",
    "Keypoint", "NoPictures", "Observed", "Parameter", "Plant", "Reach", "Run", "Simulation", "Thing", "Unstable", "UsageError",
    "Validation", "Variation", "Verdict", "World", "Worlds", "WriteError", "asset", "command", "diagnose", "fit", "observe",
    "validate",
]


def asset(name: str) -> str:
    """Path of something that Pedicel ships: asset("scenes/cherry_tomato_pull_up.scene.yaml")."""
    import os

    folder = _core.asset_folder()
    path = os.path.join(folder, name)
    if not folder or not os.path.exists(path):
        raise UsageError(f"asset: {name} is not below {folder or '(no assets were found)'}")
    return path
