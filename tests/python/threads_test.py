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
