#!/usr/bin/env python3
"""Writes reference/sections.json: beams whose section changes along them.

* A line of two pieces that hangs between two points: an elastic catenary each, with one pull along the horizontal.
* Angular frequencies of a stepped cantilever, of a linear Bernoulli beam: roots of the determinant of its conditions.
* A cantilever of two pieces, of one EA or two, under a load at the end, across it: theta' = M/EI, M' = -(1 + N/EA) Q, r' = (1 + N/EA) t, by shooting.
* A mass that crosses a stepped bridge at an even speed: linear Hermite elements and the trapezoidal rule, written here;
  two meshes and two steps tell the uncertainty.

    sections.py            needs mpmath, numpy and scipy
"""

import json
from pathlib import Path

import mpmath as mp
import numpy as np
from bearings import shape
from scipy.sparse import csc_matrix, lil_matrix
from scipy.sparse.linalg import splu

mp.mp.dps = 40
number = lambda x: float(mp.nstr(x, 17))


def catenary():
    g, pieces, span, rise = mp.mpf("9.81"), [(40, mp.mpf("5e8"), 120), (60, mp.mpf("4e6"), 15)], 95, 20

    def places(H, V):
        x = y = mp.mpf(0)
        all_places = []
        for length, EA, rhoA in pieces:
            w = rhoA * g
            then = V + w * length
            x += H * length / EA + H / w * (mp.asinh(then / H) - mp.asinh(V / H))
            y += (then**2 - V**2) / (2 * EA * w) + (mp.hypot(H, then) - mp.hypot(H, V)) / w
            V = then
            all_places.append((x, y))
        return all_places

    H, V = mp.findroot(lambda H, V: (places(H, V)[-1][0] - span, places(H, V)[-1][1] - rise), (5e4, -3e4))
    weights = [length * rhoA * g for length, EA, rhoA in pieces]
    return {
        "pieces": [{"length": length, "EA": float(EA), "rhoA": rhoA} for length, EA, rhoA in pieces],
        "gravity": float(g), "end": [span, rise],
        "horizontal": number(H), "start_vertical": number(V),
        "meets": [number(c) for c in places(H, V)[0]],
        "tension": {"start": number(mp.hypot(H, V)), "change": number(mp.hypot(H, V + weights[0])),
                    "end": number(mp.hypot(H, V + sum(weights)))},
    }


def frequencies():
    pieces = [(mp.mpf("0.8"), mp.mpf(50), mp.mpf(3)), (mp.mpf("1.2"), mp.mpf(8), mp.mpf(1))]

    def determinant(omega):
        (l1, EI1, m1), (l2, EI2, m2) = pieces
        a, b = (m1 * omega**2 / EI1) ** mp.mpf("0.25"), (m2 * omega**2 / EI2) ** mp.mpf("0.25")

        def of(k, s):  # the general deflection and its derivatives
            c, n, ch, sh = mp.cos(k * s), mp.sin(k * s), mp.cosh(k * s), mp.sinh(k * s)
            return [[c, n, ch, sh], [-k * n, k * c, k * sh, k * ch], [-(k**2) * c, -(k**2) * n, k**2 * ch, k**2 * sh],
                    [k**3 * n, -(k**3) * c, k**3 * sh, k**3 * ch]]

        start, left, right, end = of(a, 0), of(a, l1), of(b, 0), of(b, l2)
        rows = [start[0] + [0] * 4, start[1] + [0] * 4]
        for n, by1, by2 in ((0, 1, 1), (1, 1, 1), (2, EI1, EI2), (3, EI1, EI2)):
            rows.append([by1 * v for v in left[n]] + [-by2 * v for v in right[n]])
        rows += [[0] * 4 + end[2], [0] * 4 + end[3]]
        return mp.det(mp.matrix(rows))

    found, omega, before = [], mp.mpf("0.05"), None
    while len(found) < 4:
        now = mp.sign(determinant(omega))
        if before is not None and now != before:
            found.append(mp.findroot(determinant, (omega - mp.mpf("0.25"), omega), solver="anderson"))
        before, omega = now, omega + mp.mpf("0.25")
    return {"pieces": [{"length": float(l), "EI": float(EI), "rhoA": float(m)} for l, EI, m in pieces],
            "angular_frequencies": [number(w) for w in found]}


def elastica(EA_behind):
    pieces, load = [(mp.mpf("0.6"), mp.mpf("1e5"), mp.mpf(4)), (mp.mpf("0.4"), mp.mpf(EA_behind), mp.mpf(1))], mp.mpf(5)

    def right(EA, EI):
        def f(s, y):
            theta, M = y[0], y[1]
            stretch = 1 - load * mp.sin(theta) / EA
            return [M / EI, stretch * load * mp.cos(theta), stretch * mp.cos(theta), stretch * mp.sin(theta)]
        return f

    def end(M0):
        y = [mp.mpf(0), M0, mp.mpf(0), mp.mpf(0)]
        for length, EA, EI in pieces:
            n = 400
            f, h = right(EA, EI), length / n
            for _ in range(n):  # of order four: 1e-12 are left
                k1 = f(0, y)
                k2 = f(0, [a + h / 2 * b for a, b in zip(y, k1)])
                k3 = f(0, [a + h / 2 * b for a, b in zip(y, k2)])
                k4 = f(0, [a + h * b for a, b in zip(y, k3)])
                y = [a + h / 6 * (b + 2 * c + 2 * d + e) for a, b, c, d, e in zip(y, k1, k2, k3, k4)]
        return y

    mp.mp.dps = 20
    M0 = mp.findroot(lambda M: end(M)[1], (mp.mpf(-3.5), mp.mpf(-3)), solver="secant", tol=1e-14)
    y = end(M0)
    mp.mp.dps = 40
    return {"pieces": [{"length": float(l), "EA": float(EA), "EI": float(EI)} for l, EA, EI in pieces],
            "load": float(load), "tip": [number(y[2]), number(y[3])], "moment": number(M0)}


