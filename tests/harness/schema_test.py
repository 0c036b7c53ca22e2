#!/usr/bin/env python3
"""What the program prints as JSON Schema is one, accepts what it should and refuses what it should not.

schema_test.py PROGRAM SOURCE_DIR
"""
import copy
import glob
import json
import os
import subprocess
import sys
import tempfile

from jsonschema import Draft202012Validator

program, source = sys.argv[1:3]
checks = 0


def schema(name):
    text = subprocess.run([program, "schema", name], check=True, capture_output=True, text=True).stdout
    Draft202012Validator.check_schema(json.loads(text))
    return Draft202012Validator(json.loads(text))


def expect(validator, instance, valid, what):
    global checks
    checks += 1
    errors = [f"{error.json_path}: {error.message}" for error in validator.iter_errors(instance)]
    if valid == bool(errors):
        sys.exit(f"{what} should {'' if valid else 'not '}be valid: {errors}")


scene, run, study, gates, converge, sweep = (
    schema(name) for name in ("scene", "run", "study", "gates", "converge", "sweep"))

example = {
    "schema": "vlbeam.scene/1",
    "dimension": 2,
    "gravity": [0, -9.81],
    "beam": {"section": {"type": "circle", "radius": 0.01}, "elements": 4},
    "supports": [{"at": "start", "type": "clamp", "clamp": "direction"}, {"at": "end", "type": "free"}],
    "sliding_mass": {"mass": 0.8, "position": 0.1},
    "duration": 0.01,
    "output": {"interval": 0.005},
}
expect(scene, example, True, "the example")
expect(scene, {"beam": {}, "duration": 1}, True, "the shortest scene")
expect(scene, {"beam": {}}, False, "a scene without duration")
expect(scene, {"duration": 1}, False, "a scene without beam")


def changed(**changes):
    result = copy.deepcopy(example)
    for path, value in changes.items():
        *parents, key = path.split("__")
        node = result
        for parent in parents:
            node = node[parent]
        node[key] = value
    return result


# Several beams and bodies: what their schema refers to is found in a scene and in a report.
with open(os.path.join(source, "scenes", "trolley_and_hook.json")) as file:
    crane = json.load(file)
expect(scene, crane, True, "a crane")
several = copy.deepcopy(crane) | {"duration": 0.05, "output": {"interval": 0.05, "configurations": [0]}}
told = subprocess.run([program, "run", "-", "-q", "--no-check", "--report", "-"], input=json.dumps(several), check=True, capture_output=True,
                      text=True)
expect(run, json.loads(told.stdout), True, "the report of a crane")
for path, value in (("beams", []), ("beams/0/elementz", 3), ("bodies/0/mass", 0), ("links/0/type", "weld")):
    wrong = copy.deepcopy(crane)
    *parents, key = path.split("/")
    node = wrong
    for parent in parents:
        node = node[int(parent) if parent.isdigit() else parent]
    node[key] = value
    expect(scene, wrong, False, f"{value} at {path}")

stiffness = {"type": "stiffness", "EA": 1, "EI": 0, "rhoA": 1}
expect(scene, changed(beam__section=stiffness), True, "stiffnesses")
expect(scene, changed(beam__section={"radius": 0.1}), True, "a circle by default")
expect(scene, changed(beam__section={**stiffness, "radius": 0.1}), False, "a radius with stiffnesses")
expect(scene, changed(beam__section={"type": "stiffness", "EA": 1, "EI": 0}), False, "stiffnesses without rhoA")
expect(scene, changed(beam__section={"EA": 1}), False, "EA of a circle")
expect(scene, changed(beam__section=stiffness, beam__material={"density": 1}), False, "density with stiffnesses")
expect(scene, changed(supports=[{"at": "start", "type": "pin", "clamp": "full"}]), False, "the clamp of a pin")
expect(scene, changed(supports=[{"at": "middle", "type": "pin"}]), False, "a support in the middle")
motion = {"direction": [0, 1], "amplitude": 0.1, "frequency": 3, "ramp": 0.01}
expect(scene, changed(supports=[{"at": "end", "type": "pin", "motion": motion}]), True, "a support that moves")
expect(scene, changed(supports=[{"at": "end", "type": "pin", "motion": {"rate": 1}}]), False, "a motion without direction")
expect(scene, changed(supports=[{"at": "end", "type": "clamp", "motion": {"angle": {"value": 1, "ramp": 1}}}]), True, "a clamp that turns")
expect(scene, changed(sliding_mass={"mass": 1}), False, "a mass without position")
expect(scene, changed(beam__elemnts=4), False, "an unknown key")
expect(scene, changed(duration=0), False, "no duration")
for method in ("adams-bashforth-moulton", "generalized-alpha"):
    expect(scene, changed(integrator={"type": method, "step": 1e-4}), True, "a fixed step")
