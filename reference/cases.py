#!/usr/bin/env python3
"""Writes reference/cases/*.json: trajectories that vlbeam score compares other codes with.

    cases.py PROGRAM

Each case is a scene run on three meshes, each twice as fine as the one before. Its value at a time is that of the finest;
its uncertainty three times the largest difference among the three (Eca & Hoekstra's estimate where no order is claimed).
"""
import json
import os
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor

here = os.path.dirname(os.path.abspath(__file__))
program = os.path.abspath(sys.argv[1])


def trajectory(scene, elements):
    scene = json.loads(json.dumps(scene))
    scene["beam"]["elements"] = elements
    done = subprocess.run([program, "run", "-", "--csv", "-", "-q"], input=json.dumps(scene), capture_output=True,
                          text=True, check=True)
    head, *lines = done.stdout.splitlines()
    names, units = zip(*(cell.split(" [") for cell in head.split(",")))
    rows = [[float(cell) if cell else None for cell in line.split(",")] for line in lines]
    return {name: (unit[:-1], [row[i] for row in rows]) for i, (name, unit) in enumerate(zip(names, units))}


def certified(name, scene, finest, columns):
    with ThreadPoolExecutor(2) as pool:
        runs = list(pool.map(lambda n: trajectory(scene, n), (finest, finest // 2, finest // 4)))
    result = {"title": scene["title"], "source": f"vlbeam run on {finest // 4}, {finest // 2} and {finest} elements (reference/cases.py)",
              "scene": scene, "t": runs[0]["t"][1], "columns": {}}
    for column in columns:
        series = [run[column][1] for run in runs]
        spread = [3 * (max(values) - min(values)) for values in zip(*series)]
        result["columns"][column] = {"unit": runs[0][column][0], "values": series[0], "uncertainties": spread}
    os.makedirs(os.path.join(here, "cases"), exist_ok=True)
    with open(os.path.join(here, "cases", name + ".json"), "w") as file:
        json.dump(result, file)
        file.write("\n")


with open(os.path.join(here, "..", "scenes", "falling_beam.json")) as file:
    falling = json.load(file)
falling["output"] = {"interval": 0.005}
falling["duration"] = 0.45
columns = ["joint_position", "mass_x", "mass_y", "end_x", "end_y", "energy_kinetic"]
certified("falling_beam", falling, 80, columns)
engineering = json.loads(json.dumps(falling))
engineering["beam"]["strain_law"] = "engineering"
engineering["title"] += ", engineering strain"
certified("falling_beam_engineering", engineering, 80, columns)