BRIDGE = {"EI": [3e7, 8e6], "rhoA": [1500.0, 900.0], "change": 8.0, "length": 16.0, "mass": 4000.0, "speed": 20.0,
          "from": 2.0, "gravity": 0.01, "gravity_ramp": 0.1}
TIMES = [0.1, 0.2, 0.25, 0.29, 0.3, 0.31, 0.35, 0.4, 0.5, 0.6]


def crossing(elements, step):
    b = BRIDGE
    h, n = b["length"] / elements, 2 * (elements + 1)
    K, M, f = lil_matrix((n, n)), lil_matrix((n, n)), np.zeros(n)
    for e in range(elements):
        piece = 0 if (e + 0.5) * h < b["change"] else 1
        at = np.arange(2 * e, 2 * e + 4)
        K[np.ix_(at, at)] += b["EI"][piece] / h**3 * np.array([
            [12, 6 * h, -12, 6 * h], [6 * h, 4 * h * h, -6 * h, 2 * h * h],
            [-12, -6 * h, 12, -6 * h], [6 * h, 2 * h * h, -6 * h, 4 * h * h]])
        M[np.ix_(at, at)] += b["rhoA"][piece] * h / 420 * np.array([
            [156, 22 * h, 54, -13 * h], [22 * h, 4 * h * h, 13 * h, -3 * h * h],
            [54, 13 * h, 156, -22 * h], [-13 * h, -3 * h * h, -22 * h, 4 * h * h]])
        f[at] -= b["rhoA"][piece] * h / 12 * np.array([6, h, 6, -h])
    free = np.array([i for i in range(n) if i not in (0, n - 2)])
    K, M, f = csc_matrix(K)[free][:, free], csc_matrix(M)[free][:, free], f[free]
    place = {int(at): i for i, at in enumerate(free)}
    w, v, a = np.zeros(len(free)), np.zeros(len(free)), np.zeros(len(free))
    seen = {}
    for i in range(1, round(TIMES[-1] / step) + 1):
        t = i * step
        s = min(t / b["gravity_ramp"], 1.0)
        g = b["gravity"] * s**4 * (35 - 84 * s + 70 * s**2 - 20 * s**3)
        x = b["from"] + b["speed"] * t
        e = min(int(x / h + 1e-12), elements - 1)
        N, D, DD = shape(x / h - e, h)
        here = [(place[k], j) for j, k in enumerate(range(2 * e, 2 * e + 4)) if k in place]
        at, pick = np.array([p for p, _ in here]), np.array([j for _, j in here])
        N, D, DD = N[pick], D[pick], DD[pick]
        extra = {"m": b["mass"] * np.outer(N, N), "c": 2 * b["mass"] * b["speed"] * np.outer(N, D),
                 "k": b["mass"] * b["speed"] ** 2 * np.outer(N, DD)}
        by = {"m": 1.0, "c": step / 2, "k": step**2 / 4}
        local = csc_matrix((sum(by[key] * extra[key] for key in by).ravel(),
                            (np.repeat(at, len(at)), np.tile(at, len(at)))), K.shape)
        w0, v0 = w + step * v + step**2 / 4 * a, v + step / 2 * a
        rhs = g * f - K @ w0
        rhs[at] += -b["mass"] * g * N - extra["c"] @ v0[at] - extra["k"] @ w0[at]
        a = splu(csc_matrix(M + step**2 / 4 * K + local)).solve(rhs)
        w, v = w0 + step**2 / 4 * a, v0 + step / 2 * a
        for want in TIMES:
            if abs(t - want) < step / 4:
                seen[want] = float(N @ w[at])
    return np.array([seen[want] for want in TIMES])


def bridge():
    coarse, fine, shorter = crossing(64, 1e-4), crossing(128, 1e-4), crossing(128, 5e-5)
    best = shorter + (shorter - fine) / 3
    off = np.abs(best - shorter) + np.abs(fine - coarse)
    print("bridge: largest", np.abs(best).max(), "uncertain by", off.max())
    return BRIDGE | {"largest_deflection": float(np.abs(best).max()), "uncertainty": float(off.max()),
                     "samples": [{"t": t, "deflection": float(f"{d:.9g}")} for t, d in zip(TIMES, best)]}


def main():
    out = {"source": "reference/sections.py", "catenary": catenary(), "frequencies": frequencies(),
           "elasticas": [elastica("1e5"), elastica("2e4")], "bridge": bridge()}
    Path(__file__).with_suffix(".json").write_text(json.dumps(out, indent=1) + "\n")


if __name__ == "__main__":
    main()