expect(scene, changed(setting="ding-ouyang-2022"), True, "the paper's setting")
expect(scene, changed(setting="paper"), False, "a setting that is not known")
expect(scene, changed(integrator="auto"), True, "an integrator that the scene chooses")
expect(scene, changed(integrator="fast"), False, "an integrator that is not known")
expect(scene, changed(integrator={"type": "rosenbrock4", "step": 1e-4}), False, "the step of a method that chooses it")
expect(scene, changed(integrator={"step": 1e-4}), False, "the step of the default method")
expect(scene, changed(beam__elements=2.5), False, "half an element")

flow = {"nodes": [{"node": 0, "x": {"rate": -1}}, {"node": 4, "x": {"value": 1}, "support": "slide"}]}
load = {"type": "force", "node": 1, "direction": [0, 1], "magnitude": {"value": 1}}
expect(scene, changed(flow=flow), True, "a flow")
expect(scene, changed(flow={"nodes": [{"x": {"rate": -1}}]}), False, "a guide without node")
expect(scene, changed(loads=[load, {"type": "torque", "at": "point", "x": {"rate": 1}}]), True, "loads")
expect(scene, changed(loads=[{**load, "at": "beam"}]), False, "the node of a distributed load")
expect(scene, changed(loads=[{**load, "type": "torque"}]), False, "the direction of a torque")
expect(scene, changed(spin={"drives": [{"node": 0, "angle": {"rat": 1}}]}), False, "an unknown key in a list")

# What the program itself writes.
shaft = {
    "beam": {"elements": 4},
    "spin": {"angles": "hermite", "drives": [{"node": 0}]},
    "flow": {"nodes": [{"node": 0, "x": {"rate": -1}}, {"node": 4, "x": {"value": 1}}]},
    "loads": [load],
    "duration": 0.001,
    "output": {"interval": 0.001, "configurations": [0]},
}
with tempfile.TemporaryDirectory() as folder:
    path = os.path.join(folder, "scene.json")
    ramped = {**example, "gravity_ramp": 0.005, "sliding_mass": {"mass": 1, "position": 0.3, "slopes": "free"},
              "output": {"configurations": [0.01]}}
    spatial = {"dimension": 3, "gravity": [0, 0, -1], "duration": 0.001, "output": {"configurations": [0]},
               "beam": {"curve": {"start": [0, 0, 0], "end": [0, 1, 0]}, "elements": 4},
               "supports": [{"at": "start", "type": "pin"}], "sliding_mass": {"mass": 1, "position": 0.3}}
    held = {**shaft, "spin": {"drives": [{"node": 0, "angle": {"rate": 9}}]}, "loads": [],
            "flow": {"nodes": [{"node": 0}, {"node": 2, "x": {"value": 0.5}, "support": "slide"},
                               {"node": 4, "x": {"value": 1}}]}}
    for written in (example, shaft, ramped, spatial, held):
        with open(path, "w") as file:
            json.dump(written, file)
        done = subprocess.run([program, "run", path, "--report", "-"], capture_output=True, text=True)
        assert done.returncode == 0, done.stderr
        report = json.loads(done.stdout)
        expect(run, report, True, "a run's report")
        expect(scene, report["scene"], True, "the echoed scene")



