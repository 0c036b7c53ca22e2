#!/usr/bin/env python3
"""Writes reference/bearings.json: a mass that crosses a bridge of two spans at an even speed, and springs under a beam.

The bridge is a linear Bernoulli beam of Hermite elements, written here and nowhere else. The mass, which stays on it,
adds to the mass, damping and stiffness matrices with w'' + 2 v w'_x + v^2 w_xx at its place; the pier is a row with a
multiplier, its reaction. Trapezoidal rule; two meshes and two steps tell the uncertainty. Loads are so small that a
beam of large deflections is the linear one to 1e-7.

    bearings.py            needs numpy and scipy
"""

import json
from pathlib import Path

import numpy as np
from scipy.sparse import csc_matrix, lil_matrix
from scipy.sparse.linalg import splu

EI, RHO, LENGTH, PIER, MASS, SPEED, FROM, GRAVITY, RAMP, UNTIL = 3e7, 1500.0, 22.0, 10.0, 8000.0, 20.0, 1.0, 0.01, 0.1, 1.0
TIMES = [0.1, 0.2, 0.3, 0.4, 0.44, 0.45, 0.46, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0]


def shape(xi, h):
    n = np.array([1 - 3 * xi**2 + 2 * xi**3, h * (xi - 2 * xi**2 + xi**3), 3 * xi**2 - 2 * xi**3, h * (xi**3 - xi**2)])
    d = np.array([-6 * xi + 6 * xi**2, h * (1 - 4 * xi + 3 * xi**2), 6 * xi - 6 * xi**2, h * (3 * xi**2 - 2 * xi)]) / h
    dd = np.array([-6 + 12 * xi, h * (-4 + 6 * xi), 6 - 12 * xi, h * (6 * xi - 2)]) / h**2
    return n, d, dd


def crossing(elements, step):
    h, n = LENGTH / elements, 2 * (elements + 1)
    k1 = EI / h**3 * np.array([[12, 6 * h, -12, 6 * h], [6 * h, 4 * h * h, -6 * h, 2 * h * h],
                               [-12, -6 * h, 12, -6 * h], [6 * h, 2 * h * h, -6 * h, 4 * h * h]])
    m1 = RHO * h / 420 * np.array([[156, 22 * h, 54, -13 * h], [22 * h, 4 * h * h, 13 * h, -3 * h * h],
                                   [54, 13 * h, 156, -22 * h], [-13 * h, -3 * h * h, -22 * h, 4 * h * h]])
    f1 = -RHO * h / 12 * np.array([6, h, 6, -h])
    K, M, f = lil_matrix((n + 3, n + 3)), lil_matrix((n + 3, n + 3)), np.zeros(n + 3)
    for e in range(elements):
        at = np.arange(2 * e, 2 * e + 4)
        K[np.ix_(at, at)] += k1
        M[np.ix_(at, at)] += m1
        f[at] += f1
    held = [0, n - 2, 2 * round(PIER / h)]  # rows of the multipliers: deflections there are 0
    rows = lil_matrix((n + 3, n + 3))
    for i, at in enumerate(held):
        rows[n + i, at] = rows[at, n + i] = 1
    K, M, rows = csc_matrix(K), csc_matrix(M), csc_matrix(rows)
    w, v, a = np.zeros(n + 3), np.zeros(n + 3), np.zeros(n + 3)
    seen, t = {}, 0.0
    for i in range(1, round(UNTIL / step) + 1):
        t = i * step
        s = min(t / RAMP, 1.0)
        g = GRAVITY * s**4 * (35 - 84 * s + 70 * s**2 - 20 * s**3)
        x = FROM + SPEED * t
        e = min(int(x / h), elements - 1)
        at = np.arange(2 * e, 2 * e + 4)
        N, D, DD = shape(x / h - e, h)
        extra = {"m": MASS * np.outer(N, N), "c": 2 * MASS * SPEED * np.outer(N, D), "k": MASS * SPEED**2 * np.outer(N, DD)}
        by = {"m": 1.0, "c": step / 2, "k": step**2 / 4}
        local = csc_matrix((sum(by[key] * extra[key] for key in by).ravel(), (np.repeat(at, 4), np.tile(at, 4))), (n + 3, n + 3))
        w0, v0 = w + step * v + step**2 / 4 * a, v + step / 2 * a
        rhs = g * f - K @ w0
        rhs[at] += -MASS * g * N - extra["c"] @ v0[at] - extra["k"] @ w0[at]
        rhs[n:] = -(rows @ w0)[n:] / (step**2 / 4)
        solved = splu(csc_matrix(M + step**2 / 4 * K + local + rows)).solve(rhs)
        reactions = -solved[n:]
        a = solved.copy()
        a[n:] = 0
        w, v = w0 + step**2 / 4 * a, v0 + step / 2 * a
        for want in TIMES:
            if abs(t - want) < step / 4:
                seen[want] = (float(N @ w[at]), float(reactions[2]))
    return np.array([seen[want] for want in TIMES])


def main():
    coarse, fine, shorter = crossing(88, 1e-4), crossing(176, 1e-4), crossing(176, 5e-5)
    best = shorter + (shorter - fine) / 3  # the trapezoidal rule errs with the square of the step
    off = np.abs(best - shorter) + np.abs(fine - coarse)
    still = float(np.abs(best[:, 0]).max())
    print("largest deflection", still, "uncertain by", off.max(axis=0))
    out = {
        "source": "reference/bearings.py",
        "bridge": {"EI": EI, "rhoA": RHO, "length": LENGTH, "pier": PIER, "mass": MASS, "speed": SPEED, "from": FROM,
                   "gravity": GRAVITY, "gravity_ramp": RAMP},
        "largest_deflection": still,
        "uncertainty": {"deflection": float(off[:, 0].max()), "reaction": float(off[:, 1].max())},
        "samples": [{"t": t, "deflection": float(f"{d:.9g}"), "reaction": float(f"{r:.7g}")} for t, (d, r) in zip(TIMES, best)],
    }
    Path(__file__).with_suffix(".json").write_text(json.dumps(out, indent=1) + "\n")


if __name__ == "__main__":
    main()
