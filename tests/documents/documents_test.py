#!/usr/bin/env python3
"""Documents: links lead somewhere, and commands are understood.

    documents_test.py SOURCES PROGRAM
"""

import ast
import json
import re
import shlex
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.dont_write_bytecode = True
PROGRAM = Path(sys.argv.pop()).resolve()
SOURCES = Path(sys.argv.pop()).resolve()
DOCUMENTS = [path for path in sorted(SOURCES.rglob("*.md"))
             if not any(part.startswith((".", "build")) for part in path.relative_to(SOURCES).parts)]


def without_code(text):
    text = re.sub(r"^```.*?^```", "", text, flags=re.S | re.M)
    return re.sub(r"`[^`\n]*`", "", re.sub(r"^    .*$", "", text, flags=re.M))


def anchors(text):
    found = set()
    for heading in re.findall(r"^#+ +(.*)$", text, re.M):
        found.add(re.sub(r"[^\w\- ]", "", heading.lower()).strip().replace(" ", "-"))
    return found


def blocks(text):
    """Lines of code of a document: indented ones, and those of fenced blocks without a language or of a shell."""
    fenced, language = False, ""
    for line in text.splitlines():
        if line.startswith("```"):
            fenced, language = not fenced, line[3:].strip()
        elif fenced and language in ("", "sh", "bash"):
            yield line.strip()
        elif not fenced and line.startswith("    "):
            yield line.strip()


def commands(text):
    """Calls of the program: of blocks, and in the running text."""
    for line in blocks(text):
        match = re.match(r"(?:\$ )?(?:build/)?vlbeam (.*)", line)
        if match:
            yield match[1]
    for code in re.findall(r"`(?:build/)?vlbeam ([^`]+)`", re.sub(r"^```.*?^```", "", text, flags=re.S | re.M)):
        yield code


def words(command):
    return shlex.split(command.split(" #")[0].replace("...", "").replace(" | ", " ").strip())


