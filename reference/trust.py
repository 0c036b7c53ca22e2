#!/usr/bin/env python3
"""Writes reference/trust.json: scenes drawn from families whose answers are known, for the study `trust`. Needs numpy.

    trust.py [OUT]

Each family draws its parameters from one seed, over decades of length, mass and stiffness; none is drawn again or left out
for what comes of it. Answers are closed forms, or ordinary differential equations integrated to 1e-13; none comes from this
project. `uncertainty` bounds, in the unit of the answer, what the scene has beside the answer: a stiff wire bends, a stiff
rope stretches and has some mass. How it is derived stands beside each family; w is then the place by which something gives
way, and e a strain. Small parameters are drawn so that it is far below the accuracy that an automatic run promises.
"""
import json
import os
import sys

import numpy as np

G = 9.81
SEED = 20240611
SAMPLES = 20                    # intervals of the output
ASKED = range(2, SAMPLES + 1, 2)  # samples that have an answer
here = os.path.dirname(os.path.abspath(__file__))

# ---- drawing


class Draw:
    """Random numbers of one scene, written to three digits."""

    def __init__(self, family, number):
        self.random = np.random.default_rng([SEED, sum(ord(c) * 31**i for i, c in enumerate(family)) % 2**31, number])

    def even(self, low, high):
        return digits(self.random.uniform(low, high))

    def decades(self, low, high):
        return digits(10 ** self.random.uniform(low, high))

    def one_of(self, *values):
        return values[int(self.random.integers(len(values)))]

    def elements(self):
        return self.one_of(8, 10, 12, 16, 20, 24, 32, 40)


def digits(x, count=3):
    return float(f"{x:.{count - 1}e}")


def stiffness(EA, EI, rhoA, **more):
    return {"type": "stiffness", "EA": digits(EA), "EI": digits(EI), "rhoA": digits(rhoA), **more}


# ---- mathematics

def step(s):
    s = min(max(s, 0.0), 1.0)
    return s**4 * (35 - 84 * s + 70 * s**2 - 20 * s**3)


def step_rate(s):
    return 140 * (s * (1 - s)) ** 3 if 0 < s < 1 else 0.0


def ramped(rate, ramp, t):
    """Value, rate and acceleration of a function whose rate grows smoothly within `ramp`."""
    s = t / ramp
    way = s**5 * (7 - 14 * s + 10 * s**2 - 2.5 * s**3) if s < 1 else s - 0.5
    return rate * ramp * way, rate * step(s), rate * step_rate(s) / ramp


COUNTS = [2 * (k + 1) for k in range(8)]


def solve(rates, state, times, breaks=(), tolerance=1e-13):
    """States at `times` of y' = rates(t, y): Gragg's midpoint rule, extrapolated to order 16, steps by its last two columns.
    The right side may be rough at `breaks`."""
    y, t = np.array(state, float), 0.0
    largest = np.abs(y)
    stops = sorted(set(times) | {b for b in breaks if b < times[-1]})
    h, found = times[-1] / 50, {}
    for stop in stops:
        while t < stop:
            last = t + h >= stop * (1 - 1e-14)
            H = stop - t if last else h
            first = rates(t, y)
            table = []
            for k, n in enumerate(COUNTS):
                d = H / n
                a, b = y, y + d * first
                for i in range(1, n):
                    a, b = b, a + 2 * d * rates(t + i * d, b)
                row = [(a + b + d * rates(t + H, b)) / 2]
                for j in range(1, k + 1):
                    row.append(row[-1] + (row[-1] - table[k - 1][j - 1]) / ((n / COUNTS[k - j]) ** 2 - 1))
                table.append(row)
            new = table[-1][-1]
            scale = np.maximum(largest, np.abs(new)) + 1e-30
            error = np.max(np.abs(new - table[-1][-2]) / np.maximum(scale, 1e-3 * np.max(scale))) + 1e-18
            if error <= tolerance or H < 1e-9 * times[-1]:
                y, t = new, stop if last else t + H
                largest = np.maximum(largest, np.abs(y))
            wanted = H * min(4.0, max(0.2, 0.9 * (tolerance / error) ** (1 / 15)))
            h = max(h, wanted) if last and error <= tolerance else wanted
        found[stop] = y
    return [found[t] for t in times]


def newton(equations, x):
    """A root of several equations, by differences."""
    x = np.array(x, float)
    for _ in range(60):
        f = np.array(equations(x))
        J = np.empty((len(x), len(x)))
        for i in range(len(x)):
            d = 1e-6 * max(abs(x[i]), 1e-3)
            up, down = x.copy(), x.copy()
            up[i] += d
            down[i] -= d
            J[:, i] = (np.array(equations(up)) - np.array(equations(down))) / (2 * d)
        change = np.linalg.solve(J, f)
        x = x - change
        if np.max(np.abs(change) / np.maximum(np.abs(x), 1e-9)) < 1e-13:
            return x
    return x


# ---- the file

cases = []


def times_of(duration):
    return [duration * k / SAMPLES for k in ASKED]


def add(family, number, scene, values, uncertainty, source, t=None):
    """`values`: from a quantity to its values at the times asked."""
    moves = scene.get("analysis") != "statics"
    if moves:
        scene["output"] = {"interval": scene["duration"] / SAMPLES}
    cases.append({"name": f"{family} {number}", "family": family, "scene": scene,
                  "t": times_of(scene["duration"]) if moves else [1],
                  "values": {key: [float(f"{x:.15g}") for x in list_] for key, list_ in values.items()},
                  "uncertainty": float(f"{uncertainty:.2g}"), "source": source})


def line(start, end):
    return {"type": "line", "start": [float(x) for x in start], "end": [float(x) for x in end]}


CLAMPED = [{"at": "start", "type": "clamp"}, {"at": "end", "type": "clamp"}]
FULL = [{"at": "start", "type": "clamp", "clamp": "full"}, {"at": "end", "type": "clamp", "clamp": "full"}]


def wire(draw, length, mass, sag):
    """Section of a wire that sags by `sag` of its length under its weight and a bead in the middle, and stretches less."""
    rhoA = mass / length * draw.decades(-2, 0)
    EI = (mass / 192 + rhoA * length / 384) * G * length**2 / sag
    return stiffness(EI / length**2 * draw.decades(2.5, 4), EI, rhoA)


# ---- families


