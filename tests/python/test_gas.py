"""The states of a gas: the bits of the program, changes of laws, errors."""

import copy
import csv
import multiprocessing
import pickle
import unittest
from pathlib import Path

import numpy as np

import clatter
from program import DISKS, DISKS_TOML, MIXTURE, MIXTURE_TOML, SPHERES_TOML, Folder


class Runs(unittest.TestCase):
    def setUp(self):
        self.folder = Folder()
        self.addCleanup(self.folder.cleanup)

    def test_a_gallery_scene_has_the_hash_of_the_program(self):
        gas = clatter.load("vibrated", seed=3, set={"particles.count": 50})
        gas.run_until(30.0)
        result = self.folder.measure(
            "vibrated", "--seed", 3, "--set", "particles.count=50", "--until", 30
        )
        self.assertEqual(gas.hash, result["state_hash"])
        self.assertEqual(gas.time, 30.0)
        self.assertEqual(gas.seed, 3)

    def test_settings_of_the_caller_stay_the_same(self):
        laws = {"particles.restitution": 0.7}
        clatter.load("vibrated", set=laws, particles__count=20)
        self.assertEqual(laws, {"particles.restitution": 0.7})

    def test_a_list_that_contains_itself_is_an_error(self):
        size = []
        size.append(size)
        with self.assertRaises(RecursionError):
            clatter.load("vibrated", set={"box.size": size})

    def test_a_late_measurement_has_only_its_own_samples(self):
        gas = clatter.load("cradle", measure__series_interval=1e-4, measure__burn_in=0.0)
        gas.run_until(2000.0)
        result = gas.measure(duration=0.125)
        self.assertEqual(result["time"]["measured"], 0.125)

    def test_a_mixture_has_the_particles_of_the_program(self):
        path = self.folder.write("s.toml", MIXTURE_TOML)
        self.folder.measure(path, "--until", 3, "--save-state", "end.csv", "--events", "e.csv")
        with open(Path(self.folder.name, "end.csv"), encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        gas = clatter.load(MIXTURE)
        gas.run_until(3.0)
        self.assertEqual(gas.species.tolist(), [row["species"] for row in rows])
        self.assertEqual(gas.diameters.tolist(), [float(row["diameter"]) for row in rows])
        self.assertEqual(gas.masses.tolist(), [float(row["mass"]) for row in rows])
        self.assertEqual(gas.positions[:, 0].tolist(), [float(row["x"]) for row in rows])
        # By hand: diameters at the shares 1/8, 3/8, 5/8, 7/8, and masses 6 (d/2)^2.
        large = gas.species == "large"
        np.testing.assert_allclose(np.sort(gas.diameters[large]), [1.7, 1.9, 2.1, 2.3], rtol=1e-14)
        np.testing.assert_allclose(gas.masses[large], 1.5 * gas.diameters[large] ** 2, rtol=1e-14)
        self.assertEqual(gas.masses[~large].tolist(), [0.2] * 12)
        self.assertEqual(gas.species.dtype.kind, "U")
        again = pickle.loads(pickle.dumps(gas))
        self.assertEqual(again.species.tolist(), gas.species.tolist())

    def test_events_of_a_mixture_have_names(self):
        gas = clatter.load(MIXTURE)
        for flat in (False, True):
            events = gas.events(200, flat=flat)
            self.assertEqual(events.dtype.names[-2:], ("species", "partner_species"))
            species = gas.species.tolist() + [""]  # of a wall, whose number is -1
            self.assertEqual(events["species"].tolist(), [species[k] for k in events["particle"]])
            self.assertEqual(
                events["partner_species"].tolist(), [species[k] for k in events["partner"]]
            )
            self.assertEqual(set(events["partner_species"]), {"small", "large", ""})

    def test_particles_without_species_have_the_diameter_and_mass_1(self):
        gas = clatter.load(DISKS)
        self.assertEqual(gas.diameters.tolist(), [1.0] * 7)
        self.assertEqual(gas.masses.tolist(), [1.0] * 7)
        self.assertEqual(gas.masses.dtype, np.float64)
        self.assertIsNone(gas.species)
        self.assertNotIn("species", gas.events(5).dtype.names)

    def test_a_path_a_dict_and_keywords_describe_the_same_gas(self):
        path = self.folder.write("s.toml", DISKS_TOML)
        hashes = set()
        for gas in (
            clatter.load(path, particles__restitution=0.7),
            clatter.load(Path(path), seed=1, set={"particles.restitution": np.float64(0.7)}),
            clatter.load(DISKS, set={"particles": {**DISKS["particles"], "restitution": 0.7}}),
        ):
            gas.run_until(10.0)
            hashes.add(gas.hash)
        result = self.folder.measure(path, "--set", "particles.restitution=0.7", "--until", 10)
        self.assertEqual(hashes, {result["state_hash"]})

    def test_frames_have_the_numbers_of_the_trajectory(self):
        for text, dimension in ((DISKS_TOML, 2), (SPHERES_TOML, 3)):
            path = self.folder.write("s.toml", text)
            self.folder.measure(
                path, "--seed", 4, "--until", 6, "--trajectory", "t.csv", "--every", 0.1
            )
            with open(Path(self.folder.name, "t.csv"), encoding="utf-8") as file:
                rows = list(csv.DictReader(file))
            axes = "xyz"[:dimension]
            omegas = [name for name in rows[0] if name.startswith("omega")]
            self.assertEqual(len(omegas), {2: 1, 3: 3}[dimension])
            gas = clatter.load(path, seed=4)
            count = len(gas.positions)
            self.assertEqual(gas.spins.shape, {2: (count,), 3: (count, 3)}[dimension])
            frames = 0
            for frame in gas.frames(every=0.1, until=6.0):
                self.assertIs(frame, gas)
                part = rows[frames * count : (frames + 1) * count]
                read = lambda names: np.array([[float(row[n]) for n in names] for row in part])
                np.testing.assert_array_equal(gas.positions, read(axes))
                np.testing.assert_array_equal(gas.velocities, read(["v" + a for a in axes]))
                np.testing.assert_array_equal(gas.spins.reshape(count, -1), read(omegas))
                self.assertEqual(gas.time, float(part[0]["time"]))
                frames += 1
            self.assertEqual(frames, 61)
            self.assertEqual(frames * count, len(rows))

    def test_frames_begin_at_the_time_of_the_gas(self):
        gas = clatter.load("cooling")
        gas.run_until(0.25)
        self.assertEqual([frame.time for frame in gas.frames(0.1, 0.55)], [0.3, 0.4, 0.5])

    def test_arrays_are_copies(self):
        gas = clatter.load("cooling")
        positions = gas.positions
        self.assertEqual((positions.dtype, positions.ndim), (np.dtype("float64"), 2))
        positions[:] = 0.0
        self.assertTrue(gas.positions.any())
        self.assertIsNone(gas.spins)

    def test_the_temperature_is_the_mean_square_speed(self):
        gas = clatter.load("vibrated")
        gas.run_until(5.0)
        self.assertAlmostEqual(gas.temperature, np.mean(gas.velocities**2), places=12)


class Changes(unittest.TestCase):
    def test_set_is_a_change_of_the_scene(self):
        for laws in ({"gravity.acceleration": [0.3, 0.1]}, {"particles.restitution": 0.5}):
            planned = clatter.load({**DISKS, "change": [{"time": 7.3, "set": laws}]})
            planned.run_until(20.0)
            by_hand = clatter.load({**DISKS, "change": []})
            by_hand.run_until(7.3)
            by_hand.set(laws)
            by_hand.run_until(20.0)
            self.assertEqual(by_hand.hash, planned.hash)
            self.assertEqual(by_hand.scene, planned.scene)

    def test_a_refused_change_keeps_the_laws(self):
        gas, other = clatter.load("vibrated"), clatter.load("vibrated")
        for laws in ({"box.size": [30, 30]}, {"particles.restitution": 2.0}, {"walls.top": 1}):
            with self.assertRaises(clatter.SceneError):
                gas.set(laws)
        gas.run_until(3.0)
        other.run_until(3.0)
        self.assertEqual(gas.hash, other.hash)
        self.assertEqual(gas.scene, other.scene)


class Errors(unittest.TestCase):
    def words(self, kind, action, *arguments, **keywords):
        with self.assertRaises(kind) as raised:
            action(*arguments, **keywords)
        return str(raised.exception)

    def test_errors_of_the_user_have_the_words_of_the_program(self):
        self.assertTrue(issubclass(clatter.SceneError, ValueError))
        folder = Folder()
        self.addCleanup(folder.cleanup)
        bad = folder.write("bad.toml", DISKS_TOML.replace("0.9", "9.0"))
        for scene, settings in (("nowhere", {}), (bad, {}), ("vibrated", {"particles.cuont": 3})):
            flags = [f"--set={key}={value}" for key, value in settings.items()]
            words = self.words(clatter.SceneError, clatter.load, scene, set=settings)
            self.assertEqual("clatter: " + words, folder.clatter("check", scene, *flags))

    def test_a_value_has_a_type_of_the_scene(self):
        words = self.words(TypeError, clatter.load, "vibrated", particles__count=None)
        self.assertIn("NoneType", words)

    def test_text_is_unicode_and_file_names_are_bytes(self):
        self.words(UnicodeEncodeError, clatter.load, "vibrated", title="\ud800")
        self.words(UnicodeEncodeError, clatter.load, "\ud800")
        for name in ("\udcff.toml", b"\xff.toml"):
            words = self.words(clatter.SceneError, clatter.load, name)
            self.assertIn("\udcff.toml: there is no such scene;", words)

    def test_time_runs_forward(self):
        gas = clatter.load("cooling")
        gas.run_until(2.0)
        self.assertIn("already at t = 2;", self.words(clatter.SceneError, gas.run_until, 1.0))
        self.words(clatter.SceneError, gas.run_until, float("nan"))
        self.words(clatter.SceneError, gas.run_until, float("inf"))
        self.words(clatter.SceneError, gas.frames, 0.0, 5.0)
        gas.run_until(2.0)

    def test_a_collapsed_gas_continues_under_other_laws(self):
        self.assertTrue(issubclass(clatter.PhysicalStop, RuntimeError))
        scene = {
            "title": "T", "box": {"size": [20, 20]},
            "particles": {"count": 150, "restitution": 0.1}, "walls": {},
        }
        gas = clatter.load(scene)
        words = self.words(clatter.PhysicalStop, gas.run_until, 1e6)
        self.assertIn("inelastic collapse", words)
        at = gas.time
        self.assertTrue(0.0 < at < 1e6)
        gas.set({"particles.restitution": 1.0})
        gas.run_until(at + 0.01)
        self.assertEqual(gas.time, at + 0.01)


class Copies(unittest.TestCase):
    def copies(self, gas):
        yield copy.copy(gas)
        yield copy.deepcopy({"gas": gas})["gas"]
        yield pickle.loads(pickle.dumps(gas))

    def check(self, scene):
        """A copy has the state, the pictures and the future of the gas."""
        gas = clatter.load(scene, seed=5)
        gas.run_until(1.7)
        gas.set({"particles.restitution": 0.8})
        for copied in self.copies(gas):
            for later in (gas.time, 4.0):  # after the change of the scene
                same = clatter.load(scene, seed=5)
                same.run_until(1.7)
                same.set({"particles.restitution": 0.8})
                same.run_until(later)
                copied.run_until(later)
                self.assertEqual(copied.hash, same.hash)
                self.assertEqual((copied.time, copied.seed), (later, 5))
                self.assertEqual(copied.scene, same.scene)
                np.testing.assert_array_equal(copied.draw(width=100), same.draw(width=100))
        self.assertEqual(gas.time, 1.7)

    def test_copies_have_the_same_future(self):
        for view in ({}, {"field": "temperature"}, {"trails": 0.5}):
            with self.subTest(view=view):
                self.check({**DISKS, "view": view})

    def test_a_copy_of_a_gas_from_a_file_has_its_particles(self):
        folder = Folder()
        self.addCleanup(folder.cleanup)
        folder.write("two.csv", "x,y,vx,vy\n1,1,1,0\n3,1,-1,0.5\n")
        path = folder.write(
            "s.toml",
            'title = "T"\nbox.size = [4, 4]\n'
            'particles.start = { layout = "file", file = "two.csv" }\n',
        )
        gas = clatter.load(path)
        copied = pickle.loads(pickle.dumps(gas))
        copied.run_until(20.0)
        gas.run_until(20.0)
        self.assertEqual(copied.hash, gas.hash)
        self.assertEqual(copied.scene, gas.scene)

    def test_a_change_of_a_copy_stays_in_the_copy(self):
        gas = clatter.load(DISKS)
        copied = copy.copy(gas)
        copied.set({"particles.restitution": 0.5})
        self.assertEqual(gas.scene["particles"]["restitution"], 0.9)
        self.assertEqual(len(gas.scene["change"]), 1)
        gas.set({"particles.restitution": 0.7})
        self.assertEqual(copied.scene["change"][1]["set"], {"particles.restitution": "0.5"})
        self.assertEqual(gas.scene["change"][1]["set"], {"particles.restitution": "0.7"})

    def test_damaged_pickles_are_refused(self):
        saved = pickle.dumps(clatter.load(DISKS))
        for place in (len(saved) // 4, len(saved) // 2):
            damaged = saved[:place] + bytes([saved[place] ^ 1]) + saved[place + 1 :]
            with self.assertRaises(clatter.SceneError):
                pickle.loads(damaged)


def draw_into(pipe):
    try:
        pipe.send(clatter.load("cooling").draw(width=100).shape[1])
    except clatter.RunError as error:
        pipe.send(str(error))


class Forks(unittest.TestCase):
    def test_a_forked_process_draws_or_raises(self):
        clatter.load("cooling").draw(width=100)
        ours, theirs = multiprocessing.Pipe()
        child = multiprocessing.get_context("fork").Process(target=draw_into, args=(theirs,))
        child.start()
        self.addCleanup(child.kill)
        self.assertTrue(ours.poll(60), "the child neither draws nor raises")
        answer = ours.recv()
        self.assertTrue(answer == 100 or "forked" in answer)
        child.join()


if __name__ == "__main__":
    unittest.main()
