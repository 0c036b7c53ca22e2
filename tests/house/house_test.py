#!/usr/bin/env python3
"""Holds the plan of the house: its floors; how often the heart (elements, motion, time) names a room, or includes one, which
may only become less.

    house_test.py ROOT            compares with house.json
    house_test.py ROOT --write    writes what is counted now
    house_test.py ROOT --list     shows the lines that are counted
"""

import json
import re
import sys
from pathlib import Path

ROOT = Path(sys.argv[1]).resolve()
COUNTED = Path(__file__).resolve().with_name("house.json")

# The heart: elements, one beam in motion, time; and the rooms of mechanics/, which use it. No one in the heart is to use a
# room.
HEART = {"elements": "core", "motion": "mechanics/motion", "time": "mechanics/time"}
ROOMS = ("frames", "spin", "flow", "ride", "contact", "ropes", "remesh", "conserving", "sundials", "statics", "assembly",
         "bearings", "vehicles")
# What a line of the heart says when it names a room: words of the code, not of comments.
WORDS = {
    "frames": r"frames|Frames|Frame[A-Z]|moving_frame|[Tt]riad",  # a support has a frame, too
    "spin": r"[Ss]pin|\bnut\b|\bNut|nut_|_nut|[Aa]ngle_?[Ff]ield",
    "flow": r"(?<![Uu]nder)[Ff]low|MovingMesh|moving_mesh|MeshMotion|[Tt]ravel",
    "ride": r"[Rr]ider|[Dd]eparted",
    "contact": r"[Ii]mpact|[Rr]ebound|NodeContact|AtSupport|at_support",
    "ropes": r"[Dd]rum|[Gg]round|[Dd]rag\b|[Ff]luid|[Ww]inch|[Oo]utlet",
    "remesh": r"(?<!order_)[Rr]elax|[Rr]estore",
    "conserving": r"[Cc]onserving|[Ee]nergy_?[Mm]omentum|[Dd]iscrete_?[Gg]radient",
    "sundials": r"[Ss]undials|SUNDIALS|\bIDA\b|\bida\b|cvode",
    "assembly": r"[Aa]ssembly|ActingLinks|LinkForces",
    "bearings": r"[Bb]earing|HeldPoint|PointSpring",
    "vehicles": r"[Vv]ehicle|[Aa]xle",
    "statics": r"[Ss]tatic(Sample|Equations|Search|Modes|Sum)|[Ee]quilibri",
}


def library_of(path):
    if path.startswith("mechanics/rooms."):
        return "rooms"
    if path.startswith("core/"):
        return "elements"
    folder = path.split("/")[1]
    assert folder in ROOMS + ("motion", "time"), f"{path} belongs to no library"
    return folder


def sources():
    return [file for folder in ("core", "mechanics") for file in sorted((ROOT / folder).rglob("*.[ch]pp"))]


def code_of(text):
    """Lines of code, with their numbers: no comments, no blanks."""
    for number, line in enumerate(text.splitlines(), 1):
        code = re.sub(r"//.*", "", line).strip()
        if code:
            yield number, code


def counted():
    """What is counted, and the lines behind it."""
    sizes, names, includes, found = {}, {}, {}, []
    for file in sources():
        path = file.relative_to(ROOT).as_posix()
        library = library_of(path)
        for number, code in code_of(file.read_text(encoding="utf-8")):
            sizes[library] = sizes.get(library, 0) + 1
            if library not in HEART:
                continue
            included = re.match(r'#include "((?:core|mechanics)/[^"]+)"', code)
            if included:
                room = library_of(included[1])
                if room in ROOMS:
                    includes[room] = includes.get(room, 0) + 1
                    found.append(f"{path}:{number}: [{room}] {code}")
                continue
            for room, words in WORDS.items():
                if re.search(words, code):
                    names[room] = names.get(room, 0) + 1
                    found.append(f"{path}:{number}: [{room}] {code}")
    return {"lines of code": dict(sorted(sizes.items())),
            "lines of the heart that name a room": dict(sorted(names.items())),
            "includes of a room by the heart": dict(sorted(includes.items()))}, found


def upward_includes():
    """Arrows of the heart that lead upwards: elements that use motion or time, motion that uses time's methods."""
    order = list(HEART)
    count = {}
    for file in sources():
        path = file.relative_to(ROOT).as_posix()
        if library_of(path) not in HEART:
            continue
        for included in re.findall(r'#include "((?:core|mechanics)/[^"]+)"', file.read_text(encoding="utf-8")):
            ours, theirs = library_of(path), library_of(included)
            if theirs in HEART and order.index(theirs) > order.index(ours):
                count[f"{ours} -> {theirs}"] = count.get(f"{ours} -> {theirs}", 0) + 1
    return dict(sorted(count.items()))


MOST_LINES = 400  # of a file of the heart
MODEL = "mechanics/motion/system/beam_model.hpp"


def reached(path, seen):
    """Headers of this project that a file includes, and these in turn."""
    for included in re.findall(r'#include "([^"]+)"', (ROOT / path).read_text(encoding="utf-8")):
        if included not in seen:
            seen.add(included)
            reached(included, seen)
    return seen


def sizes_of_the_heart():
    """What a reader of the heart meets."""
    long = [file for file in sources() if library_of(file.relative_to(ROOT).as_posix()) in HEART
            and len(file.read_text(encoding="utf-8").splitlines()) > MOST_LINES]
    return {"headers that the model's header reaches": len(reached(MODEL, set())),
            f"files above {MOST_LINES} lines": len(long)}


# The floors of the house: a file includes its own and those before it.
FLOORS = ("core", "mechanics", "scene", "io", "tools", "studies/harness", "studies")


def floor_of(path):
    floors = [floor for floor in FLOORS if path.startswith(floor + "/")]
    return FLOORS.index(max(floors, key=len)) if floors else None


def arrows_upwards():
    """Includes that lead from a floor to one above it."""
    found = []
    for folder in ("core", "mechanics", "scene", "io", "tools", "studies"):
        for file in sorted((ROOT / folder).rglob("*.[ch]pp")):
            path = file.relative_to(ROOT).as_posix()
            for included in re.findall(r'#include "([^"]+)"', file.read_text(encoding="utf-8")):
                above = floor_of(included)
                if above is not None and above > floor_of(path):
                    found.append(f"{path} includes {included}")
    return found


def main():
    now, found = counted()
    now["includes upwards within the heart"] = upward_includes()
    now["sizes of the heart"] = sizes_of_the_heart()
    if "--list" in sys.argv:
        print("\n".join(found))
        return 0
    if "--write" in sys.argv:
        COUNTED.write_text(json.dumps(now, indent=2) + "\n", encoding="utf-8")
        return 0
    known = json.loads(COUNTED.read_text(encoding="utf-8"))
    risen = []
    for what in known:
        if what == "lines of code":
            continue
        for key in sorted(set(known[what]) | set(now[what])):
            before, after = known[what].get(key, 0), now[what].get(key, 0)
            if after > before:
                risen.append(f"{what}: {key} {before} -> {after}")
            elif after < before:
                print(f"{what}: {key} {before} -> {after}: write it down (--write)")
    risen += arrows_upwards()
    if risen:
        print("A feature that the heart must know is in the wrong room (--list shows the lines):\n  " + "\n  ".join(risen))
        return 1
    return 0


sys.exit(main())
