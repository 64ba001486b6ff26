import copy
import pickle
import threading
import unittest
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
from support import InFolder, program, recording

import dashpot


class Prediction(unittest.TestCase):
    """Every way to give the same numbers gives the same force, bit for bit."""

    def setUp(self):
        self.model = dashpot.published("spencer1997_bouc_wen")
        self.X = np.array(recording(1.0)[0])
        self.force = self.model.predict(self.X)

    def test_columns_need_no_copy_whatever_their_strides(self):
        wide = np.zeros((len(self.X), 9))
        wide[:, 1:9:2] = self.X
        for X in (self.X[:, 1:], np.asfortranarray(self.X), wide[:, 1:9:2], self.X[::-1][::-1]):
            np.testing.assert_allclose(self.model.predict(X, 0.005), self.force, rtol=1e-12)

    def test_other_numbers_are_converted(self):
        whole = np.array([[0, 0, 1], [0, 1, 1], [0, 2, 1]])
        for X in (whole, whole.tolist(), whole.astype(np.float32), whole.astype(">f8")):
            np.testing.assert_array_equal(self.model.predict(X, 0.01), self.model.predict(whole.astype(float), 0.01))

    def test_what_is_no_number_is_refused(self):
        for X in ([["a", "b"]], np.array([[1j, 2j]]), np.array([[None, 1]]), [[1, 2], [3]]):
            with self.assertRaises((TypeError, ValueError)):
                self.model.predict(X, 0.01)

    def test_masked_samples_are_refused(self):
        X = np.ma.masked_array(self.X, mask=np.zeros_like(self.X))
        np.testing.assert_array_equal(self.model.predict(X), self.force)
        X[3, 2] = np.ma.masked
        with self.assertRaisesRegex(TypeError, "masked"):
            self.model.predict(X)
        with self.assertRaisesRegex(TypeError, "masked"):
            self.model.run(X[:, 2], X[:, 3], X[:, 1], time=X[:, 0])

    def test_separate_columns_and_values_that_stay(self):
        t, x, v, _ = self.X.T
        np.testing.assert_array_equal(self.model.run(v, 1.0, x, time=t), self.force)
        np.testing.assert_array_equal(self.model.run(v, np.broadcast_to(1.0, len(v)), x, time=t), self.force)

    def test_steps_and_parts_give_the_whole(self):
        state = self.model.rest(self.X[0, 1], self.X[0, 3])
        self.assertEqual(state.shape, (self.model.state_size,))
        for k in range(1, 50):
            self.model.advance(state, self.X[k - 1, 1:], self.X[k, 1:], self.X[k, 0] - self.X[k - 1, 0])
        self.assertEqual(self.model.force(state, self.X[49, 1:]), self.force[49])
        t, x, v, i = self.X.T
        state = self.model.rest(x[0], i[0])
        first = self.model.run(v[:60], i[:60], x[:60], time=t[:60], state=state)
        then = self.model.run(v[59:], i[59:], x[59:], time=t[59:], state=state)
        np.testing.assert_array_equal(np.concatenate([first, then[1:]]), self.force)

    def test_no_samples_give_no_force(self):
        self.assertEqual(self.model.predict(np.empty((0, 3)), 0.01).shape, (0,))


class WrongUse(unittest.TestCase):
    def setUp(self):
        self.model = dashpot.published("spencer1997_bouc_wen")

    def refusal(self, kind, call, *arguments, **options):
        with self.assertRaises(kind) as caught:
            call(*arguments, **options)
        return str(caught.exception)

    def test_messages_say_what_would_be_right(self):
        X = np.zeros((3, 3))
        self.assertIn("wrong shape", self.refusal(ValueError, self.model.predict, np.zeros((3, 5)), 0.1))
        self.assertIn("wrong shape", self.refusal(ValueError, self.model.predict, np.zeros(3), 0.1))
        self.assertIn("sample_time", self.refusal(dashpot.Error, self.model.predict, X))
        self.assertIn("needs it", self.refusal(dashpot.Error, self.model.predict, X[:, 1:], 0.1))
        X[1, 1] = np.nan
        self.assertIn("velocity[1]: is nan", self.refusal(dashpot.Error, self.model.predict, X, 0.1))
        self.assertIn("no band", self.refusal(dashpot.Error, self.model.predict, X, 0.1, interval=True))
        self.assertIn("did you mean", self.refusal(dashpot.Error, dashpot.published, "spenser1997"))
        self.assertIn("nowhere", self.refusal(dashpot.Error, dashpot.load, "/nowhere.json"))
        self.assertIn("samples", self.refusal(ValueError, self.model.run, np.zeros(3), np.zeros(4)))

    def test_states_are_checked(self):
        for state in (np.zeros(7), np.zeros(1, np.float32), [0.0], np.zeros((1, 1)), None):
            with self.assertRaises((ValueError, TypeError)):
                self.model.force(state, (0, 0, 0))
        fixed = self.model.rest()
        fixed.flags.writeable = False
        with self.assertRaises(ValueError):
            self.model.advance(fixed, (0, 0, 0), (0, 0, 0), 0.1)
        with self.assertRaises(dashpot.NotUsable):
            self.model.force(np.array([np.nan]), (0, 0.1, 0))


