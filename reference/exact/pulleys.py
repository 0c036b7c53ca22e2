"""Inextensible strings over guides and pulleys, a rope that slides over a peg.

capstan     T_end = T_0 exp(sum mu_i phi_i), phi_i the angle by which the string turns at guide i (Euler, Eytelwein): of corners of a polygon
weights     three weights on a string over two rings at one height: 2 T sin(a) = W, T = P:  below the rings by b tan(a), 2 b their distance
Atwood      y'' = (m_1 - m_2) g/(m_1 + m_2 + I/R^2), tensions m_1 (g - y'') and m_2 (g + y'')
movable     a weight M on the bight between a fixed end and a ring 2 b away, both at height 0, m on the string's other end below the ring:
            2 sqrt(b^2 + y^2) + z = const (depths y, z), Lagrange with (M + I_2/R_2^2) y'^2 + (m + I_1/R_1^2) z'^2: I_1 the pulley at the
            ring, I_2 that of M (both legs vertical, b = 0: it turns by y'/R_2). b = 0: y'' = g (M - 2 m)/(M + 4 m + 4 I_1/R_1^2 + I_2/R_2^2)
peg         a rope of length L over a small smooth peg, its middle d off it: d = d_0 cosh(sqrt(2 g/L) t) from rest until d = L/2, tension at
            the peg 2 rho g a (L - a)/L, a = L/2 - d, twice that on the peg

Source: Whittaker, Analytical Dynamics; Eytelwein, Handbuch der Statik fester Koerper, 1808.
Errors: integration of dT = mu T dphi in small turns; Newton's or Lagrange's equations of both weights with the tension as unknown, integrated in
steps of order 10. Command: make.py pulleys
"""
import mpmath as mp

from common import case, integrate, newton, precisely

g = mp.mpf("9.81")


def turns(points):
    result = []
    for a, b, c in zip(points, points[1:], points[2:]):
        u, v = [[mp.mpf(q) - mp.mpf(p) for p, q in zip(*pair)] for pair in ((a, b), (b, c))]
        result.append(mp.acos(sum(p * q for p, q in zip(u, v)) / (mp.norm(u) * mp.norm(v))))
    return result


def capstan(T0, points, mu):
    tensions = [mp.mpf(T0)]
    for angle, m in zip(turns(points), mu):
        tensions.append(tensions[-1] * mp.exp(m * angle))
    return {"tensions": tensions, "turns": turns(points)}


def capstan_by_steps(T0, points, mu):
    tensions, angles = [mp.mpf(T0)], []
    for (a, b, c), m in zip(zip(points, points[1:], points[2:]), mu):
        first, second = [mp.atan2(mp.mpf(q[1]) - mp.mpf(p[1]), mp.mpf(q[0]) - mp.mpf(p[0])) for p, q in ((a, b), (b, c))]
        angles.append(abs(mp.fmod(second - first + 3 * mp.pi, 2 * mp.pi) - mp.pi))
        tensions.append(integrate(lambda _, T: [m * T[0]], [tensions[-1]], mp.mpf(0), angles[-1], 10, 16)[0])
    return {"tensions": tensions, "turns": angles}


def movable(M, m, b, y0, z0, inertia, times):
    """Lagrange's equation in y."""
    length = 2 * mp.hypot(b, y0) + z0
    def rates(_, q):
        y, v = q
        leg = mp.hypot(b, y)
        slope, bend = -2 * y / leg, -2 * b * b / leg**3  # dz/dy and its derivative
        a, c = m + inertia[0], M + inertia[1]
        return [v, (g * (M + m * slope) - a * slope * bend * v * v) / (c + a * slope * slope)]
    def run(steps):
        states = [integrate(rates, [mp.mpf(y0), mp.mpf(0)], mp.mpf(0), t, steps) for t in times]
        return {"y": [q[0] for q in states], "z": [length - 2 * mp.hypot(b, q[0]) for q in states]}
    return run


def movable_by_forces(M, m, b, y0, z0, inertia, times, steps=30):
    """Both weights move in y and z; the tensions of the two sides of the ring and the acceleration along the string follow."""
    def rates(_, q):
        y, z, v, u = q
        leg = mp.hypot(b, y)
        # unknown y'', z'', tension S of the legs: (M + I2) y'' + 2 S y/leg = M g; (m + I1) z'' + S = m g; 2 y/leg y'' + z'' = -2 b^2 v^2/leg^3
        A = mp.matrix([[M + inertia[1], 0, 2 * y / leg], [0, m + inertia[0], 1], [2 * y / leg, 1, 0]])
        acceleration = mp.lu_solve(A, mp.matrix([M * g, m * g, -2 * b * b * v * v / leg**3]))
        return [v, u, acceleration[0], acceleration[1]]
    states = [integrate(rates, [mp.mpf(y0), mp.mpf(z0), mp.mpf(0), mp.mpf(0)], mp.mpf(0), t, steps) for t in times]
    return {"y": [q[0] for q in states], "z": [q[1] for q in states]}


