# %% [markdown]
# # Draw a plant, push it, and compare with beam theory

# %%
import numpy as np

import pedicel

length, radius, modulus = 0.3, 0.003, 1.0e9
plant = pedicel.Plant("rod", youngs_modulus=modulus, density=1.0, distance=0.01)
plant.add_stem("stem", [[0, 0, 0], [0, 0, length]], radius, interpolation="linear")
print(plant, plant.check())

# %% [markdown]
# A force across its tip. A slender beam gives way by F L^3 / (3 E I).

# %%
sim = pedicel.Simulation(plant, dt=0.002)
force = 0.05
sim.set_force("rod/stem", [force, 0, 0], at=1.0)
sim.step(1500)
expected = force * length**3 / (3 * modulus * np.pi * radius**4 / 4)
found = sim.positions[-1, 0]
print(f"tip: {1e3 * found:.3f} mm, theory: {1e3 * expected:.3f} mm")
assert abs(found / expected - 1) < 0.02

# %% [markdown]
# The moment at its foot is F L. `segment_loads` has it in the segment's own frame.

# %%
moment = np.linalg.norm(sim.segment_loads[0, 3:5])
print(f"moment at the foot: {moment:.5f} N m, F L = {force * length:.5f} N m")
assert abs(moment / (force * length) - 1) < 0.05

# %% [markdown]
# Let go, it swings. Twice as stiff it swings faster, by the square root of two.

# %%
def frequency(modulus):
    stem = plant.copy()
    stem.set("material.youngs_modulus", modulus)
    stem.set("material.density", 900.0)
    stem.set("material.damping_time", 1e-5)
    run = pedicel.Simulation(stem, dt=0.0005)
    run.set_force("rod/stem", [force, 0, 0])
    run.step(2000)
    run.clear_forces()
    tip = []
    for _ in range(1000):
        run.step(1)
        tip.append(run.positions[-1, 0])
    spectrum = np.abs(np.fft.rfft(np.array(tip) - np.mean(tip), 16384))
    return np.argmax(spectrum) / (16384 * 0.0005)


one, two = frequency(modulus), frequency(2 * modulus)
print(f"{one:.2f} Hz, {two:.2f} Hz, ratio {two / one:.3f}")
assert abs(two / one - np.sqrt(2)) < 0.05

# %% [markdown]
# Many pushes at once: each world has a force of its own, and all cores work.

# %%
worlds = pedicel.Worlds(plant, 8, dt=0.002)
forces = np.linspace(0.01, 0.08, len(worlds))
for world, one in zip((worlds[i] for i in range(len(worlds))), forces):
    world.set_force("rod/stem", [one, 0, 0])
worlds.step(1000)
tips = worlds.positions[:, -1, 0]
print("tips in mm:", (1e3 * tips).round(2))
assert np.all(np.diff(tips) > 0)
