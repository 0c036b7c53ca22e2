#!/usr/bin/env python3
"""Writes reference/assemblies.json: frequencies of a portal frame by its exact dynamic stiffness, a platform on eight heavy elastic
ropes by their catenaries, and the path of Lee's frame by shooting of its two members. Needs mpmath.

    assemblies.py
"""
import json
import math
import os

import mpmath as mp

mp.mp.dps = 30
here = os.path.dirname(os.path.abspath(__file__))
G = mp.mpf("9.81")


def member(EA, EI, m, L, w):
    """Dynamic stiffness of a bar that bends by Euler and Bernoulli and stretches, harmonic at the rate w: u, v and the angle at both
    ends, along the bar."""
    b = mp.root(m * w**2 / EI, 4)
    c, s, ch, sh = mp.cos(b * L), mp.sin(b * L), mp.cosh(b * L), mp.sinh(b * L)
    k = EI / (1 - c * ch)
    bend = [
        [b**3 * (s * ch + c * sh), b**2 * s * sh, -(b**3) * (s + sh), b**2 * (ch - c)],
        [b**2 * s * sh, b * (s * ch - c * sh), -(b**2) * (ch - c), b * (sh - s)],
        [-(b**3) * (s + sh), -(b**2) * (ch - c), b**3 * (s * ch + c * sh), -(b**2) * s * sh],
        [b**2 * (ch - c), b * (sh - s), -(b**2) * s * sh, b * (s * ch - c * sh)],
    ]
    g = w * mp.sqrt(m / EA)
    K = mp.zeros(6)
    for i, row in zip((1, 2, 4, 5), bend):
        for j, entry in zip((1, 2, 4, 5), row):
            K[i, j] = k * entry
    K[0, 0] = K[3, 3] = EA * g * mp.cot(g * L)
    K[0, 3] = K[3, 0] = -EA * g * mp.csc(g * L)
    return K


def upright(K):
    """The same of a bar that points upwards."""
    R = mp.zeros(6)
    for at in (0, 3):
        R[at, at + 1], R[at + 1, at], R[at + 2, at + 2] = 1, -1, 1
    return R.T * K * R


PORTAL = {"height": 2, "width": 3, "column": {"EA": 1e8, "EI": 2e4, "rhoA": 10}, "beam": {"EA": 1e8, "EI": 3e4, "rhoA": 12}}


def portal(w):
    column, beam = PORTAL["column"], PORTAL["beam"]
    c = upright(member(column["EA"], column["EI"], column["rhoA"], PORTAL["height"], w))
    K = member(beam["EA"], beam["EI"], beam["rhoA"], PORTAL["width"], w)
    for at in (0, 3):
        for i in range(3):
            for j in range(3):
                K[at + i, at + j] += c[3 + i, 3 + j]
    return mp.det(K / 1e6)


def portal_frequencies(starts):
    return [mp.findroot(lambda f: portal(2 * mp.pi * f), mp.mpf(start)) for start in starts]


# Four ropes from above and four from below hold a platform in the middle; the ropes are drawn straight and unstretched.
PLATFORM = {"mass": 50, "EA": 2e5, "rhoA": 0.5, "reach": 3, "half": [0.25, 0.25, 0.2], "height": 1.6, "anchors": [4, 0]}


def end_of_catenary(H, V, L):
    """How far the end of a hanging rope is from its support, across and below, by the force of the support on it."""
    w, EA = PLATFORM["rhoA"] * G, PLATFORM["EA"]
    p, q = V / H, (V - w * L) / H
    return (H * L / EA + H / w * (mp.asinh(p) - mp.asinh(q)),
            L / EA * (V - w * L / 2) + H / w * (mp.sqrt(1 + p**2) - mp.sqrt(1 + q**2)))


def platform():
    half, reach = PLATFORM["half"], PLATFORM["reach"]
    across = mp.sqrt(2) * (reach - mp.mpf(str(half[0])))
    height = mp.mpf(str(PLATFORM["height"]))
    above = PLATFORM["anchors"][0] - height - mp.mpf(str(half[2]))  # of the supports over the upper corners, as drawn
    below = height - mp.mpf(str(half[2])) - PLATFORM["anchors"][1]
    long_, short = mp.hypot(across, above), mp.hypot(across, below)
    weight = PLATFORM["rhoA"] * G

    def lacks(H, V, h, v, z):
        up, down = end_of_catenary(H, V, long_), end_of_catenary(h, v, short)
        return [up[0] - across, up[1] - (above + z), down[0] - across, down[1] + below - z,
                4 * (V - weight * long_) + 4 * (v - weight * short) - PLATFORM["mass"] * G]

    H, V, h, v, z = mp.findroot(lacks, (150, 160, 30, 0, mp.mpf("0.02")))
    return {"z": height - z, "upper": mp.hypot(H, V - weight * long_), "lower": mp.hypot(h, v - weight * short)}


