"""The contract of Gymnasium's environment checker, and what the tasks promise."""

import shutil
import subprocess
import sys
import unittest
import unittest.mock
import warnings

import numpy as np

import pedicel
from pedicel import envs
from pedicel.envs import scripted

NAMES = list(envs.registry)

#: A program that looks at its own window.
SHOWN = """
import numpy as np
from pedicel import envs

env = envs.make("pedicel/Probe-v0", render_mode="human")
env.reset(seed=1)
env.step(np.zeros(env.action_space.shape))
window = env._window
window.root.update()
size = f"{window.label.winfo_width() - 2}x{window.label.winfo_height() - 2}"
shown = window.image.get(320, 240)
same = tuple(shown) == tuple(env.task.picture(640, 480)[240, 320])
env.close()
print(size, "the same," if same else f"another {shown},", "gone" if env._window is None else "there")
"""


def turned(before, after):
    """The way from one turn to another (quaternions x y z w), rad, about the world's axes."""
    x, y, z, w = before * [-1, -1, -1, 1]
    a, b, c, d = after
    way = np.array([d * x + a * w + b * z - c * y, d * y - a * z + b * w + c * x, d * z + a * y - b * x + c * w])
    return 2 * way * np.sign(d * w - a * x - b * y - c * z)


class ContractTest(unittest.TestCase):
    """What gymnasium.utils.env_checker.check_env asks of an environment."""

    def environment(self, name, **options):
        env = envs.make(name, **options)
        self.addCleanup(env.close)
        return env

    def equal(self, a, b):
        if isinstance(a, dict):
            return a.keys() == b.keys() and all(self.equal(a[k], b[k]) for k in a)
        return np.array_equal(a, b)

    def test_every_step_tells_how_gentle_it_was(self):
        env = self.environment("pedicel/Reveal-v0")
        env.reset(seed=2)
        info = env.step(env.action_space.sample())[4]
        keys = {"peak_force", "impulse", "margin_used", "strain_energy", "touched", "broken"}
        self.assertEqual(set(info["gentleness"]), keys)
        self.assertEqual(info["gentleness"], env.simulation.gentleness_total)
        self.assertGreater(info["gentleness"]["margin_used"], 0)     # the fruit hangs on its stalk
        vector = envs.make_vec("pedicel/Reveal-v0", 2)
        self.addCleanup(vector.close)
        vector.reset(seed=2)
        told = vector.step(vector.action_space.sample())[4]["gentleness"]
        self.assertEqual(told["margin_used"].shape, (2,))
        self.assertTrue(np.all(told["margin_used"] > 0))

    def test_spaces_and_returns(self):
        for name in NAMES:
            for action in ("tool", "joint"):
                env = self.environment(name, action=action)
                self.assertIsInstance(env, envs.Env)
                self.assertIs(env.unwrapped, env)
                self.assertEqual((env.action_space.low.min(), env.action_space.high.max()), (-1, 1))
                result = env.reset(seed=4)
                self.assertEqual((type(result), len(result)), (tuple, 2))
                observation, info = result
                self.assertIn(observation, env.observation_space)
                self.assertIsInstance(info, dict)
                for _ in range(3):
                    observation, reward, terminated, truncated, info = env.step(env.action_space.sample())
                    self.assertIn(observation, env.observation_space)
                    self.assertTrue(np.all(np.isfinite(observation)))
                    self.assertIs(type(reward), float)
                    self.assertIs(type(terminated), bool)
                    self.assertIs(type(truncated), bool)
                    self.assertAlmostEqual(sum(info["reward_terms"].values()), reward)

    def test_the_same_seed_gives_the_same_episode(self):
        for name in NAMES:
            one, two = self.environment(name), self.environment(name)
            one.reset(seed=9)
            one.step(one.action_space.sample())
            episodes = []
            for env in (one, two):
                env.action_space.seed(5)
                steps = [env.reset(seed=123)[0]]
                for _ in range(8):
                    observation, reward, *_ = env.step(env.action_space.sample())
                    steps += [observation, np.array(reward)]
                episodes.append(steps)
            self.assertTrue(all(self.equal(a, b) for a, b in zip(*episodes)), name)
            drawn = one.task.settings
            one.reset(seed=124)
            self.assertNotEqual(one.task.settings, drawn, name)

    def test_a_reset_without_a_seed_goes_on_drawing(self):
        env = self.environment("pedicel/Probe-v0")
        truths = [env.reset(seed=1)[1]["youngs_modulus"]] + [
            env.reset()[1]["youngs_modulus"] for _ in range(3)]
        self.assertEqual(len(set(truths)), 4)
        again = [env.reset(seed=1)[1]["youngs_modulus"]] + [
            env.reset()[1]["youngs_modulus"] for _ in range(3)]
        self.assertEqual(truths, again)
        with self.assertRaises(Exception):
            env.reset(seed=-1)

    def test_options_take_the_place_of_what_varies(self):
        env = self.environment("pedicel/Probe-v0", vary=None)
        plain = env.reset(seed=1)[1]["youngs_modulus"]
        self.assertEqual(env.reset(seed=2)[1]["youngs_modulus"], plain)
        stiff = env.reset(seed=2, options={"settings": {"material.youngs_modulus": 4e8}})[1]
        self.assertAlmostEqual(stiff["youngs_modulus"], 4e8)
        varied = self.environment("pedicel/Probe-v0", vary={
            "material.youngs_modulus": {"distribution": "uniform", "low": 1e8, "high": 1.1e8}})
        self.assertTrue(1e8 <= varied.reset(seed=1)[1]["youngs_modulus"] < 1.1e8)

    def test_an_episode_is_truncated_when_its_time_is_up(self):
        env = self.environment("pedicel/Probe-v0")
        env.reset(seed=1)
        still = np.zeros(env.action_space.shape, dtype=np.float32)
        still[-1] = -1.0
        ends = [env.step(still)[2:4] for _ in range(100)]
        self.assertEqual(ends, [(False, False)] * 99 + [(False, True)])

    def test_wrong_actions_and_options_are_refused(self):
        env = self.environment("pedicel/Probe-v0")
        env.reset(seed=1)
        with self.assertRaisesRegex(ValueError, "shape"):
            env.step(np.zeros(3))
        for bad in ({"render_mode": "hologram"}, {"observation": "smell"}):
            with self.assertRaises(ValueError):
                envs.make("pedicel/Probe-v0", **bad)
        with self.assertRaises(pedicel.UsageError):
            envs.make("pedicel/Probe-v0", action="thought")
        with self.assertRaisesRegex(ValueError, "Harvest-v0"):
            envs.make("pedicel/Unknown-v0")

    def test_a_tool_twist_is_the_tools_velocity(self):
        env = self.environment("pedicel/Probe-v0", vary=None)
        for axis in range(6):
            env.reset(seed=1)
            action = np.zeros(env.action_space.shape, dtype=np.float32)
            action[axis], action[-1] = 0.4, -1.0
            for _ in range(2):                               # the motors come up to speed
                env.step(action)
            before = env.simulation.tool_pose.copy()
            env.step(action)
            after = env.simulation.tool_pose
            moved = (after[:3] - before[:3]) / env.task.period
            way = turned(before[3:], after[3:]) / env.task.period
            wanted = np.zeros(6)
            wanted[axis] = 0.4 * (env.task.control.reach if axis < 3 else env.task.control.turn)
            np.testing.assert_allclose(moved, wanted[:3], atol=0.012, err_msg=str(axis))
            np.testing.assert_allclose(way, wanted[3:], atol=0.05, err_msg=str(axis))

    def test_a_joint_action_is_its_speed(self):
        env = self.environment("pedicel/Harvest-v0", vary=None, action="joint")
        env.reset(seed=1)
        action = np.zeros(env.action_space.shape, dtype=np.float32)
        action[0], action[3], action[-1] = 0.5, -0.5, -1.0
        opening = env.simulation.joint_positions[env.simulation.gripper_joint]
        for _ in range(3):
            env.step(action)
        speeds = env.simulation.joint_velocities[env.task.control.arm]
        np.testing.assert_allclose(speeds, [0.3, 0, 0, -0.3, 0, 0], atol=0.02)
        shut = opening - env.simulation.joint_positions[env.simulation.gripper_joint]
        self.assertAlmostEqual(shut, 3 * env.task.period * env.task.control.grip, delta=0.002)

    def test_what_handling_costs_is_in_the_reward(self):
        env = self.environment("pedicel/Reveal-v0", gentleness={"peak_force": 0.5, "impulse": 2.0, "touched": 0.1})
        env.reset(seed=1)
        sums = dict.fromkeys(("peak_force", "impulse", "touched"), 0.0)
        for _ in range(25):
            _, reward, terminated, _, info = env.step(scripted.reveal(env.task))
            self.assertAlmostEqual(sum(info["reward_terms"].values()), reward)
            for name in sums:
                sums[name] += info["reward_terms"]["gentle_" + name]
        self.assertGreater(info["gentleness"]["peak_force"], 0)
        begun = env.task.handled                             # the whole of it since the reset
        for name, price in (("peak_force", 0.5), ("impulse", 2.0), ("touched", 0.1)):
            self.assertAlmostEqual(sums[name], -price * begun[name])
        for bad in ({"smell": 1.0}, {"impulse": -1.0}, {"impulse": float("nan")}):
            with self.assertRaisesRegex(ValueError, "gentleness"):
                envs.make("pedicel/Reveal-v0", gentleness=bad)

    def test_an_action_may_come_late(self):
        def speeds(latency):
            env = self.environment("pedicel/Harvest-v0", vary={
                "env.latency": {"distribution": "choice", "values": [latency]}}, action="joint")
            env.reset(seed=1)
            action = np.zeros(env.action_space.shape, dtype=np.float32)
            action[0] = 0.5
            found = []
            for _ in range(5):
                env.step(action)
                found.append(env.simulation.joint_velocities[env.task.control.arm[0]])
            return np.array(found)

        at_once, late, later = speeds(0.0), speeds(0.15), speeds(0.25)
        self.assertTrue(np.all(at_once > 0.2), at_once)
        self.assertLess(abs(late[0]), 0.02)
        self.assertGreater(late[1], 0.2)                     # since half of the second action
        self.assertTrue(np.all(np.abs(later[:2]) < 0.02) and later[2] > 0.2, later)
        for bad in (-0.1, 3.0, "soon"):
            env = self.environment("pedicel/Probe-v0")
            with self.assertRaisesRegex(pedicel.UsageError, "env.latency"):
                env.reset(seed=1, options={"settings": {"env.latency": bad}})

    def test_everything_may_vary(self):
        for name in NAMES:
            file = f"environments/{name[8:-3].lower()}_wide.vary.yaml"
            keys = pedicel.Variation.read(pedicel.asset(file)).keys
            for kind in ("material.", "shape.radius", "shape.length", "plants.", "coupling.friction", "env.latency",
                         "look.sun", "look.stem_hue", "cameras.", ".noise.latency"):
                self.assertTrue([k for k in keys if kind in k], (name, kind))
            env = self.environment(name, vary=file)
            vector = envs.make_vec(name, 2, vary=file)
            self.addCleanup(vector.close)
            both = vector.reset(seed=10)[0]
            starts = []
            for seed in range(10, 16):
                observation, _ = env.reset(seed=seed)
                if seed < 12:
                    self.assertTrue(np.array_equal(observation, both[seed - 10]), (name, seed))
                starts.append(observation)
                self.assertTrue(np.all(np.isfinite(env.step(env.action_space.sample())[0])))
            self.assertEqual(len({start.tobytes() for start in starts}), 6, name)
            # Worlds whose actions come late by different times have the bits of single ones, too.
            env.reset(seed=11)
            random = np.random.default_rng(3)
            for _ in range(5):
                actions = random.uniform(-1, 1, vector.action_space.shape).astype(np.float32)
                actions[:, -1] = -1.0
                together, alone = vector.step(actions), env.step(actions[1])
                self.assertTrue(np.array_equal(together[0][1], alone[0]), name)

    def test_plants_that_cannot_stand_are_drawn_again(self):
        soft = {"material.youngs_modulus": {"distribution": "choice", "values": [1e5, 5e8]}}
        env = self.environment("pedicel/Harvest-v0", vary=soft)
        drawn = []
        for seed in range(4):
            env.reset(seed=seed)
            drawn.append(float(env.task.settings["material.youngs_modulus"]))
        self.assertEqual(drawn, [5e8] * 4)
        never = {"material.youngs_modulus": {"distribution": "choice", "values": [1e5]}}
        env = self.environment("pedicel/Harvest-v0", vary=never)
        with self.assertRaises(pedicel.InvalidFile):
            env.reset(seed=1)

    def test_a_window_shows_the_picture(self):
        env = self.environment("pedicel/Probe-v0", render_mode="human")
        hidden = dict.fromkeys(["tkinter"])                  # as where python3-tk is not installed
        with unittest.mock.patch.dict(sys.modules, hidden):
            try:
                pedicel.Simulation(pedicel.asset("environments/probe.scene.yaml")).render(width=16, height=16)
            except pedicel.NoPictures as why:
                self.skipTest(str(why))
            with self.assertWarnsRegex(UserWarning, "python3-tk.*nothing is shown"):
                env.reset(seed=1)
            env.step(env.action_space.sample())              # once is enough
        if not shutil.which("xvfb-run"):
            self.skipTest("xvfb-run is not there")
        try:
            import tkinter
        except ImportError:
            self.skipTest("python3-tk is not there")
        run = subprocess.run(["xvfb-run", "-a", sys.executable, "-c", SHOWN], capture_output=True, text=True,
                             timeout=300)
        self.assertEqual((run.returncode, run.stdout.strip()), (0, "640x480 the same, gone"), run.stderr)
        del tkinter

    def test_pictures_are_observations(self):
        try:
            env = self.environment("pedicel/Reveal-v0", observation="mixed", render_mode="rgb_array",
                                   picture_size=(48, 36))
            observation, _ = env.reset(seed=1)
        except pedicel.NoPictures as why:
            self.skipTest(str(why))
        self.assertEqual(observation["picture"].shape, (36, 48, 3))
        self.assertIn(observation, env.observation_space)
        picture = env.render()
        self.assertEqual((picture.shape, picture.dtype), ((480, 640, 3), np.uint8))
        self.assertGreater(picture.std(), 5)
        only = self.environment("pedicel/Reveal-v0", observation="picture", picture_size=(48, 36))
        self.assertTrue(np.array_equal(only.reset(seed=1)[0], observation["picture"]))