def incline(n):
    """Bead on a straight, stiff wire: s0 + v0 t + g sin(a) t^2/2. The wire's sag w turns its tangent by 4 w/L, and moves the
    bead's energy by m g w cos(a): a share w/(way sin(a)) of it; sudden gravity doubles w."""
    d = Draw("incline", n)
    L, mass, a = d.decades(-1, 1.5), d.decades(-3, 3), np.radians(d.even(10, 75))
    sag = 1e-8
    s0, v0 = d.even(0.08, 0.3) * L, d.one_of(0, 1) * d.even(0.1, 1) * np.sqrt(G * L)
    s0, v0 = digits(s0), digits(v0)
    way = d.even(0.3, 0.6) * L
    duration = digits((np.sqrt(v0**2 + 2 * G * np.sin(a) * way) - v0) / (G * np.sin(a)))
    start = [0, 0] if d.one_of(0, 1) else [digits(L / 3), digits(L / 7)]
    end = [start[0] + L * np.cos(a), start[1] - L * np.sin(a)]
    scene = {"beam": {"curve": line(start, end), "section": wire(d, L, mass, sag), "elements": d.elements()}, "supports": CLAMPED,
             "sliding_mass": {"mass": mass, "position": s0, **({"velocity": v0} if v0 else {})}, "duration": duration}
    s = [s0 + v0 * t + G * np.sin(a) * t * t / 2 for t in times_of(duration)]
    add("incline", n, scene, {"joint_position": s}, 10 * sag * L * (1 + 1 / np.tan(a)), "s0 + v0 t + g sin(a) t^2/2")


def friction(n):
    """The same with friction, from an equilibrium: s'' = g sin(a) - mu g cos(a) tanh(s'/v_f). Where mu > tan(a) it comes to
    rest, and creeps. The wire's curvature under the bead, some 50 w/L^2, changes the normal force by 50 w v^2/(L^2 g)."""
    d = Draw("friction", n)
    L, mass = d.decades(-1, 1.5), d.decades(-3, 3)
    stops = n % 2 == 1
    a = np.radians(d.even(5, 25) if stops else d.even(30, 75))
    mu = d.even(1.3, 2.5) * np.tan(a) if stops else d.even(0.1, 0.8) * np.tan(a)
    mu, sag = digits(mu), 1e-8
    s0, way = digits(d.even(0.08, 0.3) * L), d.even(0.3, 0.6) * L
    drive = G * (np.sin(a) - mu * np.cos(a))
    if stops:
        v0 = digits(np.sqrt(-2 * drive * way))
        duration = digits(v0 / -drive * d.even(0.7, 1.5))
    else:
        v0 = digits(d.even(0.1, 1) * np.sqrt(G * L))
        duration = digits((np.sqrt(v0**2 + 2 * drive * way) - v0) / drive)
    fades = digits(1e-3 * d.one_of(1, np.sqrt(G * L)))
    end = [L * np.cos(a), -L * np.sin(a)]
    rub = {"coefficient": mu} if fades == 1e-3 else {"coefficient": mu, "velocity": fades}
    scene = {"initial_shape": "equilibrium", "beam": {"curve": line([0, 0], end), "section": wire(d, L, mass, sag), "elements": d.elements()},
             "supports": CLAMPED, "sliding_mass": {"mass": mass, "position": s0, "velocity": v0, "friction": rub}, "duration": duration}
    rates = lambda t, y: np.array([y[1], G * np.sin(a) - mu * G * np.cos(a) * np.tanh(y[1] / fades)])
    s = [y[0] for y in solve(rates, [s0, v0], times_of(duration), tolerance=1e-12)]
    add("friction", n, scene, {"joint_position": s}, 1e2 * sag * L, "Coulomb friction on an incline, ODE")


def curved(n):
    """Bead on a stiff arc, parabola or helix, some with friction: s'' = g.t - mu |N| tanh(s'/v_f). They sag by less than a
    straight wire of their length, whose w is 1e-8 of it; a bead that runs presses with m v^2/R, too."""
    d = Draw("curved", n)
    kind = ("arc", "parabola", "helix")[n % 3]
    size, mass, sag = d.decades(-1, 1.2), d.decades(-3, 3), 1e-8
    mu = d.one_of(0, 0, d.even(0.05, 0.3))
    scene = {"supports": FULL}
    first, v0 = d.even(0.06, 0.2), 0.0
    if kind == "arc":
        span = d.even(100, 160)
        low = digits(270 - span / 2)
        curve = {"type": "arc", "center": [0, 0], "radius": size, "from_degrees": low, "to_degrees": low + span}
        L = size * np.radians(span)
        place = lambda s: np.array([np.cos(np.radians(low) + s / size), np.sin(np.radians(low) + s / size)]) * size
        along = lambda s: -G * np.cos(np.radians(low) + s / size)
        normal = lambda s, v: abs(v * v / size - G * np.sin(np.radians(low) + s / size))
    elif kind == "parabola":
        depth = d.even(0.2, 0.8) * size
        curve = {"type": "nurbs", "degree": 2, "knots": [0, 0, 0, 1, 1, 1], "control_points": [[-size, depth], [0, -depth], [size, depth]]}
        k = 2 * depth / size**2  # y = k x^2/2
        arc_to = lambda x: (x * np.sqrt(1 + (k * x) ** 2) + np.arcsinh(k * x) / k) / 2
        L = 2 * arc_to(size)
        x_of = lambda s: inverse(lambda x: arc_to(x) - (s - L / 2), lambda x: np.sqrt(1 + (k * x) ** 2), s - L / 2)
        place = lambda s: np.array([x_of(s), k * x_of(s) ** 2 / 2])
    else:
        pitch = digits(size * d.even(0.5, 3))
        turn = d.even(200, 500)
        curve = {"type": "arc", "center": [0, 0, 0], "radius": size, "from_degrees": 0, "to_degrees": turn, "pitch": -pitch}
        rise = pitch / (2 * np.pi)
        slope = np.hypot(size, rise)
        L = np.radians(turn) * slope
        place = lambda s: np.array([size * np.cos(s / slope), size * np.sin(s / slope), -rise * s / slope])
        along = lambda s: G * rise / slope
        normal = lambda s, v: np.hypot(G * size / slope, v * v * size / slope**2)
        v0 = d.one_of(0.0, 1.0) * d.even(0.2, 1) * np.sqrt(G * size)
        scene |= {"dimension": 3, "gravity": [0, 0, -G]}
    section = wire(d, L, mass, sag)
    if kind == "helix":
        section |= {"GIp": digits(section["EI"] * 0.8), "rhoIp": digits(section["rhoA"] * L**2 * 1e-4)}
    s0, v0, fades = digits(first * L), digits(v0), 1e-3
    rub = lambda s, v: mu * normal(s, v) * np.tanh(v / fades) if mu else 0.0
    if kind == "parabola":  # by x: ds/dx = sqrt(1 + k^2 x^2)
        def rates(t, y):
            x, v = y  # v the speed along the wire
            root = np.sqrt(1 + (k * x) ** 2)
            force = mu * abs(v * v * k / root**3 + G / root) * np.tanh(v / fades) if mu else 0.0
            return np.array([v / root, -G * k * x / root - force])
        state = [x_of(s0), v0]
    else:
        rates = lambda t, y: np.array([y[1], along(y[0]) - rub(*y)])
        state = [s0, v0]
    # until the bead has gone over three fifths of the wire, or turned round
    time = np.sqrt(L / G)
    probe = [time * i / 40 for i in range(1, 241)]
    path = solve(rates, state, probe, tolerance=1e-10)
    ways = [y[0] if kind != "parabola" else L / 2 + arc_to(y[0]) for y in path]
    reach = next((i for i, s in enumerate(ways) if s > s0 + 0.6 * L or (i > 2 and s < ways[i - 1])), len(probe) - 1)
    duration = digits(probe[reach])
    states = solve(rates, state, times_of(duration), tolerance=1e-12)
    s = [y[0] if kind != "parabola" else L / 2 + arc_to(y[0]) for y in states]
    points = [place(x) for x in s]
    scene |= {"beam": {"curve": curve, "section": section, "elements": d.elements()},
              "sliding_mass": {"mass": mass, "position": s0, **({"velocity": v0} if v0 else {})}, "duration": duration}
    if mu:
        scene["sliding_mass"]["friction"] = {"coefficient": mu}
        scene["initial_shape"] = "equilibrium"
    axes = "xyz" if kind == "helix" else "xy"
    add("curved wire", n, scene, {f"mass_position.{axis}": [p[i] for p in points] for i, axis in enumerate(axes)}, 1e2 * sag * L,
        f"bead on a rigid {kind}, ODE")


