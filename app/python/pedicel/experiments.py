"""Measured data: diagnose, fit, observe, validate."""

import json
import os
import tempfile
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Any, Dict, Iterator, List, Mapping, Optional, Sequence, Union

from .errors import Diagnostic
from .program import command, diagnostics_of, outputs

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
class Observed:
    """An experiment that was simulated. It is taken wherever a path of one is."""

    folder: str  #: that it was written to
    trials: List[str]  #: names of the folders of its trials

    def __fspath__(self) -> str:
        return self.folder

    def __str__(self) -> str:
        return self.folder


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


@contextmanager
def _folder(out: Optional[Path]) -> Iterator[str]:
    """Where the program may write: what nobody asked for goes afterwards."""
    if out is not None:
        yield os.fspath(out)
        return
    with tempfile.TemporaryDirectory() as folder:
        yield os.path.join(folder, "out")


def _options(folder: str, threads: int, seed: int) -> List[str]:
    options = ["--out", folder, "--seed", str(seed), "--json", "--quiet"]
    return options + (["--threads", str(threads)] if threads else [])


def diagnose(experiment: Path, *, out: Optional[Path] = None, threads: int = 0, seed: int = 1,
             time_limit: Optional[float] = None,
             settings: Optional[Mapping[str, float]] = None) -> Verdict:
    """Says what the simulation of a measured experiment gets wrong, and why.

    experiment: its folder. out: a folder for report.html, verdict.json and the extended plant.
    threads 0: all cores. time_limit: s, after which what is known is concluded. settings: of the
    manual's page on the diagnosis. Ctrl-C ends it.
    """
    with _folder(out) as folder:
        words = ["diagnose", experiment, *_options(folder, threads, seed)]
        if time_limit is not None:
            words += ["--time-limit", time_limit]
        for name, value in (settings or {}).items():
            words += ["--set", f"{name}={value!r}"]
        # 10 and above say which verdict it is.
        data = json.loads(command(*words, good=(0, 10, 11, 12, 13, 14)))
    return Verdict(data["verdict"], [_cause(one) for one in data.get("causes") or []],
                   _estimates(data.get("parameters")), data.get("gain"), data.get("remainder") or "",
                   data.get("next_experiment") or "", bool(data.get("partial")), data)


def fit(experiment: Path, parameters: Sequence[str], *, out: Optional[Path] = None, threads: int = 0,
        seed: int = 1) -> Fit:
    """Fits named parameters to a measured experiment, with intervals.

    parameters: youngs_modulus, density, damping_time, EFFECT.PARAMETER[@CURVE:AT] (free) or
    EFFECT.PARAMETER=VALUE[@CURVE:AT] (given). out: a folder for fit.json and fitted.plant.yaml.
    """
    with _folder(out) as folder:
        data = json.loads(command("fit", experiment, *parameters, *_options(folder, threads, seed)))
    found = {one["name"]: FittedParameter(one["name"], one.get("value"), one.get("low"),
                                          one.get("high"), one.get("unit", ""), one.get("seen", True),
                                          one) for one in data["parameters"]}
    return Fit(found, data)


def observe(model: Path, like: Path, out: Path, *, plant: str = "", seed: int = 1,
            noise_position: float = 0.0, noise_force: float = 0.0, noise_colour: float = 0.0,
            effects: Sequence[str] = ()) -> Observed:
    """Simulates the trials of `like` with another plant, and writes an experiment folder.

    model: plant file, or scene or experiment whose plant is meant. noise_position: m, noise_force: N,
    standard deviations. effects: as in a file, "{name: ..., ...}": simulated, but not written.
    """
    words: List[Any] = ["observe", model, "--like", like, "--out", out, "--seed", seed,
                        "--noise-position", noise_position, "--noise-force", noise_force,
                        "--noise-colour", noise_colour]
    for effect in effects:
        words += ["--set", effect]
    command(*words, *(["--plant", plant] if plant else []))
    folder = os.fspath(out)
    trials = sorted(entry.name for entry in os.scandir(folder) if entry.is_dir()
                    and any(name.endswith(".csv") for name in os.listdir(entry.path)))
    return Observed(folder, trials)


def validate(*files: Path, packages: Sequence[str] = ()) -> Validation:
    """Checks plants, scenes, leaf templates, robots, meshes, experiments and tables without running them."""
    words: List[Any] = ["validate", *files]
    for package in packages:
        words += ["--package", package]
    text = "".join(outputs(words, (0, 3)))
    found = diagnostics_of(text)
    return Validation(not any(one.severity == "error" for one in found), found, text)
