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
    'vlbeam.Scene().supports.clamp(at="middle")': "Literal['start', 'end']",
    "vlbeam.Scene().beam.elments = 3": 'maybe "elements"',
    'vlbeam.converge({}, "end.y", 1e-3).anser': None,  # a report has keys of its own
}


def test_a_type_checker_names_mistakes_and_nothing_else(tmp_path):
    pytest.importorskip("mypy")
    (tmp_path / "right.py").write_text(RIGHT)
    (tmp_path / "wrong.py").write_text("import vlbeam\n" + "\n".join(WRONG) + "\n")
    environment = {"MYPYPATH": str(Path(vlbeam.__file__).parents[1]), "PATH": "/usr/bin:/bin"}
    command = [sys.executable, "-m", "mypy", "--no-incremental", "--ignore-missing-imports", "right.py", "wrong.py"]
    told = subprocess.run(command, cwd=tmp_path, env=environment, capture_output=True, text=True).stdout
    mistakes = {line.split(":")[1]: line for line in told.splitlines() if ": error" in line}
    assert not [line for line in told.splitlines() if ": error" in line and not line.startswith("wrong.py")], told
    for line, words in enumerate(WRONG.values(), 2):
        assert words is None or words in mistakes[str(line)], told