def atwood(m1, m2, inertia):
    a = (m1 - m2) * g / (m1 + m2 + inertia)
    return {"acceleration": a, "passed": [a * t * t / 2 for t in TIMES], "tensions": [m1 * (g - a), m2 * (g + a)]}


def atwood_by_forces(m1, m2, inertia):
    """y'', and the tensions, from the three equations of motion."""
    a, one, two = mp.lu_solve(mp.matrix([[m1, 1, 0], [m2, 0, -1], [inertia, -1, 1]]), mp.matrix([m1 * g, -m2 * g, 0]))
    return {"acceleration": a, "passed": [integrate(lambda _, q: [q[1], a], [mp.mpf(0)] * 2, mp.mpf(0), t, 2)[0] for t in TIMES], "tensions": [one, two]}


def peg(rho, L, d0, times):
    d = [d0 * mp.cosh(mp.sqrt(2 * g / L) * t) for t in times]
    return {"passed": [x - d0 for x in d], "tension": [2 * rho * g * (L / 2 - x) * (L / 2 + x) / L for x in d],
            "leaves": mp.acosh(L / 2 / d0) / mp.sqrt(2 * g / L)}


def peg_by_steps(rho, L, d0, times):
    """The weight of both sides moves all of the rope; T = rho a (g + a'') of the side that rises."""
    rise = lambda q: g * 2 * q[0] / L
    at = lambda t: integrate(lambda _, q: [q[1], rise(q)], [d0, mp.mpf(0)], mp.mpf(0), t, 30)
    states = [at(t) for t in times]
    return {"passed": [q[0] - d0 for q in states], "tension": [rho * (L / 2 - q[0]) * (g + rise(q)) for q in states],
            "leaves": newton(lambda t: [at(t[0])[0] - L / 2], [mp.mpf(1)])[0]}


TIMES = [mp.mpf(i) / 10 for i in range(1, 6)]


def cases():
    lagrange = "Lagrange's equations with the inextensible string; Whittaker, Analytical Dynamics"
    units = {"masses": "kg", "inertia": "kg (I/R^2)", "lengths, places": "m", "t": "s", "tension": "N", "turns": "rad", "rho": "kg/m", "acceleration": "m/s^2"}
    f = lambda values: [float(v) for v in values]
    strings = ("three guides", [(0, 0), (1, 0), (1, 1), (2, 1), (3, 2)], (0.1, 0.2, 0.3)), ("one guide, 180 degrees", [(0, 0), (1, 0), (0, 0)], (0.25,))
    for name, points, mu in strings:
        yield case(f"capstan, {name}", "closed form", "Euler, Eytelwein: T = T_0 exp(sum mu phi)", {"T_0": 10, "points": points, "friction": mu}, units,
                   [lambda: capstan(10, points, mu), precisely(lambda: capstan_by_steps(10, points, mu), 24)], "dT = mu T dphi integrated")
    angle, energy_slope = mp.asin(mp.mpf("1.2") / 2), lambda y: [mp.mpf("1.2") + 2 * y[0] / mp.hypot(1, y[0])]
    yield case("three weights on a string over two rings", "closed form", "2 T sin(a) = W", {"middle": 1.2, "ends": 1, "distance": 2}, units,
               [lambda: {"middle": [0, -mp.tan(angle)]}, lambda: {"middle": [0, newton(energy_slope, [-0.7])[0]]}], "stationary potential energy")
    for inertia in (0, 0.5):
        yield case(f"Atwood's machine, I/R^2 = {inertia} kg", "closed form", lagrange, {"g": 9.81, "masses": [2, 1], "inertia": inertia, "t": f(TIMES)}, units,
                   [lambda: atwood(mp.mpf(2), mp.mpf(1), mp.mpf(inertia)), lambda: atwood_by_forces(mp.mpf(2), mp.mpf(1), mp.mpf(inertia))],
                   "equations of the three bodies")
    times = TIMES[:4]
    for b, y0, z0, inertia in ((0.2, 1, 1, (0, 0)), (0.2, 1, 1, (0.5, 0)), (0, 1, 1, (0.5, 0.8))):
        data = mp.mpf(3), mp.mpf(1), mp.mpf(str(b)), mp.mpf(y0), mp.mpf(z0), [mp.mpf(str(i)) for i in inertia], times
        yield case(f"movable pulley, b = {b} m, I/R^2 = {inertia[0]} and {inertia[1]} kg", "ode", lagrange,
                   {"g": 9.81, "masses": [3, 1], "b": b, "y": y0, "z": z0, "inertia": inertia, "t": f(times)}, units,
                   [precisely(lambda: movable(*data)(20), 24), precisely(lambda: movable_by_forces(*data), 22)], "equations of both weights with the tension")
    for length, start in ((2, "0.1"), (1, "0.05")):
        data = mp.mpf(1), mp.mpf(length), mp.mpf(start), TIMES
        yield case(f"rope that slides off a smooth peg, {length} m", "closed form", "d'' = 2 g d/L",
                   {"g": 9.81, "rho": 1, "length": length, "d_0": float(data[2]), "t": f(TIMES)}, units,
                   [lambda: peg(*data), precisely(lambda: peg_by_steps(*data), 24)], "integration")