def undescribed(schema, at):
    """Where a property of a run's report has no description."""
    for key, child in {**schema.get("properties", {}), **schema.get("patternProperties", {})}.items():
        if not child.get("description") and "const" not in child:
            yield f"{at}/{key}"
        yield from undescribed(child, f"{at}/{key}")
    if "items" in schema:
        yield from undescribed(schema["items"], at + "/0")


checks += 1
missing = list(undescribed(run.schema, ""))
assert not missing, f"no description: {missing}"

for path in glob.glob(os.path.join(source, "studies/*/gates.json")):
    with open(path) as file:
        instance = json.load(file)
    expect(gates, instance, True, path)
    with open(os.path.join(os.path.dirname(path), "README.md")) as file:
        excused = "no exact or independent gate" in file.read()
    checks += 1
    evidence = any(gate["kind"] in ("exact", "independent") for gate in instance["gates"])
    assert evidence != excused, f"{path}: an exact or independent gate, or a sentence in the README why there is none"
for path in glob.glob(os.path.join(source, "reports/*.json")):
    if not path.endswith(".timing.json"):
        with open(path) as file:
            expect(study, json.load(file), True, path)
rule = {"name": "a", "kind": "exact", "reason": "b", "quantity": "c", "max": 1}
guard = {"name": "a", "kind": "regression", "guards": "b", "quantity": "c", "max": 1}
order = {"expected": 2, "tolerance": 1, "at_most": 3, "finest_error": 1}
expect(gates, {"schema": "vlbeam.gates/1", "gates": [rule]}, True, "a gate")
expect(gates, {"schema": "vlbeam.gates/1", "gates": [{**rule, "fit": "d"}]}, False, "a gate on two things")
expect(gates, {"schema": "vlbeam.gates/1", "gates": [{k: rule[k] for k in rule if k != "max"}]}, False, "no bound")
for one, valid, what in (
    (guard, True, "a guard"),
    ({**guard, "reason": "c"}, False, "a guard with a reason"),
    ({**rule, "kind": "regression"}, False, "a guard that guards nothing"),
    ({**rule, "guards": "c"}, False, "evidence that guards"),
    ({**rule, "kind": "measured"}, False, "a kind there is not"),
    ({**rule, "kind": "self"}, False, "self-convergence without uncertainty"),
    ({**rule, "kind": "self", "uncertainty": "u"}, True, "self-convergence with its uncertainty"),
    ({"name": "a", "kind": "self", "reason": "b", "fit": "c", "order": order}, True, "an order of its own errors"),
):
    expect(gates, {"schema": "vlbeam.gates/1", "gates": [one]}, valid, what)


def output(*arguments):
    return subprocess.run([program, *arguments], capture_output=True, text=True).stdout


for path in glob.glob(os.path.join(source, "scenes/*.json")):
    with open(path) as file:
        expect(scene, json.load(file), True, path)
pendulum = os.path.join(source, "scenes/pendulum.json")
for arguments in (["--error", "1e-3"], ["--error", "1e-3", "--relative", "--horizon", "--at", "0.1"], ["--error", "1e-12"]):
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "c.json")
        if arguments[1] == "1e-12":  # what is not reached has a reason: a short motion, to give up early
            arguments += ["--at", "0.02"]
        output("converge", pendulum, "--quantity", "end.y", "--report", path, *arguments)
        with open(path) as file:
            expect(converge, json.load(file), True, f"a report of converge {arguments}")
given = {"schema": "vlbeam.sweep/1", "scene": "a.json", "over": {"/beam/elements": [1, 2]}}
expect(sweep, given, True, "a sweep")
expect(sweep, {**given, "over": {"/duration": {"from": 1, "to": 2, "count": 3, "spacing": "logarithmic"}}}, True, "a range")
expect(sweep, {**given, "over": {"/duration": {"from": 1, "to": 2}}}, False, "a range without a count")
expect(sweep, {**given, "combine": "both"}, False, "another combination")
expect(sweep, {**given, "quantity": []}, False, "an unknown key of a sweep")

print(f"{checks} checks passed")
