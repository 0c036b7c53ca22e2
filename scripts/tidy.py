#!/usr/bin/env python3
"""Lets clang-tidy look at the library, the studies and the program. A unit that was found clean is not looked at again
until its text, what it includes, or the checks change: a folder in the user's cache keeps hashes of preprocessed text.
"""
import concurrent.futures
import hashlib
import json
import os
import pathlib
import shlex
import subprocess
import sys
import time

root = pathlib.Path(__file__).resolve().parent.parent
build = root / "build-tidy"
clean = pathlib.Path(os.environ.get("XDG_CACHE_HOME") or pathlib.Path.home() / ".cache") / "vlbeam" / "tidy"
kept_days = 30
# Several files make one unit: their headers and templates are looked at once, and kernels for one instruction set.
options = ["-DCMAKE_CXX_COMPILER=clang++-14", "-DCMAKE_UNITY_BUILD=ON", "-DCMAKE_UNITY_BUILD_BATCH_SIZE=32",
           "-DVLBEAM_BUILD_TESTS=OFF", "-DVLBEAM_BUILD_BENCH=OFF", "-DVLBEAM_AVX2=OFF"]


def output_of(command, **where):
    return subprocess.run(command, check=True, stdout=subprocess.PIPE, **where).stdout


def hash_of(unit, checks):
    """Of all that clang-tidy sees of a unit, with its comments, in which checks may be turned off."""
    command = shlex.split(unit["command"])
    at = command.index("-o")
    text = output_of(command[:at] + command[at + 2:] + ["-E", "-C"], cwd=unit["directory"])
    return hashlib.sha256(checks + text.replace(str(root).encode(), b"")).hexdigest()


def is_clean(unit, checks):
    known = clean / hash_of(unit, checks)
    if not known.exists():
        done = subprocess.run(["clang-tidy-14", "-p", build, "--quiet", unit["file"]], stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True)
        if done.returncode != 0:
            print(done.stdout)
            return False
    known.touch()
    return True


def main():
    output_of(["cmake", "-S", root, "-B", build, *options])
    output_of(["cmake", "--build", build, "--target", "vlbeam_commit"])  # a header that is made
    clean.mkdir(parents=True, exist_ok=True)
    checks = output_of(["clang-tidy-14", "--version"]) + (root / ".clang-tidy").read_bytes()
    units = json.loads((build / "compile_commands.json").read_text())
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        failed = [u["file"] for u, good in zip(units, pool.map(lambda u: is_clean(u, checks), units)) if not good]
    for old in clean.iterdir():
        if time.time() - old.stat().st_mtime > kept_days * 86400:
            old.unlink()
    return f"clang-tidy: {', '.join(failed)}" if failed else 0


sys.exit(main())
