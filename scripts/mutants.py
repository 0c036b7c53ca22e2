#!/usr/bin/env python3
"""Puts single mistakes into a copy of the code, one at a time, and records which test or gate notices.

    scripts/mutants.py [NAME ...] [--jobs N]   run those of tests/mutants/mutants.json that have no result yet
    scripts/mutants.py --check                 only see whether each mistake can still be put in
    scripts/mutants.py --start                 that, and whether the copy builds and one test in twenty passes there

A mistake is looked for first by the tests it names, then by all tests, then by the gates of profile ci, then by those
of profile full. Results are kept in build-mutants/results.json until the mistake or the code changes; the table goes to
tests/mutants/README.md. Ends with 1 if a mistake goes unnoticed.
"""
import argparse
import concurrent.futures
import hashlib
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys

root = pathlib.Path(__file__).resolve().parent.parent
work = root / "build-mutants"
source = work / "source"
build = source / "build"
code_folders = ("cmake", "core", "include", "mechanics", "reference", "scene", "scripts", "studies", "tests")  # what a result depends on
of_the_tree = r"^(mutants|documents|install|python|program\.claims)"  # tests of documents, not of code, and of this script
hang = 900  # [s] for one program: a mutant may never end

head = """# Mutants

Single mistakes in the code, each put into a copy of it, and the first test or gate that notices. Written by
`make mutants`. "ci": what every run of continuous integration executes.

| mistake | in | noticed by | profile |
|---|---|---|---|
"""


def fail(text):
    sys.exit("mutants: " + text)


def applied(mutant, text):
    count = text.count(mutant["find"])
    if count != 1:
        fail(f'{mutant["name"]}: its text occurs {count} times in {mutant["file"]}, once is needed')
    return text.replace(mutant["find"], mutant["replace"])


def tree():
    """The files of the project: what git tracks or would, by path."""
    listed = subprocess.run(["git", "-c", f"safe.directory={root}", "ls-files", "-co", "--exclude-standard", "-z"], cwd=root,
                            stdout=subprocess.PIPE, check=True, text=True).stdout
    return sorted(path for path in map(pathlib.Path, filter(None, listed.split("\0"))) if (root / path).is_file())


def digest():
    total = hashlib.sha256()
    for path in tree():
        if path.parts[0] in code_folders and path.parent.name != "mutants":
            total.update(path.as_posix().encode() + (root / path).read_bytes())
    return total.hexdigest()


def copy_code():
    """All of the project, for tests read documents, scenes and reports, too. Touches only what differs, so that little
    is compiled again."""
    files = tree()
    for path in files:
        there, here = source / path, root / path
        if not there.exists() or there.read_bytes() != here.read_bytes():
            there.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(here, there)
    known = set(files)
    for path in source.rglob("*"):
        if path.is_file() and build not in path.parents and path.relative_to(source) not in known:
            path.unlink()


def run(command, **options):
    """Exit code and output; None for one that had to be stopped."""
    options = {"cwd": source, "timeout": hang} | options
    try:
        done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                              errors="replace", **options)
        return done.returncode, done.stdout
    except subprocess.TimeoutExpired:
        return None, ""


def compile_targets(targets, jobs):
    code, output = run(["cmake", "--build", build, "--parallel", str(jobs), "--target", *targets], timeout=None)
    if code != 0:
        print(output[-3000:])
    return code == 0


def failed_tests(output):
    names = re.findall(r"\[  FAILED  \] (\S+?)(?:,.*)? \(\d+ ms\)", output)
    return list(dict.fromkeys(name for name in names))


def program(target):
    return next((build / "tests").glob(f"*/{target}"))


def run_tests(targets):
    for target in targets:
        code, output = run([program(target), "--gtest_brief=1"], cwd=program(target).parent)
        if code != 0:
            return found(failed_tests(output) or [target + (" (never ends)" if code is None else " (crashes)")], "ci")
    return None


def compile_own(target, jobs):
    """A test program anew, but the library as it was: a mistake in a header is in the test's own instances at once, and
    the whole library takes minutes. Needs Ninja, which tells its commands."""
    code, output = run(["ninja", "-C", build, "-t", "commands", target])
    commands = output.splitlines()
    own = [command for command in commands if f"CMakeFiles/{target}.dir/" in command]
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        done = list(pool.map(lambda command: run(command, shell=True, cwd=build)[0], own[:-1]))
    return code == 0 and all(result == 0 for result in done) and run(own[-1], shell=True, cwd=build)[0] == 0


