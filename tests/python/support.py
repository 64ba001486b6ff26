"""What the tests share. DASHPOT_PROGRAM and PYTHONPATH come from ctest."""

import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

import dashpot

PROJECT = Path(__file__).resolve().parents[2]


def run(*command, cwd=None) -> str:
    """What the command prints; its failure fails the test, with its words."""
    done = subprocess.run([str(word) for word in command], cwd=cwd, capture_output=True, text=True)
    if done.returncode != 0:
        raise AssertionError(f"{command} gave {done.returncode}:\n{done.stdout}{done.stderr}")
    return done.stdout


def program(*arguments, cwd=None) -> str:
    """What `dashpot` prints on stdout."""
    return run(os.environ["DASHPOT_PROGRAM"], *arguments, cwd=cwd)


def python(script: Path, *arguments, cwd=None) -> str:
    return run(sys.executable, script, *arguments, cwd=cwd)


class InFolder(unittest.TestCase):
    """A folder of its own for each test."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="dashpot-test-")
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)


def bingham(current: float, frequency: float = 2.0, samples: int = 400):
    """t, x, v, i, F of a Bingham damper: 400 N + 200 N/A at yield, 1000 N s/m."""
    t = 0.005 * np.arange(samples)
    phase = 2 * np.pi * frequency * t + 0.1
    x, v = 0.02 * np.sin(phase), 2 * np.pi * frequency * 0.02 * np.cos(phase)
    i = np.full(samples, float(current))
    return t, x, v, i, (400 + 200 * current) * np.sign(v) + 1000 * v


def recording(current: float, **more):
    """X (t, x, v, i) and y of it."""
    *columns, force = bingham(current, **more)
    return np.column_stack(columns), force
