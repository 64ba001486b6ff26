import ast
import copy
import os
import shutil
import signal
import subprocess
import sys
import textwrap
import threading
import unittest
import warnings
from pathlib import Path

import numpy as np
from support import PROJECT, InFolder, bingham, recording

import dashpot
from dashpot import _core


def bench(currents=(0.0, 0.5, 1.0)) -> dashpot.Recordings:
    recordings = dashpot.Recordings()
    for current in currents:
        t, x, v, i, force = bingham(current)
        recordings.add({"t_s": t, "x_mm": 1000 * x, "v [m/s]": v, "i [A]": i, "F_N": force}, name=f"{current} A")
    return recordings


class RecordingsInMemory(unittest.TestCase):
    def test_columns_are_read_as_a_file_would_be(self):
        recordings = bench()
        self.assertEqual(len(recordings), 3)
        one = recordings[-1]
        self.assertEqual(one["name"], "1.0 A")
        np.testing.assert_allclose(one["columns"]["displacement [m]"], bingham(1.0)[1], rtol=1e-12)
        self.assertIn("x_mm", recordings.describe())
        with self.assertRaises(IndexError):
            recordings[3]

    def test_without_current_the_drive_is_one_unknown_constant(self):
        recordings = dashpot.Recordings()
        t, _, v, _, force = bingham(1.0)
        recordings.add({"t_s": t, "v [m/s]": v, "F_N": force}, name="public")
        ranking = dashpot.identify(recordings, models=["bingham"], leave_out="blocks=3")
        self.assertEqual(ranking.best.drive_unit, "")
        self.assertNotIn("varies", str(ranking))
        step = t[1] - t[0]
        for current in (0.0, 7.0):
            predicted = ranking.best.predict(np.column_stack([v, np.full_like(v, current)]), sample_time=step)
            self.assertLess(np.std(predicted - force), 0.05 * np.std(force))
        with self.assertRaisesRegex(dashpot.Error, "needs a displacement|has no displacement"):
            dashpot.identify(recordings, models=["bingham", "tanh_kwok"], leave_out="blocks=3")
        with self.assertRaisesRegex(dashpot.Error, "the recordings before it have no current or voltage"):
            recordings.add({"t_s": t, "v [m/s]": v, "F_N": force, "i [A]": 0 * v}, name="driven")

    def test_views_outlive_the_recordings_and_cannot_be_written(self):
        view = bench()[0]["columns"]["force [N]"]
        np.testing.assert_array_equal(view, bingham(0.0)[4])
        with self.assertRaises(ValueError):
            view[0] = 1

    def test_numpy_numbers_are_options(self):
        t, x, v, i, force = bingham(0.5)
        table = {"t_s": t, "v [m/s]": v, "i [A]": i, "F_N": force}
        dashpot.Recordings().add(table, conditions={"gap": np.float32(1e-3)})
        self.assertEqual(len(dashpot.identify(bench(), "bingham", seed=np.int64(3))), 1)

    def test_what_is_no_table_says_what_would_be_right(self):
        t, x, v, i, force = bingham(0.5)
        table = {"t_s": t, "v [m/s]": v, "i [A]": i, "F_N": force}
        with self.assertRaisesRegex(TypeError, r"one table is no path: Recordings\(\).add\(table\)"):
            dashpot.identify(table, "bingham")
        with self.assertRaisesRegex(dashpot.Error, "no name tells a channel .there are left, right"):
            dashpot.Recordings().add({"left": t, "right": x})
        with self.assertRaisesRegex(TypeError, "table is a ndarray; a DataFrame, or a dict of arrays"):
            dashpot.Recordings().add(np.column_stack([t, x]))
        with self.assertRaisesRegex(TypeError, "sample_time is no number: '5ms'"):
            dashpot.Recordings().add(table, sample_time="5ms")
        dates = np.datetime64("2024-01-01") + (1000 * t).astype("timedelta64[ms]")
        with self.assertRaisesRegex(TypeError, "t_s holds datetime64.*; seconds as numbers"):
            dashpot.Recordings().add({**table, "t_s": dates})

    def test_wrong_tables_are_refused(self):
        t, x, v, i, force = bingham(0.0)
        for table in ({"F": force}, {}, {"t": t, "x": x, "F": force[:-1], "i": i}):
            with self.assertRaises(ValueError):
                dashpot.Recordings().add(table, sample_time=0.005)
        with self.assertRaisesRegex(dashpot.Error, "there already"):
            bench().add({"t": t, "x": x, "F": force, "i": i}, name="0.5 A")
        with self.assertRaisesRegex(dashpot.Error, "nowhere"):
            dashpot.Recordings("/nowhere")

    def test_what_is_no_recording_says_what_would_be_right(self):
        with self.assertRaisesRegex(TypeError, "recording '0.5 A': they are counted by whole numbers"):
            bench()["0.5 A"]
        with self.assertRaisesRegex(TypeError, "recordings: is a int; Recordings, a path, or a list of paths"):
            dashpot.compare(bench(), 3)