# Lee's frame (S. L. Lee, F. S. Manuel, E. C. Rossow, J. Eng. Mech. Div. 94, 1968): two members 120 long at a right angle, hinged at both
# ends, with a load across the upper one at a fifth of its length.
LEE = {"length": 120, "EA": 4320, "EI": 1440, "at": 24}


def member_end(F, state, length, steps):
    """Place, angle and moment along a member that bears the force F on its cut, by Runge-Kutta: it stretches by F.t/EA, turns by M/EI
    and the moment changes by the part of F across it."""
    EA, EI = LEE["EA"], LEE["EI"]

    def rates(y):
        c, s = math.cos(y[2]), math.sin(y[2])
        stretch = 1 + (F[0] * c + F[1] * s) / EA
        return [stretch * c, stretch * s, y[3] / EI, -stretch * (F[1] * c - F[0] * s)]

    h, y = length / steps, state
    along = lambda by, rate: [p + by * q for p, q in zip(y, rate)]
    for _ in range(steps):
        a = rates(y)
        b = rates(along(h / 2, a))
        c = rates(along(h / 2, b))
        d = rates(along(h, c))
        y = [v + h / 6 * (p + 2 * q + 2 * r + t) for v, p, q, r, t in zip(y, a, b, c, d)]
    return y


def lee(H, V, angle, P, fine=1):
    """Both ends of the upper member: where the load is, and its far end."""
    L, at = LEE["length"], LEE["at"]
    y = member_end((H, V), [0.0, 0.0, angle, 0.0], L, 400 * fine)
    y[2] -= math.pi / 2
    load = member_end((H, V), y, at, 80 * fine)
    return load, member_end((H, V + P), load, L - at, 320 * fine)


def lee_at(v, guess, fine=1):
    """Load with which its point of action has gone down by v."""
    L = LEE["length"]

    def lacks(u):
        load, end = lee(*u, fine)
        return [end[0] - L, end[1] - L, end[3] / 100, L - load[1] - v]

    u = list(guess)
    for _ in range(40):
        r, J = lacks(u), mp.zeros(4)
        for k in range(4):
            d = 1e-6 * max(1, abs(u[k]))
            up, down = lacks([w + d * (i == k) for i, w in enumerate(u)]), lacks([w - d * (i == k) for i, w in enumerate(u)])
            for i in range(4):
                J[i, k] = (up[i] - down[i]) / (2 * d)
        step = mp.lu_solve(J, mp.matrix(r))
        share = min(1, 0.3 / max(abs(step[2]), 1e-9))
        u = [w - float(share * s) for w, s in zip(u, step)]
        if max(abs(s) for s in step) < 1e-10:
            return u
    raise RuntimeError(f"no frame at {v}")


def lee_path():
    guess, rows = [0, -0.5, math.pi / 2, 0.5], []
    for k in range(1, 121):
        guess = lee_at(k / 2, guess)
        rows.append([k / 2, guess[3]])
    top = max(range(len(rows)), key=lambda i: rows[i][1])
    again = lee_at(rows[top][0], guess if top == 119 else lee_at(rows[top][0], [0, -1, math.pi / 2, 1.8]), 2)
    assert abs(again[3] - rows[top][1]) < 1e-9 * rows[top][1], "the steps are too long"
    return rows


answer = platform()
with open(os.path.join(here, "assemblies.json"), "w") as file:
    digits = lambda value: float(mp.nstr(value, 14))
    json.dump({"source": "reference/assemblies.py: exact dynamic stiffness; elastic catenaries",
               "portal": {**PORTAL, "frequencies": [digits(f) for f in portal_frequencies((4.67, 12.5, 31.78, 35.49, 47.68))],
                          "unit": "Hz"},
               "lee": {**LEE, "unit": "m, N", "rows": "way of the load down, the load", "path": [[v, digits(P)] for v, P in lee_path()]},
               "platform": {**PLATFORM, "unit": "m, N", **{key: digits(value) for key, value in answer.items()}}}, file, indent=1)
    file.write("\n")