def inverse(f, slope, x):
    for _ in range(60):
        change = f(x) / slope(x)
        x -= change
        if abs(change) < 1e-16 * max(abs(x), 1e-9):
            break
    return x


def rod_pendulum(n):
    """Stiff rod on a hinge, some with a weight at the end: a'' = -g (M + m/2)/(L (M + m/3)) sin(a). Bent by less than
    w = (m + M) g L^3/EI/10, which it follows, and by as much of its phase."""
    d = Draw("rod pendulum", n)
    L, mass, weak = d.decades(-1, 1.5), d.decades(-3, 3), 1e-6
    M = digits(mass * d.decades(-1, 1.5)) if d.one_of(0, 1) else 0.0
    a0 = np.radians(d.even(10, 150))
    EI = (mass + M) * G * L**2 / weak
    frequency = np.sqrt(G * (M + mass / 2) / (M + mass / 3) / L)
    duration = digits(2 * np.pi / frequency * d.decades(-0.5, 0.6))
    N = d.elements()
    spin = digits(d.one_of(0, 0, d.even(-1, 1)) * frequency)
    section = stiffness(EI / L**2 * d.decades(2, 4), EI, mass / L)
    scene = {"beam": {"curve": line([0, 0], [L * np.sin(a0), -L * np.cos(a0)]), "section": section, "elements": N},
             "supports": [{"at": "start", "type": "pin"}], "duration": duration}
    mass = scene["beam"]["section"]["rhoA"] * L
    frequency2 = G * (M + mass / 2) / (M + mass / 3) / L
    if M:
        scene["point_masses"] = [{"node": N, "mass": M}]
    if spin:
        scene["initial_velocity"] = {"rotation": spin, "about": [0, 0]}
    states = solve(lambda t, y: np.array([y[1], -frequency2 * np.sin(y[0])]), [a0, spin], times_of(duration))
    turns = max(1.0, duration * np.sqrt(frequency2))
    add("rod pendulum", n, scene, {"end.x": [L * np.sin(y[0]) for y in states], "end.y": [-L * np.cos(y[0]) for y in states]},
        0.3 * weak * L * turns, "physical pendulum, ODE")


def swinging_weight(n):
    """Weight on a stiff, light rope, in the plane or going round: m r'' = m g - T r/L. To first order in its mass the rope
    counts as a rod; it is stretched by e = T/EA < 4e-7, and its sag has the square of its share of the mass."""
    d = Draw("swinging weight", n)
    L, M, e, share = d.decades(-1, 1.5), d.decades(-3, 3), 1e-7, d.decades(-5, -3)
    N, space = d.elements(), n % 2 == 1
    a0 = np.radians(d.even(10, 80))
    rope = stiffness(M * G / e, 0, share * M / L)
    m = rope["rhoA"] * L
    pull = G * (M + m / 2) / (M + m / 3)
    time = 2 * np.pi * np.sqrt(L / G)
    duration = digits(time * d.decades(-0.5, 0.5))
    scene = {"beam": {"section": rope, "elements": N}, "supports": [{"at": "start", "type": "pin"}],
             "point_masses": [{"node": N, "mass": M}], "duration": duration}
    if space:
        first = np.array([L * np.sin(a0), 0, -L * np.cos(a0)])
        spin = digits(d.even(0.2, 1.3) * np.sqrt(G / L))
        scene |= {"dimension": 3, "gravity": [0, 0, -G], "initial_velocity": {"rotation": spin, "axis": [0, 0, 1], "about": [0, 0, 0]}}
        scene["beam"]["curve"] = line([0, 0, 0], first)
        speed = np.array([0, spin * first[0], 0])
    else:
        first = np.array([L * np.sin(a0), -L * np.cos(a0)])
        scene["beam"]["curve"] = line([0, 0], first)
        speed = np.zeros(2)
    down = np.array([0, 0, -pull] if space else [0, -pull])
    size = len(first)

    def rates(t, y):
        r, v = y[:size], y[size:]
        return np.concatenate([v, down - (v @ v + r @ down) / (r @ r) * r])
    states = solve(rates, np.concatenate([first, speed]), times_of(duration))
    turns = max(1.0, duration * np.sqrt(G / L))
    add("swinging weight", n, scene, {f"end.{axis}": [y[i] for y in states] for i, axis in enumerate("xyz"[:size])},
        L * turns * (10 * e + 3 * share**2), "point on a light rod, ODE")


