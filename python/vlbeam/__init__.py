"""Variable-length beam finite elements: run scenes, and learn how far their numbers can be trusted.

    import vlbeam
    scene = vlbeam.scene("falling_beam")
    r = vlbeam.run(scene)
    r.t, r.joint_position, r.end, r.energy.total      # numpy arrays, SI units: r.units
    r.plot(); r.to_pandas()                           # matplotlib, pandas
    vlbeam.converge(scene, "joint_position", 1e-3)    # how far can it be trusted?

A scene is a dictionary, as `vlbeam schema scene` (here: `vlbeam.schema("scene")`) describes it; its keys are attributes, too.
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
from . import _scene
from ._notebook import bar as _bar
from ._result import ComputationFailed, Convergence, Record, Result
from ._vlbeam import InvalidInput

__version__ = _vlbeam.version
__all__ = ["ComputationFailed", "Convergence", "InvalidInput", "Result", "Scene", "converge", "run", "scene", "scenes", "schema", "sweep"]

_SCENES = _Path(__file__).parent / "scenes"


def __getattr__(name):
    if name == "Scene":  # its class is made from the option table, which takes a moment
        globals()["Scene"] = _scene.scene_class()
        return globals()["Scene"]
    raise AttributeError(f"module 'vlbeam' has no attribute {name!r}")


def __dir__():
    return __all__


def _text(scene):
    if not isinstance(scene, str):
        return _json.dumps(scene, default=_scene.plain)
    if "{" not in scene:
        raise ValueError(f"{scene!r:.60} is no JSON text; a scene in a file is json.load(open(path))")
    return scene


def run(scene, *, check=None, progress=True):
    """Runs a scene: a dictionary, a `Scene`, or JSON text. Returns a `Result`.

    check: let companions with longer steps and on coarser meshes tell the error, `Result.error`. If not given, that is
    done where the scene leaves its integrator out.
    progress: show a bar, in notebooks.

    Raises InvalidInput where the scene is not understood, with the text that the program prints, and the attributes
    `field` (a JSON pointer), `value` and `allowed`. Raises ComputationFailed where the motion breaks down; its `result`
    holds what there is until then. Ctrl-C ends a run with KeyboardInterrupt. Other threads of Python go on meanwhile.
    """
    with _bar("run", progress) as told:
        done = _vlbeam.Run(_text(scene), check, told)
    result = Result(done)
    if done.status == "failed":
        raise ComputationFailed(f"the computation failed at t = {done.failure_time:g} s: {done.failure}", result)
    return result


def converge(scene, quantity, error, *, relative=False, at=None, horizon=False, jobs=0, limit=None, progress=True):
    """Refines mesh, time and quadrature until a quantity is known to the error wanted. Returns a `Convergence`.

    quantity: a name as in r["end.y"]. error: in its unit; with `relative` in parts of its magnitude.
    at: the time [s] at which the quantity is wanted; the end of the scene if not given.
    horizon: also until when the motion can be predicted at all. jobs: runs at a time; 0: one a processor.
    limit: wall time [s], after which the answer known then is returned. progress: show a bar, in notebooks.
    """
    with _bar("converge", progress) as told:
        text = _vlbeam.converge(_text(scene), quantity, float(error), relative, at, horizon, jobs, limit, told)
    return Convergence(_json.loads(text, object_hook=Record))


def sweep(scene, over, *, quantities=None, combine="product", jobs=0, progress=True):
    """Runs a scene for many values of its options, on several threads.

        vlbeam.sweep(scene, {"/beam/elements": [10, 20, 40]}, quantities=["end.y"])

    over: lists of values by JSON pointer, or {"from", "to", "count", "spacing"} in place of a list.
    combine: "product" for every combination of values, "zip" for the first of each, the second of each, and so on.
    Returns a record of numpy arrays of shape (cases,): one for each option, one for each quantity at the end of the run
    (in its unit; NaN where a case failed), `t` [s], `status` and `failure`.
    """
    import numpy

    plan = {"schema": "vlbeam.sweep/1", "scene": _json.loads(_text(scene)), "combine": combine, "over": over}
    if quantities is not None:
        plan["quantities"] = list(quantities)
    with _bar("sweep", progress) as told:
        found = _json.loads(_vlbeam.sweep(_json.dumps(plan, default=_scene.plain), jobs, told))
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
    """An example scene, to run or to change: a `Scene`, which is a dictionary. `scenes()` lists them."""
    return _scene.scene_class()(_json.loads(_vlbeam.scene(str(_SCENES), name)))


def scenes():
    """Names of the example scenes, with their titles."""
    return dict(_vlbeam.scenes(str(_SCENES)))


def schema(of="scene"):
    """The JSON Schema of "scene", "run", "converge" or "sweep": every key with its unit, range and default."""
    return _json.loads(_vlbeam.schema(of))
