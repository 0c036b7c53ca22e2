"""What a type checker says of programs: nothing of right ones, and the line of a mistake."""

import subprocess
import sys
from pathlib import Path

import pytest
import vlbeam

RIGHT = """
import vlbeam

scene = vlbeam.Scene(title="A trolley", gravity=[0, -9.81])
scene.beam.curve.line(start=[0, 0], end=[1, 0])
scene.supports.clamp(at="start")
scene.output = {"interval": 0.1}
scene["duration"] = 1
r = vlbeam.run(scene)
last: float = r.energy.total[-1]
c = vlbeam.converge(scene, "end.y", 1e-3, limit=60)
bound: float = c.answer + c.uncertainty
elements: int = vlbeam.scene("falling_beam").beam.elements
"""
WRONG = {
    'vlbeam.Scene().beam.elements = "many"': 'expression has type "str", variable has type "int"',
    'vlbeam.Scene().supports.clamp(at="middle")': "expected \"Literal['start', 'end']\"",
    "vlbeam.Scene().beam.elments = 3": 'maybe "elements"',
    'vlbeam.converge({}, "end.y", 1e-3).anser': None,  # a report has keys of its own
}


def checked(code, folder):
    pytest.importorskip("mypy")
    (folder / "program.py").write_text(code)
    environment = {"MYPYPATH": str(Path(vlbeam.__file__).parents[1]), "PATH": "/usr/bin:/bin"}
    command = [sys.executable, "-m", "mypy", "--no-incremental", "--ignore-missing-imports", "program.py"]
    return subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True)


def test_a_right_program_has_no_complaint(tmp_path):
    told = checked(RIGHT, tmp_path)
    assert told.returncode == 0, told.stdout + told.stderr


def test_mistakes_are_named(tmp_path):
    told = checked("import vlbeam\n" + "\n".join(WRONG) + "\n", tmp_path).stdout
    for line, words in enumerate(WRONG.values(), 2):
        assert words is None or any(f"program.py:{line}: error" in said and words in said for said in told.splitlines()), told
