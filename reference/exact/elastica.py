"""Cantilevers bent far by a moment or a dead force at the end.

Strain energy per reference length, l = |r_x|, theta the angle of the tangent:
    green         W = EA (l^2 - 1)^2/8 + EI theta'^2/(2 l^2)
    engineering   W = EA (l - 1)^2/2 + EI theta'^2/2
Force F (constant between loads) and moment mu = dW/dtheta' obey dW/dl = F.t, mu' = -l F.n. An end moment alone: F = 0, so
    green  l^2 = 1 + 2 M^2/(EA EI), theta' = l^2 M/EI;   engineering  l = 1, theta' = M/EI:   a circle of curvature theta'/l.
Inextensible, dead load P across the end: EI theta'^2/2 = P (sin theta_end - sin theta), in elliptic integrals with
k^2 = (1 + sin theta_end)/2.

Source: Love, Mathematical Theory of Elasticity, 262-263.
Errors: Newton's method on W - M theta', shooting, other steps. Command: make.py elastica
"""
import mpmath as mp

from common import bracketed, case, integrate, newton, precisely


def energy(law, EA, EI, l, bend):
    return EA * (l * l - 1) ** 2 / 8 + EI * bend**2 / l**2 / 2 if law == "green" else EA * (l - 1) ** 2 / 2 + EI * bend**2 / 2


def circle(law, EA, EI, L, M):
    l = mp.sqrt(1 + 2 * M * M / (EA * EI)) if law == "green" else mp.mpf(1)
    bend = l * l * M / EI
    return arc(l, bend, L)


def arc(l, bend, L):
    curvature, angle = bend / l, bend * L
    return {"stretch": l, "angle": angle, "tip": [mp.sin(angle) / curvature, (1 - mp.cos(angle)) / curvature]}


def circle_by_energy(law, EA, EI, L, M):
    """The state where W - M theta' is stationary, derivatives by differences."""
    W = lambda l, bend: energy(law, EA, EI, l, bend)
    slopes = lambda x: [mp.diff(W, tuple(x), (1, 0)) / EA, mp.diff(W, tuple(x), (0, 1)) / EI - M / EI]
    return arc(*newton(slopes, [1, M / EI]), L)


def inextensible(load):
    """x, y over L and the angle of the end, for P L^2/EI = load."""
    a = mp.sqrt(load)
    first = lambda k: mp.asin(1 / (k * mp.sqrt(2)))
    k = bracketed(lambda k: mp.ellipk(k * k) - mp.ellipf(first(k), k * k) - a, mp.sqrt(mp.mpf(1) / 2) + mp.mpf(10) ** -30, 1 - mp.mpf(10) ** -12)
    y = 1 - 2 / a * (mp.ellipe(k * k) - mp.ellipe(first(k), k * k))
    return {"x": mp.sqrt(2 * (2 * k * k - 1)) / a, "y": y, "angle": mp.asin(2 * k * k - 1)}


def stretch(law, EA, EI, mu, pull):
    """l of the moment and of F.t."""
    if law == "engineering":
        return 1 + pull / EA
    l = mp.mpf(1)
    for _ in range(50):  # dW/dl = EA l (l^2 - 1)/2 - l mu^2/EI, for theta' = l^2 mu/EI
        change = (EA * l * (l * l - 1) / 2 - l * mu * mu / EI - pull) / (EA * (3 * l * l - 1) / 2 - mu * mu / EI)
        l -= change
        if abs(change) < mp.mpf(10) ** (3 - mp.mp.dps):
            return l
    raise ArithmeticError("no stretch")


def shoot(law, EA, EI, force, theta, mu, L, steps):
    """x, y, theta, mu at the end."""
    def rates(_, state):
        c, s = mp.cos(state[2]), mp.sin(state[2])
        l = 1 if law == "inextensible" else stretch(law, EA, EI, state[3], force[0] * c + force[1] * s)
        bend = state[3] / EI * (l * l if law == "green" else 1)
        return [l * c, l * s, bend, -l * (force[1] * c - force[0] * s)]
    return integrate(rates, [mp.mpf(0), mp.mpf(0), mp.mpf(theta), mu], mp.mpf(0), mp.mpf(L), steps)


def dead_load(law, EA, EI, P, steps):
    """A beam of length 1."""
    mu = newton(lambda m: [shoot(law, EA, EI, (0, P), 0, m[0], 1, steps)[3]], [P * (1 - P / EI / 12 if P < 5 * EI else 0.45)])[0]
    x, y, angle, _ = shoot(law, EA, EI, (0, P), 0, mu, 1, steps)
    return {"x": x, "y": y, "angle": angle}


def seed():
    return mp.mpf(20e6) * mp.pi / 10**4, mp.mpf(20e6) * mp.pi / 10**8 / 4


def cases():
    love = "Love, Mathematical Theory of Elasticity, 262-263"
    force = {"EA": "N", "EI": "N m^2", "length": "m", "P": "N", "x": "m", "y": "m", "angle": "rad", "tip": "m", "moment": "N m", "stretch": "1"}
    for law in ("green", "engineering"):
        for turns, EA in ((1, 4e4), (0.25, 4e4), (1, 4e6), (0.25, 4e6)):
            data = mp.mpf(EA), mp.mpf(100) / 3, 1, turns * 2 * mp.pi * 100 / 3
            name = f"roll-up, {law}, {turns:g} turn" + (", EA = 4e6" if EA > 4e4 else "")
            yield case(name, "closed form", "circle of this strain energy: mu = M, F = 0",
                       {"law": law, "EA": EA, "EI": float(data[1]), "length": 1, "moment": float(data[3])}, force,
                       [lambda: circle(law, *data), lambda: circle_by_energy(law, *data)], "stationary W - M theta' by Newton's method")
    for load in (1, 2, 5, 10):
        yield case(f"elastica, P L^2/EI = {load}", "closed form", love, {"load": load, "length": 1}, {"load": "1", "x": "L", "y": "L", "angle": "rad"},
                   [lambda: inextensible(mp.mpf(load)), precisely(lambda: dead_load("inextensible", 0, mp.mpf(1), mp.mpf(load), 30), 24)], "shooting")
    EA, EI = seed()
    for law in ("green", "engineering"):
        for load in (1, 4):
            yield case(f"elastica, {law}, seed beam, P L^2/EI = {load}", "shooting", "dW/dl = F.t, mu' = -l F.n of this strain energy",
                       {"law": law, "EA": float(EA), "EI": float(EI), "length": 1, "P": float(load * EI)}, force,
                       [precisely(lambda n=n: dead_load(law, EA, EI, load * EI, n), 24) for n in (24, 16)], "24 and 16 steps of order 10")
