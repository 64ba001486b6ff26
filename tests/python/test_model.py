import copy
import pickle
import unittest

import numpy as np
from support import InFolder, recording

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
    def test_files_pickles_and_copies_are_the_same_model(self):
        model = dashpot.published("spencer1997")
        path = str(self.folder / "model.json")
        model.save(path)
        for other in (dashpot.load(path), pickle.loads(pickle.dumps(model)), copy.deepcopy(model)):
            self.assertEqual(other.to_json(), model.to_json())
        self.assertEqual((model.name, model.kind, model.drive_unit), ("modified_bouc_wen", "law", "V"))
        self.assertEqual(model.domain["current"], (0.0, 2.25))
        self.assertIn("modified_bouc_wen", repr(model))


if __name__ == "__main__":
    unittest.main()