class VectorTest(unittest.TestCase):
    def vector(self, name="pedicel/Probe-v0", count=3, **options):
        env = envs.make_vec(name, count, **options)
        self.addCleanup(env.close)
        return env

    def still(self, env):
        actions = np.zeros(env.action_space.shape, dtype=np.float32)
        actions[:, -1] = -1.0
        return actions

    def test_a_vector_is_single_environments(self):
        for name in NAMES:
            vector = self.vector(name)
            singles = [envs.make(name) for _ in range(3)]
            observations, _ = vector.reset(seed=20)
            self.assertEqual(observations.shape, vector.observation_space.shape)
            for w, env in enumerate(singles):
                self.assertTrue(np.array_equal(observations[w], env.reset(seed=20 + w)[0]), name)
            random = np.random.default_rng(2)
            for _ in range(6):
                actions = random.uniform(-1, 1, vector.action_space.shape).astype(np.float32)
                actions[:, -1] = -1.0
                observations, rewards, terminated, truncated, infos = vector.step(actions)
                for w, env in enumerate(singles):
                    one = env.step(actions[w])
                    self.assertTrue(np.array_equal(observations[w], one[0]), name)
                    self.assertEqual((rewards[w], terminated[w], truncated[w]), one[1:4])
                    self.assertEqual(infos["time"][w], one[4]["time"])
                    self.assertEqual(infos["reward_terms"].keys() - {"_" + k for k in one[4]["reward_terms"]},
                                     one[4]["reward_terms"].keys())
            self.assertTrue(infos["_time"].all())

    def say(self, env, world):
        actions = self.still(env)
        actions[world, -1] = 1.0
        return env.step(actions)

    def test_next_step(self):
        env = self.vector()
        self.assertIn("NextStep", str(env.metadata["autoreset_mode"]) + "NextStep")
        env.reset(seed=1)
        *_, terminated, _, infos = self.say(env, 1)
        self.assertEqual(list(terminated), [False, True, False])
        self.assertGreater(infos["time"][1], 0)
        observations, rewards, terminated, truncated, infos = env.step(self.still(env))
        self.assertEqual((rewards[1], terminated[1], truncated[1], infos["time"][1]), (0, False, False, 0))
        self.assertGreater(infos["time"][0], 0.15)
        self.assertAlmostEqual(env.step(self.still(env))[-1]["time"][1], 0.1, delta=0.01)

    def test_same_step(self):
        env = self.vector(autoreset="SameStep")
        env.reset(seed=1)
        observations, _, terminated, _, infos = self.say(env, 1)
        self.assertTrue(terminated[1])
        self.assertEqual(list(infos["_final_obs"]), [False, True, False])
        self.assertIsNone(infos["final_obs"][0])
        self.assertFalse(np.array_equal(infos["final_obs"][1], observations[1]))
        self.assertEqual(infos["time"][1], 0)
        self.assertGreater(infos["final_info"]["time"][1], 0)

    def test_disabled(self):
        env = self.vector(autoreset="Disabled")
        env.reset(seed=1)
        self.say(env, 1)
        with self.assertRaisesRegex(ValueError, "reset_mask"):
            env.step(self.still(env))
        before = env.worlds.positions.copy()
        _, infos = env.reset(options={"reset_mask": np.array([False, True, False])})
        self.assertEqual(list(infos["_time"]), [False, True, False])
        self.assertTrue(np.array_equal(before[0], env.worlds.positions[0]))
        env.step(self.still(env))
        self.assertAlmostEqual(env.worlds.times[0] - env.worlds.times[1], 0.1, delta=0.01)
        with self.assertRaises(ValueError):
            self.vector(autoreset="Sometimes")