class Documents(unittest.TestCase):
    where = ""  # the document that is looked at

    def _formatMessage(self, message, standard):
        return f"{self.where}: {super()._formatMessage(message, standard)}"

    def each(self):
        for path in DOCUMENTS:
            self.where = path.relative_to(SOURCES)
            yield path, path.read_text(encoding="utf-8")

    def test_links_lead_somewhere(self):
        for path, text in self.each():
            for target in re.findall(r"\]\(([^)\s]+)\)", without_code(text)):
                if re.match(r"https?:", target):
                    continue
                file, _, anchor = target.partition("#")
                there = (path.parent / file).resolve() if file else path
                self.assertTrue(there.exists(), target)
                if anchor and there.suffix == ".md":
                    self.assertIn(anchor, anchors(there.read_text(encoding="utf-8")), target)

    def test_the_readme_is_short(self):
        self.assertLessEqual(len((SOURCES / "README.md").read_text(encoding="utf-8").splitlines()), 150)

    def test_lines_are_short(self):
        """140 characters a line, but for tables, headings, captions and code."""
        for path, text in self.each():
            if path.name == "what_goes_together.md":  # made by a test
                continue
            for line in re.sub(r"^```.*?^```", "", text, flags=re.S | re.M).splitlines():
                if not line.startswith(("|", "#", "    ", "![", "*Figure")):
                    self.assertLessEqual(len(line), 140, line)

    def test_keys_of_a_scene_are_the_programs(self):
        told = subprocess.run([sys.executable, SOURCES / "docs/scene_keys.py", PROGRAM, "-"], capture_output=True, text=True, check=True)
        self.assertEqual(told.stdout, (SOURCES / "docs/scene_keys.md").read_text(encoding="utf-8"), "docs/scene_keys.py makes it anew")

    def test_quantities_are_the_programs(self):
        told = subprocess.run([sys.executable, SOURCES / "docs/what_comes_out.py", PROGRAM, "-"], capture_output=True, text=True, check=True)
        self.assertEqual(told.stdout, (SOURCES / "docs/what_comes_out.md").read_text(encoding="utf-8"), "docs/what_comes_out.py makes it anew")

    def test_targets_of_make_exist(self):
        makefile = (SOURCES / "Makefile.studies").read_text(encoding="utf-8")
        known = set(re.search(r"^\.PHONY: (.*)$", makefile, re.M)[1].split())
        for _, text in self.each():
            called = [re.findall(r"\bmake ([a-z]+)", code) for code in [*blocks(text), *re.findall(r"`([^`\n]+)`", text)]]
            for target in sum(called, []):
                self.assertIn(target, known)

    def test_commands_are_understood(self):
        helps = {}
        told = subprocess.run([PROGRAM, "--help"], capture_output=True, text=True, check=True)
        known = set(re.findall(r"^  ([a-z]+)  ", told.stdout, re.M))

        def options_of(command):
            self.assertIn(command, known)
            if command not in helps:
                told = subprocess.run([PROGRAM, command, "--help"], capture_output=True, text=True)
                helps[command] = set(re.findall(r"(?<![\w-])(--?[a-z][\w-]*)", told.stdout))
            return helps[command]

        documents = [text for _, text in self.each()]
        examples = re.findall(r"^  vlbeam (.*?)(?:  .*)?$", told.stdout, re.M)
        self.assertGreaterEqual(len(examples), 4)
        for text in [*documents, "\n".join(f"    vlbeam {example}" for example in examples)]:
            for command in commands(text):
                given = words(command)
                if given[0].startswith("--"):
                    self.assertIn(given[0], ("--help", "--version"))
                    continue
                if given[0] == "COMMAND":
                    continue
                for option in given[1:]:
                    if re.match(r"--?[a-z]", option):
                        self.assertIn(option, options_of(given[0]), command)
                options_of(given[0])

    def test_what_goes_with_what(self):
        """The matrix of the README: "yes" runs, "no" is refused as bad input."""
        text = (SOURCES / "README.md").read_text(encoding="utf-8")
        rows = [[cell.strip() for cell in line.strip("|").split("|")]
                for line in text.split("## What it can, and what it cannot")[1].split("\n\n")[1].splitlines()]
        integrators = [{"type": "dopri5"}, {"type": "generalized-alpha", "step": 1e-6}, {"type": "energy-momentum", "step": 1e-6}]

        def falling(**mass):
            scene = json.loads((SOURCES / "scenes/falling_beam.json").read_text(encoding="utf-8"))
            scene["sliding_mass"].update(mass)
            return scene

        def moved():
            scene = falling()
            scene["supports"][0]["motion"] = {"direction": [0, 1], "amplitude": 0.01, "frequency": 1, "ramp": 0.1}
            return scene

        def library(name):
            return json.loads((SOURCES / f"scenes/{name}.json").read_text(encoding="utf-8"))

        def ropes():
            scene = library("movable_pulley")
            return scene | {"fluid": {"density": 1, "area": 1e-6}, "ground": {"height": -100, "stiffness": 1e3}}

        def in_space():
            return {"dimension": 3, "gravity": [0, 0, -9.81], "supports": [{"at": "start", "type": "clamp"}],
                    "beam": {"curve": {"type": "arc", "center": [0, 0, 0], "radius": 1, "from_degrees": 0, "to_degrees": 90}, "elements": 8, "space_law": "frames",
                             "section": {"type": "rectangle", "width": 0.01, "height": 0.02, "orientation": [0, 0, 1]},
                             "material": {"density": 7800, "youngs_modulus": 2e11, "poisson_ratio": 0.3}}}

        scenes = {"a sliding mass": falling(), "several masses": library("two_trolleys"), "friction": falling(friction={"coefficient": 0.1}), "supports that move": moved(),
                  "two slopes": falling(slopes="free"), "beams that are curved": library("semicircle"),
                  "loads": library("moving_force") | {"vehicles": [{"name": "lorry", "x": {"value": 0.1}, "axles": [{"force": 1}]}]}, "ropes": ropes(), "several beams": library("slider_crank"), "in space": in_space(), "spin": library("torsion")}
        self.assertEqual(len(scenes), len(rows) - 2)
        for row in rows[2:]:
            name = next(name for name in scenes if row[0].startswith(name))
            for integrator, cell in zip(integrators, row[1:]):
                scene = scenes[name] | {"integrator": integrator, "duration": 1e-5, "output": {}}
                if "multipliers" in cell:
                    scene["constraints"] = "multipliers"
                told = subprocess.run([PROGRAM, "run", "-", "-q"], input=json.dumps(scene), text=True, capture_output=True)
                self.assertEqual(2 if cell == "no" else 0, told.returncode, f"{row[0]}, {integrator['type']}: {told.stderr}")

    def test_scenes_and_code_are_well_formed(self):
        for _, text in self.each():
            for language, code in re.findall(r"^```(\w+)\n(.*?)^```", text, re.S | re.M):
                if language == "json":
                    json.loads(code)
                if language == "python":
                    ast.parse(code)

    def test_python_that_is_shown_exists(self):
        namespace = ast.parse((SOURCES / "python/vlbeam/__init__.py").read_text(encoding="utf-8"))
        known = next(ast.literal_eval(node.value) for node in namespace.body
                     if isinstance(node, ast.Assign) and getattr(node.targets[0], "id", "") == "__all__")
        for _, text in self.each():
            for name in re.findall(r"\bvlbeam\.([a-z]\w*|[A-Z]\w*)\(", text):
                self.assertIn(name, known)

    def test_folders_of_the_core_use_those_above_them(self):
        core = SOURCES / "core"
        order = self.folders_of(core)
        for path in sorted(core.rglob("*.[ch]pp")):
            if path.parent == core:
                continue
            for folder in re.findall(r'#include "core/(\w+)/', path.read_text(encoding="utf-8")):
                self.assertLessEqual(order.index(folder), order.index(path.parent.name), path)

    def test_libraries_use_those_below_them(self):
        self.folders_of(SOURCES / "mechanics")
        for library, used in (("core", {"core"}), ("mechanics", {"core", "mechanics"}), ("scene", {"core", "mechanics", "scene"})):
            for path in sorted((SOURCES / library).rglob("*.[ch]pp")):
                tops = set(re.findall(r'#include "(\w+)/', path.read_text(encoding="utf-8")))
                self.assertLessEqual(tops, used, path)

    def folders_of(self, library):
        """In the order of its README, which names them all."""
        order = re.findall(r"^\| `(\w+)/` \|", (library / "README.md").read_text(encoding="utf-8"), re.M)
        self.assertEqual(sorted(order), sorted(path.name for path in library.iterdir() if path.is_dir()))
        return order


if __name__ == "__main__":
    unittest.main()