class Identification(InFolder):
    def test_a_law_from_a_file(self):
        law = PROJECT / "examples" / "laws" / "my_tanh.yaml"
        ranking = dashpot.identify(bench(), models=[str(law), "tanh_kwok"], leave_out="blocks=3")
        errors = ranking.report["models"]
        self.assertEqual({model["name"] for model in errors}, {"my_tanh", "tanh_kwok"})
        self.assertEqual(errors[0]["left_out"], errors[1]["left_out"])
        with self.assertRaisesRegex(dashpot.Error, "is neither a model nor the file of a law"):
            dashpot.identify(bench(), models=["my_tanh.txt"])

    def test_budget(self):
        ranking = dashpot.identify(bench(), budget=1e-6, starts=1)
        self.assertEqual(len(ranking), 1)
        self.assertIn("passive_network", " ".join(model["name"] for model in ranking.untried))
        self.assertGreaterEqual(ranking.untried[-1]["budget_minutes"], ranking.untried[0]["budget_minutes"])
        self.assertEqual(dashpot.identify(bench(), "bingham", budget=1e-6, starts=1).untried, [])

    def test_ranking(self):
        told = []
        ranking = dashpot.identify(
            bench(), "bingham,polynomial", "current", starts=1, progress=lambda stage, share: told.append((stage, share))
        )
        self.assertEqual(ranking.best.name, "bingham")
        self.assertAlmostEqual(ranking.best.force(ranking.best.rest(), (0, 0.2, 0.5)), 700, places=4)
        self.assertEqual(ranking.report["models"][0]["left_out"]["pooled"]["samples"], 400)
        self.assertTrue(told)
        force, half_width = ranking.best.predict(recording(0.5)[0], interval=True)
        self.assertEqual(force.shape, half_width.shape)
        self.assertIn("Bingham", str(ranking))
        self.assertEqual(ranking.leaders[0], "bingham")
        ratio = ranking.report["models"][1]["over_first"]
        self.assertLessEqual(ratio["low"], ratio["times"])
        ranking.save_report(str(self.folder / "report.html"))
        self.assertIn("<html", (self.folder / "report.html").read_text())
        with self.assertRaises(dashpot.Error):
            ranking.save_report("report.pdf")

    def test_a_rate_that_nobody_said_is_told(self):
        model = dashpot.identify(bench(), "bingham", "current", starts=1).best
        X = recording(0.5)[0]
        with self.assertWarnsRegex(UserWarning, "rows are taken as 0.005 s apart, as in the model's fit"):
            force = model.predict(X[:, 1:])
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            np.testing.assert_array_equal(model.predict(X[:, 1:], sample_time=0.005), force)
            np.testing.assert_allclose(model.predict(X), force)

    def test_a_file_that_cannot_be_read_is_told(self):
        (self.folder / "data").mkdir()
        X, y = recording(0.5)
        rows = [f"{t},{x},{i},{f}" for (t, x, _, i), f in zip(X, y)]
        for name, torn in ("good", rows[60]), ("torn", "0.3,0,1,"):
            lines = ["t_s,x_m,i_A,F_N"] + rows[:60] + [torn] + rows[61:]
            (self.folder / "data" / f"{name}.csv").write_text("\n".join(lines))
        with self.assertWarnsRegex(UserWarning, "not read: .*torn.csv:62"):
            recordings = dashpot.Recordings(self.folder / "data")
        self.assertEqual(len(recordings), 1)
        model = dashpot.identify(recordings, models=["bingham"], leave_out="blocks=3", starts=1).best
        with self.assertWarnsRegex(UserWarning, "has seen 1 of 1 records: these errors are no judgement"):
            self.assertEqual(model.evaluate(recordings)["records_seen"], 1)

    def test_what_speaks_against_a_recording_is_warned_of(self):
        t, x, v, i, _ = bingham(0.5)
        force = 500 * np.tanh(v / 0.05) + 1000 * v
        recordings = dashpot.Recordings()
        with self.assertWarnsRegex(UserWarning, "suspect: sizes: the force has one sign whichever way"):
            recordings.add({"t_s": t, "x_m": x, "i_A": i, "F_N": np.abs(force)}, name="sizes")
        self.assertIn("suspect: the force has one sign", recordings.describe())
        np.savetxt(self.folder / "run.csv", np.c_[t, 1000 * x, i, force], delimiter=",", header="t_s,x,i_A,F_N", comments="")
        with self.assertWarnsRegex(UserWarning, "suspect: run: the displacement .* is its unit m right"):
            dashpot.Recordings(self.folder)

    def test_a_gap_in_time_ends_a_recording(self):
        X, y = recording(0.5)
        t, x, v, i = X.T
        table = {"time": t + 2 * (t > 1), "displacement": x, "velocity": v, "current": i, "force": y}
        single = {name: samples.astype(np.float32) for name, samples in table.items()}
        for columns in (table, single):
            data = dashpot.Recordings().add(columns)
            self.assertEqual([data[k]["name"] for k in range(len(data))],
                             ["recording 1, stretch 1", "recording 1, stretch 2"])
            self.assertEqual([data[k]["sample_time"] for k in range(len(data))], [0.005, 0.005])

    def test_options_that_cannot_be(self):
        for options in ({"models": "bingam"}, {"starts": 0}, {"fix": "alpha=1"}, {"leave_out": "everything"}):
            with self.assertRaises(dashpot.Error):
                dashpot.identify(bench(), **{"models": "bingham", **options})
        with self.assertRaises(TypeError):
            dashpot.identify(bench(), "bingham", start=1)

    def test_an_exception_of_the_progress_function_stops_the_work(self):
        def refuse(stage, share):
            raise KeyError(stage)

        with self.assertRaises(KeyError):
            dashpot.identify(bench(), "modified_bouc_wen", starts=1000, progress=refuse)

    def test_other_threads_run_meanwhile(self):
        ticks, done = [], threading.Event()
        ticker = threading.Thread(target=lambda: [ticks.append(1) for _ in iter(lambda: done.wait(0.002), True)])
        ticker.start()
        dashpot.identify(bench(), "tanh_kwok", starts=2)
        done.set()
        ticker.join()
        self.assertGreater(len(ticks), 5)

    def test_ctrl_c_interrupts(self):
        script = textwrap.dedent("""
            import signal, sys
            sys.path.insert(0, %r)
            from test_identify import bench
            import dashpot
            # A shell has whatever it starts in the background ignore Ctrl+C, these tests too.
            signal.signal(signal.SIGINT, signal.default_int_handler)
            try:
                dashpot.identify(bench(), "modified_bouc_wen", starts=100000,
                                 progress=lambda *_: print("at work", flush=True))
            except KeyboardInterrupt:
                print("interrupted", flush=True)
        """) % os.path.dirname(__file__)
        child = subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE, text=True)
        self.addCleanup(child.kill)
        self.assertEqual(child.stdout.readline(), "at work\n")
        child.send_signal(signal.SIGINT)
        self.assertIn("interrupted", child.communicate(timeout=60)[0])
        self.assertEqual(child.returncode, 0)


