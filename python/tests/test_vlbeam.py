"""The Python package: the same numbers and the same words as the program, without holding Python up."""

import json
import re
import runpy
import subprocess
import sys
import threading
import time
from pathlib import Path

import numpy as np
import pytest
import vlbeam

SOURCES = Path(__file__).resolve().parents[2]
PROGRAM = Path(vlbeam.__file__).resolve().parents[2] / "vlbeam"


@pytest.fixture
def falling():
    scene = vlbeam.scene("falling_beam")
    scene["beam"]["elements"] = 10
    scene["duration"] = 0.3
    scene["output"] = {"interval": 0.01}
    return scene


def test_samples_are_those_of_the_report(falling):
    r = vlbeam.run(falling)
    samples = r.report()["samples"]
    assert r.status == "completed"
    assert r.t.shape == (31,) and r.end.shape == (31, 2)
    for name in r.units:
        here, there = r, samples
        for segment in name.split("."):
            here, there = getattr(here, segment), there[segment]
        expected = np.array(there, dtype=float).reshape(here.shape)
        np.testing.assert_array_equal(here, expected, err_msg=name)
    np.testing.assert_array_equal(r["end.y"], r.end[:, 1])
    assert r.units["energy.total"] == "J"
    assert r.units["end"] == r.units["end.y"] == "m"
    with pytest.raises(KeyError):
        r.units["wind.y"]


def test_numbers_are_the_programs(falling, tmp_path):
    (tmp_path / "scene.json").write_text(json.dumps(falling))
    subprocess.run([PROGRAM, "run", "scene.json", "--report", "r.json", "-q"], cwd=tmp_path, check=True)
    samples = json.loads((tmp_path / "r.json").read_text())["samples"]
    r = vlbeam.run(falling)
    assert r.joint_position.tolist() == samples["joint_position"]
    assert r.energy.total.tolist() == samples["energy"]["total"]


def test_scenes_may_hold_arrays(falling):
    plain = vlbeam.run(falling)
    falling["gravity"] = np.array([0, -9.81])
    falling["duration"] = np.float64(0.3)
    falling["beam"]["elements"] = np.int64(10)
    assert vlbeam.run(falling).end.tolist() == plain.end.tolist()
    with pytest.raises(TypeError, match="a scene cannot hold a set"):
        vlbeam.run({"beam": {1, 2}})


def test_arrays_own_their_numbers_and_outlive_the_run(falling):
    t = vlbeam.run(falling).t
    assert type(t.base).__name__ == "PyCapsule" and t.flags.writeable
    assert t[-1] == 0.3


def test_what_is_not_there_is_not_a_number():
    scene = vlbeam.scene("pendulum")
    r = vlbeam.run(scene)
    assert np.isnan(r.joint_position).all() and r.mass_position.shape == (51, 2)
    with pytest.raises(AttributeError, match="contact"):
        r.contact


def test_shapes(falling):
    falling["output"] = {"configurations": [0, 0.3]}
    r = vlbeam.run(falling)
    assert r.shape_times == [0, 0.3]
    shape = r.shape(-1, points=4)
    assert shape.r.shape == (10 * 5, 2) and shape.strain.shape == (50,)
    np.testing.assert_allclose(shape.r[-1], r.end[-1], atol=1e-12)
    with pytest.raises(IndexError, match="2 shapes"):
        r.shape(2)


def test_errors_are_the_programs(falling, tmp_path):
    falling["beam"]["elments"] = 10
    (tmp_path / "scene.json").write_text(json.dumps(falling))
    told = subprocess.run([PROGRAM, "run", "scene.json"], cwd=tmp_path, capture_output=True, text=True)
    with pytest.raises(vlbeam.InvalidInput) as caught:
        vlbeam.run(falling)
    assert told.returncode == 2
    assert told.stderr.strip() == f"vlbeam: scene.json: {caught.value}"
    assert caught.value.field == "/beam/elments" and "elements" in caught.value.allowed
    assert isinstance(caught.value, ValueError)
    with pytest.raises(vlbeam.InvalidInput, match="pendulum"):
        vlbeam.scene("pendulun")
    with pytest.raises(vlbeam.InvalidInput, match="joint_position"):
        vlbeam.converge(vlbeam.scene("falling_beam"), "joint_positoin", 1e-3)


def test_a_run_that_breaks_down_keeps_what_it_has():
    scene = vlbeam.scene("incline")
    scene["sliding_mass"]["velocity"] = -10  # against the support at the start, where the mass stops
    scene["supports"] = [{"at": "start", "type": "clamp"}, {"at": "end", "type": "clamp"}]
    with pytest.raises(vlbeam.ComputationFailed, match=r"^the computation failed at t = [\d.e-]+ s: ") as caught:
        vlbeam.run(scene)
    assert caught.value.result.status == "failed" and caught.value.result.t.size > 0