def elastic_rope(n):
    """Weight on a light rope that stretches, W = EA (l - 1)^2/2: to first order in its mass the rope counts with a third of it
    for inertia, a half for weight. It starts unstretched, bounces and swings."""
    d = Draw("elastic rope", n)
    L, M, e, share = d.decades(-1, 1.5), d.decades(-3, 3), d.decades(-4, -1.5), 1e-5
    N, a0 = d.elements(), np.radians(d.even(0, 60))
    rope = stiffness(M * G / e, 0, share * M / L)
    m, law = rope["rhoA"] * L, "engineering" if n % 2 else "green"
    duration = digits(2 * np.pi * np.sqrt(L / G) * d.decades(-0.7, 0.1))
    scene = {"beam": {"curve": line([0, 0], [L * np.sin(a0), -L * np.cos(a0)]), "section": rope, "strain_law": law, "elements": N},
             "supports": [{"at": "start", "type": "pin"}], "point_masses": [{"node": N, "mass": M}], "duration": duration}
    inertia, weight, EA = M + m / 3, (M + m / 2) * G, rope["EA"]

    def rates(t, y):
        r, v = y[:2], y[2:]
        l = np.hypot(*r) / L
        pull = EA * (l - 1) if law == "engineering" else EA * l * (l * l - 1) / 2
        return np.concatenate([v, (np.array([0, -weight]) - pull * r / (l * L)) / inertia])
    states = solve(rates, [L * np.sin(a0), -L * np.cos(a0), 0, 0], times_of(duration))
    bounces = duration * np.sqrt(G / (L * e))
    add("elastic rope", n, scene, {"end.x": [y[0] for y in states], "end.y": [y[1] for y in states]},
        L * (e * bounces * share + 10 * share**2 + 1e-9), "mass on a spring that swings, ODE")


def over_a_ring(n):
    """Two weights on a rope over a ring, a wheel or a ring with friction (the rope then next to massless):
    (M1 + M2 + rhoA L + J/r^2) y'' = g (M1 - M2 + rhoA (l1 - l2 + 2 y)), with friction T1 = T2 e^(mu pi tanh(y'/v_f)).
    Both sides stretch by e = T/EA < 3e-7 and vibrate about that. A rope that starts at once vibrates with v = sqrt(e g L)
    along the ring, which evens friction out while y' is less: by t v^2/v_f as long as v is far below v_f."""
    d = Draw("over a ring", n)
    l1, l2, M2, e = d.decades(-0.5, 1), d.decades(-0.5, 1), d.decades(-2, 2), 1e-7
    kind, N = ("ring", "wheel", "friction")[n % 3], d.elements()
    l1, l2 = max(l1, digits(l2 / 4)), max(l2, digits(l1 / 4))
    mu = d.even(0.05, 0.3)
    fades = digits(0.01 * np.sqrt(G * l2))
    e = 1e-8 if kind == "friction" else e
    ratio = d.even(1.1, 3) * (np.exp(mu * np.pi) if kind == "friction" else 1)
    M1 = digits(M2 * ratio)
    share = 1e-7 if kind == "friction" else d.decades(-4, -0.5)
    rope = stiffness(M2 * ratio * G / e, 0, share * M2 / (l1 + l2))
    rhoA = rope["rhoA"]
    joint = {"position": l1, "support": "pin", "slopes": "free"}
    turning = 0.0
    if kind == "wheel":
        radius = digits(0.05 * l2)
        inertia = digits(M2 * radius**2 * d.decades(-1, 0.7))
        joint["pulley"] = {"radius": radius, "inertia": inertia}
        turning = inertia / radius**2
    if kind == "friction":
        joint["friction"] = {"coefficient": mu, "velocity": fades}

    def rates(t, y):
        growth = np.exp(mu * np.pi * np.tanh(y[1] / fades)) if kind == "friction" else 1.0
        drive = G * (M1 - M2 * growth + rhoA * (l1 - l2 + 2 * y[0]))
        return np.array([y[1], drive / (M1 + M2 * growth + rhoA * (l1 + l2) + turning)])
    way = d.even(0.3, 0.7) * l2
    mean = rates(0, [0.0, 1.0])[1]
    duration = digits(np.sqrt(2 * way / mean))
    scene = {"beam": {"curve": {"type": "polyline", "points": [[0, -l1], [0, 0], [0, -l2]]}, "section": rope, "elements": N},
             "sliding_joints": [joint], "point_masses": [{"node": 0, "mass": M1}, {"node": N, "mass": M2}], "duration": duration}
    states = solve(rates, [0.0, 0.0], times_of(duration), tolerance=1e-12)
    rubs = 3 * share * l2 + 3 * duration * e * G * (l1 + l2) / fades if kind == "friction" else 0
    add("over a ring", n, scene, {"joint_position": [l1 + y[0] for y in states]}, 10 * e * (l1 + l2) + rubs,
        "Atwood's machine with rope, wheel and friction, ODE")


def winch(n):
    """A weight on a winch: hoisted or lowered at a rate, straight down or swinging, on a trolley, by a drum with a motor, by a
    given pull. The rope has 1e-7 of the mass and stretches by e < 3e-7: rod's first order, e L for what it adds to places."""
    d = Draw("winch", n)
    kind = ("hoist", "swing", "trolley", "drum", "pull")[n % 5]
    L, M, e, share = d.decades(-0.5, 1.3), d.decades(-1, 3), 1e-7, 1e-7
    N, out = d.elements(), d.one_of(-1, 1) * d.even(0.1, 0.45) * L
    rope = stiffness(M * G / e, 0, share * M / L)
    time = np.sqrt(L / G)
    support = {"at": "start", "type": "pin"}
    scene = {"beam": {"section": rope, "elements": N}, "point_masses": [{"node": N, "mass": M}], "supports": [support]}
    end = np.array([0.0, -L])
    if kind in ("hoist", "swing", "trolley"):
        duration = digits(time * d.decades(0.2, 1.2))
        ramp = digits(duration * d.even(0.2, 0.8))
        rate = digits(out / (duration - ramp / 2))
        support["feed"] = {"rate": rate, "rate_ramp": ramp}
        fed = lambda t: ramped(rate, ramp, t)
        drive = lambda t: (0.0, 0.0, 0.0)
        if kind == "hoist" or kind == "trolley":
            scene["initial_shape"] = "equilibrium"
        angle = 0.0
        if kind == "swing":
            angle = np.radians(d.even(5, 60))
        if kind == "trolley":
            speed = digits(d.one_of(-1, 1) * d.decades(-1, 0) * np.sqrt(G * L))
            support["motion"] = {"direction": [1, 0], "rate": speed, "rate_ramp": ramp}
            drive = lambda t: ramped(speed, ramp, t)
        end = np.array([L * np.sin(angle), -L * np.cos(angle)])

        def rates(t, y):
            l, l_rate, _ = fed(t)
            return np.array([y[1], -(2 * l_rate * y[1] + G * np.sin(y[0]) + drive(t)[2] * np.cos(y[0])) / (L + l)])
        states = solve(rates, [angle, 0.0], times_of(duration), breaks=[ramp])
        places = [(drive(t)[0] + (L + fed(t)[0]) * np.sin(y[0]), -(L + fed(t)[0]) * np.cos(y[0])) for t, y in zip(times_of(duration), states)]
        values = {"end.x": [p[0] for p in places], "end.y": [p[1] for p in places]}
        if kind == "hoist":
            values = {"end.y": values["end.y"]}
        turns = max(1.0, duration / time)
        source = "pendulum of given length and pivot, ODE"
    else:
        # straight down: s'' is constant
        if kind == "drum":
            radius = digits(0.05 * L)
            inertia = digits(M * radius**2 * d.decades(-1, 1))
            torque = digits(d.even(-1.8, 0.5) * M * G * radius)
            support["drum"] = {"radius": radius, "inertia": inertia, "torque": {"value": torque}}
            acceleration = (M * G + torque / radius) / (M + inertia / radius**2)
        else:
            pull = digits(M * G * (d.even(0.5, 0.9) if out > 0 else d.even(1.1, 1.5)))
            support["held_tension"] = {"value": pull}
            acceleration = G - pull / M
        duration = digits(np.sqrt(2 * abs(out / acceleration)))
        values = {"end.y": [-L - acceleration * t * t / 2 for t in times_of(duration)]}
        turns, source = 1.0, "constant acceleration of a weight on a drum or under a given pull"
    scene["beam"]["curve"] = line([0, 0], end)
    scene["duration"] = duration
    add("winch", n, scene, values, 2 * L * turns * (10 * e + 3 * share), source)