class HarvestTest(unittest.TestCase):
    def test_a_led_hand_takes_the_fruit_and_lays_it_down(self):
        env = envs.make("pedicel/Harvest-v0", vary=None)
        env.reset(seed=1)
        total, info, ended = 0.0, {}, False
        while not ended:
            _, reward, terminated, truncated, info = env.step(scripted.harvest(env.task))
            total += reward
            ended = terminated or truncated
        self.assertTrue(info["is_success"], info)
        self.assertTrue(terminated)
        self.assertGreater(total, 10)

    def test_a_hand_that_does_nothing_gets_nothing(self):
        env = envs.make("pedicel/Harvest-v0", vary=None)
        env.reset(seed=1)
        total = sum(env.step(np.zeros(env.action_space.shape))[1] for _ in range(20))
        self.assertAlmostEqual(total, -0.2, delta=0.1)


class ProbeTest(unittest.TestCase):
    def test_the_truth_is_rewarded_most(self):
        env = envs.make("pedicel/Probe-v0")
        rewards = []
        for shift in (0.0, 0.3, 1.0):
            truth = env.reset(seed=3)[1]["youngs_modulus"]
            action = np.zeros(env.action_space.shape)
            low, high = env.task.low, env.task.high
            action[-2] = 2 * (np.log(truth / low) / np.log(high / low)) - 1 + shift
            action[-1] = 1.0
            _, reward, terminated, _, info = env.step(action)
            self.assertTrue(terminated)
            self.assertEqual(info["is_success"], shift == 0.0)
            rewards.append(reward)
        self.assertAlmostEqual(rewards[0], 4.99, delta=1e-3)
        self.assertGreater(rewards[0], rewards[1])
        self.assertGreater(rewards[1], rewards[2])

    def test_a_stiffer_stem_pushes_back_harder(self):
        forces = []
        for modulus in (2e7, 2e8):
            env = envs.make("pedicel/Probe-v0", vary=None)
            env.reset(seed=1, options={"settings": {"material.youngs_modulus": modulus}})
            action = np.zeros(env.action_space.shape)
            action[0], action[-1] = -0.4, -1.0  # towards the stem
            for _ in range(25):
                env.step(action)
            forces.append(np.linalg.norm(env.task.force()))
        self.assertGreater(forces[0], 0.01)
        self.assertGreater(forces[1], 3 * forces[0])


    def test_a_beam_says_it_within_a_third(self):
        for seed in range(3):
            env = envs.make("pedicel/Probe-v0")
            env.reset(seed=seed)
            terminated = False
            while not terminated:
                _, reward, terminated, _, info = env.step(scripted.probe(env.task))
            self.assertAlmostEqual(np.log(info["estimate"] / info["youngs_modulus"]), 0.0, delta=0.3)


