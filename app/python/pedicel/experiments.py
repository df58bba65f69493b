"""Measured data: diagnose, fit, observe, validate."""

import json
import os
import re
from dataclasses import dataclass, field
from typing import Any, Dict, List, Mapping, Optional, Sequence, Union

from . import _core
from .errors import Diagnostic

Path = Union[str, "os.PathLike[str]"]


@dataclass(frozen=True)
class Estimate:
    """A number with its 95 % interval."""

    value: float
    low: Optional[float]
    high: Optional[float]
    unit: str


@dataclass(frozen=True)
class Cause:
    """Something that the model lacks."""

    name: str  #: as in the manual's page on effects
    parameters: Dict[str, Estimate]
    where: Dict[str, Any]  #: curve, at, or what else it is at; may be empty
    because: str  #: in plain words
    evidence: Optional[float]  #: nats
    data: Dict[str, Any] = field(repr=False, default_factory=dict)  #: all that verdict.json says of it


@dataclass(frozen=True)
class Verdict:
    """What a diagnosis found; the manual's page on the verdict explains it."""

    verdict: str  #: adequate, named, ambiguous, unknown, bad_data or numerical
    causes: List[Cause]
    parameters: Dict[str, Estimate]  #: refitted
    gain: Optional[float]  #: share of the error above the noise that the causes remove, held-out trials
    remainder: str
    next_experiment: str
    partial: bool  #: the search was cut short
    data: Dict[str, Any] = field(repr=False)  #: verdict.json as it is

    @property
    def names(self) -> List[str]:
        """Names of the causes."""
        return [cause.name for cause in self.causes]


@dataclass(frozen=True)
class FittedParameter:
    """A fitted number with its 95 % interval by profile likelihood."""

    name: str
    value: Optional[float]
    low: Optional[float]
    high: Optional[float]
    unit: str
    seen: bool  #: false: the data cannot tell
    data: Dict[str, Any] = field(repr=False, default_factory=dict)


@dataclass(frozen=True)
class Fit:
    """What a fit found."""

    parameters: Dict[str, FittedParameter]
    data: Dict[str, Any] = field(repr=False)  #: fit.json as it is

    def __getitem__(self, name: str) -> FittedParameter:
        return self.parameters[name]


@dataclass(frozen=True)
class Validation:
    """Whether files are good, and what was found in them."""

    good: bool
    diagnostics: List[Diagnostic]
    text: str  #: as the command line says it

    def __bool__(self) -> bool:
        return self.good


def _estimate(data: Mapping[str, Any]) -> Estimate:
    return Estimate(data.get("value"), data.get("low"), data.get("high"), data.get("unit", ""))


def _estimates(data: Optional[Mapping[str, Any]]) -> Dict[str, Estimate]:
    return {name: _estimate(one) for name, one in (data or {}).items() if isinstance(one, dict)}


def _cause(data: Mapping[str, Any]) -> Cause:
    return Cause(data["name"], _estimates(data.get("parameters")), dict(data.get("where") or {}),
                 data.get("because") or "", data.get("evidence"), dict(data))


def diagnose(experiment: Path, *, out: Optional[Path] = None, threads: int = 0, seed: int = 1,
             time_limit: Optional[float] = None,
             settings: Optional[Mapping[str, float]] = None) -> Verdict:
    """Says what the simulation of a measured experiment gets wrong, and why.

    experiment: its folder. out: a folder for report.html, verdict.json and the extended plant.
    threads 0: all cores. time_limit: s, after which what is known is concluded. settings: of the
    manual's page on the diagnosis. Ctrl-C ends it.
    """
    data = json.loads(_core.diagnose(os.fspath(experiment), os.fspath(out or ""), threads, seed,
                                     time_limit, dict(settings or {})))
    return Verdict(data["verdict"], [_cause(one) for one in data.get("causes") or []],
                   _estimates(data.get("parameters")), data.get("gain"), data.get("remainder") or "",
                   data.get("next_experiment") or "", bool(data.get("partial")), data)


def fit(experiment: Path, parameters: Sequence[str], *, out: Optional[Path] = None, threads: int = 0,
        seed: int = 1) -> Fit:
    """Fits named parameters to a measured experiment, with intervals.

    parameters: youngs_modulus, density, damping_time, EFFECT.PARAMETER[@CURVE:AT] (free) or
    EFFECT.PARAMETER=VALUE[@CURVE:AT] (given). out: a folder for fit.json and fitted.plant.yaml.
    """
    data = json.loads(_core.fit(os.fspath(experiment), list(parameters), os.fspath(out or ""), threads,
                                seed))
    found = {one["name"]: FittedParameter(one["name"], one.get("value"), one.get("low"),
                                          one.get("high"), one.get("unit", ""), one.get("seen", True),
                                          one) for one in data["parameters"]}
    return Fit(found, data)


def observe(model: Path, like: Path, out: Path, *, plant: str = "", seed: int = 1,
            noise_position: float = 0.0, noise_force: float = 0.0, noise_colour: float = 0.0,
            effects: Sequence[str] = ()) -> str:
    """Simulates the trials of `like` with another plant, and writes an experiment folder.

    model: plant file, or scene or experiment whose plant is meant. noise_position: m, noise_force: N,
    standard deviations. effects: as in a file, "{name: ..., ...}": simulated, but not written.
    Returns the folder.
    """
    _core.observe(os.fspath(model), os.fspath(like), os.fspath(out), plant, seed, noise_position,
                  noise_force, noise_colour, list(effects))
    return os.fspath(out)


_LINE = re.compile(r"^(?P<file>.*?)(?::(?P<line>\d+))?(?::(?P<column>\d+))?: "
                   r"(?P<severity>error|warning|notice): (?P<what>.*)$")


def validate(*files: Path, packages: Sequence[str] = ()) -> Validation:
    """Checks plants, scenes, leaf templates, robots, meshes, experiments and tables without running them."""
    good, text = _core.validate([os.fspath(one) for one in files], list(packages))
    found = []
    for line in text.splitlines():
        match = _LINE.match(line)
        if match:
            found.append(Diagnostic(match["severity"], match["file"], int(match["line"] or 0),
                                    int(match["column"] or 0), match["what"]))
    return Validation(good, found, text)
