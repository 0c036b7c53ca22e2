#!/usr/bin/env python3
"""No answer depends on the units: scenes of the library in other units of length, mass and time, each number scaled by
the unit that `vlbeam schema scene` gives it, must give the same run in those units.

scales_test.py PROGRAM SOURCE_DIR             some scenes in some units
scales_test.py PROGRAM SOURCE_DIR SCENE ...   these; --all: each scene of the library, at each end of each scale
scales_test.py PROGRAM SOURCE_DIR --print LENGTH MASS TIME SCENE      only prints the scene in these units

A scene is run as it is, then in units in which its lengths, masses and times are so many times as large. By powers of
ten the automatic choice of the integrator and the warnings must be the same, steps differ by at most 5 % and places by
no more than the accuracy asked. By powers of two, with the integrator that was chosen, steps must be the same and places
differ by rounding only.
"""
import copy
import glob
import json
import math
import os
import re
import subprocess
import sys
import tempfile

# What units are made of: powers of length, mass and time.
BASE = {"m": (1, 0, 0), "kg": (0, 1, 0), "s": (0, 0, 1), "N": (1, 1, -2), "Pa": (-1, 1, -2), "J": (2, 1, -2),
        "W": (2, 1, -3), "Hz": (0, 0, -1)}
PURE = {"-", "1", "rad", "degrees", "a", "turn"}
LOAD = "N, N m, or these per m"  # which one is said by the type of the load and by what it acts on
STATE = "m, m/s, rad, rad/s, -, 1/s"


def powers(unit):
    total = [0, 0, 0]
    for i, part in enumerate(unit.split("/")):
        for token in part.split():
            name, _, exponent = token.partition("^")
            if name in PURE:
                continue
            for k, power in enumerate(BASE[name]):
                total[k] += (-1 if i else 1) * power * int(exponent or 1)
    return total


class Units:
    """How many times as large lengths, masses and times are."""

    def __init__(self, length=1, mass=1, time=1):
        self.scales = (length, mass, time)

    def factor(self, unit):
        exact = 1.0
        for scale, power in zip(self.scales, powers(unit)):
            exact = exact * scale ** power if power >= 0 else exact / scale ** -power
        return exact

    def __str__(self):
        return "length {:g}, mass {:g}, time {:g}".format(*self.scales)


def unit_of(schema):
    found = re.search(r" \[([^\[\]]+)\](?=; | \(|$)", schema.get("description", ""))
    return found.group(1) if found else None


def multiply(value, factor):
    if isinstance(value, list):
        return [multiply(each, factor) for each in value]
    return value if value is None or isinstance(value, bool) else value * factor


def load_unit(load):
    unit = "N m" if load.get("type", "force") in ("moment", "torque") else "N"
    return unit + "/m" if load.get("at", "node") == "beam" else unit


def scaled(node, schema, units, load=None):
    """`node` of a scene in other units."""
    if "anyOf" in schema and "properties" not in schema:
        schema = next(each for each in schema["anyOf"] if "properties" in each)
    if isinstance(node, dict):
        load = node if "magnitude" in node else load
        return {key: scaled(value, schema["properties"][key], units, load) for key, value in node.items()}
    unit = unit_of(schema)
    if isinstance(node, list) and unit is None and "items" in schema:
        return [scaled(each, schema["items"], units, load) for each in node]
    if unit is None or isinstance(node, str):
        return node
    if unit == STATE:
        raise SystemExit("a scene with one atol for all of the state depends on its units")
    table, comma, unit_of_value = unit.partition(", ")
    if comma and table == "s":
        value = unit_of_value.replace(LOAD, load_unit(load)) if load else unit_of_value
        return [[multiply(t, units.factor("s")), multiply(f, units.factor(value))] for t, f in node]
    if load:
        unit = unit.replace(LOAD, load_unit(load))
    return multiply(node, units.factor(unit))


class Program:
    def __init__(self, path):
        self.path = path
        self.scene_schema, self.run_schema = (json.loads(self.text("schema", name)) for name in ("scene", "run"))

    def text(self, *arguments):
        return subprocess.run([self.path, *arguments], check=True, capture_output=True, text=True).stdout

    def run(self, scene):
        with tempfile.TemporaryDirectory() as folder:
            report = os.path.join(folder, "report.json")
            done = subprocess.run([self.path, "run", "--no-check", "-", "--report", report, "-q"],
                                  input=json.dumps(scene), text=True, capture_output=True)
            if not os.path.exists(report):
                return {"status": "refused", "message": done.stderr.strip()}
            with open(report) as file:
                return json.load(file)

    def in_units(self, scene, units):
        return scaled(scene, self.scene_schema, units)

    def whole(self, scene, report):
        """The scene with all that it left to defaults, some of which have units; but with its own integrator."""
        whole = copy.deepcopy(report["scene"])
        whole["integrator"] = scene.get("integrator", "auto")
        if scene.get("analysis") == "statics":
            whole.pop("integrator")
        return whole


