#!/usr/bin/env python3
"""Writes reference/work_precision.json: the states that the study work_precision measures errors against.

    work_precision.py PROGRAM          (make references)

Each problem of the study is run by two integrators that share nothing but the right-hand side, at tolerances near
rounding. Their difference is the stated error; the first one's state is the reference.
"""
import json
import math
import os
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor

here = os.path.dirname(os.path.abspath(__file__))
program = os.path.abspath(sys.argv[1])
with open(os.path.join(here, "..", "studies", "work_precision", "study.json")) as file:
    study = json.load(file)


def merged(target, patch):
    """RFC 7396."""
    if not isinstance(patch, dict):
        return patch
    result = dict(target) if isinstance(target, dict) else {}
    for key, value in patch.items():
        if value is None:
            result.pop(key, None)
        else:
            result[key] = merged(result.get(key), value)
    return result


def final_state(scene):
    scene = merged(scene, {"output": {"interval": scene["duration"]}})
    done = subprocess.run([program, "run", "-", "--report", "-"], input=json.dumps(scene), capture_output=True, text=True)
    report = json.loads(done.stdout) if done.stdout else {}
    if report.get("status") != "completed":
        sys.exit(f"{json.dumps(scene)}: {report.get('status')} {done.stderr}")
    samples, n = report["samples"], -1
    return {
        "joint_position": samples["joint_position"][n],
        "mass_position": samples["mass_position"][n],
        "end": samples["end"][n],
        "events": len(report["events"]),
    }


def difference(a, b):
    """max(|dx_i|, |dr_end|, |dr_mass|) [m], of a beam 1 m long."""
    distances = [math.dist(a["end"], b["end"])]
    if a["joint_position"] is not None:
        distances += [abs(a["joint_position"] - b["joint_position"]), math.dist(a["mass_position"], b["mass_position"])]
    return max(distances)


def certified(problem, element):
    scene = merged(merged(study["scene"], problem.get("scene", {})), {"beam": {"element": element}})
    tolerance = problem["reference_tolerance"]
    first, second = (
        final_state(merged(scene, {"integrator": {"type": integrator, "rtol": tolerance, "atol": tolerance}}))
        for integrator in study["reference_integrators"]
    )
    return {**first, "tolerance": tolerance, "error": difference(first, second)}


def converged():
    spec = study["converged"]
    scene = merged(merged(study["scene"], spec["scene"]), {"integrator": spec["integrator"]})
    states = [final_state(merged(scene, {"beam": {"element": element}})) for element in spec["elements"]]
    coarser = final_state(merged(scene, {"beam": {"element": spec["elements"][-1], "elements": spec["coarser"]}}))
    return {**states[-1], "error": max(difference(*states), difference(states[-1], coarser))}


with ThreadPoolExecutor(2) as pool:
    pending = {
        name: {element: pool.submit(certified, problem, element) for element in problem["elements"]}
        for name, problem in study["problems"].items()
    }
    finest = pool.submit(converged)
    first, second = study["reference_integrators"]
    result = {
        "source": "reference/work_precision.py, from the scenes of studies/work_precision/study.json: states at the"
        f" end of each run by {first} at the given tolerance; error is the difference to {second} at the same one."
        f" converged is the falling beam with {study['converged']['scene']['beam']['elements']} elements; its error is"
        f" the larger of the differences to the other element and to {study['converged']['coarser']} elements.",
        "units": {"joint_position": "m", "mass_position": "m", "end": "m", "error": "m"},
        "problems": {name: {e: job.result() for e, job in jobs.items()} for name, jobs in pending.items()},
        "converged": finest.result(),
    }
with open(os.path.join(here, "work_precision.json"), "w") as file:
    json.dump(result, file, indent=2)
    file.write("\n")
for name, elements in result["problems"].items():
    for element, state in elements.items():
        print(f"{name} {element}: two integrators agree to {state['error']:.1e} m")
print(f"converged: known to {result['converged']['error']:.1e} m")
