"""Interrupts and threads."""

import signal
import threading
import unittest

import clatter


class Interrupts(unittest.TestCase):
    def interrupt(self, action):
        """Runs an action that would take hours. Ctrl-C ends it."""
        signal.setitimer(signal.ITIMER_REAL, 0.3)
        with self.assertRaises(KeyboardInterrupt):
            action()

    def setUp(self):
        before = signal.signal(signal.SIGALRM, lambda *_: signal.raise_signal(signal.SIGINT))
        self.addCleanup(signal.signal, signal.SIGALRM, before)

    def check(self, gas):
        """The gas has run to some time, and has the bits of an uninterrupted run."""
        at = gas.time
        self.assertTrue(0.0 < at < 1e9)
        other = clatter.load("vibrated")
        other.run_until(at + 1.0)
        gas.run_until(at + 1.0)
        self.assertEqual(gas.hash, other.hash)

    def test_ctrl_c_halts_a_run(self):
        gas = clatter.load("vibrated")
        self.interrupt(lambda: gas.run_until(1e9))
        self.check(gas)

    def test_ctrl_c_halts_a_measurement(self):
        gas = clatter.load("vibrated", measure__series_interval=1000.0)
        self.interrupt(lambda: gas.measure(duration=1e8))
        self.check(gas)

    def test_a_handler_cannot_use_a_gas_in_motion(self):
        gas = clatter.load("vibrated")

        def handler(*_):
            with self.assertRaisesRegex(clatter.RunError, "busy"):
                gas.positions
            raise KeyboardInterrupt

        signal.signal(signal.SIGALRM, handler)
        self.interrupt(lambda: gas.run_until(1e9))
        self.check(gas)


class Threads(unittest.TestCase):
    def test_gases_in_threads_have_the_bits_of_a_gas_alone(self):
        seeds = range(1, 5)
        alone = {}
        together = {}
        errors = []

        def run(hashes, seed):
            try:
                gas = clatter.load("vibrated", seed=seed, measure__burn_in=20)
                for frame in gas.frames(1.0, 10.0):
                    frame.draw(48)
                result = gas.measure(duration=30.0)
                hashes[seed] = (gas.hash, result["temperature"]["mean"])
            except Exception as error:
                errors.append(error)

        for seed in seeds:
            run(alone, seed)
        threads = [threading.Thread(target=run, args=(together, seed)) for seed in seeds]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(errors, [])
        self.assertEqual(alone, together)
        self.assertEqual(len({state for state, _ in alone.values()}), 4)

    def test_python_runs_beside_a_gas(self):
        gas = clatter.load("vibrated")
        began = threading.Event()

        def run():
            began.set()
            # Without the lock of Python, the main thread reads the gas while it is in motion.
            gas.run_until(5e3)

        thread = threading.Thread(target=run)
        thread.start()
        began.wait()
        refused = 0
        while thread.is_alive():
            try:
                gas.time
            except clatter.RunError:
                refused += 1
        thread.join()
        self.assertGreater(refused, 0)
        self.assertEqual(gas.time, 5e3)


if __name__ == "__main__":
    unittest.main()