class Estimator(unittest.TestCase):
    def setUp(self):
        self.X, self.y = zip(*(recording(current) for current in (0.0, 0.5, 1.0)))
        self.X, self.y = list(self.X), list(self.y)

    def test_fit_predict_score(self):
        identifier = dashpot.Identifier("bingham", starts=1).fit(self.X, self.y)
        self.assertGreater(identifier.score(self.X, self.y), 1 - 1e-12)
        np.testing.assert_allclose(identifier.predict(self.X[1]), self.y[1], rtol=1e-6)
        self.assertEqual(len(identifier.predict(self.X)), 3)
        self.assertEqual(identifier.report_["status"], "converged")
        self.assertGreater(identifier.model_.score(self.X[0], self.y[0]), 1 - 1e-12)

    def test_a_constant_force_has_the_score_of_scikit_learn(self):
        identifier = dashpot.Identifier("bingham", starts=1).fit(self.X, self.y)
        still = np.array([[k / 200, 0.0, 0.0, 0.5] for k in range(100)])
        force = np.asarray(identifier.predict(still))
        self.assertEqual(np.ptp(force), 0)
        self.assertEqual(identifier.score(still, np.full(100, force[0])), 1)
        for other in (force[0] + 8, 0.1):  # whose mean over the samples is, and is not, quite the same number
            self.assertEqual(identifier.score(still, np.full(100, other)), 0)

    def test_gaps_in_time_begin_a_new_recording(self):
        X, y = self.X[2], self.y[2]
        kept = np.r_[0:150, 250:400]
        data = dashpot.Identifier().recordings(X[kept], y[kept])
        self.assertEqual([len(data[k]["columns"]["force [N]"]) for k in range(len(data))], [150, 150])
        self.assertEqual(len(dashpot.Identifier(sample_time=0.005).recordings(X[:, 1:], y)), 1)

    def test_parameters(self):
        identifier = dashpot.Identifier("arctan", seed=3)
        self.assertEqual(dashpot.Identifier(**identifier.get_params()).get_params(), identifier.get_params())
        self.assertEqual(identifier.set_params(seed=4).seed, 4)
        self.assertEqual(repr(identifier), "Identifier(model='arctan', seed=4)")
        with self.assertRaises(ValueError):
            identifier.set_params(seeds=4)

    def test_wrong_use(self):
        with self.assertRaisesRegex(dashpot.Error, "not fitted"):
            dashpot.Identifier().predict(self.X[0])
        with self.assertRaisesRegex(dashpot.Error, "samples"):
            dashpot.Identifier().fit(self.X[0], self.y[0][:-1])
        with self.assertRaisesRegex(dashpot.Error, "recordings"):
            dashpot.Identifier().fit(self.X, self.y[:-1])
        with self.assertRaisesRegex(dashpot.Error, "drive_unit: is 'mA'; 'A' or 'V'"):
            dashpot.Identifier(drive_unit="mA").fit(self.X[0], self.y[0])
        with self.assertRaisesRegex(dashpot.Error, "y has 0 dimensions; one force per sample"):
            dashpot.Identifier().fit(self.X[0], None)

    def test_scikit_learn(self):
        try:
            from sklearn.base import clone
            from sklearn.model_selection import GridSearchCV, KFold, cross_val_score
        except ImportError:
            self.skipTest("SKIPPED: scikit-learn is not here")
        identifier = dashpot.Identifier("bingham", starts=1, threads=1)
        copied = clone(identifier)
        self.assertIsNot(copied, identifier)
        self.assertEqual(copied.get_params(), identifier.get_params())
        search = GridSearchCV(identifier, {"model": ["polynomial", "bingham"]}, cv=KFold(3), error_score="raise")
        self.assertEqual(search.fit(self.X, self.y).best_params_, {"model": "bingham"})
        self.assertGreater(min(cross_val_score(identifier, self.X, self.y, cv=KFold(3))), 0.9)
        # Rows of one array: what is cut out of the middle leaves a gap in time.
        search.fit(self.X[2], self.y[2])
        self.assertEqual(search.best_params_, {"model": "bingham"})
        self.assertEqual(copy.deepcopy(search.best_estimator_).model_.name, "bingham")


