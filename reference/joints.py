#!/usr/bin/env python3
"""Writes reference/joints.json: equilibria of beams that run without friction through what is held, by codes without elements.

sleeve: a rod of the strain energy per length W = EA (|r_x|^2 - 1)^2/8 + EI kappa^2/2 leaves a sleeve inclined by beta and bears a dead load P
downwards at its free end; what is behind the sleeve bears nothing. Rolling a rod of this energy through a point does no work where
W - r_x.F - theta' mu is the same on both sides (F the force, mu = dW/dtheta' the moment): so it is 0 where the rod leaves the sleeve. With
mu = 0 at the end that gives the length l outside and the moment at the sleeve, by shooting (equilibria.py). Without stretch it is
P sin(beta) = M^2/(2 EI).

ring: a heavy cable (EI = 0) between two points runs through a ring. On each side of it r_x = l(T) F/T with F = F_0 + w x e_y linear in x, T = |F|,
and l(T) of the law: EA (l - 1) = T (engineering) or EA l (l^2 - 1)/2 = T (green). T is the same on both sides of the ring. Needs mpmath.

rings: the same through two of them.

    joints.py
"""
import json
import math
import os

from equilibria import newton, rates, shoot, stretch

RINGS = {"EA": 100.0, "weight": 1.0, "length": 3.0, "rings": [[0.9, 0.0], [2.0, 0.0]], "start": [0.15, 0.2], "end": [2.84, 0.12]}
CABLE = {"EA": 100.0, "weight": 1.0, "length": 2.0, "ring": [0.8, 0.0], "start": [0.15, 0.2], "end": [1.84, 0.12]}


def sleeve(EA, EI, load, degrees, steps=800):
    beta = math.radians(degrees)
    force = (0.0, -load)
    beam = (EA, EI, 0.0)

    def off(unknown):
        moment, length = unknown
        end = shoot(beam, force, [0, 0, beta, moment], length, steps)
        l = stretch(EA, EI, 0.0, moment, -load * math.sin(beta))
        kappa = l * moment / EI
        energy = EA * (l * l - 1) ** 2 / 8 + EI * kappa**2 / 2
        return [end[3], energy + l * load * math.sin(beta) - l * kappa * moment]

    moment = -math.sqrt(2 * EI * load * math.sin(beta))
    moment, length = newton(off, [moment, math.sqrt(EI / load)])
    x, y, theta, _ = shoot(beam, force, [0, 0, beta, moment], length, steps)
    return {"length": length, "moment": moment, "x": x, "y": y, "theta": theta}


def rings(green, cable, first):
    """Through any number of rings; `first` is a guess: the force at the start of each span, then where the rings are along the cable."""
    from mpmath import findroot, mp, mpf, quad, sqrt
    mp.dps = 25
    EA, w, total = mpf(cable["EA"]), mpf(cable["weight"]), mpf(cable["length"])
    points = [[mpf(str(c)) for c in p] for p in (cable["start"], *cable["rings"], cable["end"])]
    count = len(points) - 1

    def stretched(tension):
        l = 1 + tension / EA
        for _ in range(12 if green else 0):
            l -= (EA * l * (l * l - 1) / 2 - tension) / (EA * (3 * l * l - 1) / 2)
        return l

    def span(horizontal, vertical, length):
        """From the point where the force is (horizontal, vertical), which the weight behind it makes grow upwards."""
        def part(x, c):
            f = (horizontal, vertical + w * x)
            tension = sqrt(f[0] ** 2 + f[1] ** 2)
            return stretched(tension) * f[c] / tension
        return [quad(lambda x: part(x, c), [length * k / 8 for k in range(9)]) for c in (0, 1)]

    def forces(unknown):
        """At the start of each span and at its end, and its length."""
        cuts = [mpf(0), *unknown[2 * count:], total]
        lengths = [b - a for a, b in zip(cuts, cuts[1:])]
        return [(unknown[2 * k], unknown[2 * k + 1], unknown[2 * k + 1] + w * l, l) for k, l in enumerate(lengths)]

    def off(*unknown):
        at = forces(unknown)
        rest = []
        for k, (h, v, _, length) in enumerate(at):
            way = span(h, v, length)
            rest += [points[k][c] + way[c] - points[k + 1][c] for c in (0, 1)]
        return rest + [h1**2 + e1**2 - h2**2 - v2**2 for (h1, _, e1, _), (h2, v2, _, _) in zip(at, at[1:])]

    root = findroot(off, first, tol=1e-40, maxsteps=60)
    residual = max(abs(c) for c in off(*root))
    assert residual < 1e-18, residual
    at = forces(list(root))
    return {"x": [float(x) for x in list(root)[2 * count:]], "tension": [float(sqrt(h**2 + v**2)) for h, v, _, _ in at[1:]],
            "start_force": [float(-at[0][0]), float(-at[0][1])], "end_force": [float(at[-1][0]), float(at[-1][2])],
            "ring_forces": [[float(h1 - h2), float(e1 - v2)] for (h1, _, e1, _), (h2, v2, _, _) in zip(at, at[1:])]}


def ring(green, cable):
    one = rings(green, {**cable, "rings": [cable["ring"]]}, (0.3, -0.5, 0.4, -0.6, 0.8))
    return {"x": one["x"][0], "tension": one["tension"][0], "start_force": one["start_force"], "end_force": one["end_force"],
            "ring_force": one["ring_forces"][0]}


def rounded(values, digits):
    def short(value):
        return [short(v) for v in value] if isinstance(value, list) else round(value, digits)
    return {key: short(value) for key, value in values.items()}


if __name__ == "__main__":
    folder = os.path.dirname(os.path.abspath(__file__))
    section = {"EA": 1000.0, "EI": 1.0, "load": 1.0}
    angles = [15, 30, 45, 60, 75]
    rods = {str(a): sleeve(section["EA"], section["EI"], section["load"], a) for a in angles}
    finer = {str(a): sleeve(section["EA"], section["EI"], section["load"], a, 1600) for a in angles}
    print({a: finer[a]["length"] - rods[a]["length"] for a in rods})
    stiff = {a: sleeve(1e10, 1.0, 1.0, a)["length"] for a in (30, 60)}
    print("inextensible:", stiff, "published 1.02805680105213, 1.47494154080637")
    laws = {law: ring(law == "green", CABLE) for law in ("green", "engineering")}
    two = {law: rings(law == "green", RINGS, (0.7, -0.6, 0.5, -0.5, 0.4, -0.2, 0.8, 1.98)) for law in ("green", "engineering")}
    with open(os.path.join(folder, "joints.json"), "w") as file:
        json.dump({"source": "reference/joints.py: shooting and quadrature, no elements; digits beyond those given change with its step",
                   "sleeve": {**section, "degrees": {a: rounded(finer[a], 12) for a in finer}},
                   "ring": {**CABLE, **{law: rounded(laws[law], 14) for law in laws}},
                   "rings": {**RINGS, **{law: rounded(two[law], 14) for law in two}}},
                  file, indent=1)
        file.write("\n")