def moving_force(n):
    """Force that moves over a simply supported beam: 400 modes of the linear beam, and the static deflection of the others.
    What is not linear has the square of the slopes, 10 (w/L)^2."""
    d = Draw("moving force", n)
    L, rhoA, slender = d.decades(-1, 2), d.decades(-1, 3.5), d.decades(2.5, 4.5)
    EI = digits(rhoA * L**3 * d.decades(0, 4) * G / 48)
    share, deflection = d.one_of(0.1, 0.2, 0.5, 0.8, 1.3), 1e-4 * d.decades(-1, 0)
    speed = digits(share * np.pi / L * np.sqrt(EI / rhoA))
    force = digits(48 * EI * deflection / L**2)
    duration = digits(0.95 * L / speed)
    section = stiffness(EI / L**2 * slender, EI, rhoA)
    scene = {"gravity": [0, 0], "beam": {"curve": line([0, 0], [L, 0]), "section": section, "elements": d.elements()},
             "supports": [{"at": "start", "type": "pin"}, {"at": "end", "type": "slide"}],
             "loads": [{"at": "point", "x": {"rate": speed}, "magnitude": {"value": force}, "direction": [0, -1]}], "duration": duration}
    number = np.arange(1, 401)
    wave = number * np.pi / L
    free, forced = wave**2 * np.sqrt(EI / rhoA), wave * speed
    values = []
    for t in times_of(duration):
        sine = np.sin(forced * t)
        modes = 2 * force / (rhoA * L) * np.sum(sine * (sine - forced / free * np.sin(free * t)) / (free**2 - forced**2))
        x = speed * t
        static = force * x**2 * (L - x) ** 2 / (3 * EI * L) - 2 * force / (rhoA * L) * np.sum(sine**2 / free**2)
        values.append(-(modes + static))
    add("moving force", n, scene, {"load0_y": values}, deflection * L * (20 * deflection**2 + 1e-8), "modes of the linear beam")


