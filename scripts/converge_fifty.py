#!/usr/bin/env python3
"""What `vlbeam converge` says of fifty scenes of the study trust, whose answers are known: the first and every fifth from
the third on.

    converge_fifty.py PROGRAM FOLDER [SECONDS]

Asks for a thousandth of the first quantity at the last time, in 60 s of one thread at most. Prints a line for each scene
whose truth is outside of the stated uncertainty, or of which nothing is known; fails where more than one in twenty of the
answers is outside. Reports stay in FOLDER.
"""

import json
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from os import cpu_count
from pathlib import Path

PROGRAM, FOLDER = Path(sys.argv[1]).resolve(), Path(sys.argv[2])
SECONDS = sys.argv[3] if len(sys.argv) > 3 else "60"
CASES = json.loads((Path(__file__).resolve().parent.parent / "reference" / "trust.json").read_text(encoding="utf-8"))["cases"]
CHOSEN = [0, *range(2, len(CASES), 5)]
MOST_OUTSIDE = 0.05


def converged(index):
    """The report of one, or what the program says instead."""
    case = CASES[index]
    scene, report = FOLDER / f"{index}.json", FOLDER / f"{index}.converge.json"
    scene.write_text(json.dumps(case["scene"]), encoding="utf-8")
    command = [PROGRAM, "converge", scene, "--quantity", next(iter(case["values"])), "--error", "1e-3", "--relative",
               "--limit", SECONDS, "--jobs", "1", "--quiet", "--report", report]
    if case["scene"].get("analysis", "dynamics") == "dynamics":
        command += ["--at", repr(case["t"][-1])]
    told = subprocess.run(command, capture_output=True, text=True)
    found = json.loads(report.read_text(encoding="utf-8")) if told.returncode in (0, 1, 3) and report.exists() else {}
    return found, told.stderr.strip().replace("\n", "; ")


FOLDER.mkdir(parents=True, exist_ok=True)
with ThreadPoolExecutor(cpu_count()) as threads:
    found = list(threads.map(converged, CHOSEN))
answered = outside = 0
for index, (report, said) in zip(CHOSEN, found):
    case = CASES[index]
    name, values = next(iter(case["values"].items()))
    if report.get("answer") is None or report.get("uncertainty") is None:
        print(f"{case['name']}, {name}: nothing is known ({said})")
        continue
    answered += 1
    off = abs(report["answer"] - values[-1])
    if off > report["uncertainty"] + case["uncertainty"]:
        outside += 1
        print(f"{case['name']}, {name}: {off:.3g} off, +- {report['uncertainty']:.3g} was said, known to {case['uncertainty']:.3g}")
print(f"{answered} of {len(CHOSEN)} answered, {answered - outside} within the stated uncertainty")
sys.exit(outside > MOST_OUTSIDE * answered or answered < (1 - 2 * MOST_OUTSIDE) * len(CHOSEN))
