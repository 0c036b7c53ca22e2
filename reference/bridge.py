#!/usr/bin/env python3
"""Writes reference/bridge.json: a mass that is driven at constant speed over a simply supported beam, by modes of the linear beam.

w = sum q_n(t) sin(n pi x/L); with c_n = rhoA L/2, k_n = EI (n pi/L)^4 L/2 and xi = x_0 + v t
    c_n q_n'' + k_n q_n = -g S rhoA L (1 - cos n pi)/(n pi) - m (g S + D^2w) sin(n pi xi/L),
    D^2w = w_tt + 2 v w_xt + v^2 w_xx  at xi:
the acceleration of a mass that moves over a beam that moves. Gravity grows smoothly, S = s^4 (35 - 84 s + 70 s^2 - 20 s^3), s = t/T_r. Of the modes left out the static deflection under the contact force is added.
The uncertainty is the change by two thirds of the modes, or by half of the steps. No libraries.

    bridge.py
"""
import json
import math
import os

BEAM = {"length": 20.0, "EI": 2e10, "rhoA": 2000.0, "gravity": 9.81, "gravity_ramp": 0.1}
MASS = {"mass": 8000.0, "speed": 30.0, "start": 1.0}
TIMES = [0.1, 0.2, 0.3, 0.4, 0.5, 0.6]


def deflections(modes, steps):
    """Of the beam under the mass, at TIMES."""
    length, EI, rhoA, g = BEAM["length"], BEAM["EI"], BEAM["rhoA"], BEAM["gravity"]
    mass, v, start = MASS["mass"], MASS["speed"], MASS["start"]
    number = range(1, modes + 1)
    wave = [n * math.pi / length for n in number]
    inertia = rhoA * length / 2
    stiffness = [EI * k**4 * length / 2 for k in wave]
    weight = [-g * rhoA * (1 - math.cos(n * math.pi)) / k for n, k in zip(number, wave)]

    def accelerations(t, q, rate):
        s = min(t / BEAM["gravity_ramp"], 1.0)
        share = s**4 * (35 + s * (-84 + s * (70 - 20 * s)))
        xi = start + v * t
        sine = [math.sin(k * xi) for k in wave]
        convected = sum(2 * v * k * math.cos(k * xi) * r - v * v * k * k * s * x for k, s, r, x in zip(wave, sine, rate, q))
        free = [(share * p - k * x) / inertia for p, k, x in zip(weight, stiffness, q)]
        # (c + m s s^T) q'' = c free - m (g + convected) s, by Sherman and Morrison
        push = -mass * (share * g + convected + sum(s * a for s, a in zip(sine, free))) / (1 + mass / inertia * sum(s * s for s in sine))
        return [a + s * push / inertia for a, s in zip(free, sine)], push

    q, rate, t = [0.0] * modes, [0.0] * modes, 0.0
    result = []
    for until in TIMES:
        count = round(steps * (until - t))
        h = (until - t) / count
        for _ in range(count):
            a1, _ = accelerations(t, q, rate)
            q2, r2 = [x + h / 2 * r for x, r in zip(q, rate)], [r + h / 2 * a for r, a in zip(rate, a1)]
            a2, _ = accelerations(t + h / 2, q2, r2)
            q3, r3 = [x + h / 2 * r for x, r in zip(q, r2)], [r + h / 2 * a for r, a in zip(rate, a2)]
            a3, _ = accelerations(t + h / 2, q3, r3)
            q4, r4 = [x + h * r for x, r in zip(q, r3)], [r + h * a for r, a in zip(rate, a3)]
            a4, _ = accelerations(t + h, q4, r4)
            q = [x + h / 6 * (a + 2 * b + 2 * c + d) for x, a, b, c, d in zip(q, rate, r2, r3, r4)]
            rate = [r + h / 6 * (a + 2 * b + 2 * c + d) for r, a, b, c, d in zip(rate, a1, a2, a3, a4)]
            t += h
        t = until
        xi = start + v * t
        push = accelerations(t, q, rate)[1]
        left_out = sum(math.sin(n * math.pi * xi / length)**2 * 2 / (EI * length) / (n * math.pi / length)**4
                       for n in range(modes + 1, 4000))
        result.append(sum(x * math.sin(k * xi) for x, k in zip(q, wave)) + push * left_out)
    return result


if __name__ == "__main__":
    fine = deflections(48, 2e5)
    change = [max(abs(a - b), abs(a - c)) for a, b, c in zip(fine, deflections(32, 2e5), deflections(48, 1e5))]
    static = MASS["mass"] * BEAM["gravity"] * BEAM["length"]**3 / (48 * BEAM["EI"])
    with open(os.path.join(os.path.dirname(os.path.abspath(__file__)), "bridge.json"), "w") as file:
        json.dump({"source": "reference/bridge.py: modes of the linear beam, no elements", "beam": BEAM, "driven": MASS,
                   "static_deflection": static, "uncertainty": max(change),
                   "under_the_mass": [{"t": t, "y": float(f"{y:.12g}")} for t, y in zip(TIMES, fine)]}, file, indent=1)
        file.write("\n")
