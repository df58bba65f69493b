# %% [markdown]
# # Learn to push leaves aside
#
# The cross-entropy method, in numpy: many small policies are tried at once, and the next ones are
# drawn around the best. `python3 learn_reveal.py SECONDS FILE` learns for that long (default: 600), and
# writes the policy to the file (*.npy). With 0 seconds it takes the policy from there and tries it.

# %%
import sys
import time

import numpy as np

from pedicel import envs
from pedicel.envs import scripted

seconds = float(sys.argv[1]) if len(sys.argv) > 1 else 600.0
file = sys.argv[2] if len(sys.argv) > 2 else None
worlds, best, drawn = 16, 4, np.random.default_rng(0)
vector = envs.make_vec("pedicel/Reveal-v0", worlds)

# %% [markdown]
# A policy is linear in a few numbers of the state: time left, the way from the tool to the fruit,
# what is seen of it, the largest margin, the force at the hand. Its output is the tool's velocity.

# %%
USED = np.arange(21, 28)
SCALE = np.array([1.0, 5.0, 5.0, 5.0, 1.0, 1.0, 1.0])
inputs, outputs = len(USED) + 1, 3


def actions(parameters, observations):
    """(worlds, 7) of as many policies."""
    weights = parameters.reshape(-1, outputs, inputs)
    x = np.concatenate([observations[:, USED] * SCALE, np.ones((len(observations), 1))], axis=1)
    full = np.zeros((len(observations), vector.single_action_space.shape[0]), dtype=np.float32)
    full[:, :3] = np.tanh(np.einsum("woi,wi->wo", weights, x))
    return full


def returns(parameters, seed):
    """The sum of rewards of one episode of each policy, all with the same seed."""
    observations, _ = vector.reset(seed=[seed] * worlds)
    totals, running = np.zeros(worlds), np.ones(worlds, dtype=bool)
    while running.any():
        observations, rewards, terminated, truncated, _ = vector.step(actions(parameters, observations))
        totals += np.where(running, rewards, 0.0)
        running &= ~(terminated | truncated)
    return totals


# %%
mean, spread = np.zeros(outputs * inputs), 0.4 * np.ones(outputs * inputs)
begin, curve, generation = time.perf_counter(), [], 0
while time.perf_counter() - begin < seconds:
    tried = mean + spread * drawn.normal(size=(worlds, len(mean)))
    score = returns(tried, 1000 + generation)
    elite = tried[np.argsort(score)[-best:]]
    mean, spread = 0.3 * mean + 0.7 * elite.mean(axis=0), 0.3 * spread + 0.7 * elite.std(axis=0) + 0.02
    curve.append(score.mean())
    generation += 1
    print(f"{time.perf_counter() - begin:6.0f} s, generation {generation}: mean {score.mean():6.2f}, "
          f"best {score.max():6.2f}", flush=True)
if seconds == 0 and file:
    mean = np.load(file)
elif file:
    np.save(file, mean)

# %% [markdown]
# On seeds that it has not learned on, beside the policy written by hand and a random one.

# %%
def single(policy, seeds):
    env = envs.make("pedicel/Reveal-v0")
    env.action_space.seed(0)
    found = []
    for seed in seeds:
        observation, _ = env.reset(seed=seed)
        total, ended = 0.0, False
        while not ended:
            observation, reward, terminated, truncated, _ = env.step(policy(env, observation))
            total, ended = total + reward, terminated or truncated
        found.append(total)
    return np.mean(found)


seeds = range(1, 6)
learned = single(lambda env, o: actions(mean[None], o[None])[0], seeds)
by_hand = single(lambda env, o: scripted.reveal(env.task), seeds)
random = single(lambda env, o: env.action_space.sample(), seeds)
print(f"learned {learned:.2f}, by hand {by_hand:.2f}, random {random:.2f}")
if seconds >= 300:
    assert learned > max(by_hand, random)