def moving_mass(n):
    """Mass driven over a simply supported beam while gravity has grown smoothly: modes of the linear beam with the mass on it
    (Sherman and Morrison), 40 and 28 of them, with the static deflection of the others under the contact force."""
    d = Draw("moving mass", n)
    L, rhoA = d.decades(0, 2), d.decades(0, 3.5)
    deflection, share = 1e-4 * d.decades(-1, 0.3), d.one_of(0.1, 0.2, 0.4)
    mass = digits(rhoA * L * d.decades(-1.3, 0))
    EI = digits((mass + 0.625 * rhoA * L) * G * L**2 / (48 * deflection))
    speed = digits(share * np.pi / L * np.sqrt(EI / rhoA))
    start = digits(0.05 * L)
    duration = digits(0.85 * L / speed)
    ramp = digits(duration * d.even(0.1, 0.3))
    section = stiffness(EI / L**2 * d.decades(2.5, 4), EI, rhoA)
    scene = {"gravity_ramp": ramp, "beam": {"curve": line([0, 0], [L, 0]), "section": section, "elements": d.elements()},
             "supports": [{"at": "start", "type": "pin"}, {"at": "end", "type": "slide"}],
             "sliding_joints": [{"mass": mass, "position": start, "x": {"rate": speed}}], "duration": duration}

    def deflections(modes):
        number = np.arange(1, modes + 1)
        wave = number * np.pi / L
        inertia, hold = rhoA * L / 2, EI * wave**4 * L / 2
        weight = -G * rhoA * (1 - np.cos(number * np.pi)) / wave

        def accelerations(t, q, rate):
            grown, xi = step(t / ramp), start + speed * t
            sine, cosine = np.sin(wave * xi), np.cos(wave * xi)
            free = (grown * weight - hold * q) / inertia
            convected = np.sum(2 * speed * wave * cosine * rate - speed**2 * wave**2 * sine * q)
            push = -mass * (grown * G + convected + sine @ free) / (1 + mass / inertia * (sine @ sine))
            return free + sine * push / inertia, push
        rates = lambda t, y: np.concatenate([y[modes:], accelerations(t, y[:modes], y[modes:])[0]])
        count = int(np.ceil(duration * np.sqrt(hold[-1] / inertia) / 0.25 / SAMPLES)) * SAMPLES
        h, y, found = duration / count, np.zeros(2 * modes), []
        for i in range(count):
            t = i * h
            a = rates(t, y)
            b = rates(t + h / 2, y + h / 2 * a)
            c = rates(t + h / 2, y + h / 2 * b)
            y = y + h / 6 * (a + 2 * b + 2 * c + rates(t + h, y + h * c))
            if (i + 1) % (count // SAMPLES) == 0 and (i + 1) // (count // SAMPLES) in ASKED:
                t = (i + 1) * h
                sine = np.sin(wave * (start + speed * t))
                push = accelerations(t, y[:modes], y[modes:])[1]
                more = np.arange(modes + 1, 2000) * np.pi / L
                found.append(y[:modes] @ sine + push * 2 / (EI * L) * np.sum(np.sin(more * (start + speed * t)) ** 2 / more**4))
        return np.array(found)
    fine, coarse = deflections(40), deflections(28)
    add("moving mass", n, scene, {"mass_position.y": list(fine)}, 2 * np.max(np.abs(fine - coarse)) + deflection * L * 20 * deflection**2,
        "modes of the linear beam with a mass on it")


def turning_rod(n):
    """Stiff rod that flies and turns freely, turns on a hinge, or is turned by its clamp: rigid motions. Drawn out by less than
    e = rhoA W^2 L^2/EA; bent by a clamp that turns it by w = rhoA L^4 W'/(8 EI)."""
    d = Draw("turning rod", n)
    kind = ("free", "hinge", "clamp", "space")[n % 4]
    L, mass, e, N = d.decades(-1, 1.5), d.decades(-3, 3), 1e-7, d.elements()
    turning, turns = digits(d.decades(-1, 1) * np.sqrt(G / L)), d.decades(-0.7, 0.5)
    EA = mass / L * turning**2 * L**2 / e
    EI = EA * L**2 / d.decades(2, 3.5)
    duration = digits(2 * np.pi * turns / turning)
    space = kind == "space"
    a0 = np.radians(d.even(0, 360))
    first = np.array([L * np.cos(a0), L * np.sin(a0)] + ([0.0] if space else []))
    scene = {"beam": {"curve": line([0] * len(first), first), "section": stiffness(EA, EI, mass / L), "elements": N}, "duration": duration}
    w = 0.0
    t = np.array(times_of(duration))
    if kind in ("free", "space"):
        fall = d.one_of(0.0, 1.0)
        speed = np.array([digits(d.even(-1, 1) * np.sqrt(G * L)) for _ in first])
        middle, down = first / 2, np.zeros(len(first))
        down[-1] = -G * fall
        axis = np.array([0.0, 0.0, 1.0])
        if space:  # about an axis across the rod: it stays across it
            tilt = np.radians(d.even(0, 180))
            axis = np.array([-np.sin(a0) * np.sin(tilt), np.cos(a0) * np.sin(tilt), np.cos(tilt)])
            across = np.cross(axis, first)
            scene |= {"dimension": 3}
        else:
            across = np.array([-first[1], first[0]])
        first_velocity = {"translation": list(speed), "rotation": turning, "about": list(middle)}
        scene |= {"gravity": list(down), "initial_velocity": first_velocity | ({"axis": list(axis)} if space else {})}
        places = [middle + speed * x + down * x * x / 2 + (first * np.cos(turning * x) + across * np.sin(turning * x)) / 2 for x in t]
    elif kind == "hinge":
        scene |= {"gravity": [0, 0], "supports": [{"at": "start", "type": "pin"}], "initial_velocity": {"rotation": turning, "about": [0, 0]}}
        places = [np.array([L * np.cos(a0 + turning * x), L * np.sin(a0 + turning * x)]) for x in t]
    else:
        ramp = digits(duration * d.even(0.3, 0.8))
        w = 1e-7 * 2
        EI = max(EI, mass / L * L**3 * 2.2 * turning / ramp / 8 / w)
        scene["beam"]["section"] = stiffness(max(EA, EI / L**2 * 100), EI, mass / L)
        scene |= {"gravity": [0, 0], "supports": [{"at": "start", "type": "clamp", "motion": {"angle": {"rate": turning, "rate_ramp": ramp}}}]}
        angle = [a0 + ramped(turning, ramp, x)[0] for x in t]
        places = [np.array([L * np.cos(a), L * np.sin(a)]) for a in angle]
    add("turning rod", n, scene, {f"end.{axis_}": [p[i] for p in places] for i, axis_ in enumerate("xyz"[:len(first)])},
        L * (3 * w + 3 * e * (1 + 2 * np.pi * turns)), "rigid motion")


def collision(n):
    """Beads on a straight, stiff wire without weight that strike each other, or one under gravity that strikes the lower support
    and rebounds: points, momentum and restitution. The wire stays straight (w = 1e-8 L under gravity). The
    contact distance is a share of an element: what it is off by is an error of the mesh."""
    d = Draw("collision", n)
    L, M, N = d.decades(-1, 1.5), d.decades(-3, 3), d.elements()
    restitution, near = d.one_of(1.0, d.even(0.2, 0.95)), d.one_of(None, 0.01, 0.001)
    contact = {} if near is None else {"distance": near}  # between joints
    time = np.sqrt(L / G)
    if n % 2:
        other = digits(M * d.decades(-1, 1))
        v0 = digits(L / time * d.decades(-1, 1))
        a, b = digits(d.even(0.1, 0.3) * L), digits(d.even(0.45, 0.6) * L)
        section = wire(d, L, M + other, 1e-8)
        meet = (b - a) / v0
        common = M * v0 / (M + other)
        after = [common - restitution * other * v0 / (M + other), common + restitution * M * v0 / (M + other)]
        free = lambda speed: ((0.9 * L if speed > 0 else a / 2) - b) / speed if speed else np.inf
        duration = digits(meet + min(free(after[0]), free(after[1]), 2 * meet))
        scene = {"gravity": [0, 0], "supports": CLAMPED, "beam": {"curve": line([0, 0], [L, 0]), "section": section, "elements": N},
                 "sliding_joints": [{"mass": M, "position": a, "velocity": v0}, {"mass": other, "position": b}],
                 "contact": {"joints": "rebound", "restitution": restitution, **contact}, "duration": duration}
        first = [a + v0 * t if t < meet else b + after[0] * (t - meet) for t in times_of(duration)]
        second = [b if t < meet else b + after[1] * (t - meet) for t in times_of(duration)]
        add("collision", n, scene, {"joint0_position": first, "joint1_position": second}, 1e-9 * L, "momentum and restitution of points")
    else:
        incline_ = np.radians(d.even(20, 80))
        down = G * np.sin(incline_)
        s0 = digits(d.even(0.3, 0.6) * L)
        section = wire(d, L, M, 1e-8)
        strike = np.sqrt(2 * (L - s0) / down)
        duration = digits(strike * d.even(1.3, 1 + 1.6 * restitution))
        end = [L * np.cos(incline_), -L * np.sin(incline_)]
        scene = {"initial_shape": "equilibrium", "beam": {"curve": line([0, 0], end), "section": section, "elements": N}, "supports": CLAMPED,
                 "sliding_joints": [{"mass": M, "position": s0, "at_support": "rebound", "restitution": restitution}], "duration": duration}
        place = lambda t: s0 + down * t * t / 2 if t < strike else L - restitution * down * strike * (t - strike) + down * (t - strike) ** 2 / 2
        add("collision", n, scene, {"joint_position": [place(t) for t in times_of(duration)]}, 1e-7 * L * (1 + 1 / np.tan(incline_)),
            "free slide and restitution of a point")


def elastica(n):
    """Cantilever, straight or an arc, under a dead force at its end: shooting with the strain law's own stretch and curvature
    (reference/exact/elastica.py)."""
    d = Draw("elastica", n)
    L, EI, slender = d.decades(-1, 2), d.decades(-3, 6), d.decades(4, 8)
    arc, law = n % 2 == 1, d.one_of("engineering", "engineering", "green") if n % 2 == 0 else "engineering"
    EA = digits(EI / L**2 * slender)
    load, way = d.decades(-2, 0.7), np.radians(d.even(0, 360) if arc else d.even(30, 150))
    force = digits(load * EI / L**2)
    direction = np.array([np.cos(way), np.sin(way)])
    N = d.elements()
    if arc:
        span = d.even(30, 180)
        radius = digits(L / np.radians(span))
        L = radius * np.radians(span)
        curve, kappa, theta0 = {"type": "arc", "center": [0, 0], "radius": radius, "from_degrees": 0, "to_degrees": span}, 1 / radius, np.pi / 2
        first = np.array([radius, 0.0])
    else:
        curve, kappa, theta0, first = line([0, 0], [L, 0]), 0.0, 0.0, np.zeros(2)
    pull = force * direction

    def stretch(mu, tension):
        if law == "engineering":
            return 1 + tension / EA
        l = 1.0
        for _ in range(50):  # dW/dl = EA l (l^2 - 1)/2 - l mu^2/EI, for theta' = l^2 mu/EI
            change = (EA * l * (l * l - 1) / 2 - l * mu * mu / EI - tension) / (EA * (3 * l * l - 1) / 2 - mu * mu / EI)
            l -= change
            if abs(change) < 1e-16:
                break
        return l

    def rates(s, y):  # lengths over L
        c, q = np.cos(y[2]), np.sin(y[2])
        mu = y[3] * EI / L
        l = stretch(mu, pull[0] * c + pull[1] * q)
        bend = mu / EI * (l * l if law == "green" else 1) + kappa
        return np.array([l * c, l * q, bend * L, -l * (pull[1] * c - pull[0] * q) * L**2 / EI])
    end = lambda mu: solve(rates, [0.0, 0.0, theta0, mu], [1.0])[0]
    mu = 0.0
    for share in np.linspace(0.1, 1, 10):  # the branch that grows from the unloaded beam
        pull = share * force * direction
        mu = newton(lambda x: [end(x[0])[3]], [mu if mu else 0.05 * load])[0]
    tip = first + L * end(mu)[:2]
    section = {"type": "stiffness", "EA": EA, "EI": EI, "rhoA": 1.0}
    scene = {"analysis": "statics", "gravity": [0, 0], "beam": {"curve": curve, "section": section, "strain_law": law, "elements": N},
             "supports": [{"at": "start", "type": "clamp"}], "loads": [{"node": N, "magnitude": {"value": force}, "direction": list(direction)}]}
    add("arc" if arc else "elastica", n, scene, {"end.x": [tip[0]], "end.y": [tip[1]]}, 1e-10 * L, "shooting")


def catenary(n):
    """Rope between two supports, with a weight on it: pieces of the elastic catenary (Irvine 1981), W = EA (l - 1)^2/2."""
    d = Draw("catenary", n)
    L, rhoA, e = d.decades(0, 2.3), d.decades(-2, 1.5), d.decades(-5, -2)
    N = d.elements()
    node = N // 2
    span, drop = d.even(0.3, 0.98) * L, d.one_of(0, d.even(-0.5, 0.5)) * L
    if np.hypot(span, drop) > 0.98 * L:
        drop = 0.0
    span, drop = digits(span), digits(drop)
    EA = digits(rhoA * G * L / e)
    weight = digits(rhoA * G * L * d.decades(-1, 1)) if n % 2 else 0.0
    w = rhoA * G

    def piece(H, V, length):
        """From its start, where the rope pulls to the right with H and up with V at what comes next, over `length`."""
        V2 = V + w * length
        x = H * length / EA + H / w * (np.arcsinh(V2 / H) - np.arcsinh(V / H))
        y = (V2**2 - V**2) / (2 * EA * w) + (np.hypot(H, V2) - np.hypot(H, V)) / w
        return x, y, V2

    def shape(H, V):
        x1, y1, middle = piece(H, V, L * node / N)
        x2, y2, last = piece(H, middle + weight, L * (N - node) / N)
        return (x1, y1), (x1 + x2, y1 + y2), last
    guess = [w * L / 4 + weight / 4, -w * L / 2 - weight / 2]
    size = w * L + weight
    off = lambda z: (np.array(shape(size * z[0], size * z[1])[1]) - [span, drop]) / L
    H, V = size * root2(off, [guess[0] / size, guess[1] / size])
    (x1, y1), _, last = shape(H, V)
    section = {"type": "stiffness", "EA": EA, "EI": 0, "rhoA": rhoA}
    scene = {"analysis": "statics", "beam": {"curve": {"type": "polyline", "points": corner(L, L * node / N, span, drop)}, "section": section,
                                             "strain_law": "engineering", "elements": N},
             "supports": [{"at": "start", "type": "pin"}, {"at": "end", "type": "pin"}]}
    values = {"axial_force.max": [max(np.hypot(H, V), np.hypot(H, last))]}
    uncertainty = 1e-9 * (w * L + weight)
    if weight:
        scene["loads"] = [{"node": node, "magnitude": {"value": weight}, "direction": [0, -1]}]
        values, uncertainty = {"load0_x": [x1], "load0_y": [y1]}, 1e-9 * L
    add("catenary", n, scene, values, uncertainty, "pieces of the elastic catenary (Irvine 1981)")


def corner(L, first, span, drop):
    """Points of a rope of length L drawn with one corner `first` along it, below its chord."""
    chord, second = np.hypot(span, drop), L - first
    along = (chord**2 + first**2 - second**2) / (2 * chord)
    across = -np.sqrt(first**2 - along**2)
    c, s = span / chord, drop / chord
    return [[0.0, 0.0], [along * c - across * s, along * s + across * c], [span, drop]]


def root2(equations, x):
    """Newton's method with steps that are halved until the first unknown stays positive and the residual falls."""
    x = np.array(x, float)
    size = lambda z: np.max(np.abs(equations(z)))
    for _ in range(200):
        f = np.array(equations(x))
        J = np.empty((2, 2))
        for i in range(2):
            h = 1e-6 * max(abs(x[i]), 1e-3)
            up, down = x.copy(), x.copy()
            up[i] += h
            down[i] -= h
            J[:, i] = (np.array(equations(up)) - np.array(equations(down))) / (2 * h)
        change, share = np.linalg.solve(J, f), 1.0
        while share > 1e-6 and (x[0] - share * change[0] <= 0 or size(x - share * change) > size(x) * (1 + 1e-12) + 1e-15):
            share /= 2
        x = x - share * change
        if np.max(np.abs(share * change)) < 1e-14 * np.max(np.abs(x)):
            break
    if size(x) > 1e-11:
        raise ArithmeticError("no catenary")
    return x


def bar_wave(n):
    """Bar drawn smoothly at one end: d'Alembert, exact for W = EA (l - 1)^2/2, whatever the strain."""
    d = Draw("bar wave", n)
    L, rhoA, EA = d.decades(-1, 2), d.decades(-2, 3), d.decades(0, 9)
    speed = np.sqrt(EA / rhoA)
    way, ramp = digits(L * d.decades(-4, -1.3)), digits(L / speed * d.even(0.5, 3))
    duration = digits(L / speed * d.decades(0.1, 1))
    section = {"type": "stiffness", "EA": EA, "EI": 0, "rhoA": rhoA}
    scene = {"gravity": [0, 0], "duration": duration,
             "beam": {"curve": line([0, 0], [L, 0]), "section": section, "strain_law": "engineering", "compression": "full",
                      "elements": d.elements()},
             "supports": [{"at": "start", "type": "pin", "motion": {"direction": [-1, 0], "value": way, "ramp": ramp}}]}
    given = lambda t: -way * step(t / ramp)
    place = lambda t: L + 2 * sum((-1) ** k * given(t - (2 * k + 1) * L / speed) for k in range(60))
    add("bar wave", n, scene, {"end.x": [place(t) for t in times_of(duration)]}, 1e-13 * L, "d'Alembert")


def shaken_cantilever(n):
    """Cantilever under a force at its end that oscillates: modes of the linear beam. What is not linear has the square of the
    slopes."""
    d = Draw("shaken cantilever", n)
    L, rhoA, EI, slender = d.decades(-1, 2), d.decades(-2, 3), d.decades(-2, 9), d.decades(3, 5)
    deflection, share = 1e-4 * d.decades(-1, 0), d.one_of(0.3, 0.7, 2.0, 5.0)
    roots = [1.8751040687119611, 4.694091132974175, 7.854757438237613, 10.995540734875467, 14.13716839104647]
    roots += [(k + 0.5) * np.pi for k in range(5, 300)]
    free = np.array(roots) ** 2 / L**2 * np.sqrt(EI / rhoA)
    frequency = digits(share * free[0] / (2 * np.pi))
    forced, force = 2 * np.pi * frequency, digits(3 * EI * deflection / L**2)
    duration = digits(2 * np.pi / free[0] * d.decades(-0.3, 0.7))
    N = d.elements()
    section = stiffness(EI / L**2 * slender, EI, rhoA)
    scene = {"gravity": [0, 0], "beam": {"curve": line([0, 0], [L, 0]), "section": section, "elements": N},
             "supports": [{"at": "start", "type": "clamp"}], "duration": duration,
             "loads": [{"node": N, "magnitude": {"amplitude": force, "frequency": frequency}, "direction": [0, 1]}]}
    EI_, rhoA_ = scene["beam"]["section"]["EI"], scene["beam"]["section"]["rhoA"]
    free = np.array(roots) ** 2 / L**2 * np.sqrt(EI_ / rhoA_)
    values = []
    for t in times_of(duration):
        modes = 4 * force / (rhoA_ * L) * np.sum((np.sin(forced * t) - forced / free * np.sin(free * t)) / (free**2 - forced**2))
        left = force * np.sin(forced * t) * (L**3 / (3 * EI_) - 4 / (rhoA_ * L) * np.sum(1 / free**2))
        values.append(modes + left)
    largest = max(abs(x) for x in values)
    add("shaken cantilever", n, scene, {"end.y": values}, largest * (20 * (largest / L) ** 2 + 1e-8), "modes of the linear beam")


def triangle(n):
    """Three weights on a rope over two rings: their forces close a triangle. Each side has one tension, by which it stretches
    evenly, l = 1 + T/EA; the rope has 1e-8 of the weights' mass."""
    d = Draw("three weights", n)
    N, half, M1, e = d.one_of(16, 24, 32, 40), d.decades(-0.5, 1), d.decades(-2, 3), d.decades(-7, -3.5)
    M2 = digits(M1 * d.even(0.85, 1.2))
    W = digits((M1 + M2) * d.even(0.4, 0.8))
    # angles on both sides of the middle weight, above the horizontal, of a triangle of the forces M1, M2, W
    a1, a2 = np.arcsin((W**2 + M1**2 - M2**2) / (2 * W * M1)), np.arcsin((W**2 + M2**2 - M1**2) / (2 * W * M2))
    depth = 2 * half / (1 / np.tan(a1) + 1 / np.tan(a2))
    side = 3 * half  # in the ratio of whole elements, so that node N/2 is the middle
    whole = 2 * (side + half)
    scene = {"analysis": "statics", "beam": {"curve": {"type": "polyline", "points": [[-half, -side], [-half, 0], [half, 0], [half, -side]]},
                                             "section": stiffness(max(M1, M2) * G / e, 0, 1e-8 * M1 / whole), "strain_law": "engineering", "elements": N},
             "sliding_joints": [{"position": x, "support": "pin", "slopes": "free"} for x in (side, side + 2 * half)],
             "point_masses": [{"node": 0, "mass": M1}, {"node": N // 2, "mass": W}, {"node": N, "mass": M2}]}
    EA = scene["beam"]["section"]["EA"]
    first, second = depth / np.sin(a1) / (1 + M1 * G / EA), depth / np.sin(a2) / (1 + M2 * G / EA)  # before stretching
    values = {"joint0_position": [side + half - first], "joint1_position": [side + half + second]}
    add("three weights", n, scene, values, 1e-7 * whole, "triangle of forces")


FAMILIES = ((incline, 16), (friction, 16), (curved, 18), (rod_pendulum, 16), (swinging_weight, 16), (elastic_rope, 12), (over_a_ring, 18),
            (winch, 20), (moving_force, 12), (moving_mass, 8), (turning_rod, 16), (collision, 16), (elastica, 20), (catenary, 12), (bar_wave, 10),
            (shaken_cantilever, 10), (triangle, 10))

if __name__ == "__main__":
    for family, count in FAMILIES:
        for number in range(count):
            family(number)
        print(family.__name__, count, file=sys.stderr)
    out = sys.argv[1] if len(sys.argv) > 1 else os.path.join(here, "trust.json")
    with open(out, "w") as file:
        file.write('{"source": "reference/trust.py: closed forms and ordinary differential equations; the seed is fixed",\n "cases": [\n')
        file.write(",\n".join(json.dumps(case) for case in cases))
        file.write("\n]}\n")
