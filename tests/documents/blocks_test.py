#!/usr/bin/env python3
"""Every block of code of the documents runs, and prints what stands below it.

    blocks_test.py [--slow] SOURCES PROGRAM

A document is worked through in a folder of its own, from its first block to its last:

* commands of the program are run; --slow also runs those that take more than 10 s,
* "`NAME.json`:" before a JSON block writes that file, "`NAME.txt`:" before a block of `text`; a part of a scene is put into a scene that has room for it, and run,
* Python is executed, C++ and CMake stand in an example that is compiled,
* a block of `text` is what the block before it prints; "..." stands for any lines.
"""

import contextlib
import io
import json
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.dont_write_bytecode = True
SLOW = "--slow" in sys.argv and not sys.argv.remove("--slow")
PROGRAM = Path(sys.argv.pop()).resolve()
SOURCES = Path(sys.argv.pop()).resolve()
DOCUMENTS = [SOURCES / "README.md", *sorted((SOURCES / "docs").glob("*.md"))]
TAKE_LONG = ("converge scene.json", "sweep")
# What changes the checkout or the machine, with the test that covers it.
ELSEWHERE = {
    "make": "documents_test: the targets exist; CI calls them", "cmake --install": "install.used_by_a_stranger", "cmake -S examples": "install.used_by_a_stranger",
    "scripts/packages.sh": "CI's first stage", "scripts/slurm_sweep.sh": "program.slurm", "sbatch": "program.slurm", "build/vlbeam sweep sweep.json --out": "program.slurm",
    "python3 -m venv": "python.wheel", "~/vlbeam-env/bin/": "python.wheel", "PYTHONPATH=": "python.module", "python3 docs/tutorials/run.py": "python.tutorials",
    "vlbeam claims": "program.claims", "python3 python/": "python.module", "python3": "python.module",
}
BLOCK = re.compile(r"^```(?P<language>\w*)\n(?P<fenced>.*?)^```$|(?<=\n\n)(?P<indented>(?:    [^\n]*\n)+)", re.S | re.M)


def blocks(text):
    """(language, code, the line before) of a document."""
    for match in BLOCK.finditer(text):
        before = text[: match.start()].rstrip().rpartition("\n")[2]
        if match["indented"]:
            yield "sh", re.sub(r"^    ", "", match["indented"], flags=re.M), before
        else:
            yield match["language"] or "sh", match["fenced"], before


def pattern(expected):
    """What matches the text; lines of "..." match any lines."""
    return re.compile("".join(r"(?:.*\n)*?" if line.strip() == "..." else re.escape(line.rstrip()) + r"[ ]*\n" for line in expected.splitlines()))


