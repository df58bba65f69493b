"""Runs the programs and gathers their figures."""

import json
import statistics
import subprocess
from pathlib import Path

from schemes import DROOP, FREQUENCY, TIP_DROP

ROOT = Path(__file__).resolve().parents[2]
PEERS = ROOT / "build/peers"
PEDICEL = ROOT / "build/release/pedicel"

SPEEDS = [("forest", 1), ("forest", 2), ("tree", 1), ("tree", 2)]


def program(scheme):
    return PEDICEL if scheme.program == "pedicel" else PEERS / scheme.program


def call(command, cap):
    """The JSON object that a program prints, {} after `cap` seconds or a crash."""
    try:
        done = subprocess.run([str(word) for word in command], cwd=PEERS, timeout=cap,
                              capture_output=True, text=True)
    except subprocess.TimeoutExpired:
        return {}
    start = done.stdout.find("{")
    return json.loads(done.stdout[start:]) if done.returncode == 0 and start >= 0 else {}


def pedicel(scheme, name, threads, seconds, *more):
    return [PEDICEL, "bench", name, "--threads", threads, "--dt", scheme.dt, "--duration", seconds,
            "--json", *scheme.options, *more]


def peer(scheme, work, threads=1, seconds=1.0):
    dt = scheme.dt_40 if work == "tip40" and scheme.dt_40 else scheme.dt
    return [program(scheme), work, dt, threads, seconds]


class Row:
    """What is known of one scheme. Absent figures are None."""

    def __init__(self, scheme):
        self.scheme = scheme
        self.installed = program(scheme).exists()
        self.samples = {speed: [] for speed in SPEEDS}
        self.gave_up = set()  # works and accuracies that passed their time or blew up
        self.memory = self.tip_20 = self.tip_40 = self.frequency = self.damping = self.droop = None

    def prepare(self):
        """Compiles what the program keeps (MuJoCo's models): no part of what is measured."""
        if self.installed and self.scheme.keeps_models:
            for work in ("forest", "tree"):
                call(peer(self.scheme, work), 300)

    def add_speed(self, work, threads, seconds, cap):
        """One more sample of a real-time factor, from about `seconds` of wall time."""
        if not self.installed or work in self.gave_up:
            return
        if (work, threads) == ("tree", 2) and self.scheme.program != "pedicel":
            return  # peers share out plants, and there is but one
        if self.scheme.program == "pedicel":
            name = {"forest": "rods_2242", "tree": "tree_2242"}[work]
            found = call(pedicel(self.scheme, name, threads, seconds, "--no-accuracy"), cap)
        else:
            found = call(peer(self.scheme, work, threads, seconds), cap)
        if "real_time_factor" not in found:
            self.gave_up.add(work)
            return
        self.samples[work, threads].append(found["real_time_factor"])
        if (work, threads) == ("forest", 1):
            self.memory = max(self.memory or 0.0, found["peak_megabytes"])

    def add_accuracy(self, cap):
        if not self.installed:
            return
        if self.scheme.program == "pedicel":
            found = call(pedicel(self.scheme, "row_1k", 2, 0.01), cap)
            self.tip_20, self.tip_40 = found["cantilever_error"], found["cantilever_error_40"]
            self.frequency, self.damping = found["frequency_error"], found["damping_ratio"]
            self.droop = found["forest_droop"]
            return
        self.tip_20 = error(call(peer(self.scheme, "tip20"), cap).get("tip_drop"), TIP_DROP)
        self.tip_40 = error(call(peer(self.scheme, "tip40"), cap).get("tip_drop"), TIP_DROP)
        ring = call(peer(self.scheme, "ring20"), cap)
        self.frequency = error(ring.get("frequency"), FREQUENCY)
        self.damping = ring.get("damping")
        self.droop = call(peer(self.scheme, "droop", 2), cap).get("droop")
        if self.droop is None:
            self.gave_up.add("droop")

    def speed(self, work, threads):
        samples = self.samples[work, threads]
        return statistics.median(samples) if samples else None

    def worst_error(self):
        """The largest of the tip's, the frequency's and the damping's error, 20 elements."""
        errors = [abs(e) for e in (self.tip_20, self.frequency, self.damping) if e is not None]
        return max(errors) if errors else None

    def figures(self):
        """One flat record: bench.json and bench.csv."""
        s = self.scheme
        return {
            "peer": s.peer, "scheme": s.scheme, "dt": s.dt, "installed": self.installed,
            **{f"rtf_{work}_{threads}": self.speed(work, threads) for work, threads in SPEEDS},
            **{f"samples_{work}_{threads}": len(self.samples[work, threads])
               for work, threads in SPEEDS},
            "tip_error_20": self.tip_20, "tip_error_40": self.tip_40,
            "frequency_error": self.frequency, "damping_ratio": self.damping,
            "forest_droop": self.droop, "forest_droop_error": error(self.droop, DROOP),
            "peak_megabytes": self.memory, "gave_up": " ".join(sorted(self.gave_up)),
        }


def error(value, right):
    return None if value is None else value / right - 1.0
