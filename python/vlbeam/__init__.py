"""Variable-length beam finite elements: run scenes, and learn how far their numbers can be trusted.

    import vlbeam
    scene = vlbeam.scene("falling_beam")
    r = vlbeam.run(scene)
    r.t, r.joint_position, r.end, r.energy.total      # numpy arrays
    vlbeam.converge(scene, "joint_position", 1e-3)     # how far can it be trusted?

Scenes are dictionaries, as `vlbeam schema scene` (here: `vlbeam.schema("scene")`) describes them.
"""

import json as _json
import sys as _sys
from pathlib import Path as _Path

try:
    import numpy as _numpy  # noqa: F401: the module's arrays are numpy's
except ImportError:
    raise ImportError(f"vlbeam needs numpy, which {_sys.executable} does not have (Debian: python3-numpy, for /usr/bin/python3)") from None
try:
    from . import _vlbeam
except ImportError as _error:
    _built = ", ".join(path.name for path in _Path(__file__).parent.glob("_vlbeam*")) or "none"
    raise ImportError(
        f"vlbeam was not built for this interpreter: {_sys.executable}, Python {_sys.version.split()[0]}; modules here: {_built}. "
        f"Use the Python it was built for, or build with OPTIONS=-DPython_EXECUTABLE={_sys.executable} ({_error})") from None
from ._vlbeam import InvalidInput

__version__ = _vlbeam.version
__all__ = ["ComputationFailed", "InvalidInput", "Result", "converge", "run", "scene", "scenes", "schema", "sweep"]

_SCENES = _Path(__file__).parent / "scenes"


class ComputationFailed(RuntimeError):
    """The computation broke down. `result` holds what was computed until then, up to the last good state."""

    def __init__(self, message, result):
        super().__init__(message)
        self.result = result


class Record(dict):
    """A dictionary whose keys are attributes, too."""

    __getattr__ = dict.__getitem__

    def __getattribute__(self, name):
        try:
            return super().__getattribute__(name)
        except KeyError:
            raise AttributeError(name) from None


class _OfSamples(dict):
    """What is known of samples by name; what is known of "end" holds for "end.y", too."""

    def __missing__(self, name):
        whole = name.rpartition(".")[0] if isinstance(name, str) else ""
        if not whole:
            raise KeyError(name)
        return self[whole]


class _Part:
    """Samples below a path: `r.energy` with `r.energy.total`."""

    def __init__(self, run, tree, path):
        self._run, self._tree, self._path = run, tree, path

    def __getattr__(self, name):
        if name.startswith("_") or name not in self._tree:
            raise AttributeError(f"{name!r} is not sampled here; there are: {', '.join(self._tree)}")
        path = f"{self._path}{name}"
        below = self._tree[name]
        value = _Part(self._run, below, path + "/") if below else self._run.samples(path)
        self.__dict__[name] = value
        return value

    def __dir__(self):
        return list(self._tree)

    def __repr__(self):
        return f"<{self._path.rstrip('/') or 'samples'}: {', '.join(self._tree)}>"


class Result(_Part):
    """What a run gave. Samples are numpy arrays: shape (samples,) for numbers, (samples, dimension) for vectors; NaN
    where a quantity is not there, like `joint_position` once the mass has left the beam."""

    def __init__(self, run):
        tree, self.units, self.descriptions = {}, _OfSamples(), _OfSamples()
        for path, unit, description in run.paths():
            branch = tree
            for segment in path.split("/"):
                branch = branch.setdefault(segment, {})
            name = path.replace("/", ".")
            self.units[name], self.descriptions[name] = unit, description
        super().__init__(run, tree, "")

    def __getitem__(self, name):
        """Samples of one number by its name: r["end.y"]."""
        return self._run.column(name)

    def __dir__(self):
        return [*self._tree, "units", "descriptions", "status", "warnings", "events", "shape", "shape_times", "report", "csv", "save"]

    def __repr__(self):
        return self._run.summary()

    @property
    def status(self):
        """completed, or separated where the mass has left the beam."""
        return self._run.status

    @property
    def shape_times(self):
        """Times [s] at which the whole shape was kept: those of /output/configurations."""
        return self._run.shape_times()

    def shape(self, index, points=8):
        """Points along the axis of a shape that was kept, `points` intervals an element: arrays t, x, r, r_x, v, strain,
        tension, curvature."""
        times = self._run.shape_times()
        if not -len(times) <= index < len(times):
            raise IndexError(f"{len(times)} shapes were kept, numbered from 0: list their times in /output/configurations")
        return Record(self._run.shape(index % len(times), points))

    def report(self):
        """The report as `vlbeam run --report` writes it (`vlbeam.schema("run")`), as a dictionary."""
        return _json.loads(self._run.report())

    @property
    def warnings(self):
        """What the run warns of: records with `kind`, `message` and `remedy`."""
        return _json.loads(self._run.report(), object_hook=Record)["warnings"]

    @property
    def events(self):
        """Length-control events and what else happened, as the report has them."""
        return _json.loads(self._run.report(), object_hook=Record)["events"]

    def csv(self):
        """The samples as CSV text, units in the first line."""
        return self._run.csv()

    def save(self, path):
        """Writes the report to a file, for `vlbeam plot` and `vlbeam compare`."""
        _Path(path).write_text(self._run.report(), encoding="utf-8")


