"""Results and pictures are those of the program."""

import subprocess
import unittest
from pathlib import Path

import numpy as np

import clatter
from program import DISKS_TOML, SPHERES_TOML, Folder


class Results(unittest.TestCase):
    def setUp(self):
        self.folder = Folder()
        self.addCleanup(self.folder.cleanup)

    def same(self, found, expected):
        self.assertEqual(list(found), list(expected))
        for result in (found, expected):
            self.assertGreater(result.pop("performance")["peak_memory_bytes"], 0)
        self.maxDiff = None
        self.assertEqual(found, expected)

    def test_a_measurement_is_the_result_of_the_program(self):
        for name, text in (("disks", DISKS_TOML), ("spheres", SPHERES_TOML)):
            path = self.folder.write(name + ".toml", text)
            gas = clatter.load(path, seed=2)
            self.same(gas.measure(), self.folder.measure(path, "--seed", 2))
            self.assertEqual(gas.time, 21.0)

    def test_the_duration_is_a_key_of_the_scene(self):
        gas = clatter.load("vibrated", particles__count=40)
        words = ["--set", "particles.count=40", "--set", "measure.duration=30"]
        self.same(gas.measure(duration=30), self.folder.measure("vibrated", *words))

    def test_a_measurement_leaves_no_trace(self):
        path = self.folder.write("s.toml", DISKS_TOML)
        measured, other = clatter.load(path), clatter.load(path)
        # The change of gravity at t = 3.3 restarts the averages.
        for start, end in ((3.3, 21.0), (21.0, 41.0)):
            result = measured.measure()
            self.assertEqual(result["time"]["burn_in"], start)
            self.assertAlmostEqual(result["time"]["measured"], end - start, places=12)
            self.assertEqual(measured.time, end)
        other.run_until(41.0)
        self.assertEqual(measured.hash, other.hash)

    def test_a_measurement_needs_a_positive_duration(self):
        gas = clatter.load("vibrated")
        with self.assertRaises(clatter.SceneError):
            gas.measure(duration=-1.0)
        with self.assertRaises(clatter.SceneError):
            clatter.load("vibrated", measure__series_interval=1e-9).measure()
        self.assertEqual(gas.time, 0.0)


class Events(unittest.TestCase):
    def setUp(self):
        self.folder = Folder()
        self.addCleanup(self.folder.cleanup)

    def test_events_are_the_event_log_of_the_program(self):
        for name, text in (("disks", DISKS_TOML), ("spheres", SPHERES_TOML)):
            path = self.folder.write(name + ".toml", text)
            result = self.folder.measure(path, "--seed", 2, "--events", name + ".csv")
            log = np.genfromtxt(
                Path(self.folder.name, name + ".csv"), delimiter=",", names=True, skip_header=1
            )
            gas = clatter.load(path, seed=2)
            # The gravity of the disks changes during the first call.
            self.assertLess(3.3, log["time"][29])
            parts = [gas.events(30), gas.events(len(log) - 30)]
            self.assertEqual(gas.time, parts[1]["time"][-1])
            events = np.concatenate(parts)
            columns = set()
            for field in events.dtype.names:
                if events[field].ndim == 1:
                    np.testing.assert_array_equal(events[field], log[field])
                    columns.add(field)
                else:
                    for axis, letter in zip(range(events[field].shape[1]), "xyz"):
                        column = f"{field}_{letter}"
                        np.testing.assert_array_equal(events[field][:, axis], log[column])
                        columns.add(column)
            self.assertEqual(columns, set(log.dtype.names))
            self.assertEqual(events["kind"].dtype, np.int64)
            gas.run_until(21.0)
            self.assertEqual(gas.hash, result["state_hash"])

    def test_flat_events_have_the_columns_of_the_csv(self):
        for name, text in (("disks", DISKS_TOML), ("spheres", SPHERES_TOML)):
            path = self.folder.write(name + ".toml", text)
            self.folder.measure(path, "--events", name + ".csv")
            log = np.genfromtxt(
                Path(self.folder.name, name + ".csv"), delimiter=",", names=True, skip_header=1
            )
            events = clatter.load(path).events(len(log), flat=True)
            self.assertEqual(events.dtype.names, log.dtype.names)
            for column in log.dtype.names:
                np.testing.assert_array_equal(events[column], log[column])
            self.assertEqual(events["partner"].dtype, np.int64)

    def test_flat_events_are_a_table_of_pandas(self):
        try:
            import pandas
        except ImportError:
            self.skipTest("this test needs pandas")
        events = clatter.load("vibrated").events(50, flat=True)
        table = pandas.DataFrame(events)
        self.assertEqual(list(table), list(events.dtype.names))
        self.assertEqual(len(table), 50)
        np.testing.assert_array_equal(table["velocity_after_y"], events["velocity_after_y"])

    def test_a_gas_without_collisions_has_no_events(self):
        gas = clatter.load({"title": "T", "box": {"size": [9, 8]}, "particles": {"count": 1}})
        with self.assertRaisesRegex(clatter.RunError, "only 0 of 1 collisions occur"):
            gas.events(1)
        with self.assertRaises(clatter.SceneError):
            gas.events(0)


class Pictures(unittest.TestCase):
    def pixels(self, folder, file):
        raw = subprocess.run(
            ["ffmpeg", "-v", "error", "-i", Path(folder.name, file),
             "-f", "rawvideo", "-pix_fmt", "rgba", "-"],
            capture_output=True, check=True,
        ).stdout
        return np.frombuffer(raw, np.uint8)

    def test_a_picture_is_the_picture_of_the_program(self):
        with_field = DISKS_TOML + '[view]\nfield = "temperature"\n'
        for name, text in (("disks", with_field), ("spheres", SPHERES_TOML)):
            folder = Folder()
            self.addCleanup(folder.cleanup)
            path = folder.write(name + ".toml", text)
            gas = clatter.load(path)
            gas.run_until(12.0)
            picture = gas.draw(width=320)
            self.assertEqual((picture.dtype, picture.shape[1:]), (np.dtype("uint8"), (320, 4)))
            self.assertGreater(picture[..., :3].std(), 10.0)
            size = f"320x{picture.shape[0]}"
            folder.clatter("render", path, "--to", 12, "--size", size, "--out", "p.png")
            np.testing.assert_array_equal(picture.ravel(), self.pixels(folder, "p.png"))

    def test_the_height_follows_the_box(self):
        gas = clatter.load("cooling", box__size=[40, 20], particles__count=20)
        self.assertEqual(gas.draw(width=200).shape, (100, 200, 4))
        self.assertEqual(gas.draw().shape, (320, 640, 4))
        with self.assertRaises(clatter.SceneError):
            gas.draw(width=3)

    def test_a_picture_changes_no_gas(self):
        gas, other = clatter.load("vibrated"), clatter.load("vibrated")
        for frame in gas.frames(1.0, 3.0):
            frame.draw(64)
        other.run_until(3.0)
        self.assertEqual(gas.hash, other.hash)


if __name__ == "__main__":
    unittest.main()
