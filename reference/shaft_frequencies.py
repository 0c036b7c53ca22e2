#!/usr/bin/env python3
"""Writes reference/shaft_frequencies.json: natural frequencies of a shaft between two clamps under a torque M, that the
study space compares with. Needs mpmath.

    shaft_frequencies.py

With w = y + i z a straight shaft of EI, m = rhoA and length L bends as EI w'''' - i M w''' + m w.. = 0. What goes as
exp(i k x + i s t) has EI k^4 - M k^3 = m s^2. Four of these make w = w' = 0 at both ends where a determinant vanishes;
over the Vandermonde determinant of the k, and turned by their sum, it is a real function of s. Every frequency stands
twice, for two directions. s = 0 is Greenhill's torque, 8.98682 EI/L.
"""
import json
import os

import mpmath as mp

mp.mp.dps = 30
here = os.path.dirname(os.path.abspath(__file__))
torques = [0, 2, 4, 6, 7, 8, 8.5]


def clamped(torque, s):
    k = mp.polyroots([1, -torque, 0, 0, -s * s], maxsteps=200, extraprec=200)
    rows = [[1] * 4, k, [mp.expj(a) for a in k], [a * mp.expj(a) for a in k]]
    apart = mp.fprod(k[i] - k[j] for i in range(4) for j in range(i))
    return mp.re(mp.det(mp.matrix(rows)) / apart * mp.expj(-mp.fsum(k) / 2))


def lowest(torque):
    s, step, before = mp.mpf("0.1"), mp.mpf("0.1"), None
    while True:
        now = clamped(torque, s)
        if before is not None and now * before < 0:
            return float(mp.findroot(lambda x: clamped(torque, x), (s - step, s), solver="anderson", tol=1e-30) / (2 * mp.pi))
        before, s = now, s + step


with open(os.path.join(here, "shaft_frequencies.json"), "w") as file:
    json.dump({"shaft": {"EI": 1, "rhoA": 1, "length": 1}, "torques": torques,
               "frequencies": [lowest(torque) for torque in torques]}, file, indent=1)
    file.write("\n")
