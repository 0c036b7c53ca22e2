#!/usr/bin/env python3
"""Times whole runs, and another program's beside them in the same minutes.

    bench/marks.py PROGRAM [--vs PROGRAM] [--repeats 5] [--slow]

Prints times, the least of the repeats, in milliseconds: processor time of whole processes, wall time of motions and
events; of long beams their memory, too. With --vs also the ratio to the other program, whose runs alternate with these,
so that a busy machine slows both. All on one thread. --slow adds runs of 1000 to 1000000 elements (minutes a program),
and two threads. Marks are what was asked of the code, at most: milliseconds on an AMD EPYC (Zen 5), or "x": times what
version 999c9a7 takes, which --vs measures; of two threads at least.
"""

import argparse
import functools
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import typing

SCENES = pathlib.Path(__file__).resolve().parent.parent / "scenes"


class Work(typing.NamedTuple):
    title: str
    scene: dict
    marks: dict = {}  # by what is measured


def falling_beam(elements, integrator, duration, **more):
    scene = json.loads((SCENES / "falling_beam.json").read_text(encoding="utf-8"))
    scene["beam"]["elements"] = elements
    scene["integrator"] = integrator
    scene["duration"] = duration
    scene["output"] = {"interval": duration}
    return scene | more


def shot(elements):
    """A mass that passes an element a step of 1 ms, on a beam of elements of 25 mm, for 20 steps."""
    scene = falling_beam(elements, steps(1e-3), 0.02)
    length = 0.025 * elements
    scene["beam"]["curve"] = {"type": "line", "start": [0, 0], "end": [length, 0]}
    scene["sliding_mass"] |= {"position": 0.2 * length, "velocity": 25}
    return scene


def steps(step):
    return {"type": "generalized-alpha", "step": step}


CONSERVATIVE = {"length_control": {"velocities": "conservative"}}
# What the times are to be at most: milliseconds, or times those of version 999c9a7, which one gives by --vs.
RUNS = [
    Work("N = 8, steps of 10 ms, to 0.5 s: the tip errs by less than 1 %", falling_beam(8, steps(1e-2), 0.5),
         {"motion": "0.55 x"}),
    Work("N = 24, steps of 2.5 ms, to 0.5 s: by less than 0.1 %", falling_beam(24, steps(2.5e-3), 0.5),
         {"motion": "0.6 x"}),
    Work("N = 12, steps of 5 ms, to 0.5 s", falling_beam(12, steps(5e-3), 0.5), {"whole process": "5"}),
    Work("N = 40, steps of 2.5 ms, to 0.5 s", falling_beam(40, steps(2.5e-3), 0.5),
         {"motion": "0.27 x", "an event": "0.02"}),
    Work("the same with conservative velocities", falling_beam(40, steps(2.5e-3), 0.5, **CONSERVATIVE),
         {"motion": "0.3 x"}),
    Work("N = 40, steps of 1 ms, through the whip to 0.65 s", falling_beam(40, steps(1e-3), 0.65), {"motion": "0.5 x"}),
    Work("N = 40, dopri5 at 1e-6, to 0.65 s",
         falling_beam(40, {"type": "dopri5", "rtol": 1e-6, "atol": 1e-8}, 0.65), {"motion": "0.6 x"}),
]
SLOW = [
    Work("N = 1000, steps of 0.1 ms, to 0.45 s", falling_beam(1000, steps(1e-4), 0.45), {"motion": "1500"}),
    Work("N = 10000, 20 steps with an event each", shot(10000)),
    Work("N = 100000, 20 steps with an event each", shot(100000), {"an event": "0.03", "memory": "1"}),
    Work("N = 1000000, 20 steps with an event each", shot(1000000), {"motion": "20000", "memory": "1"}),
]
TWO_THREADS = {10000: "1.7", 100000: "1.7", 1000000: "1.3"}  # times as fast as one, at least


