"""Winches, each against its own equation of motion. Writes reference/winches.json. Needs mpmath.

* held_tension: a mass m on a rope of rhoA kg/m whose length l = L + s hangs from an outlet that holds the tension P. What comes
  in has the speed of what is outside, so only forces count: (m + rhoA l) s'' = (m + rhoA l) g - P. The rope is inextensible.
* drum: a drum without a motor, of inertia J with all that is wound up on it. What runs off has the drum's speed, too, so the
  whole mass m + rhoA L + J/r^2 stays, and its weight grows: s = (a/b) (cosh(sqrt(b) t) - 1), a = g (m + rhoA L)/M,
  b = g rhoA/M. Inextensible as well.
* growth: the mode of an element of half the length of its neighbours at a free end, over c/L (consistent masses, Hermite): its
  frequency, and what an inflow of the speed v adds to its energy a second, u_0'^2 rhoA v/2 over v/L times the energy; the same
  where the strain at the end is held.
"""
import json
import os

import mpmath as mp

mp.mp.dps = 30
G = mp.mpf("9.81")


def held_tension(pull, mass, rhoA, length, until):
    heavy = lambda s: mass + rhoA * (length + s)
    return mp.odefun(lambda t, y: [y[1], G - pull / heavy(y[0])], 0, [mp.mpf(0), mp.mpf(0)])(until)[0]


def drum(mass, rhoA, length, turning, until):
    whole = mass + rhoA * length + turning
    a, b = G * (mass + rhoA * length) / whole, G * rhoA / whole
    return a / b * (mp.cosh(mp.sqrt(b) * until) - 1)


def growth(short, elements=12):
    """Modes of a bar of Hermite elements, the first of the length `short`, the others of length 1: (frequency, rate)."""
    n = 2 * elements + 2
    mass, stiffness = mp.zeros(n), mp.zeros(n)
    M = [[156, 22, 54, -13], [22, 4, 13, -3], [54, 13, 156, -22], [-13, -3, -22, 4]]
    K = [[36, 3, -36, 3], [3, 4, -3, -1], [-36, -3, 36, -3], [3, -1, -3, 4]]
    for k in range(elements):
        h = mp.mpf(short if k == 0 else 1)
        scale = [1, h, 1, h]
        for i in range(4):
            for j in range(4):
                mass[2 * k + i, 2 * k + j] += h * M[i][j] * scale[i] * scale[j] / 420
                stiffness[2 * k + i, 2 * k + j] += K[i][j] * scale[i] * scale[j] / (30 * h)

    def largest(free):
        m = mp.matrix([[mass[i, j] for j in free] for i in free])
        k = mp.matrix([[stiffness[i, j] for j in free] for i in free])
        lower = mp.cholesky(m)
        inverse = lower**-1
        values, vectors = mp.eigsy(inverse * k * inverse.T)
        vectors = inverse.T * vectors
        gains = [vectors[0, i] ** 2 for i in range(len(free))]  # modes of mass 1: energy frequency^2/2, mean u_0'^2 half of its square
        which = max(range(len(free)), key=lambda i: gains[i])
        return mp.sqrt(values[which]), gains[which] / 2
    return largest(list(range(n))), largest([0] + list(range(2, n)))


def written(x):
    return float(mp.nstr(x, 12))


(free, held) = growth("0.5")
answer = {
    "source": "reference/winches.py: equations of motion by mpmath.odefun, closed form, eigenvalues of Hermite elements",
    "held_tension": {"pull": 8, "mass": 0.5, "rhoA": 0.3, "length": 2, "t": 0.8,
                     "paid_out": written(held_tension(mp.mpf(8), mp.mpf("0.5"), mp.mpf("0.3"), mp.mpf(2), mp.mpf("0.8")))},
    "drum": {"mass": 15, "rhoA": 0.5, "length": 1, "radius": 0.25, "inertia": 1.84375, "t": 2,
             "paid_out": written(drum(mp.mpf(15), mp.mpf("0.5"), mp.mpf(1), mp.mpf("29.5"), mp.mpf(2)))},
    "growth": {"free": {"frequency": written(free[0]), "rate": written(free[1])},
               "held_strain": {"frequency": written(held[0]), "rate": written(held[1])}},
}
with open(os.path.join(os.path.dirname(os.path.abspath(__file__)), "winches.json"), "w") as file:
    json.dump(answer, file, indent=1)
    file.write("\n")
