import json
import unittest
import warnings
from pathlib import Path

import numpy as np
from support import InFolder, program

import dashpot

PLANT = {
    "plant": "oscillator",
    "parameters": {"mass": {"about": "90 kg", "from": "50 kg", "to": "200 kg"}, "damping": 0, "stiffness": "40 kN/m"},
    "inputs": [{"channel": "push", "kind": "force", "at": "mass"}],
    "sensors": [
        {"channel": "x", "quantity": "displacement", "at": "mass", "noise": "0.01 mm"},
        {"channel": "a", "quantity": "acceleration", "at": "mass", "noise": 0.01},
    ],
}


class InsideAPlant(InFolder):
    """From a virtual ride to the damper, its plant and its force, which no sensor showed."""

    def setUp(self):
        super().setUp()
        self.plant = self.folder / "plant.json"
        self.plant.write_text(json.dumps(PLANT))
        words = ["--damper", "kwok2006", "--duration", "4", "--push", "800", "--sample-rate", "200"]
        program("bench", "--in", self.plant, "--true", "mass=100kg", *words, "--output", self.folder / "rides")
        self.ride = self.folder / "rides" / "ride_1.csv"

    def table(self):
        names = self.ride.read_text().splitlines()[0].split(",")
        return dict(zip(names, np.loadtxt(self.ride, delimiter=",", skiprows=1).T))

    def test_identified_and_observed(self):
        fit = dashpot.identify_in_plant(self.ride, self.plant, "tanh_kwok", starts=4)
        mass = fit.parameters["mass"]
        self.assertAlmostEqual(mass["value"], 100, delta=2)
        self.assertLess(mass["low"], mass["value"])
        self.assertTrue(fit.advice["sensors"])
        self.assertEqual(fit.model.name, "tanh_kwok")

        # Arrays give what the file does, to the bit.
        same = dashpot.identify_in_plant(self.table(), PLANT, "tanh_kwok", starts=4)
        self.assertEqual(same.parameters["mass"]["value"], mass["value"])

        seen = dashpot.observe(fit.model, self.table(), fit.plant, force_error=[(20, 0.02)])
        force, half = seen["damper_force"]
        self.assertEqual(force.shape, (800,))
        self.assertTrue((half > 0).all())
        truth = np.loadtxt(self.folder / "rides" / "truth" / "ride_1.csv", delimiter=",", skiprows=1)[:, 1]
        self.assertLess(np.std(truth - force), 0.05 * np.std(truth))
        with self.assertRaises(KeyError):
            seen["damper_farce"]

        # In free run, the fit leaves what it left where it was fitted, to the time that it held back.
        run = dashpot.evaluate_in_plant(fit.model, self.table(), fit.plant)
        self.assertEqual(repr(run), "<dashpot.PlantRun of 1 rides>")
        sensor = fit.report["sensors"][0]
        self.assertAlmostEqual(run.error(sensor["sensor"]) / sensor["error_fitted"], 1, delta=0.3)
        self.assertIn("damper_force [N]", run.rides[0]["columns"])
        with self.assertRaises(KeyError):
            run.error("a sensor that is not there")

    def test_law_of_a_file(self):
        law = Path(__file__).parents[2] / "examples" / "laws" / "my_tanh.yaml"
        fit = dashpot.identify_in_plant(self.ride, self.plant, str(law), starts=2)
        self.assertEqual(fit.model.name, "my_tanh")

    def test_driven_as_found(self):
        car = {"unsprung_mass": "40 kg", "spring_stiffness": 2e4, "sprung_mass": 350, "tyre_stiffness": 2e5}
        found = {"plant": "quarter_car", "parameters": {**car, "sprung_mass": {"found": 350, "low": 340, "high": 360}},
                 "inputs": [{"channel": "road", "kind": "ground"}]}
        ride = {"dampers": "viscous,damping=1500", "road": "step,height=0.01", "duration": 1}
        words = [f"{name}={value}" for name, value in car.items()]
        driven = dashpot.simulate(found, **ride)
        same = dashpot.simulate("quarter_car", values=words, **ride)
        self.assertTrue((driven["body_acceleration"] == same["body_acceleration"]).all())

    def test_watched(self):
        def day(seed, *wear):
            words = ["--damper", "kwok2006", "--true", "mass=100kg", "--duration", "4", "--push", "800"]
            folder = self.folder / f"day_{seed}"
            program("bench", "--in", self.plant, *words, "--sample-rate", "200", "--seed", seed, *wear, "--output", folder)
            return folder / "ride_1.csv"

        plant = dict(PLANT, parameters=dict(PLANT["parameters"], mass="100 kg"), current="0 A")
        model = dashpot.published("kwok2006")
        choices = {"reference": 6, "false_alarms": 0.01}
        taught = dashpot.watch(model, [day(seed) for seed in range(1, 8)], plant, **choices)
        self.assertIsNone(taught.alarm)
        self.assertEqual(len(taught.days), 7)

        # The state as a file keeps it: the days before stand there, and the weak ones raise the alarm.
        state = json.loads(json.dumps(taught.state))
        weak = [day(seed, "--wear", "force=-0.3") for seed in range(20, 23)]
        faded = dashpot.watch(model, weak, plant, state=state, **choices)
        self.assertEqual(faded.days[:7], taught.days)
        self.assertEqual(faded.alarm["quantity"], "force")
        self.assertAlmostEqual(faded.alarm["fall"], 0.3, delta=0.06)
        with self.assertRaisesRegex(dashpot.Error, "is of another level"):
            dashpot.watch(model, weak, plant, state=state, level="x", **choices)

        # Names that tell another order are warned of.
        with warnings.catch_warnings(record=True) as said:
            warnings.simplefilter("always")
            later = [self.folder / "day_10.csv", self.folder / "day_2.csv"]
            for path in later:
                path.write_text(weak[0].read_text())
            told = dashpot.watch(model, later, plant, **choices)
        self.assertEqual(len(told.warnings), 1)
        self.assertIn("day_2.csv comes behind day_10.csv", str(said[0].message))

    def rig(self):
        return {
            "plant": "matrices",
            "coordinates": ["floor", "table"],
            "mass": [["100 kg", 0], [0, "60 kg"]],
            "stiffness": [["60 kN/m", "-20 kN/m"], ["-20 kN/m", "20 kN/m"]],
            "dampers": [
                {"name": "low", "from": "ground", "to": "floor"},
                {"name": "high", "from": "floor", "to": "table"},
            ],
            "inputs": [{"channel": "push", "kind": "force", "at": "floor", "noise": 1}],
            "sensors": [
                {"channel": "x", "quantity": "displacement", "at": "table", "noise": "0.01 mm"},
                {"channel": "a", "quantity": "acceleration", "at": "floor", "noise": 0.01},
            ],
            "voltage": "coil",
        }

    def test_two_dampers_watched(self):
        rig = dict(self.rig(), current="0 A")
        del rig["voltage"]
        plant = self.folder / "rig.json"
        plant.write_text(json.dumps(rig))
        days = []
        for day in range(1, 10):
            worn = ["--wear", "high_force=-0.3"] if day > 7 else []
            words = ["--damper", "kwok2006", "--duration", "4", "--push", "800", "--sample-rate", "200", "--seed", day]
            program("bench", "--in", plant, *words, *worn, "--output", self.folder / f"day_{day}")
            days.append(self.folder / f"day_{day}" / "ride_1.csv")
        model = dashpot.published("kwok2006")
        each = {"high": model, "low": model}
        told = dashpot.watch(each, days, rig, reference=6, false_alarms=0.01)
        self.assertEqual(told.alarm["quantity"], "high_force")
        self.assertAlmostEqual(told.alarm["fall"], 0.3, delta=0.06)
        self.assertEqual(told.report["dampers"], {"low": "tanh_kwok", "high": "tanh_kwok"})
        with self.assertRaisesRegex(dashpot.Error, "the damper 'low' has no model"):
            dashpot.watch({"high": model}, days, rig)
        with self.assertRaisesRegex(TypeError, "model: is a str"):
            dashpot.watch({"high": model, "low": "model.json"}, days, rig)

    def test_two_dampers(self):
        rig = self.rig()
        plant = self.folder / "rig.json"
        plant.write_text(json.dumps(rig))
        words = ["--damper", "spencer1997", "--levels", "1", "--duration", "2", "--push", "300", "--sample-rate", "200"]
        program("bench", "--in", plant, *words, "--output", self.folder / "both")
        ride = self.folder / "both" / "ride_1.csv"
        seen = dashpot.observe(dashpot.published("spencer1997"), ride, rig, force_error=[(5, 0.02)])
        truths = np.genfromtxt(self.folder / "both" / "truth" / "ride_1.csv", delimiter=",", names=True)
        for strut in ("low", "high"):
            force, half = seen[strut + "_damper_force"]
            column = next(name for name in truths.dtype.names if name.startswith(strut + "_damper_force"))
            error = (truths[column] - force)[100:]
            self.assertLess(np.std(error), 0.1 * np.std(truths[column]))
            self.assertTrue((half > 0).all())

    def test_two_kinds(self):
        rig = dict(self.rig(), damper_kinds={"new": "high", "old": "low"})
        plant = self.folder / "kinds.json"
        plant.write_text(json.dumps(rig))
        words = ["--damper", "spencer1997", "--levels", "1", "--duration", "3", "--push", "900", "--sample-rate", "200"]
        program("bench", "--in", plant, *words, "--wear", "low_force=-0.5", "--output", self.folder / "kinds")
        ride = self.folder / "kinds" / "ride_1.csv"
        fit = dashpot.identify_in_plant(ride, rig, "tanh_guo", starts=2)
        self.assertEqual(list(fit.models), ["new", "old"])
        self.assertIn("new.", next(iter(fit.parameters)))
        with self.assertRaisesRegex(ValueError, "are of 2 kinds: .models has new, old"):
            fit.model
        seen = dashpot.observe(fit.dampers, ride, fit.plant, force_error=[(20, 0.02)])
        force, half = seen["low_damper_force"]
        self.assertTrue((half > 0).all())

    def test_wrong_use(self):
        with self.assertRaisesRegex(dashpot.Error, "unknown law|tanh_quok"):
            dashpot.identify_in_plant(self.ride, self.plant, "tanh_quok")
        with self.assertRaisesRegex(dashpot.Error, "has no column 'push'"):
            dashpot.identify_in_plant({"x": np.zeros(500), "a": np.zeros(500)}, PLANT, "tanh_kwok", sample_time=0.01)
        with self.assertRaisesRegex(dashpot.Error, "mass"):
            dashpot.observe(dashpot.published("spencer1997"), self.ride, PLANT)


if __name__ == "__main__":
    unittest.main()