def by_tests(mutant, jobs):
    if mutant["file"].endswith(".hpp") and (build / "build.ninja").exists():
        for target in mutant["tests"]:
            if not compile_own(target, jobs):
                return {"by": "nothing: it does not compile", "caught": False}
        if noticed := run_tests(mutant["tests"]):
            return noticed
    if not compile_targets(mutant["tests"], jobs):
        return {"by": "nothing: it does not compile", "caught": False}
    if noticed := run_tests(mutant["tests"]):
        return noticed
    if not compile_targets(["all"], jobs):
        return {"by": "nothing: it does not compile", "caught": False}
    code, output = run(["ctest", "--test-dir", build, "--parallel", str(jobs), "--timeout", "300",
                        "--exclude-regex", of_the_tree])
    if code != 0:
        return found(re.findall(r"^\s+\d+ - (\S+) \((?!Skipped)", output, re.M) or ["the tests never end"], "ci")
    return None


def by_gates(profile, jobs):
    out = work / ("reports-" + profile)
    shutil.rmtree(out, ignore_errors=True)
    code, output = run(["scripts/studies.sh", "run", profile, out, str(jobs)])
    failed = re.findall(r"FAILED\s+(.*)", output)
    if code != 0:
        return found([line.strip()[:80] for line in failed] or ["a study does not end"], profile)
    return None


def found(names, profile):
    text = f"`{names[0]}`" + (f" and {len(names) - 1} more" if len(names) > 1 else "")
    return {"by": text, "caught": True, "profile": profile}


def table(mutants, results):
    lines = []
    for mutant in mutants:
        result = results.get(mutant["name"])
        if result is None:
            continue
        mistake = mutant["mistake"].replace("|", "\\|")
        lines.append(f'| {mistake} | `{mutant["file"]}` | {result["by"]} | {result.get("profile", "")} |\n')
    caught = sum(results[m["name"]]["caught"] for m in mutants if m["name"] in results)
    (root / "tests" / "mutants" / "README.md").write_text(
        head + "".join(lines) + f"\n{caught} of {len(lines)} are noticed; {len(mutants) - len(lines)} have not been run yet.\n")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("names", nargs="*")
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--start", action="store_true")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    choice = parser.parse_args()
    mutants = json.loads((root / "tests" / "mutants" / "mutants.json").read_text())
    for mutant in mutants:
        applied(mutant, (root / mutant["file"]).read_text())
    if choice.check:
        return 0
    if unknown := set(choice.names) - {m["name"] for m in mutants}:
        fail("no mutant " + ", ".join(sorted(unknown)))

    source.mkdir(parents=True, exist_ok=True)
    copy_code()
    if run(["cmake", "-S", source, "-B", build, "-DCMAKE_BUILD_TYPE=Release", *os.environ.get("CMAKE_ARGS", "").split()])[0]:
        fail("the copy cannot be configured")

    tests = sorted({target for mutant in mutants for target in mutant["tests"]})
    if not compile_targets([*tests, "vlbeam"], choice.jobs):  # tests of the harness run the program
        fail("the copy does not compile")
    if choice.start:  # one test in twenty of each program: the copy lacks nothing; all of them are run elsewhere
        os.environ |= {"GTEST_TOTAL_SHARDS": "20", "GTEST_SHARD_INDEX": "0"}
    with concurrent.futures.ThreadPoolExecutor(choice.jobs) as pool:
        for noticed in pool.map(lambda target: run_tests([target]), reversed(tests)):
            if noticed:
                fail("without any mistake there fails " + noticed["by"])
    if choice.start:
        return 0

    kept = work / "results.json"
    results = json.loads(kept.read_text()) if kept.exists() else {}
    code_is = digest()
    results = {name: result for name, result in results.items() if result["code"] == code_is}
    for mutant in mutants:
        name = mutant["name"]
        if choice.names and name not in choice.names:
            continue
        old = results.get(name)
        if old and old["mutant"] == mutant:
            continue
        print(f"{name}: {mutant['mistake']} ...", end=" ", flush=True)
        if not compile_targets(tests, choice.jobs):  # the library without the mistake before
            fail("the copy does not compile")
        path = source / mutant["file"]
        right = path.read_text()
        try:
            path.write_text(applied(mutant, right))
            result = by_tests(mutant, choice.jobs) or by_gates("ci", choice.jobs) or by_gates("full", choice.jobs)
        finally:
            path.write_text(right)
        result = result or {"by": "nothing", "caught": False}
        results[name] = dict(result, code=code_is, mutant=mutant)
        kept.write_text(json.dumps(results, indent=1))
        print(result["by"], flush=True)
        table(mutants, results)
    table(mutants, results)
    unnoticed = [name for name, result in results.items() if not result["caught"]]
    if unnoticed:
        print("unnoticed:", ", ".join(unnoticed))
    return 1 if unnoticed else 0


if __name__ == "__main__":
    sys.exit(main())
