"""Who is measured, how, and what is right."""

from dataclasses import dataclass

TIP_DROP = 0.227248  # m, heavy elastica of the cantilever
FREQUENCY = 1.10599  # Hz, its first one without gravity (Euler-Bernoulli)
DROOP = -4.62e-3  # m, mean over the forest's 228 ends


@dataclass(frozen=True)
class Scheme:
    """One row of the table: a program at one setting."""

    peer: str
    scheme: str
    label: str  # in the chart
    dt: float  # s
    program: str  # of build/peers; "pedicel": ours
    package: str = ""  # what Debian calls it
    options: tuple = ()  # of pedicel bench
    dt_40: float = 0.0  # s, with 40 elements, where an explicit scheme needs less; 0: dt
    keeps_models: bool = False  # the first run compiles for up to a minute


# dt of the explicit schemes: a rod of rigid segments of length h has a highest mode at 7 sqrt(EI /
# rho A) / h^2 rad/s (each segment turning against its neighbours). The forest's stiffest pieces
# come to 9100 rad/s, and 1e-4 s is the largest round step at which it stays bounded (2e-4 s
# explodes, Simbody's 1.5e-4 s too); the cantilever with 40 elements to 22000 rad/s, 2 / w = 9e-5 s.
SCHEMES = [
    Scheme("Pedicel", "direct, BDF2, Newton to the end, self-contact on", "Pedicel, self-contact",
           1 / 240, "pedicel", options=("--self-contact",)),
    Scheme("Pedicel", "direct, BDF2, Newton to the end", "Pedicel", 1 / 240, "pedicel"),
    Scheme("Pedicel", "direct, BDF2, 1 Newton iteration", "Pedicel, 1 Newton", 1 / 240, "pedicel",
           options=("--set", "rods.newton_iterations=1")),
    Scheme("Pedicel", "direct, BDF2, 1 Newton iteration, self-contact on",
           "Pedicel, 1 Newton, self-contact", 1 / 240, "pedicel",
           options=("--set", "rods.newton_iterations=1", "--self-contact")),
    Scheme("Pedicel", "the paper's method: position-based, 5 iterations", "paper's method", 1 / 200,
           "pedicel", options=("--set", "rods.solver=position_based")),
    Scheme("MuJoCo", "ball joints, linearly implicit springs", "MuJoCo 1/240", 1 / 240,
           "peer_mujoco", "libmujoco-dev", keeps_models=True),
    Scheme("MuJoCo", "the same, four times the step", "MuJoCo 1/60", 1 / 60, "peer_mujoco",
           "libmujoco-dev"),
    Scheme("DART", "ball joints, articulated bodies, linearly implicit springs", "DART", 1 / 240,
           "peer_dart", "libdart-dev"),
    Scheme("Bullet btMultiBody", "spherical joints, articulated bodies, explicit springs",
           "Bullet multibody", 1e-4, "peer_bullet", "libbullet-dev", dt_40=5e-5),
    Scheme("Simbody", "ball joints, articulated bodies, explicit springs", "Simbody", 1e-4,
           "peer_simbody", "libsimbody-dev", dt_40=5e-5),
    Scheme("Bullet btSoftBody", "rope: position-based distances, 10 iterations", "Bullet soft body",
           1 / 240, "peer_softbody", "libbullet-dev"),
]

# Packages that a peer needs beside its own.
MORE_PACKAGES = {"libdart-dev": ["libdart-external-ikfast-dev"]}