class Frames(unittest.TestCase):
    def setUp(self):
        try:
            import pandas
        except ImportError:
            self.skipTest("SKIPPED: pandas is not here")
        t, x, v, i, self.force = bingham(1.0)
        self.frame = pandas.DataFrame(
            {"t [ms]": 1000 * t, "x_mm": 1000 * x, "velocity": v, "current [A]": i, "operator": "Jo"}, index=t + 10
        )
        self.pandas = pandas

    def test_in_and_out(self):
        force = self.pandas.Series(self.force, index=self.frame.index)
        identifier = dashpot.Identifier("bingham", starts=1).fit(self.frame, force)
        predicted = identifier.predict(self.frame)
        self.assertTrue(predicted.index.equals(self.frame.index))
        self.assertEqual(predicted.name, "force [N]")
        np.testing.assert_allclose(predicted, self.force, rtol=1e-6)
        self.assertGreater(identifier.score(self.frame, force), 1 - 1e-12)
        recordings = dashpot.Recordings().add(self.frame.assign(F_N=self.force))
        self.assertIn("velocity [m/s]", recordings.frame(0).columns)

    def test_nullable_columns_are_numbers_and_others_are_named(self):
        model = dashpot.published("vrths_mr_bingham")
        nullable = self.frame.drop(columns="operator").convert_dtypes()
        self.assertNotIsInstance(nullable["current [A]"].dtype, np.dtype)
        np.testing.assert_array_equal(model.predict(nullable), model.predict(self.frame))
        with self.assertRaisesRegex(TypeError, "column 'x_mm' holds object, not real numbers"):
            model.predict(self.frame.assign(x_mm=self.frame["x_mm"].astype(str)))

    def test_columns_that_are_missing_are_named(self):
        model = dashpot.published("spencer1997_bouc_wen")
        with self.assertRaisesRegex(dashpot.Error, "no column is voltage"):
            model.predict(self.frame)
        with self.assertRaisesRegex(dashpot.Error, "no column is velocity"):
            model.predict(self.frame.drop(columns="velocity"))