class Keeping(InFolder):
    def test_a_model_is_not_made_by_itself(self):
        for make in (dashpot.DamperModel, lambda: dashpot.DamperModel.__new__(dashpot.DamperModel)):
            with self.assertRaisesRegex(TypeError, "load"):
                make()

    def test_files_pickles_and_copies_are_the_same_model(self):
        model = dashpot.published("spencer1997")
        path = Path(self.folder) / "model.json"
        model.save(path)
        for other in (dashpot.load(path), dashpot.load(str(path)), pickle.loads(pickle.dumps(model)), copy.deepcopy(model)):
            self.assertEqual(other.to_json(), model.to_json())
        self.assertEqual((model.name, model.kind, model.drive_unit), ("modified_bouc_wen", "law", "V"))
        self.assertEqual(model.domain["current"], (0.0, 2.25))
        self.assertIn("modified_bouc_wen", repr(model))

    def test_exports_are_the_program_s(self):
        model = dashpot.published("vrths_mr_tanh_kwok")
        model.save(str(self.folder / "model.json"))
        files = model.export(["c", "dpr"], self.folder / "ours", name="front", precision="float", sample_time=0.002)
        program("export", "model.json", "--to", "c,dpr", "--name", "front", "--precision", "float", "--sample-time", "2ms",
                "-o", "theirs", cwd=self.folder)
        self.assertEqual({Path(file).name for file in files}, {file.name for file in (self.folder / "theirs").iterdir()})
        for file in map(Path, files):
            ours, theirs = (
                [line for line in path.read_text().splitlines() if "export" not in line]  # the command differs
                for path in (file, self.folder / "theirs" / file.name)
            )
            self.assertEqual(ours, theirs)

    def test_exports_that_cannot_be_write_nothing(self):
        model = dashpot.published("vrths_mr_bingham")
        for options in ({"to": "fmu4"}, {"to": []}, {"to": "c", "name": "2fast"}, {"to": "c", "precision": "half"},
                        {"to": "c", "sample_time": -1}, {"to": ["c", "fmu3"], "compiler": "no-such-compiler"}):
            with self.assertRaises(dashpot.Error):
                model.export(folder=self.folder / "out", **options)
        with self.assertRaises(TypeError):
            model.export("c", speed=1)
        self.assertFalse((self.folder / "out").exists())


class Threads(unittest.TestCase):
    def test_others_run_during_a_long_prediction(self):
        """A thread counts while the library computes: with the lock held it could not."""
        model = dashpot.published("spencer1997_bouc_wen")
        X = np.tile([[0.01, 0.1, 1.0]], (2_000_000, 1))
        ticks, done = [], threading.Event()
        ticker = threading.Thread(target=lambda: [ticks.append(1) for _ in iter(lambda: done.wait(0.002), True)])
        ticker.start()
        before = len(ticks)
        model.predict(X, 0.001)
        during = len(ticks) - before
        done.set()
        ticker.join()
        self.assertGreater(during, 3)

    def test_a_model_serves_several_threads(self):
        model = dashpot.published("spencer1997")
        t = 1e-3 * np.arange(5000)
        X = np.column_stack([0.01 * np.sin(20 * t), 0.2 * np.cos(20 * t), 1 + np.sin(3 * t)])
        expected = model.predict(X, 0.001)
        with ThreadPoolExecutor(4) as pool:
            for force in pool.map(lambda _: model.predict(X, 0.001), range(8)):
                np.testing.assert_array_equal(force, expected)


if __name__ == "__main__":
    unittest.main()