def test_python_goes_on_meanwhile():
    scene = vlbeam.scene("falling_beam")
    scene["beam"]["elements"] = 160
    scene["integrator"] = {"type": "generalized-alpha", "step": 1e-4}
    counted, stop = [0], threading.Event()

    def count():
        while not stop.is_set():
            counted[0] += 1
            time.sleep(0.001)

    thread = threading.Thread(target=count)
    thread.start()
    before = counted[0]
    vlbeam.run(scene)
    after = counted[0]
    stop.set()
    thread.join()
    assert after - before > 20  # at most one where the run kept the others waiting


@pytest.mark.parametrize("call", ["vlbeam.run(s)", "vlbeam.converge(s, 'end.y', 1e-9)",
                                  "vlbeam.sweep(s, {'/beam/elements': [80] * 8}, jobs=2)"])
def test_ctrl_c_stops(call):
    script = f"""
import os, signal, threading, time, vlbeam
s = vlbeam.scene("falling_beam")
s["beam"]["elements"] = 160
s["duration"] = 0.6
s["integrator"] = {{"type": "generalized-alpha", "step": 1e-7}}  # much longer than the limit below, uninterrupted
threading.Timer(0.5, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
try:
    {call}
except KeyboardInterrupt:
    print("stopped")
r = vlbeam.run(vlbeam.scene("pendulum"))
print(r.status)
"""
    told = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, timeout=120)
    lines = told.stdout.split("\n")
    assert lines[0] == "stopped", told.stdout + told.stderr
    assert lines[1] == "completed"


def test_converge():
    found = vlbeam.converge(vlbeam.scene("pendulum"), "end.y", 1e-4)
    assert found.reached and found["reached"]
    assert abs(found.answer - -0.7772451393) <= found.uncertainty <= 1e-4


def test_a_run_tells_its_error(falling):
    run = vlbeam.run(falling)
    assert run.error.time >= 0 and run.error.mesh > 0 and 0 < run.error.trusted_until <= falling["duration"]
    assert {"end", "joint 0", "shape", "energy"} <= {row.quantity for row in run.error.quantities}
    assert vlbeam.run(falling, check=False).error is None


def test_sweep(falling):
    found = vlbeam.sweep(falling, {"/beam/elements": [4, 8], "/sliding_mass/mass": [0.5, 0.8]}, quantities=["end.y"])
    assert found["/beam/elements"].tolist() == [4, 4, 8, 8]
    assert found["/sliding_mass/mass"].tolist() == [0.5, 0.8, 0.5, 0.8]
    falling["beam"]["elements"], falling["sliding_mass"]["mass"] = 8, 0.5
    assert found["end.y"][2] == vlbeam.run(falling, check=False).end[-1, 1]
    with pytest.raises(vlbeam.InvalidInput, match="/beam/elements"):
        vlbeam.sweep(falling, {"/beam/elements": [4, -1]})


def test_scenes_and_schema():
    assert vlbeam.scenes()["pendulum"] == "Flexible pendulum"
    assert "properties" in vlbeam.schema("scene")
    assert re.fullmatch(r"\d+\.\d+\.\d+", vlbeam.__version__)


def test_the_stub_knows_what_there_is(falling):
    stub = (Path(vlbeam.__file__).parent / "__init__.pyi").read_text()
    for name in vlbeam.__all__:
        assert re.search(rf"^(class|def) {name}\b|import {name}\b", stub, re.M), name
    for name in vlbeam.run(falling).units:
        for segment in name.split("."):
            if not re.search(rf"^    {segment}: ", stub, re.M):
                assert name.startswith("reactions."), name


@pytest.mark.parametrize("example", sorted(path.stem for path in (SOURCES / "python/examples").glob("*.py")))
def test_examples_run(example, tmp_path, monkeypatch):
    pytest.importorskip("matplotlib")
    figure = tmp_path / "figure.svg"
    monkeypatch.setattr(sys, "argv", [example, str(figure)])
    runpy.run_path(str(SOURCES / "python/examples" / f"{example}.py"), run_name="__main__")
    assert figure.stat().st_size > 10000


@pytest.mark.parametrize("missing, sentence", [("numpy", "needs numpy, which"), ("vlbeam._vlbeam", "not built for this interpreter")])
def test_an_interpreter_that_cannot_import_it_is_told_why(missing, sentence):
    code = f"import sys; sys.modules[{missing!r}] = None; import vlbeam"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert done.returncode == 1
    last = done.stderr.strip().splitlines()[-1]
    assert last.startswith("ImportError: ") and sentence in last and sys.executable in last
