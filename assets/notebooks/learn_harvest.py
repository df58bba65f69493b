# %% [markdown]
# # Learn to take a fruit off and to lay it down
#
# A policy looks at what the one by hand does, and then becomes better than it by an evolution
# strategy, in numpy. `python3 learn_harvest.py SECONDS FILE` learns for that long (default: 600), and
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
vector = envs.make_vec("pedicel/Harvest-v0", worlds)

# %% [markdown]
# What a policy sees: as long as the fruit is on, the way to it, whether it is near, and how hard it is
# held; once it is off, the way to the tray, and whether the hand is above it. It is linear in these, with
# weights of its own for either half. Its output is the tool's velocity and the gripper's speed.

# %%
inputs, outputs = 7, 4


def features(observations):
    """(worlds, 2 * inputs): one half of them is zero."""
    to_fruit, to_tray = observations[:, 22:25], observations[:, 25:28]
    on, force = observations[:, 31:32], observations[:, 34:35]
    near = np.exp(-np.sum(to_fruit**2, axis=1, keepdims=True) / 0.02**2)
    held = near * np.minimum(force / 2.0, 1.0)
    above = np.exp(-np.sum(to_tray[:, :2] ** 2, axis=1, keepdims=True) / 0.05**2)
    one = np.ones_like(on)
    taking = np.concatenate([10 * to_fruit, 2 * near, 2 * held, one, 50 * observations[:, 35:36]], axis=1)
    laying = np.concatenate([5 * to_tray, 2 * above, one, 0 * one, 0 * one], axis=1)
    return np.concatenate([on * taking, (1 - on) * laying], axis=1)


def actions(parameters, observations):
    """(worlds, 7) of as many policies."""
    weights = parameters.reshape(-1, outputs, 2 * inputs)
    out = np.tanh(np.einsum("woi,wi->wo", weights, features(observations)))
    full = np.zeros((len(observations), vector.single_action_space.shape[0]), dtype=np.float32)
    full[:, :3], full[:, -1] = out[:, :3], out[:, 3]
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


# %% [markdown]
# What the policy by hand does in four episodes is fitted by least squares, without the moments in which
# it waits.

# %%
def shown(seeds):
    """Features and actions of the policy by hand."""
    env, seen, done = envs.make("pedicel/Harvest-v0"), [], []
    for seed in seeds:
        observation, _ = env.reset(seed=seed)
        ended = False
        while not ended:
            action = scripted.harvest(env.task)
            if np.abs(action).max() > 0.2:
                seen.append(features(observation[None])[0])
                done.append(np.arctanh(np.clip(action[[0, 1, 2, 6]], -0.95, 0.95)))
            observation, _, terminated, truncated, _ = env.step(action)
            ended = terminated or truncated
    return np.array(seen), np.array(done)


begin, generation = time.perf_counter(), 0
seen, done = shown(range(500, 504))
square = seen.T @ seen + 0.1 * np.eye(2 * inputs)
kept = np.linalg.solve(square, seen.T @ done).T.ravel()
size, spread, proposed = len(kept), 0.01, None

# %% [markdown]
# Then many that are like it are tried at once. The mean of those that did better is proposed, and takes the
# place of the one that is kept where it does better than it on the next seed, too.

# %%
while time.perf_counter() - begin < seconds:
    tried = kept + spread * drawn.normal(size=(worlds, size))
    tried[0] = kept
    if proposed is not None:
        tried[1] = proposed
    score = returns(tried, 1000 + generation)
    if proposed is not None and score[1] > score[0]:
        kept = proposed
    order = np.argsort(score)[-best:]
    proposed = tried[order[score[order] >= score[0]]].mean(axis=0)
    generation += 1
    print(f"{time.perf_counter() - begin:6.0f} s, generation {generation}: kept {score[0]:6.2f}, "
          f"mean {score.mean():6.2f}, best {score.max():6.2f}", flush=True)
if seconds == 0 and file:
    kept = np.load(file)
elif file:
    np.save(file, kept)

# %% [markdown]
# On seeds that it has not learned on, beside the policy written by hand and a random one.

# %%
def single(policy, seeds):
    env = envs.make("pedicel/Harvest-v0")
    env.action_space.seed(0)
    found, laid = [], 0
    for seed in seeds:
        observation, _ = env.reset(seed=seed)
        total, ended = 0.0, False
        while not ended:
            observation, reward, terminated, truncated, info = env.step(policy(env, observation))
            total, ended = total + reward, terminated or truncated
        found.append(total)
        laid += info["is_success"]
    return np.mean(found), laid


seeds = range(1, 6) if seconds >= 60 else range(1, 2)
results = {"learned": single(lambda env, o: actions(kept[None], o[None])[0], seeds),
           "by hand": single(lambda env, o: scripted.harvest(env.task), seeds),
           "random": single(lambda env, o: env.action_space.sample(), seeds)}
for name, (total, laid) in results.items():
    print(f"{name}: {total:.2f}, {laid} of {len(seeds)} laid down")
if seconds >= 60:
    assert results["learned"][0] > max(results["by hand"][0], results["random"][0])
