#!/usr/bin/env python3
"""Writes reference/equilibria.json: equilibria of beams with the strain energy EA (|r_x|^2 - 1)^2/8 + EI (kappa - kappa_0)^2/2,
kappa = theta'/|r_x|, by shooting. No element is involved: between loads the force F is constant, and with the direction t, its
normal n and the stretch l = |r_x|

    mu = dW/dtheta' = EI (kappa - kappa_0)/l,   mu' = -l F.n,   theta' = l kappa,   r' = l t,
    EA l (l^2 - 1)/2 - mu kappa = F.t           (which gives l).

    equilibria.py
"""
import json
import math
import os

STEPS = 100  # of the classical Runge-Kutta method; twice as many show which digits stand


def stretch(EA, EI, kappa0, mu, pull):
    l = 1.0
    for _ in range(50):
        kappa = kappa0 + l * mu / EI
        f = EA * l * (l * l - 1) / 2 - mu * kappa - pull
        change = f / (EA * (3 * l * l - 1) / 2 - mu * mu / EI)
        l -= change
        if abs(change) < 1e-15:
            break
    return l


def rates(beam, force, state):
    EA, EI, kappa0 = beam
    _, _, theta, mu = state
    c, s = math.cos(theta), math.sin(theta)
    l = stretch(EA, EI, kappa0, mu, force[0] * c + force[1] * s)
    return (l * c, l * s, l * (kappa0 + l * mu / EI), -l * (force[1] * c - force[0] * s))


def shoot(beam, force, start, length, steps):
    h = length / steps
    state = start
    for _ in range(steps):
        k1 = rates(beam, force, state)
        k2 = rates(beam, force, [a + h / 2 * b for a, b in zip(state, k1)])
        k3 = rates(beam, force, [a + h / 2 * b for a, b in zip(state, k2)])
        k4 = rates(beam, force, [a + h * b for a, b in zip(state, k3)])
        state = [a + h / 6 * (b + 2 * c + 2 * d + e) for a, b, c, d, e in zip(state, k1, k2, k3, k4)]
    return state


def solve(matrix, rhs):
    """Gauss with pivoting."""
    n = len(rhs)
    rows = [list(row) + [b] for row, b in zip(matrix, rhs)]
    for i in range(n):
        p = max(range(i, n), key=lambda k: abs(rows[k][i]))
        rows[i], rows[p] = rows[p], rows[i]
        for k in range(i + 1, n):
            f = rows[k][i] / rows[i][i]
            rows[k] = [a - f * b for a, b in zip(rows[k], rows[i])]
    x = [0.0] * n
    for i in reversed(range(n)):
        x[i] = (rows[i][n] - sum(rows[i][j] * x[j] for j in range(i + 1, n))) / rows[i][i]
    return x


def newton(f, x):
    for _ in range(60):
        y = f(x)
        columns = []
        for i in range(len(x)):
            h = 1e-6 * max(1.0, abs(x[i]))
            up, down = list(x), list(x)
            up[i] += h
            down[i] -= h
            columns.append([(a - b) / (2 * h) for a, b in zip(f(up), f(down))])
        change = solve([[columns[j][i] for j in range(len(x))] for i in range(len(y))], y)
        x = [a - b for a, b in zip(x, change)]
        if max(abs(c) / max(1.0, abs(a)) for c, a in zip(change, x)) < 1e-13:
            return x
    return x


def elastica(steps=STEPS):
    """A clamped beam of length 1 under a dead load P L^2/EI = 4 across its end."""
    EA, EI = 2e7 * math.pi * 1e-4, 2e7 * math.pi * 1e-8 / 4
    force = (0.0, 4 * EI)
    end = lambda mu: shoot((EA, EI, 0.0), force, [0, 0, 0, mu], 1.0, steps)
    mu = newton(lambda x: [end(x[0])[3]], [0.2])[0]
    x, y, theta, _ = end(mu)
    return {"x": x, "y": y, "theta": theta}


class Arch:
    """Half of a circular arch, pinned, of span 1, that bears P in its middle."""

    EA, EI, rise = 1e4, 1.0, 0.04

    def __init__(self, steps=STEPS):
        self.steps = steps
        self.radius = (0.25 + self.rise**2) / (2 * self.rise)
        self.half = math.asin(0.5 / self.radius)
        self.guess = [0.0, 0.0, self.half]

    def load(self, height):
        """P that holds the middle at this height."""
        beam = (self.EA, self.EI, -1 / self.radius)

        def off(x):
            end = shoot(beam, x[:2], [0, 0, x[2], 0], self.radius * self.half, self.steps)
            return [end[0] - 0.5, end[1] - height, end[2]]

        self.guess = newton(off, self.guess)
        return 2 * self.guess[1]  # the force from the right on the left half is P/2 upwards

    def path(self):
        """Extreme loads on the way down, and the height under 60 N."""
        n, heights, loads, guesses = 140, [], [], []
        for i in range(n + 1):
            heights.append(self.rise - i * 0.14 / n)
            loads.append(self.load(heights[-1]))
            guesses.append(self.guess)
        sign = 1 if loads[1] > 0 else -1  # that a load downwards has
        result = {}
        for name, better in (("limit", 1), ("lower_limit", -1)):
            inner = [i for i in range(1, n) if (sign * loads[i] - sign * loads[i - 1]) * better > 0
                     and (sign * loads[i + 1] - sign * loads[i]) * better < 0]
            a, b = heights[inner[0] + 1], heights[inner[0] - 1]
            self.guess = guesses[inner[0]]
            ratio = (math.sqrt(5) - 1) / 2
            for _ in range(35):  # golden section
                c, d = b - ratio * (b - a), a + ratio * (b - a)
                if better * sign * self.load(c) > better * sign * self.load(d):
                    b = d
                else:
                    a = c
            result[name] = sign * self.load((a + b) / 2)
        i = max(k for k in range(n) if sign * loads[k] < 60 <= sign * loads[k + 1])
        a, b = heights[i], heights[i + 1]
        self.guess = guesses[i]
        for _ in range(45):
            c = (a + b) / 2
            a, b = (c, b) if sign * self.load(c) < 60 else (a, c)
        result["height"] = (a + b) / 2
        return result


def rounded(values, digits):
    return {key: round(value, digits) for key, value in values.items()}


if __name__ == "__main__":
    folder = os.path.dirname(os.path.abspath(__file__))
    arch, elastic = Arch().path(), elastica(800)
    finer, finer_elastic = Arch(2 * STEPS).path(), elastica(1600)
    print({key: finer[key] - arch[key] for key in arch}, {key: finer_elastic[key] - elastic[key] for key in elastic})
    with open(os.path.join(folder, "equilibria.json"), "w") as file:
        json.dump({"source": "reference/equilibria.py: shooting, no elements; digits beyond those given change with its step",
                   "elastica": rounded(finer_elastic, 12),
                   "arch": {"EA": Arch.EA, "EI": Arch.EI, "rise": Arch.rise, "span": 1, "load": 60, **rounded(finer, 9)}},
                  file, indent=1)
        file.write("\n")
