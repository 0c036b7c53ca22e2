#!/usr/bin/env python3
"""Times whole runs, and another program's beside them in the same minutes.

    bench/marks.py PROGRAM [--vs PROGRAM] [--repeats 5] [--slow]

Prints processor times, the least of the repeats, in milliseconds; with --vs the ratio to the other program, whose runs
alternate with these, so that a busy machine slows both. --slow adds the run of 1000 elements and one of 100000.
"""

import argparse
import json
import pathlib
import resource
import subprocess
import sys
import tempfile

SCENES = pathlib.Path(__file__).resolve().parent.parent / "scenes"


def falling_beam(elements, integrator, duration, **more):
    scene = json.loads((SCENES / "falling_beam.json").read_text(encoding="utf-8"))
    scene["beam"]["elements"] = elements
    scene["integrator"] = integrator
    scene["duration"] = duration
    scene["output"] = {"interval": duration}
    return scene | more


def steps(step):
    return {"type": "generalized-alpha", "step": step}


CONSERVATIVE = {"length_control": {"velocities": "conservative"}}
RUNS = {
    "N = 12, steps of 5 ms, to 0.5 s": falling_beam(12, steps(5e-3), 0.5),
    "N = 40, steps of 2.5 ms, to 0.5 s": falling_beam(40, steps(2.5e-3), 0.5),
    "the same with conservative velocities": falling_beam(40, steps(2.5e-3), 0.5, **CONSERVATIVE),
    "N = 40, steps of 1 ms, through the whip to 0.65 s": falling_beam(40, steps(1e-3), 0.65),
    "N = 40, dopri5 at 1e-6, to 0.65 s": falling_beam(40, {"type": "dopri5", "rtol": 1e-6, "atol": 1e-8}, 0.65),
}
SLOW = {
    "N = 1000, steps of 0.1 ms, to 0.45 s": falling_beam(1000, steps(1e-4), 0.45),
    "N = 100000, 20 steps of 10 us": falling_beam(100000, steps(1e-5), 2e-4),
}


def run(program, scene, folder):
    """Processor time of the process and of its motion [s], and of one event [s], or None without any."""
    source, report = folder / "scene.json", folder / "report.json"
    source.write_text(json.dumps(scene), encoding="utf-8")
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run([program, "run", source, "--report", report, "--force"], capture_output=True, text=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode != 0:
        sys.exit(f"{program} failed:\n{done.stderr}")
    result = json.loads(report.read_text(encoding="utf-8"))
    events = len(result["events"])
    whole = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return {
        "whole process": whole,
        "motion": result["timing"]["motion"],
        "an event": result["timing"]["length_control"] / events if events else None,
    }


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--vs", help="another program, whose runs alternate with these")
    parser.add_argument("--repeats", type=int, default=5)
    parser.add_argument("--slow", action="store_true")
    arguments = parser.parse_args()
    programs = [arguments.program] + ([arguments.vs] if arguments.vs else [])

    runs = RUNS | (SLOW if arguments.slow else {})
    library = sorted(SCENES.glob("*.json"))
    print(f"{'':52}{'ms':>10}" + (f"{'other':>10}{'ratio':>8}" if arguments.vs else ""))

    def show(name, times):
        line = f"{name:52}{1e3 * times[0]:10.3f}"
        if len(times) > 1:
            line += f"{1e3 * times[1]:10.3f}{times[0] / times[1]:8.3f}"
        print(line, flush=True)

    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)

        def least(scene, repeats):
            best = [{} for _ in programs]
            for _ in range(repeats):
                for i, program in enumerate(programs):
                    for key, seconds in run(program, scene, folder).items():
                        if seconds is not None:
                            best[i][key] = min(seconds, best[i].get(key, seconds))
            return best

        for title, scene in runs.items():
            best = least(scene, arguments.repeats if title in RUNS else 1)
            print(title)
            for key in best[0]:
                show("  " + key, [each[key] for each in best])
        total = [0.0] * len(programs)
        for path in library:
            scene = json.loads(path.read_text(encoding="utf-8"))
            for i, each in enumerate(least(scene, min(arguments.repeats, 2))):
                total[i] += each["whole process"]
        show(f"{len(library)} scenes of the library, whole processes", total)


if __name__ == "__main__":
    main()
