#!/usr/bin/env python3
"""Writes reference/vehicles.json: axles that come onto a bridge and leave it.

The bridge is the linear Bernoulli beam of bearings.py. A sprung mass is an unknown, z; its wheel is as high as the
beam, w, or 0 off it, and pushes with
    F + (m_w + m_s) g + k (w - z) + c (w' - z') + m_w w'',   m_s z'' = k (w - z) + c (w' - z'),
where w' and w'' are those of a point that travels. Gravity grows smoothly, of the beam, too. Trapezoidal rule, two
meshes, two steps.

    vehicles.py            needs numpy and scipy
"""

import json
from pathlib import Path

import numpy as np
from scipy.sparse import csc_matrix, lil_matrix
from scipy.sparse.linalg import splu

from bearings import shape

GRAVITY, RAMP = 0.01, 0.1
CASES = [
    {"name": "sprung", "EI": 2e8, "rhoA": 2000.0, "length": 20.0, "pier": None, "speed": 30.0, "from": -1.5, "until": 1.0, "place": 10.0,
     "axles": [{"distance": 0.0, "force": 0.0, "mass": 0.0, "sprung_mass": 9000.0, "stiffness": 1.6e6, "damping": 2e4}]},
    {"name": "wheel", "EI": 2e8, "rhoA": 2000.0, "length": 20.0, "pier": None, "speed": 30.0, "from": -1.5, "until": 0.7, "place": 10.0,
     "axles": [{"distance": 0.0, "force": 0.0, "mass": 1500.0, "sprung_mass": 9000.0, "stiffness": 1.6e6, "damping": 2e4}]},
    {"name": "two_axles", "EI": 3e8, "rhoA": 1500.0, "length": 22.0, "pier": 10.0, "speed": 20.0, "from": 0.0, "until": 1.4, "place": 16.0,
     "axles": [{"distance": 0.0, "force": 50.0, "mass": 0.0, "sprung_mass": 4000.0, "stiffness": 8e5, "damping": 1e4},
               {"distance": 3.0, "force": 0.0, "mass": 0.0, "sprung_mass": 6000.0, "stiffness": 1e6, "damping": 0.0}]},
]


def passing(case, elements, step):
    """Deflection at the place, push of the first axle and height of its mass, every tenth of a second."""
    EI, rho, length = case["EI"], case["rhoA"], case["length"]
    h, n, axles = length / elements, 2 * (elements + 1), case["axles"]
    k1 = EI / h**3 * np.array([[12, 6 * h, -12, 6 * h], [6 * h, 4 * h * h, -6 * h, 2 * h * h],
                               [-12, -6 * h, 12, -6 * h], [6 * h, 2 * h * h, -6 * h, 4 * h * h]])
    m1 = rho * h / 420 * np.array([[156, 22 * h, 54, -13 * h], [22 * h, 4 * h * h, 13 * h, -3 * h * h],
                                   [54, 13 * h, 156, -22 * h], [-13 * h, -3 * h * h, -22 * h, 4 * h * h]])
    held = [0, n - 2] + ([2 * round(case["pier"] / h)] if case["pier"] else [])
    size = n + len(axles) + len(held)
    K, M, rows = lil_matrix((size, size)), lil_matrix((size, size)), lil_matrix((size, size))
    for e in range(elements):
        at = np.arange(2 * e, 2 * e + 4)
        K[np.ix_(at, at)] += k1
        M[np.ix_(at, at)] += m1
    weight = np.zeros(size)
    for e in range(elements):
        weight[2 * e : 2 * e + 4] -= rho * h / 12 * np.array([6, h, 6, -h])
    for i, axle in enumerate(axles):
        M[n + i, n + i] = axle["sprung_mass"]
    first = n + len(axles)
    for i, at in enumerate(held):
        rows[first + i, at] = rows[at, first + i] = 1
    K, M, rows = csc_matrix(K), csc_matrix(M), csc_matrix(rows)
    w, v, a = np.zeros(size), np.zeros(size), np.zeros(size)
    probe = 2 * round(case["place"] / h)
    seen, b, c = [], step / 2, step**2 / 4
    every = round(0.1 / step)
    for i in range(1, round(case["until"] / step) + 1):
        t = i * step
        extra_m, extra_c, extra_k = (lil_matrix((size, size)) for _ in range(3))
        share = min(t / RAMP, 1.0)
        g = GRAVITY * share**4 * (35 - 84 * share + 70 * share**2 - 20 * share**3)
        load, pushes = g * weight, []
        for j, axle in enumerate(axles):
            x = case["from"] + case["speed"] * t - axle["distance"]
            own = n + j
            on = 0 <= x <= length
            e = min(max(int(x / h), 0), elements - 1)
            at = np.arange(2 * e, 2 * e + 4)
            N, D, DD = shape(x / h - e, h) if on else (np.zeros(4),) * 3
            mw, k, d, s = axle["mass"], axle["stiffness"], axle["damping"], case["speed"]
            # along (beam, mass): wheel's way w, its rate, its acceleration
            both = np.append(at, own)
            stretch, follows = np.append(N, -1.0), np.append(s * D, 0.0)
            onto = np.append(N, -1.0)
            extra_k[np.ix_(both, both)] += np.outer(onto, k * stretch + d * follows)
            extra_c[np.ix_(both, both)] += np.outer(onto, d * stretch)
            extra_m[np.ix_(at, at)] += mw * np.outer(N, N)
            extra_c[np.ix_(at, at)] += 2 * mw * s * np.outer(N, D)
            extra_k[np.ix_(at, at)] += mw * s**2 * np.outer(N, DD)
            still = axle["force"] + (mw + axle["sprung_mass"]) * g
            load[at] -= still * N
            pushes.append((both, stretch, follows, mw, k, d, s, N, D, DD, at, still, on))
        m, d_, k_ = M + csc_matrix(extra_m), csc_matrix(extra_c), K + csc_matrix(extra_k)
        w0, v0 = w + step * v + c * a, v + b * a
        rhs = load - k_ @ w0 - d_ @ v0
        rhs[first:] = -(rows @ w0)[first:] / c
        a = splu(csc_matrix(m + b * d_ + c * k_ + rows)).solve(rhs)
        a[first:] = 0
        w, v = w0 + c * a, v0 + b * a
        if i % every == 0:
            both, stretch, follows, mw, k, d, s, N, D, DD, at, still, on = pushes[0]
            push = still + k * stretch @ w[both] + d * (stretch @ v[both] + follows @ w[both])
            push += mw * (N @ a[at] + 2 * s * D @ v[at] + s * s * DD @ w[at])
            seen.append((w[probe], push if on else np.nan, w[n]))
    return np.array(seen)


def main():
    out = {"source": "reference/vehicles.py", "gravity": GRAVITY, "gravity_ramp": RAMP, "cases": []}
    for case in CASES:
        e = round(4 * case["length"])
        coarse, fine, shorter = passing(case, e, 2e-4), passing(case, 2 * e, 2e-4), passing(case, 2 * e, 1e-4)
        best = shorter + (shorter - fine) / 3
        off = np.nanmax(np.abs(best - shorter) + np.abs(fine - coarse), axis=0)
        print(case["name"], "largest", np.nanmax(np.abs(best), axis=0), "uncertain by", off)
        out["cases"].append({**case, "uncertainty": [float(f"{x:.2g}") for x in off],
                             "samples": [[float(f"{x:.8g}") if np.isfinite(x) else None for x in row] for row in best]})
    Path(__file__).with_suffix(".json").write_text(json.dumps(out, indent=1) + "\n")


if __name__ == "__main__":
    main()
