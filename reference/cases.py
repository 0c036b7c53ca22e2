#!/usr/bin/env python3
"""Writes reference/cases/*.json: motions that vlbeam score compares other codes with.

    cases.py [PROGRAM]

Most are the answers of the judge, another program with another formulation (reference/judge/judge.json). Without PROGRAM
these alone are written. What the judge does not compute, engineering strain, is run by PROGRAM on three meshes, each twice
as fine as the one before: a value is that of the finest, its uncertainty three times the largest difference among the three
(Eca & Hoekstra's estimate where no order is claimed).
"""
import json
import os
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor

here = os.path.dirname(os.path.abspath(__file__))
program = os.path.abspath(sys.argv[1]) if len(sys.argv) > 1 else None
columns = {"joint_position": "m", "mass_x": "m", "mass_y": "m", "start_x": "m", "start_y": "m", "end_x": "m", "end_y": "m",
           "energy_kinetic": "J"}


def trajectory(scene, elements):
    scene = json.loads(json.dumps(scene))
    scene["beam"]["elements"] = elements
    done = subprocess.run([program, "run", "-", "--csv", "-", "-q"], input=json.dumps(scene), capture_output=True,
                          text=True, check=True)
    head, *lines = done.stdout.splitlines()
    names, units = zip(*(cell.split(" [") for cell in head.split(",")))
    rows = [[float(cell) if cell else None for cell in line.split(",")] for line in lines]
    return {name: (unit[:-1], [row[i] for row in rows]) for i, (name, unit) in enumerate(zip(names, units))}


def write(name, case):
    os.makedirs(os.path.join(here, "cases"), exist_ok=True)
    with open(os.path.join(here, "cases", name + ".json"), "w") as file:
        json.dump(case, file)
        file.write("\n")


def read(*path):
    with open(os.path.join(here, *path)) as file:
        return json.load(file)


def certified(name, scene, finest):
    """By runs of the program on three meshes."""
    with ThreadPoolExecutor(2) as pool:
        runs = list(pool.map(lambda n: trajectory(scene, n), (finest, finest // 2, finest // 4)))
    case = {"title": scene["title"], "source": f"vlbeam run on {finest // 4}, {finest // 2} and {finest} elements (reference/cases.py)",
            "scene": scene, "t": runs[0]["t"][1], "columns": {}}
    for column in columns:
        if column not in runs[0]:
            continue
        series = [run[column][1] for run in runs]
        spread = [3 * (max(values) - min(values)) for values in zip(*series)]
        case["columns"][column] = {"unit": runs[0][column][0], "values": series[0], "uncertainties": spread}
    write(name, case)


def judged():
    """By the judge."""
    asked = {case["case"]: case for case in read("judge", "cases.json")["cases"]}
    for answer in read("judge", "judge.json")["cases"]:
        scene = asked[answer["case"]]["scene"]
        scene["beam"]["strain_law"] = "green"  # the judge's energy (reference/judge/energy.hpp)
        scene["output"] = {"interval": answer["t"][0]}
        known = {name.replace("mass_position", "mass").replace(".", "_"): numbers for name, numbers in answer["quantities"].items()}
        write(answer["case"],
              {"title": scene["title"] + ": " + answer["what"], "source": "the judge, another formulation (reference/judge)",
               "scene": scene, "t": answer["t"],
               "columns": {name: {"unit": unit, "values": known[name]["value"], "uncertainties": known[name]["uncertainty"]}
                           for name, unit in columns.items() if name in known}})


judged()
if program:
    falling = read("..", "scenes", "falling_beam.json")
    falling["output"] = {"interval": 0.005}
    falling["duration"] = 0.45
    falling["beam"]["strain_law"] = "engineering"
    falling["title"] += ", engineering strain"
    certified("falling_beam_engineering", falling, 80)
