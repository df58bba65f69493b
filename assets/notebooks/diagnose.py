# %% [markdown]
# # Ask what a model lacks
#
# A stem is measured: it is pulled by a load and let go. Here the measurement is made by a simulation
# with something that the model does not know: a root that gives way.

# %%
import os
import tempfile

import pedicel

folder = tempfile.mkdtemp()
plant = pedicel.Plant("stem", youngs_modulus=3e8, density=900, damping_time=0.004, distance=0.04)
plant.add_stem("stem", [[0, 0, 0], [0, 0, 0.5]], 0.004, interpolation="linear")

plan = os.path.join(folder, "plan")
for trial in ("x", "y"):
    os.makedirs(os.path.join(plan, trial))
    with open(os.path.join(plan, trial, "markers.csv"), "w") as table:
        table.write("time,foot.x,foot.y,foot.z,low.x,low.y,low.z,top.x,top.y,top.z\n")
        table.writelines(f"{0.01 * i:.2f},,,,,,,,,\n" for i in range(151))
plant.save(os.path.join(plan, "plant.yaml"))
with open(os.path.join(plan, "experiment.yaml"), "w") as file:
    file.write("""format: pedicel-experiment
version: 1
title: a stem, loaded and let go
plant: plant.yaml
markers:
  - {name: foot, curve: stem, at: 0.1}
  - {name: low, curve: stem, at: 0.4}
  - {name: top, curve: stem, at: 1.0}
trials:
  - name: x
    folder: x
    drive:
      - {kind: load, curve: stem, at: 1.0, force: [0.1, 0, 0], from: 0.1, to: 0.7}
  - name: y
    folder: y
    drive:
      - {kind: load, curve: stem, at: 1.0, force: [0, 0.08, 0], from: 0.1, to: 0.7}
""")

# %% [markdown]
# `observe` writes what the instruments would have reported.

# %%
measured = pedicel.observe(
    os.path.join(plan, "plant.yaml"), plan, os.path.join(folder, "measured"), noise_position=3e-4,
    effects=["{name: base_compliance, stiffness: 2.0}"])
assert pedicel.validate(measured), pedicel.validate(measured).text

# %% [markdown]
# The diagnosis takes a minute or so. A short weak piece at the foot bends as a soft root does, so these
# data may not tell the two apart: then the verdict is `ambiguous`, and the likeliest cause comes first.

# %%
verdict = pedicel.diagnose(measured, out=os.path.join(folder, "diagnosis"))
print(verdict.verdict, verdict.names)
cause = verdict.causes[0]
print(cause.because)
for name, estimate in cause.parameters.items():
    print(f"{name} = {estimate.value:.3g} ({estimate.low:.3g} to {estimate.high:.3g}) {estimate.unit}")
print("next experiment:", verdict.next_experiment)
assert verdict.verdict in ("named", "ambiguous") and cause.name == "base_compliance"
assert abs(cause.parameters["stiffness"].value / 2.0 - 1) < 0.1
print("report:", os.path.join(folder, "diagnosis", "report.html"))
