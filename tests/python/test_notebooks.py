import contextlib
import io
import json
import os
import unittest

from support import PROJECT, InFolder, program

NOTEBOOKS = PROJECT / "examples/notebooks"


def run(name: str) -> str:
    """What the code cells of a notebook print, one after the other, in the folder that we are in."""
    cells = json.loads((NOTEBOOKS / name).read_text(encoding="utf-8"))["cells"]
    names, printed = {}, io.StringIO()
    for place, cell in enumerate(cells):
        if cell["cell_type"] == "code":
            with contextlib.redirect_stdout(printed):
                exec(compile("".join(cell["source"]), f"{name}, cell {place + 1}", "exec"), names)
    return printed.getvalue()


class Notebooks(InFolder):
    """The cells run as they stand, without Jupyter."""

    def setUp(self):
        super().setUp()
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(self.folder)
        for name, seed in (("campaign", 1), ("again", 2)):
            program("bench", "--motions", "20x0.5,20x1,20x2,10x4", "--levels", "0,1,2", "--cycles", "2",
                    "--sample-rate", "200", "--seed", seed, "--output", name)

    def test_all_are_tested_and_hold_no_output(self):
        self.assertEqual(sorted(path.name for path in NOTEBOOKS.glob("*.ipynb")),
                         ["car.ipynb", "compare.ipynb", "identify.ipynb"])
        for path in NOTEBOOKS.glob("*.ipynb"):
            for cell in json.loads(path.read_text(encoding="utf-8"))["cells"]:
                self.assertEqual(cell.get("outputs", []), [])

    def test_identify(self):
        printed = run("identify.ipynb")
        self.assertIn("in rebound and", printed)
        self.assertIn("Residuals at 99 % confidence", printed)
        self.assertIn("strongest correlation: 0.", printed)
        self.assertTrue((self.folder / "report.html").exists())

    def test_compare(self):
        printed = run("compare.ipynb")
        self.assertIn("mm/s: ", printed)
        self.assertIn("% of the force's power left", printed)
        self.assertGreater((self.folder / "changes.html").stat().st_size, 10000)

    def test_car(self):
        printed = run("car.ipynb")
        self.assertIn("controlled {", printed)
        self.assertTrue((self.folder / "ecu" / "front.c").exists())


if __name__ == "__main__":
    unittest.main()
