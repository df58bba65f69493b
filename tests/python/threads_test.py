"""Python's other threads go on while a simulation steps."""

import os
import signal
import threading
import time
import unittest

import pedicel
from given import PULL_UP, Case


class ThreadsTest(Case):
    def test_other_threads_go_on_while_it_steps(self):
        sim = pedicel.Simulation(PULL_UP)
        counts, ends = [], threading.Event()

        def count():
            while not ends.is_set():
                counts.append(time.perf_counter())
                time.sleep(0.001)

        thread = threading.Thread(target=count)
        thread.start()
        begin = time.perf_counter()
        sim.step(400)
        end = time.perf_counter()
        ends.set()
        thread.join()
        during = [t for t in counts if begin < t < end]
        # With the interpreter's lock held the thread would get through once at most.
        self.assertGreater(len(during), 10, f"in {end - begin:.3f} s")

    def test_two_simulations_on_two_threads(self):
        alone = pedicel.Simulation(PULL_UP)
        alone.step(100)
        sims = [pedicel.Simulation(PULL_UP) for _ in range(2)]
        threads = [threading.Thread(target=sim.step, args=(100,)) for sim in sims]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual([sim.state_hash for sim in sims], [alone.state_hash] * 2)

    def test_calls_on_one_simulation_wait_for_each_other(self):
        alone, sim = pedicel.Simulation(self.scene), pedicel.Simulation(self.scene)
        alone.step(400)
        threads = [threading.Thread(target=sim.step, args=(100,)) for _ in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual((sim.steps, sim.state_hash), (400, alone.state_hash))

    def test_whoever_reads_while_it_begins_anew_comes_to_no_harm(self):
        sim, ends, faults = pedicel.Simulation(PULL_UP), threading.Event(), []

        def read():
            try:
                while not ends.is_set():
                    sim.quantities(), sim.events, sim.state_hash, sim.parameters, sim.gentleness
                    sim.tool_jacobian(), sim.joint_lower, sim.time, sim.steps, sim.camera_names
                    sim.set_joint_velocities({sim.joint_names[0]: 0.1})
            except Exception as fault:  # the thread's own would be lost
                faults.append(fault)

        threads = [threading.Thread(target=read) for _ in range(2)]
        for thread in threads:
            thread.start()
        for _ in range(5):
            sim.step(5)
            sim.reset(seed=3)
        ends.set()
        for thread in threads:
            thread.join()
        self.assertEqual(faults, [])

    def forked(self, task):
        """What a child says that was forked off, and its exit code; it has a minute."""
        here, there = os.pipe()
        child = os.fork()
        if child == 0:
            os.close(here)
            try:
                os.write(there, str(task()).encode())
            except pedicel.UsageError as fault:
                os.write(there, b"refused: " + str(fault).encode())
            finally:
                os.close(there)
                os._exit(0)
        os.close(there)
        watch = threading.Timer(60, os.kill, (child, signal.SIGKILL))
        watch.start()
        with os.fdopen(here, "rb") as pipe:
            said = pipe.read().decode()
        code = os.waitpid(child, 0)[1]
        watch.cancel()
        return said, code

    def test_a_fork_hangs_nowhere(self):
        single = pedicel.Simulation(self.scene)
        worlds, many = pedicel.Worlds(self.scene, 2, threads=2), pedicel.Simulation(self.scene, threads=2)
        single.step(5), many.step(5), worlds.step(5)
        pictures = True
        try:
            single.render(width=16, height=16)
        except pedicel.NoPictures:
            pictures = False

        def steps():
            single.step(20)
            return single.state_hash

        said = self.forked(steps)
        self.assertEqual(said, (steps(), 0))
        for task in (lambda: worlds.step(1), lambda: worlds[0].step(1), lambda: many.step(1), lambda: worlds.reset()):
            said, code = self.forked(task)
            self.assertEqual(code, 0)
            self.assertIn("before a fork", said)
        # They can be let go of, and others can be made.
        self.assertEqual(self.forked(lambda: [worlds.threads, globals().update(w=pedicel.Worlds(self.scene, 2, threads=2)),
                                              globals()["w"].step(3)][0]), ("2", 0))
        if pictures:
            said, code = self.forked(lambda: single.render(width=16, height=16).shape)
            self.assertEqual(code, 0)
            self.assertIn("forked off one that has drawn", said)

    def test_ctrl_c_ends_many_worlds(self):
        worlds = pedicel.Worlds(self.scene, 2)
        timer = threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT))
        timer.start()
        with self.assertRaises(KeyboardInterrupt):
            worlds.step(100000000)
        timer.join()
        self.assertEqual(worlds[0].steps, worlds[1].steps)
        alone = pedicel.Simulation(self.scene, threads=1)
        alone.step(worlds[0].steps)
        self.assertEqual(alone.state_hash, worlds[0].state_hash)

    def test_ctrl_c_ends_a_long_call(self):
        sim = pedicel.Simulation(PULL_UP)
        timer = threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT))
        timer.start()
        with self.assertRaises(KeyboardInterrupt):
            sim.step(1000000)
        timer.join()
        self.assertGreater(sim.steps, 0)
        steps, now = sim.steps, sim.state_hash
        other = pedicel.Simulation(PULL_UP)
        other.step(steps)
        self.assertEqual(other.state_hash, now)


if __name__ == "__main__":
    unittest.main()