class Blocks(unittest.TestCase):
    def test_every_block(self):
        ran = {}
        for path in DOCUMENTS:
            with tempfile.TemporaryDirectory() as folder, self.subTest(document=path.name):
                for beside in ("scenes", "reference"):
                    (Path(folder) / beside).symlink_to(SOURCES / beside)
                printed, names = "", {"__name__": "document"}
                for language, code, before in blocks(path.read_text(encoding="utf-8")):
                    ran[language] = ran.get(language, 0) + 1
                    file = re.search(r"`(\w+\.txt)`:$", before)
                    if language == "text" and file:
                        (Path(folder) / file[1]).write_text(code)
                    elif language == "text":
                        if printed is not None:
                            self.assertRegex(printed, pattern(code))
                    elif language == "sh":
                        printed = self.shell(code, Path(folder))
                    elif language == "json":
                        self.scene(code, before, Path(folder))
                    elif language == "python":
                        printed = self.python(code, names)
                    elif language in ("cpp", "cmake"):
                        self.example(code)
                    else:
                        self.fail(f"what is a block of {language!r}?")
        self.assertGreater(min(ran.get(kind, 0) for kind in ("sh", "json", "python", "text", "cpp")), 0, ran)

    def shell(self, code, folder):
        """What the commands print; nothing is known of commands that are not run."""
        printed = ""
        for line in code.splitlines():
            command = re.sub(r"^\$ ", "", line.split("  #")[0].strip())
            if not command or next((True for known in ELSEWHERE if command.startswith(known)), False):
                continue
            match = re.match(r"(?:build/)?vlbeam (.*)", command)
            self.assertTrue(match, f"{command}: no test runs this")
            if any(match[1].startswith(long) for long in TAKE_LONG) and not SLOW:
                printed = None
                continue
            if match[1].startswith("plot") and not shutil.which("gnuplot"):
                continue
            self.prepare(match[1], folder)
            told = subprocess.run(["bash", "-c", f"{shlex.quote(str(PROGRAM))} {match[1]}"], cwd=folder, capture_output=True, text=True)
            allowed = (0, 1) if match[1].startswith("converge") else (0,)  # the error may be out of reach, and said to be
            self.assertIn(told.returncode, allowed, f"{command}\n{told.stderr}")
            printed = None if printed is None else printed + told.stdout + told.stderr
        return printed

    def prepare(self, command, folder):
        """Files that a reader has and this folder has not."""
        if command.startswith("compare"):
            for run in ("a.json", "b.json"):
                shutil.copyfile(folder / "r.json", folder / run)
        if command.startswith("score"):
            (folder / "their.csv").write_text("t,s\n0.1,0.13\n")
            (folder / "theirs").mkdir(exist_ok=True)
            (folder / "theirs" / "falling_beam_ours_N10.csv").write_text("t,joint_position\n0.1,0.13\n")

    def scene(self, code, before, folder):
        given = json.loads(code)
        named = re.search(r"`(\w+\.json)`:$", before)
        if named:
            (folder / named[1]).write_text(code)
        if str(given.get("schema", "")).startswith("vlbeam.sweep"):
            (folder / "sweep.json").write_text(code)
            return
        if "beams" not in given and not {"beam", "duration"} <= given.keys():
            given = self.with_room(given)
        told = subprocess.run([PROGRAM, "run", "-", "-q"], input=json.dumps(given), text=True, capture_output=True)
        self.assertEqual(0, told.returncode, f"{code}\n{told.stderr}")

    def with_room(self, part):
        """A short scene with this part in it."""
        rope = {"supports": [{"at": "start", "type": "clamp"}], "gravity_ramp": 0.1}
        if "contact" in part:
            rope["supports"].append({"at": "end", "type": "pin"})
        stiff = {"type": "stiffness", "EA": 1e6, "EI": 1e2, "rhoA": 1}
        if "spin" in part:
            stiff = {"type": "circle", "radius": 0.02}
        scene = {"gravity": [0, -1], "duration": 0.01, "output": {"interval": 0.01}, **rope,
                 "beam": {"curve": {"type": "line", "start": [0, 0], "end": [3, 0]}, "section": stiff, "elements": 30}}
        if "spin" in part:
            scene["beam"]["material"] = {"density": 7800, "youngs_modulus": 2e11, "poisson_ratio": 0.3}
            scene |= {"dimension": 3, "gravity": [0, -1, 0], "supports": [{"at": "start", "type": "pin"}]}
            scene["beam"]["curve"] = {"type": "line", "start": [0, 0, 0], "end": [3, 0, 0]}
        if "beam" in part:  # with what holds it
            scene["supports"] = []
        if "initial_velocity" in part:
            scene["supports"] = [{"at": "start", "type": "pin"}]
        if part.get("analysis") == "statics":
            scene = {key: value for key, value in scene.items() if key not in ("duration", "output", "gravity_ramp")}
        if part.get("initial_shape") == "equilibrium":
            scene.pop("gravity_ramp")
            part = part | {"duration": 0.01}
        return scene | part

    def python(self, code, names):
        """What it prints; nothing is known where the package is not there."""
        try:
            import vlbeam  # noqa: F401
        except ImportError:
            compile(code, "block", "exec")
            return None
        printed = io.StringIO()
        with contextlib.redirect_stdout(printed):
            exec(compile(code, "block", "exec"), names)
        return printed.getvalue()

    def example(self, code):
        """Each line stands in a program or a script of examples/, which a test compiles against the installed library."""
        texts = [path.read_text(encoding="utf-8") for path in (SOURCES / "examples").rglob("*") if path.suffix in (".cpp", ".txt")]
        lines = {" ".join(line.split("//")[0].replace("${name}", "my_program").split()) for text in texts for line in text.splitlines()}
        for line in code.splitlines():
            wanted = " ".join(line.split("//")[0].split())
            self.assertTrue(not wanted or wanted in lines, f"no example has the line  {wanted}")


if __name__ == "__main__":
    unittest.main()
