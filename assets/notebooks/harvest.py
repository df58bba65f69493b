# %% [markdown]
# # A robot takes a tomato off
#
# Each part between `# %%` is a cell: editors such as VS Code, Spyder and Jupytext run them one by one.
# As a script it runs as a whole: `python3 harvest.py`.

# %%
import numpy as np

import pedicel

scene = pedicel.asset("scenes/cherry_tomato_pull_up.scene.yaml")
sim = pedicel.Simulation(scene)
print(len(sim.segment_names), "segments,", len(sim.fruit_names), "fruits, joints:", sim.joint_names)

# %% [markdown]
# The scene has a program: the arm grasps `fruit_5`, pulls, and lays it down.
# Arrays are views, so what is kept must be copied.

# %%
times, margins, forces = [], [], []
fruit = sim.fruit_names.index("truss/fruit_5")
while sim.time < 3.5 and not sim.events:
    sim.step(4)
    times.append(sim.time)
    margins.append(sim.stalk_margins[fruit])
    forces.append(np.linalg.norm(sim.stalk_loads[fruit, :3]))

event = sim.events[0]
print(f"{event.organ} came off at {event.time:.2f} s by {event.cause}, at {event.force:.2f} N")
print(f"largest force in its stalk before: {max(forces):.2f} N")
assert event.organ == "truss/fruit_5" and max(margins) > 0.9

# %% [markdown]
# A later break: the threshold is a setting, and a reset takes it.

# %%
sim.reset(settings={"detach.stretch": 0.2})
while sim.time < 4.3 and not sim.events:
    sim.step(4)
print(f"with a tougher stalk: {sim.events[0].time:.2f} s")
assert sim.events[0].time > event.time

# %% [markdown]
# The same run again gives the same bits, so a saved state comes back exactly.

# %%
saved, there = sim.save(), sim.state_hash
sim.step(40)
sim.restore(saved)
assert sim.state_hash == there

# %% [markdown]
# A picture, where there is OpenGL off screen.

# %%
try:
    picture = sim.render("close", width=320, height=240)
    print("a picture:", picture.shape, "mean colour", picture.mean(axis=(0, 1)).round())
except pedicel.NoPictures as why:
    print(why)