def _plain(value):
    """A numpy array or number as what JSON can say."""
    if hasattr(value, "tolist"):
        return value.tolist()
    raise TypeError(f"a scene cannot hold a {type(value).__name__}: {value!r:.60}")


def _text(scene):
    if not isinstance(scene, str):
        return _json.dumps(scene, default=_plain)
    if "{" not in scene:
        raise ValueError(f"{scene!r:.60} is no JSON text; a scene in a file is json.load(open(path))")
    return scene


def run(scene):
    """Runs a scene, a dictionary or its JSON text.

    Raises InvalidInput where it is not understood, with the text that the program prints (attributes `field`, a JSON
    pointer, `value` and `allowed`), and ComputationFailed, whose `result` holds what there is, where it breaks down.
    Ctrl-C ends it with KeyboardInterrupt; other threads of Python go on meanwhile.
    """
    done = _vlbeam.Run(_text(scene))
    result = Result(done)
    if done.status == "failed":
        raise ComputationFailed(f"the computation failed at t = {done.failure_time:g} s: {done.failure}", result)
    return result


def converge(scene, quantity, error, *, relative=False, at=None, horizon=False, jobs=0):
    """Refines mesh, time and quadrature of a scene until a quantity is known to the error wanted: what `vlbeam converge`
    reports (`vlbeam.schema("converge")`), with `answer`, `uncertainty` and `reached` among its keys and attributes."""
    text = _vlbeam.converge(_text(scene), quantity, float(error), relative, at, horizon, jobs)
    return _json.loads(text, object_hook=Record)


def sweep(scene, over, *, quantities=None, combine="product", jobs=0):
    """Runs a scene for many values of its options, on several threads.

        vlbeam.sweep(scene, {"/beam/elements": [10, 20, 40]}, quantities=["end.y"])

    `over` maps JSON pointers to lists of values, or to {"from", "to", "count", "spacing"}. Returns a dictionary of numpy
    arrays, one entry a case: an array for each option, each quantity (at the end of the run; NaN where a case failed),
    `t`, `status` and `failure`.
    """
    import numpy

    plan = {"schema": "vlbeam.sweep/1", "scene": _json.loads(_text(scene)), "combine": combine, "over": over}
    if quantities is not None:
        plan["quantities"] = list(quantities)
    found = _json.loads(_vlbeam.sweep(_json.dumps(plan, default=_plain), jobs))
    cases = found["cases"]

    def numbers(values):
        return numpy.array([numpy.nan if value is None else value for value in values], dtype=float)

    columns = Record({option: numpy.array([case["options"][option] for case in cases]) for option in over})
    for name in found["quantities"]:
        columns[name] = numbers((case.get("values") or {}).get(name) for case in cases)
    columns["t"] = numbers(case.get("t") for case in cases)
    columns["status"] = numpy.array([case["status"] for case in cases])
    columns["failure"] = [case.get("failure") for case in cases]
    return columns


def scene(name):
    """An example scene as a dictionary, to run or to change; `scenes()` lists them."""
    return _json.loads(_vlbeam.scene(str(_SCENES), name))


def scenes():
    """Names of the example scenes, with their titles."""
    return dict(_vlbeam.scenes(str(_SCENES)))


def schema(of="scene"):
    """The JSON Schema of "scene", "run", "converge" or "sweep": every key with its unit, range and default."""
    return _json.loads(_vlbeam.schema(of))
