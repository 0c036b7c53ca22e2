#!/usr/bin/env python3
"""Writes reference/arc_frequencies.json: natural frequencies of a clamped arc of a circle, in its plane and across it,
that the study space compares with. Needs mpmath.

    arc_frequencies.py

The linear equations of a curved beam with arc angle s, R = 1, are first-order systems y' = A y with constant A. In the
plane, for displacements u along and v away from the centre, N = EA (u' + v), B = EI (v'' + v):
    N' = -m w^2 u,  B'' = m w^2 v - N - B.
Across it, for a displacement z and a rotation f about the tangent, M = EI (f - z''), T = GIp (f' + z'), V = M' + T:
    V' = -m w^2 z,  T' = M - j w^2 f.
The block of exp(A angle) that takes forces at the clamp to those at the free end is singular at a frequency.
"""
import json
import os

import mpmath as mp

mp.mp.dps = 30
here = os.path.dirname(os.path.abspath(__file__))

beam = {"angle_degrees": 120, "EA": 1e5, "EI_in": 4, "EI_across": 2, "GIp": 1, "rhoA": 1, "rhoIp": 0.05}
angle = mp.radians(beam["angle_degrees"])


def in_plane(w):
    m = beam["rhoA"] * w**2  # u, v, v', N, B, B'
    return [[0, -1, 0, 1 / mp.mpf(beam["EA"]), 0, 0], [0, 0, 1, 0, 0, 0], [0, -1, 0, 0, 1 / mp.mpf(beam["EI_in"]), 0],
            [-m, 0, 0, 0, 0, 0], [0, 0, 0, 0, 0, 1], [0, m, 0, -1, -1, 0]]


def across(w):
    m, j = beam["rhoA"] * w**2, mp.mpf(beam["rhoIp"]) * w**2  # z, z', f, M, T, V
    return [[0, 1, 0, 0, 0, 0], [0, 0, 1, -1 / mp.mpf(beam["EI_across"]), 0, 0], [0, -1, 0, 0, 1 / mp.mpf(beam["GIp"]), 0],
            [0, 0, 0, 0, -1, 1], [0, 0, -j, 1, 0, 0], [-m, 0, 0, 0, 0, 0]]


def frequencies(system, count):
    def free_end(w):
        return mp.det(mp.expm(mp.matrix(system(w)) * angle)[3:6, 3:6])

    found, w, step, before = [], mp.mpf("0.05"), mp.mpf("0.05"), None
    while len(found) < count:
        now = free_end(w)
        if before is not None and now * before < 0:
            found.append(mp.findroot(free_end, (w - step, w), solver="anderson", tol=1e-40))
        before, w = now, w + step
    return [float(w / (2 * mp.pi)) for w in found]


with open(os.path.join(here, "arc_frequencies.json"), "w") as file:
    json.dump({"beam": beam, "in_plane": frequencies(in_plane, 3), "across": frequencies(across, 3)}, file, indent=1)
    file.write("\n")