@functools.cache
def one_thread(program):
    """The option, of a program that has it."""
    text = subprocess.run([program, "run", "--help"], capture_output=True, text=True).stdout
    return ["--threads", "1"] if "--threads" in text else []


def run(program, scene, folder, options=None):
    """Processor time of the process, wall time of its motion and of one event [s], None without any, and its memory
    at most [B]; nothing where the program does not know the scene."""
    source, report, errors = folder / "scene.json", folder / "report.json", folder / "errors.txt"
    source.write_text(json.dumps(scene), encoding="utf-8")
    with open(errors, "wb") as stderr:
        process = subprocess.Popen([program, "run", source, "--report", report, "--force",
                                    *(options or one_thread(program))], stdout=subprocess.DEVNULL, stderr=stderr,
                                   close_fds=False)  # no copy of this process is made, and timed
        _, status, used = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode == 2:
        return None
    if process.returncode != 0:
        sys.exit(f"{program} failed:\n{errors.read_text(encoding='utf-8')}")
    result = json.loads(report.read_text(encoding="utf-8"))
    events = len(result["events"])
    return {
        "whole process": used.ru_utime + used.ru_stime,
        "motion": result["timing"]["motion"],
        "an event": result["timing"]["length_control"] / events if events else None,
        "memory": 1024 * used.ru_maxrss,
    }


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--vs", help="another program, whose runs alternate with these")
    parser.add_argument("--repeats", type=int, default=5)
    parser.add_argument("--slow", action="store_true")
    arguments = parser.parse_args()
    programs = [arguments.program] + ([arguments.vs] if arguments.vs else [])

    library = sorted(SCENES.glob("*.json"))
    print(f"{'':60}{'ms':>10}" + (f"{'other':>10}{'ratio':>8}" if arguments.vs else "") + f"{'mark':>8}")

    def show(name, values, scale=1e3, mark=""):
        line = f"{name:60}{scale * values[0]:10.3f}"
        if len(values) > 1:
            line += f"{scale * values[1]:10.3f}{values[0] / values[1]:8.3f}"
        print(f"{line}{mark:>8}".rstrip(), flush=True)

    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)

        def least(scene, repeats):
            best = [{} for _ in programs]
            for _ in range(repeats):
                for i, program in enumerate(programs):
                    measured = run(program, scene, folder)
                    if measured is None:
                        return None
                    for key, value in measured.items():
                        if value is not None:
                            best[i][key] = min(value, best[i].get(key, value))
            return best

        for title, scene, marks in RUNS + (SLOW if arguments.slow else []):
            elements = scene["beam"]["elements"]
            best = least(scene, arguments.repeats if elements < 1000 else min(arguments.repeats, 3))
            print(title if best else title + ": not known to all programs")
            for key in best[0] if best else []:
                values = [each[key] for each in best]
                if key != "memory":
                    show("  " + key, values, mark=marks.get(key, ""))
                elif elements >= 100000:  # of fewer it is mostly the program itself
                    show("  memory, kB an element", values, 1e-3 / elements, marks.get(key, ""))
        total = [0.0] * len(programs)
        known = 0
        for path in library:
            best = least(json.loads(path.read_text(encoding="utf-8")), min(arguments.repeats, 2))
            known += best is not None
            for i, each in enumerate(best or []):
                total[i] += each["whole process"]
        show(f"{known} scenes of the library, whole processes", total, mark="0.5 x")
        for elements, mark in TWO_THREADS.items() if arguments.slow else []:
            times = {threads: [] for threads in (1, 2)}
            for _ in range(min(arguments.repeats, 3)):
                for threads, of in times.items():
                    of.append(run(arguments.program, shot(elements), folder, ["--threads", str(threads)])["motion"])
            print(f"{f'N = {elements}, times as fast with two threads':60}{min(times[1]) / min(times[2]):10.3f}"
                  + " " * (18 if arguments.vs else 0) + f"{mark:>8}", flush=True)


if __name__ == "__main__":
    main()
