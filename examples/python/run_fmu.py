"""A damper's FMU under a sine, without Dashpot: python3 run_fmu.py DAMPER.fmu [--amplitude M] [--frequency HZ] [--command A]

A co-simulation importer for FMI 3.0 in nothing but Python's own library: how any simulator drives what `dashpot export
--to fmu3` wrote. Prints the force over time as CSV, and on stderr what the damper does in a cycle.
"""

import argparse
import ctypes
import math
import platform
import sys
import tempfile
import xml.etree.ElementTree as xml
import zipfile
from pathlib import Path

LOG = ctypes.CFUNCTYPE(None, ctypes.c_void_p, ctypes.c_int, ctypes.c_char_p, ctypes.c_char_p)
FOLDERS = {"Linux": "linux", "Darwin": "darwin", "Windows": "windows"}
ENDINGS = {"Linux": "so", "Darwin": "dylib", "Windows": "dll"}


class Fmu:
    """One instance of an FMU; use it in a `with`."""

    def __init__(self, path):
        self._folder = tempfile.TemporaryDirectory(prefix="fmu-")
        with zipfile.ZipFile(path) as archive:
            archive.extractall(self._folder.name)
        description = xml.parse(Path(self._folder.name) / "modelDescription.xml").getroot()
        if not description.get("fmiVersion", "").startswith("3."):
            raise ValueError(f"{path} is not of FMI 3")
        if description.find("CoSimulation") is None:
            raise ValueError(f"{path} has no co-simulation")
        self.variables = {v.get("name"): v.attrib for v in description.find("ModelVariables")}
        step = description.find("DefaultExperiment")
        self.step = float(step.get("stepSize", 1e-3)) if step is not None else 1e-3
        self._library = self._load(description.find("CoSimulation").get("modelIdentifier"))
        self._messages = []
        self._log = LOG(lambda _, status, category, text: self._messages.append(text.decode()))
        self._instance = None
        self._start(description.get("instantiationToken"))

    def _load(self, name):
        system = platform.system()
        machine = {"AMD64": "x86_64", "arm64": "aarch64"}.get(platform.machine(), platform.machine())
        binary = f"binaries/{machine}-{FOLDERS[system]}/{name}.{ENDINGS[system]}"
        library = ctypes.CDLL(str(Path(self._folder.name) / binary))
        library.fmi3InstantiateCoSimulation.restype = ctypes.c_void_p
        library.fmi3FreeInstance.restype = None
        return library

    def _start(self, token):
        yes, no = ctypes.c_bool(True), ctypes.c_bool(False)
        self._instance = self._library.fmi3InstantiateCoSimulation(
            b"damper", token.encode(), None, no, yes, no, no, None, ctypes.c_size_t(0), None, self._log, None
        )
        if not self._instance:
            raise RuntimeError(f"the FMU does not start: {'; '.join(self._messages)}")
        self._call("fmi3EnterInitializationMode", no, ctypes.c_double(0), ctypes.c_double(0), no, ctypes.c_double(0))

    def _call(self, function, *arguments):
        status = getattr(self._library, function)(ctypes.c_void_p(self._instance), *arguments)
        if status > 1:  # 0: OK, 1: a warning
            raise RuntimeError(f"{function}: {'; '.join(self._messages) or f'status {status}'}")

    def _references(self, names):
        missing = [name for name in names if name not in self.variables]
        if missing:
            raise KeyError(f"no variable {missing[0]}; known: {', '.join(self.variables)}")
        return (ctypes.c_uint32 * len(names))(*(int(self.variables[name]["valueReference"]) for name in names))

    def set(self, values):
        """Sets variables by their names."""
        numbers, count = (ctypes.c_double * len(values))(*values.values()), ctypes.c_size_t(len(values))
        self._call("fmi3SetFloat64", self._references(values), count, numbers, count)

    def get(self, name):
        number, one = ctypes.c_double(), ctypes.c_size_t(1)
        self._call("fmi3GetFloat64", self._references([name]), one, ctypes.byref(number), one)
        return number.value

    def initialised(self):
        """After the inputs of the first instant are set."""
        self._call("fmi3ExitInitializationMode")

    def do_step(self, time, step):
        flags, last = [ctypes.c_bool() for _ in range(3)], ctypes.c_double()
        self._call("fmi3DoStep", ctypes.c_double(time), ctypes.c_double(step), ctypes.c_bool(True),
                   *map(ctypes.byref, flags), ctypes.byref(last))

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self._library.fmi3FreeInstance(ctypes.c_void_p(self._instance))
        self._folder.cleanup()


def run(path, times, inputs, output="f"):
    """The output at every time under inputs (name -> values at these times), from rest at the first."""
    with Fmu(path) as fmu:
        result = []
        for k, time in enumerate(times):
            if k > 0:
                fmu.do_step(times[k - 1] - times[0], time - times[k - 1])
            fmu.set({name: values[k] for name, values in inputs.items()})
            if k == 0:
                fmu.initialised()
            result.append(fmu.get(output))
        return result


def main():
    words = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    words.add_argument("fmu")
    words.add_argument("--amplitude", type=float, default=0.01, help="of the sine, m")
    words.add_argument("--frequency", type=float, default=1, help="of the sine, Hz")
    words.add_argument("--command", type=float, default=1, help="to the coil, A or V")
    asked = words.parse_args()
    with Fmu(asked.fmu) as fmu:
        step, drive = fmu.step, "u" if "u" in fmu.variables else "i"
        if not {"s", "v", "f"} <= set(fmu.variables):
            raise ValueError(f"{asked.fmu} is no damper's: it has {', '.join(fmu.variables)}")
    rate, a = 2 * math.pi * asked.frequency, asked.amplitude
    t = [k * step for k in range(round(2 / asked.frequency / step) + 1)]
    s, v = [a * math.sin(rate * time) for time in t], [a * rate * math.cos(rate * time) for time in t]
    f = run(asked.fmu, t, {"s": s, "v": v, drive: [asked.command] * len(t)})
    print("time [s],displacement [m],velocity [m/s],force [N]")
    for row in zip(t, s, v, f):
        print(",".join(f"{value:.9g}" for value in row))
    last = [k for k in range(1, len(t)) if t[k] > 1 / asked.frequency]
    energy = sum(0.5 * (f[k] + f[k - 1]) * (s[k] - s[k - 1]) for k in last)
    print(f"second cycle: force {min(f[k] for k in last):.1f} ... {max(f[k] for k in last):.1f} N, {energy:.1f} J dissipated",
          file=sys.stderr)


if __name__ == "__main__":
    try:
        main()
    except (OSError, RuntimeError, ValueError, zipfile.BadZipFile) as error:
        sys.exit(f"run_fmu.py: {error}")
