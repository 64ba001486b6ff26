import importlib.util
import json
import unittest

import numpy as np
from support import InFolder, bingham, program

import dashpot


def bench(currents=(0.0, 1.0), lag=0.0) -> dashpot.Recordings:
    recordings = dashpot.Recordings()
    for current in currents:
        t, x, v, i, force = bingham(current, samples=1000)
        noise = np.random.default_rng(int(10 * current)).normal(0, 5, len(force))
        recordings.add({"t_s": t, "x_m": x, "v [m/s]": v, "i [A]": i, "F_N": force + lag * x + noise}, name=f"{current} A")
    return recordings


class Numbers(InFolder):
    def test_parameters_and_covariance_travel_with_the_model(self):
        model = dashpot.identify(bench(), models=["bingham"], leave_out="blocks=3").best
        c0 = model.parameters["c0_a"]
        self.assertEqual(c0["unit"], "N*s/m")
        self.assertAlmostEqual(c0["value"], 1000, delta=20)
        self.assertLess(c0["low"], c0["value"])
        names = list(model.parameters)
        self.assertEqual(model.covariance.shape, (len(names), len(names)))
        np.testing.assert_array_equal(model.covariance, model.covariance.T)
        error = np.sqrt(model.covariance[names.index("c0_a"), names.index("c0_a")])
        self.assertAlmostEqual(c0["high"] - c0["value"], 1.96 * error, delta=1e-3 * error)

        # In its file, too; and a set of the literature has values alone.
        path = str(self.folder / "model.json")
        model.save(path)
        again = dashpot.load(path)
        self.assertEqual(again.parameters, model.parameters)
        np.testing.assert_array_equal(again.covariance, model.covariance)
        published = dashpot.published("spencer1997")
        self.assertIsNone(published.covariance)
        self.assertIsNone(next(iter(published.parameters.values()))["low"])

        # A fit that starts there.
        warm = dashpot.identify(bench(), models=["bingham"], leave_out="blocks=3", starts=1, start_from=[path])
        self.assertAlmostEqual(warm.best.parameters["c0_a"]["value"], c0["value"], delta=1)
        with self.assertRaisesRegex(dashpot.Error, "not among the models to fit"):
            dashpot.identify(bench(), models=["arctan"], leave_out="blocks=3", start_from=[path])

    def test_traces_are_what_evaluate_judges(self):
        model = dashpot.identify(bench(), models=["bingham"], leave_out="blocks=3").best
        traces = model.traces(bench())
        self.assertEqual(len(traces), 2)
        columns = traces[1]["columns"]
        left = columns["residual [N]"]
        np.testing.assert_allclose(left, columns["measured [N]"] - columns["modelled [N]"], atol=1e-9)
        report = model.evaluate(bench())
        self.assertEqual(report["records_seen"], 0)  # of files alone it can be told
        self.assertEqual(model.evaluate(bench(), keep_inertia=True), report)  # none was taken off
        self.assertAlmostEqual(np.sqrt(np.mean(left**2)), report["records"][1]["metrics"]["rmse_N"], places=3)
        if importlib.util.find_spec("matplotlib"):
            dashpot.plot.traces(traces).savefig(self.folder / "fit.png")
            self.assertGreater((self.folder / "fit.png").stat().st_size, 10000)
        else:
            with self.assertRaisesRegex(dashpot.Error, "python3-matplotlib"):
                dashpot.plot.traces(traces)


class Looks(InFolder):
    def setUp(self):
        super().setUp()
        for name, seed in (("before", 1), ("after", 2)):
            program("bench", "--motions", "20x0.5,20x1,20x2,20x4", "--levels", "0,1", "--cycles", "3",
                    "--sample-rate", "200", "--seed", seed, "--output", self.folder / name)

    def test_characterise_says_what_the_program_says(self):
        data = self.folder / "before"
        figures = dashpot.characterise(data, speeds=[0.1])
        self.assertEqual(figures, json.loads(program("characterise", data, "--speeds", "100", "--json")))
        self.assertIn("<html", dashpot.characterise(data, format="html"))
        self.assertIn("energy", dashpot.characterise(data, format="csv").splitlines()[0])
        with self.assertRaisesRegex(dashpot.Error, "above 0"):
            dashpot.characterise(data, speeds=[-1])
        with self.assertRaisesRegex(dashpot.Error, "json, html"):
            dashpot.characterise(data, format="pdf")
        if importlib.util.find_spec("matplotlib"):
            dashpot.plot.sheet(figures).savefig(self.folder / "sheet.png")

    def test_compare_takes_models_recordings_and_paths(self):
        before, after = self.folder / "before", dashpot.Recordings(self.folder / "after")
        found = dashpot.compare(before, after, names=["old", "new"])
        self.assertEqual([other["name"] for other in found["others"]], ["new"])
        model = dashpot.identify(before, models=["bingham"]).best
        model.save(str(self.folder / "bingham.json"))
        named = dashpot.compare(after, str(self.folder / "bingham.json"))
        held = dashpot.compare(after, model, names=["recordings 1", str(self.folder / "bingham.json")])
        self.assertEqual(named, held)
        self.assertIn("bingham", dashpot.compare(after, model, format="text"))
        with self.assertRaisesRegex(dashpot.Error, "two or more"):
            dashpot.compare(after)
        with self.assertRaisesRegex(dashpot.Error, "one each"):
            dashpot.compare(after, model, names=["one"])


if __name__ == "__main__":
    unittest.main()