class Vehicles(unittest.TestCase):
    def test_a_model_drives(self):
        damper = dashpot.published("vrths_mr_tanh_kwok")
        trace = dashpot.simulate(dampers=damper, road="step,height=3cm", duration=0.5)
        self.assertEqual(len(trace["body"]), len(trace["time"]))
        self.assertAlmostEqual(trace["time [s]"][-1], 0.5)
        self.assertIn("step", repr(trace))
        with self.assertRaises(KeyError):
            trace["wing"]
        with self.assertRaisesRegex(dashpot.Error, "gravel"):
            dashpot.simulate(road="gravel")
        with self.assertRaisesRegex(dashpot.Error, "duration: is nan; finite numbers"):
            dashpot.simulate(duration=float("nan"))
        for nothing in (None, [damper, 3]):
            with self.assertRaisesRegex(TypeError, "dampers: is a .*; a DamperModel or a damper's words"):
                dashpot.simulate(dampers=nothing)


class Stubs(InFolder):
    def test_the_stub_file_has_every_name_of_the_compiled_module(self):
        tree = ast.parse((PROJECT / "bindings/python/dashpot/_core.pyi").read_text())
        stated = {node.name: node for node in tree.body if isinstance(node, (ast.ClassDef, ast.FunctionDef))}
        for name in [name for name in dir(_core) if not name.startswith("__")]:
            self.assertIn(name, stated)
            if not isinstance(getattr(_core, name), type) or issubclass(getattr(_core, name), Exception):
                continue
            members = {node.name for node in stated[name].body if isinstance(node, ast.FunctionDef)}
            for member in [member for member in vars(getattr(_core, name)) if not member.startswith("_")]:
                self.assertIn(member, members, f"{name}.{member}")

    def test_docstrings(self):
        for owner in [dashpot, *(one for one in vars(dashpot).values() if isinstance(one, type))]:
            for name, member in vars(owner).items():
                if not name.startswith("_") and callable(member) or isinstance(member, property):
                    self.assertTrue(member.__doc__, f"{owner.__name__}.{name}")

    def test_types(self):
        """mypy reads the package and the examples without a finding, and finds what is wrong."""
        if not shutil.which("mypy"):
            self.skipTest("SKIPPED: mypy is not here")
        wrong = self.folder / "wrong.py"
        wrong.write_text(textwrap.dedent("""
            import dashpot
            model = dashpot.published("spencer1997")
            force, half_width = model.predict([[0.0, 1.0]], interval=True)
            model.predict([[0.0, 1.0]], intervals=True)
            width: str = force.size
        """))
        examples = [*(PROJECT / "examples/python").glob("*.py")]
        checked = subprocess.run(
            ["mypy", "--cache-dir", os.devnull, "--ignore-missing-imports", *examples, wrong], capture_output=True,
            text=True, env={**os.environ, "MYPYPATH": str(Path(dashpot.__file__).parents[1])})
        found = [line for line in checked.stdout.splitlines() if "error:" in line]
        self.assertEqual(len(found), 2, checked.stdout + checked.stderr)
        self.assertRegex(found[0], "wrong.py:5.*No overload variant")
        self.assertRegex(found[1], "wrong.py:6.*Incompatible types in assignment")


if __name__ == "__main__":
    unittest.main()
