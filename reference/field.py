#!/usr/bin/env python3
"""Computes the answers of reference/field.json anew: numbers that other programs' tests, manuals and papers print, and what is right.

A problem has the scene that vlbeam runs, and numbers: a quantity of its last sample (or at a time, `at`), of which factor * quantity +
offset is what is printed, within half a unit of the last digit or what their own words or test allow. `answer` is the right value of the
model that vlbeam has, `known_to` its uncertainty, `theirs` the right value of the model that printed the number, where it is another
one. field_beams.py and field_cables.py have the equations. All else in the file is written by hand.

    field.py               needs numpy, scipy and mpmath; a minute
"""
import json
import math
from pathlib import Path

import field_beams
import field_cables

HERE = Path(__file__).resolve().parent
ABOUT = ("Problems that the tests, manuals and papers of other programs print numbers of, with the right values of these numbers. ours = "
         "factor * quantity + offset, of the last sample or at a time; printed, and what it is right within by its own digits, words or "
         "test; answer: the right value of vlbeam's model, known_to: its uncertainty; theirs: the right value of their model, where that "
         "is another one. Made by reference/field.py: it computes answer, known_to and theirs; the rest is written by hand.")


def uncertainty(value, told):
    """At least what double precision leaves, as 1, 2 or 5 times a power of ten."""
    least = max(float(told), 1e-12 * abs(value))
    power = 10.0**math.floor(math.log10(least))
    return next(float(f"{step * power:.0e}") for step in (1, 2, 5, 10) if step * power >= least * (1 - 1e-9))


def fill(number, answer):
    value, told, *theirs = map(float, answer)
    known = uncertainty(value, told)
    digits = 1 - math.floor(math.log10(known))
    number["answer"], number["known_to"] = round(value, digits), known
    number.pop("theirs", None)
    if theirs:
        number["theirs"] = round(theirs[0], digits) + 0.0


def written(value, indent=0, width=140):
    """JSON: what fits on a line is on one, and each number of a problem has one."""
    line = json.dumps(value, ensure_ascii=False)
    if len(line) + indent <= width or not isinstance(value, (dict, list)) or "printed" in value:
        return line
    pad = " " * (indent + 1)
    if isinstance(value, dict):
        inside = (f"{pad}{json.dumps(key)}: {written(of, indent + 1, width - len(key) - 4)}" for key, of in value.items())
    else:
        inside = (pad + written(of, indent + 1, width) for of in value)
    first, final = "{}" if isinstance(value, dict) else "[]"
    return first + "\n" + ",\n".join(inside) + "\n" + " " * indent + final


def main():
    field = json.loads((HERE / "field.json").read_text())
    answers = {**field_beams.answers(), **field_cables.answers()}
    assert set(answers) == {problem["name"] for problem in field["problems"]}
    for problem in field["problems"]:
        for number in problem["numbers"]:
            fill(number, answers[problem["name"]][number["quantity"] + (f"@{number['at']:g}" if "at" in number else "")])
    (HERE / "field.json").write_text(written({"about": ABOUT, "problems": field["problems"]}) + "\n")


if __name__ == "__main__":
    main()