def quantities(node, schema, path=""):
    """Samples and what they have a unit of, by their paths."""
    if "properties" in schema and isinstance(node, dict):
        for key, value in node.items():
            if key in schema["properties"]:
                yield from quantities(value, schema["properties"][key], path + "/" + key)
    elif isinstance(node, list) and schema.get("type") == "array":
        yield path, unit_of(schema) or "-", node


def flat(values):
    for value in values:
        if isinstance(value, list):
            yield from flat(value)
        elif value is not None and not isinstance(value, (str, bool)):
            yield value


def differences(program, one, other, units):
    """Of samples, over the largest that there is of each quantity."""
    key = "samples"
    schema = program.run_schema["properties"][key]
    there = {path: values for path, _, values in quantities(other[key], schema)}
    statics = one["scene"].get("analysis") == "statics"
    for path, unit, values in quantities(one[key], schema):
        if statics and path == "/t":  # the number of the equilibrium
            continue
        a, b = list(flat(values)), [value / units.factor(unit) for value in flat(there.get(path, []))]
        if len(a) != len(b):
            yield path, math.inf
            continue
        size = max(map(abs, a), default=0)
        yield path, max((abs(x - y) for x, y in zip(a, b)), default=0) / size if size > 0 else max(map(abs, b), default=0)


def steps(report):
    return report.get("solver", {}).get("steps", 0)


TEN = [Units(length=1e-6), Units(length=1e6), Units(mass=1e-9), Units(mass=1e9), Units(time=1e-6), Units(time=1e6),
       Units(1e-3, 1e-9, 1e-3), Units(1e3, 1e9, 1e3)]
TWO = [Units(length=2.0 ** -20), Units(length=2.0 ** 20), Units(mass=2.0 ** -30), Units(mass=2.0 ** 30),
       Units(time=2.0 ** -20), Units(time=2.0 ** 20)]


def check(program, name, scene, tens, twos, tolerance):
    """What is wrong, in lines."""
    here = program.run(scene)
    whole = program.whole(scene, here)
    method = here.get("scene", {}).get("integrator", {})
    for units in tens:
        there = program.run(program.in_units(whole, units))
        head = f"{name}, {units}: "
        if there["status"] != here["status"]:
            yield head + f"{there['status']} for {here['status']}, {there.get('failure', there.get('message', ''))}"
            continue
        chosen = there["scene"].get("integrator", {})
        if chosen.get("type") != method.get("type"):
            yield head + f"{chosen.get('type')} for {method.get('type')}"
        if abs(steps(there) - steps(here)) > 0.05 * steps(here):
            yield head + f"{steps(there)} steps for {steps(here)}"
        kinds = [sorted({warning["kind"] for warning in run.get("warnings", [])}) for run in (here, there)]
        if kinds[0] != kinds[1]:
            yield head + f"warnings {kinds[1]} for {kinds[0]}"
        for path, error in differences(program, here, there, units):
            if error > tolerance and path in PLACES:
                yield head + f"{path} differs by {error:.1e}"
    fixed = copy.deepcopy(whole)
    if "integrator" in fixed:
        fixed["integrator"] = method
        here = program.run(fixed)  # a method that is named knows less of what is to come than the automatic one
    for units in twos:
        there = program.run(program.in_units(fixed, units))
        head = f"{name}, {units}: "
        if there["status"] != here["status"]:
            yield head + f"{there['status']} for {here['status']}, {there.get('failure', there.get('message', ''))}"
            continue
        if steps(there) != steps(here):
            yield head + f"{steps(there)} steps for {steps(here)}, with the same integrator"
        for path, error in differences(program, here, there, units):
            if error > ROUNDING and path in PLACES:
                yield head + f"{path} differs by {error:.1e}, with the same integrator"


PLACES = ("/end", "/joint_position", "/mass_position", "/sliding_joints/position", "/sliding_joints/mass_position")
ROUNDING = 1e-9
SOME = [("pendulum", None), ("pendulum", {"accuracy": 1e-8}), ("winch", None), ("three_weights", None),
        ("semicircle", None), ("kite", None)]


def main():
    program, source = Program(sys.argv[1]), sys.argv[2]
    names = sys.argv[3:]

    def read(name):
        with open(name if name.endswith(".json") else os.path.join(source, "scenes", name + ".json")) as file:
            return json.load(file)

    if names[:1] == ["--print"]:
        units = Units(*map(float, names[1:4]))
        json.dump(program.in_units(read(names[4]), units), sys.stdout, indent=1)
        return
    tens, twos, cases = TEN, TWO, [(name, None) for name in names]
    if names[:1] == ["--all"]:
        files = glob.glob(os.path.join(source, "scenes", "*.json"))
        cases = [(name, None) for name in sorted(os.path.basename(each)[:-5] for each in files)]
    elif not names:
        tens, twos, cases = TEN[-2:], TWO[:3], SOME
    wrong = 0
    for name, integrator in cases:
        scene = read(name)
        if integrator:
            scene["integrator"] = integrator
        for line in check(program, name, scene, tens, twos, 1e-4):
            wrong += 1
            print(line, flush=True)
    if wrong:
        sys.exit(f"{wrong} differences between units")


if __name__ == "__main__":
    main()
