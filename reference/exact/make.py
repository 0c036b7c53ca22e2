#!/usr/bin/env python3
"""Writes reference/exact/exact.json: exact solutions of problems that beams, strings, shafts and beads have, with the errors of their digits.

    make.py                  all of it, in two minutes
    make.py --check          computes all anew, and compares with the file
    make.py catenary beads   prints the cases of these modules

Each module has its equations, sources, and functions for other parameters. Needs Python 3, mpmath and numpy.
"""
import importlib
import json
import os
import sys

sys.dont_write_bytecode = True
os.environ["OPENBLAS_NUM_THREADS"] = os.environ["OMP_NUM_THREADS"] = "1"  # sums in one order: the same digits

TOPICS = ("elastica", "sleeves", "catenary", "beads", "moving_loads", "axial", "torsion", "pulleys", "columns", "pendulums")
FILE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "exact.json")


def solved(topics):
    result = []
    for topic in topics:
        for case in importlib.import_module(topic).cases():
            result.append({"case": case.pop("case"), "module": topic, **case})
            print(result[-1]["case"], file=sys.stderr, flush=True)
    return result


def flat(value):
    return [x for v in value for x in flat(v)] if isinstance(value, (list, tuple)) else [value]


def differences(now, kept):
    """Values that differ by more than both errors."""
    kept = {case["case"]: case for case in kept}
    result = [f"{name}: no longer there" for name in kept.keys() - {case["case"] for case in now}]
    for case in now:
        old = kept.get(case["case"])
        if old is None or old["values"].keys() != case["values"].keys():
            result.append(f"{case['case']}: other values")
            continue
        for key, value in case["values"].items():
            allowed = case["error"][key] + old["error"][key] + 1e-15
            worst = max(abs(a - b) - allowed - 1e-15 * abs(a) for a, b in zip(flat(value), flat(old["values"][key])))
            if worst > 0:
                result.append(f"{case['case']}: {key} differs")
    return result


if __name__ == "__main__":
    arguments = sys.argv[1:]
    unknown = [a for a in arguments if a not in TOPICS + ("--check",)]
    if unknown:
        sys.exit(f"no topic {', '.join(unknown)}: there are {', '.join(TOPICS)}, and --check")
    if arguments == ["--check"]:
        with open(FILE) as file:
            kept = json.load(file)["cases"]
        found = differences(solved(TOPICS), kept)
        print("\n".join(found) or "as in the file")
        sys.exit(bool(found))
    if arguments:
        print(json.dumps(solved([a for a in arguments if a in TOPICS]), indent=1))
        sys.exit()
    cases = solved(TOPICS)
    if len({case["case"] for case in cases}) < len(cases):
        sys.exit("two cases have the same name")
    with open(FILE, "w") as file:
        json.dump({"source": "reference/exact/make.py: closed forms, roots, series, shooting and ordinary differential equations, no elements; "
                             "error is the largest difference from another precision, step or method, with the rounding",
                   "cases": cases}, file, indent=1)
        file.write("\n")