class RevealTest(unittest.TestCase):
    def test_a_push_aside_reveals_it_more_often_than_chance(self):
        shown = {}
        for name in ("scripted", "random"):
            env = envs.make("pedicel/Reveal-v0")
            env.action_space.seed(1)
            totals = []
            for seed in range(4):
                env.reset(seed=seed)
                total, ended = 0.0, False
                while not ended:
                    action = scripted.reveal(env.task) if name == "scripted" else env.action_space.sample()
                    _, reward, terminated, truncated, info = env.step(action)
                    total += reward
                    ended = terminated or truncated
                totals.append(total)
            shown[name] = np.mean(totals)
        self.assertGreater(shown["scripted"], shown["random"] + 2.0, shown)

    def test_the_fruit_is_hidden_and_can_be_seen(self):
        env = envs.make("pedicel/Reveal-v0")
        for seed in range(4):
            info = env.reset(seed=seed)[1]
            self.assertLess(info["seen"], 0.5, seed)

    def test_a_force_on_what_hides_it_reveals_it(self):
        env = envs.make("pedicel/Reveal-v0", vary=None)
        before = env.reset(seed=1)[1]["seen"]
        env.simulation.set_force("bush/screen", [0, 1.5, 0], at=1.0)
        for _ in range(20):
            _, reward, terminated, _, info = env.step(np.zeros(env.action_space.shape))
        self.assertGreater(info["seen"], before + 0.3)


if __name__ == "__main__":
    warnings.simplefilter("error")
    unittest.main()
