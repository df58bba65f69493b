"""Policies written by hand, to compare with what is learned. They are led by the task, not by
observations, and give actions of kind "tool"."""

import numpy as np


def towards(task, place, most: float = 1.0) -> np.ndarray:
    """The tool's velocity towards a place (m), as an action, without a turn."""
    away = np.asarray(place) - task.run.tool_pose[:3]
    speed = away / task.period / task.control.reach
    size = np.linalg.norm(speed)
    return np.concatenate([speed / max(1.0, size / most), np.zeros(3)])


def harvest(task) -> np.ndarray:
    """To the fruit, shut, pull up and back, over the tray, open."""
    run, fruit, time = task.run, task.fruit(), task.elapsed
    if run.fruit_attached[task.target]:
        if time < 1.5:
            return np.append(towards(task, fruit, 0.5), 0.0)
        if time < 2.0:
            return np.append(towards(task, fruit, 0.2), -1.0 if task.control.opening > 0.01 else 0.0)
        return np.append(towards(task, run.tool_pose[:3] + [0.1, 0.0, 0.1], 0.5), 0.0)
    over = task.tray_place() + [0.0, 0.0, 0.08]
    away = np.linalg.norm((fruit - over)[:2])
    if away < 0.04:
        return np.append(np.zeros(6), 1.0)
    way = over + [0.0, 0.0, 0.0 if away < 0.15 else 0.08] - fruit
    return np.append(towards(task, run.tool_pose[:3] + way, 0.6), 0.0)


def reveal(task) -> np.ndarray:
    """Below the leaves to the stem that hides the fruit, and push it aside."""
    run = task.run
    if task.elapsed < 1.0:
        return np.append(towards(task, [0.10, -0.085, 0.35], 0.6), 0.0)
    return np.append(towards(task, run.tool_pose[:3] + [-0.1, -0.02, 0.0], 0.2), 0.0)


def probe(task) -> np.ndarray:
    """Push the stem by a little, then say what a beam of its shape says."""
    if task.elapsed < 4.0:
        return np.concatenate([towards(task, task.run.tool_pose[:3] + [-0.1, 0, 0], 0.12), [0.0, 0.0, -1.0]])
    # A cantilever of the stem's mean radius, pushed at the tool's height: F = 3 E I d / h^3.
    height = task.run.tool_pose[2]
    place = np.argmin(np.abs(task.start[:, 2] - height))
    moved = np.linalg.norm(task.run.positions[task.stem][place] - task.start[place])
    inertia = np.pi * 0.0052**4 / 4
    modulus = np.linalg.norm(task.force()) * height**3 / (3 * inertia * max(moved, 1e-4))
    share = np.log(max(modulus, task.low) / task.low) / np.log(task.high / task.low)
    return np.concatenate([np.zeros(task.control.size), [2 * share - 1, 1.0]])
