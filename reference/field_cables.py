"""Moorings, risers and overhead lines of reference/field.json: their right answers from the published inputs. Called by field.py.

* Elastic catenaries in closed form (Irvine, Cable Structures, 1981), with 40 digits: weight per unstretched length, tension EA times the
  stretch. Nothing but rounding is left.
* Chains on a floor: the floor gives way, pushing with k S(p) per length at the depth p, S = p^2/(2 d) down to the depth d that bears the
  chain's weight without buoyancy, and p - d/2 below (docs/theory/loads.md). From where it lies the chain is integrated to where it leaves
  the floor; a catenary follows (1e-9 of pulls). Theirs is the floor that does not give way, and friction where they have it.
* A riser with bending stiffness: a boundary value problem by collocation (scipy's solve_bvp), with two tolerances.
* Spans on strings of insulators: the equilibrium of elastic catenaries by Newton's method, down to rounding (1e-10 m, 1e-9 of pulls).

Each answer is (answer, uncertainty) or (answer, uncertainty, answer of the model that printed the number).
"""
import math

import mpmath as mp
import numpy as np
from field_beams import newton
from scipy.integrate import solve_bvp, solve_ivp
from scipy.optimize import brentq

mp.mp.dps = 40


# --------------------------------------------------------------------------------------------------------------- catenaries
def reach(H, V, w, L, EA, of=mp):
    """Span and rise of an elastic catenary that pulls with (H, V) at its start; w per unstretched length, down."""
    end, hypot = V + w * L, (mp.hypot if of is mp else math.hypot)
    return (H * L / EA + H / w * (of.asinh(end / H) - of.asinh(V / H)),
            (V * L + w * L * L / 2) / EA + (hypot(H, end) - hypot(H, V)) / w)


def catenary(x, z, L, EA, w):
    """H, V at the start and V at the end of an elastic catenary between two points, x apart and z in height."""
    x, z, L, EA, w = map(mp.mpf, (x, z, L, EA, w))
    chord = mp.hypot(x, z)
    if L > chord * mp.mpf("1.0005"):
        a = mp.sqrt(3 * ((L * L - z * z) / (x * x) - 1))
        start = abs(w) * x / (2 * a), w / 2 * (z * mp.coth(a) - L)
    else:  # taut: a spring, or a parabola that has stretched
        T = max(EA * (chord - L) / L, (w * w * x * x * EA / 24)**(mp.mpf(1) / 3))
        start = T * x / chord, T * z / chord - w * L / 2
    H, V = mp.findroot(lambda H, V: [a - b for a, b in zip(reach(H, V, w, L, EA), (x, z))], start, tol=1e-40, maxsteps=200)
    return H, V, V + w * L


def moorpy():
    """Lines without a floor: tests/test_catenary.py, sets 3 and 5 to 9. Pulls on what holds the line."""
    answers = {}
    taut = ("246.22420940032947", "263.55766330843164")
    for name, line in {
        "sagging": (400, 200, 500, "7.51e12", 200),
        "buoyant": ("37.96888656874307", "20.49078283711694", 100, "751e6", "-881.0549577007893"),
        "taut_short": (*taut, "360.62566262396927", "700e6", "3.08735"),
        "taut_even": (*taut, "360.63566262396927", "700e6", "3.08735"),
        "taut_long": (*taut, "360.64566262396927", "700e6", "3.08735"),
        "taut_heavy": ("119.3237383002058", "52.49668849178113", "130.36140355177318", "700e6", "34.91060469991227"),
    }.items():
        H, start, end = catenary(*line)
        answers["moorpy_" + name] = {"reactions.start.position.x": (H, 0), "reactions.start.position.y": (start, 0),
                                     "reactions.end.position.x": (-H, 0), "reactions.end.position.y": (-end, 0)}
    return answers


# -------------------------------------------------------------------------------------------------------------------- floor
def lift(H, w, EA, floor):
    """From where a chain lies to where it leaves the floor (k, d): its unstretched length, its span, and V there, H its pull along it."""
    k, d = floor
    rest = w / k + d / 2
    push = lambda p: 0.0 if p < 0 else k * p * p / (2 * d) if p < d else k * (p - d / 2)
    out = math.sqrt(H * (1 + H / EA) / k)  # what is not level fades by e along this length
    first = 1e-3 * d

    def f(s, state):
        V, p = state[0], rest - state[2]
        stretch = 1 / math.hypot(H, V) + 1 / EA
        return [w - push(p), H * stretch, V * stretch]
    leaves = lambda s, state: state[2] - rest
    leaves.terminal = True
    found = solve_ivp(f, (0, 100 * out), [k * first * out, 0, first], method="DOP853", rtol=1e-13, atol=1e-13 * d, events=leaves)
    return found.t[-1], found.y[1, -1], found.y[0, -1]


def chain(H, V, L, EA, w, floor):
    """Span and height of the upper end, over the floor on which the chain lies from its anchor on; (H, V) at that end. No floor: rigid."""
    s, x, V0 = lift(H, w, EA, floor) if floor else (0.0, 0.0, 0.0)
    hangs = (V - V0) / w
    span, rise = reach(H, V0, w, hangs, EA, math)
    return (L - hangs - 2 * s) * (1 + H / EA) + 2 * x + span, rise  # it sinks in behind the anchor as it leaves the floor


def moored(x, z, L, EA, w, floor):
    """H, V at the fairlead and the tension at the anchor of a chain that lies on the floor."""
    def miss(u):
        span, rise = chain(u[0] * w * L, u[1] * w * L, L, EA, w, floor)
        return [span / x - 1, rise / z - 1]
    a = math.sqrt(max(3 * ((L * L - z * z) / (x * x) - 1), 0.04))
    H, V = newton(miss, [x / (2 * a) / L, 0.5 * (z / L / math.tanh(a) + 1)]) * w * L
    return H, V, math.hypot(H, lift(H, w, EA, floor)[2]) if floor else H


def floors():
    answers, k = {}, 1e7

    line = (400, 200, 500, 7.51e12, 800)  # MoorPy, tests/test_catenary.py, set 1
    own, rigid = moored(*line, (k, 800 / k)), moored(*line, None)
    answers["moorpy_seabed"] = {quantity: (own[i], 1e-9 * own[i], rigid[i]) for i, quantity in
                                ((0, "reactions.end.position.x"), (1, "reactions.end.position.y"), (0, "reactions.start.position.x"))}

    weight, dry = (390 - 1025 * math.pi / 4 * 0.252**2) * 9.80665, 390 * 9.80665  # MoorDyn, tests/quasi_static_chain.cpp
    for depth, x, L in ((50, 400, 410), (200, 700, 760), (600, 1500, 1700)):
        (H, V, anchor), (H0, V0, anchor0) = (moored(x, depth, L, 1.674e9, weight, floor) for floor in ((k, dry / k), None))
        answers[f"moordyn_chain_{depth}"] = {
            "places.fairlead.axial_force": (math.hypot(H, V) / 1000, 1e-12 * H, math.hypot(H0, V0) / 1000),
            "places.anchor.axial_force": (anchor / 1000, 1e-12 * H, anchor0 / 1000)}

    own, theirs = bridle((k, 320 * 9.81 / k), 0), bridle(None, 1)
    answers["map_bridle"] = {"port pin.force.x": (own[0], 1e-9 * own[0], theirs[0]), "port pin.force.z": (own[1], 1e-9 * own[1], theirs[1])}
    return answers


def bridle(floor, friction):
    """MAP++, docs/source/python_example.rst: H, V at the upper end of a chain of 450 m, from (400, 0, -350), which two ropes of 90 m hold
    at (25, +-20, -10). Friction that has come into play holds back a share of the pull along the floor (Jonkman, NREL/TP-500-41958,
    2007)."""
    g, rho, L, rope, EA, soft = 9.81, 1025, 450, 90, 9.8e9, 9.8e8
    w = (320 - rho * math.pi / 4 * 0.25**2) * g
    light = (100 - rho * math.pi / 4 * 0.30**2) * g

    def place(H, V):
        x, z = chain(H, V, L, EA, w, floor)
        if friction:
            lies = L - V / w
            slack = lies - H / (friction * w)
            x += friction * w / (2 * EA) * (slack * max(slack, 0) - lies**2)
        return 400 - x, z - 350

    def miss(u):
        H, V, pull = u * 1e6
        x, z = place(H, V)
        span, rise = reach(pull, V / 2, light, rope, soft, math)
        return [(math.hypot(x - 25, 20) - span) / rope, (-10 - z - rise) / rope, (2 * pull * (x - 25) / math.hypot(x - 25, 20) - H) / 1e6]
    return newton(miss, [0.6, 1.14, 0.31])[:2] * 1e6


# -------------------------------------------------------------------------------------------------------------------- riser
def risers():
    """Low & Langley's riser (OMAE 2006): pulls on the line in kN, and the axial force at its ends, with and without bending stiffness."""
    g, L, EA, EI = 9.807, 170, 500e6, 120.8e3
    w = (165 - 1000 * math.pi / 4 * 0.396**2) * g
    H0, start, end = map(float, catenary(100, 50, L, EA, w))
    pulls = lambda top, bottom, H, V, W: dict(zip(
        ("places.top.axial_force", "reactions.end.position.y", "reactions.end.position.x", "reactions.start.position.y",
         "places.bottom.axial_force"), np.array([top, W, H, -V, bottom]) / 1000))
    rope = pulls(math.hypot(H0, end), math.hypot(H0, start), H0, start, end)

    def f(s, y, p):  # x, z, theta, M
        H, V = p[0] * 1e4, p[1] * 1e4 + w * s
        stretch = 1 + (H * np.cos(y[2]) + V * np.sin(y[2])) / EA
        Q = V * np.cos(y[2]) - H * np.sin(y[2])
        return np.vstack((stretch * np.cos(y[2]), stretch * np.sin(y[2]), y[3] * 1e4 / EI, -stretch * Q / 1e4))

    ends = lambda a, b, p: np.array([a[0], a[1], a[3], b[0] - 100, b[1] - 50, b[3]])
    s = np.linspace(0, L, 4001)
    V = start + w * s
    theta = np.arctan2(V, H0)
    guess = np.vstack((H0 / w * (np.arcsinh(V / H0) - math.asinh(start / H0)), (np.hypot(H0, V) - math.hypot(H0, start)) / w, theta,
                       EI * np.gradient(theta, s) / 1e4))
    found = []
    for tolerance, every in ((1e-8, 4), (1e-10, 1)):
        beam = solve_bvp(f, ends, s[::every], guess[:, ::every], p=[H0 / 1e4, start / 1e4], tol=tolerance, max_nodes=400000)
        assert beam.success, beam.message
        H, V, first, final = *(beam.p * 1e4), beam.y[2, 0], beam.y[2, -1]
        W = V + w * L
        found.append(pulls(H * math.cos(final) + W * math.sin(final), H * math.cos(first) + V * math.sin(first), H, V, W))
    coarse, fine = found
    return {"lowlangley_riser": {of: (fine[of], abs(fine[of] - coarse[of])) for of in fine},
            "lowlangley_riser_without_bending": {of: (value, 0) for of, value in rope.items()}}


# ------------------------------------------------------------------------------------------------------------------ pulleys
def pulleys():
    """Code_Aster SSNL100: 220 m of cable over two pulleys, 100 m and 200 m off, to an end 10 m behind the second: two like spans, and a
    strand of the same tension; theirs is straight. Heights of the cable at 52.5 and 157.5 m along it."""
    w, EA, whole = 30.0, 5e7, 220

    def span(L):
        H, V, _ = map(float, catenary(100, 0, L, EA, w))
        return H, V

    def level(H, x):  # length of a catenary between two points x apart and level
        return brentq(lambda L: reach(H, -w * L / 2, w, L, EA, math)[0] - x, 0.99 * x, 1.2 * x, xtol=1e-14)

    def left(L, straight):
        T = math.hypot(*span(L))
        if straight:
            return 10 / (1 + T / EA) - (whole - 2 * L)
        H = brentq(lambda H: math.hypot(H, w * level(H, 10) / 2) - T, 0.5 * T, T, xtol=1e-11)
        return level(H, 10) - (whole - 2 * L)

    heights = []
    for straight in (False, True):
        L = brentq(left, 104.5, 105.2, args=(straight,), xtol=1e-13)
        H, V = span(L)
        heights.append([reach(H, V, w, s, EA, math)[1] for s in (52.5, 157.5 - L)])
    own, theirs = heights
    return {"aster_ssnl100": {f"places.{side}.position.y": (own[i], 1e-10, theirs[i]) for i, side in enumerate(("left", "right"))}}


# ----------------------------------------------------------------------------------------------------------- overhead lines
def otls():
    """Catenaries under weight and a load across, the same along the span: each lies in the plane of its chord and of the load. The length
    is that of the inextensible curve of the pull H; with EA = 1e12 it stretches by 1e-9."""
    def span(across, along, q, H):
        k = mp.mpf(H) / q
        a = mp.findroot(lambda a: k * (mp.cosh((a + across) / k) - mp.cosh(a / k)) - along, along * k / across - across / 2)
        L = k * (mp.sinh((a + across) / k) - mp.sinh(a / k))
        return L, *catenary(across, along, L, mp.mpf("1e12"), q)

    answers = {}
    q, c = mp.sqrt(2) * mp.mpf("0.3535533"), mp.sqrt(mp.mpf(1) / 2)  # per length; the load is down and across, 45 degrees each
    for name, z in (("otls_level", 0), ("otls_inclined", 100)):
        along, x = z * c, mp.mpf(1000)
        across = mp.hypot(x, along)
        L, H, V, _ = span(across, along, q, 1000)
        ex, eu = (x / across, z / 2 / across, z / 2 / across), (0, -c, c)
        span_mid, rise = reach(H, V, q, L / 2, mp.mpf("1e12"))
        middle = {f"places.middle.position.{i}": (span_mid * a + rise * b, 0) for i, a, b in zip("xyz", ex, eu)}
        pull = {f"reactions.start.position.{i}": (H * a + V * b, 0) for i, a, b in zip("xyz", ex, eu)}
        answers[name] = {**middle, **pull}
    _, H, _, V = span(mp.mpf(1000), mp.mpf(500), mp.mpf("0.5"), 1000)
    answers["otls_steep"] = {"axial_force.max": (mp.hypot(H, V), 0)}
    return answers


def insulators(wind, natural):
    """RTE mechaphlowers, test_model_ducloux_integration.py: places of the clamps under strings of insulators of 3 m, from their upper ends,
    and the pull of the first in daN. natural: weight and wind per unstretched length, stretch where the tension is; theirs: both per
    stretched length, a whole span stretched by its mean tension."""
    lengths, weights = (497.647471727149, 299.883603547399, 397.144221942162), (1000, 500, 500, 1000)
    EA, w, warm = 60000e6 * 600.4e-6, 1.8 * 9.81, 1 + 2.3e-5 * 15
    tops = np.array([[0, 0, 30.0], [500, 0, 33.0], [800, 0, 33.0], [1200, 0, 30.0]])
    load = np.array([0, wind * 0.03186, -w])
    q = np.linalg.norm(load)
    down = load / q

    def span(pull, length):
        """From one end to the other, and the pull there."""
        V = -pull @ down
        H = np.linalg.norm(pull + V * down)
        level = (pull + V * down) / H
        if natural:
            L = length * warm
            x, z = reach(H, V, q, L, EA * warm, math)
        else:
            L = length * (warm + H / EA)
            for _ in range(60):
                W = V + q * L
                mean = (W * math.hypot(H, W) - V * math.hypot(H, V) + H * H * (math.asinh(W / H) - math.asinh(V / H))) / (2 * q * L)
                L = length * (warm + mean / EA)
            x, z = reach(H, V, q, L, math.inf, math)
        return x * level - z * down, pull - load * L

    def miss(y):
        pulls, strings, bears = y[:9].reshape(3, 3) * 1e4, y[9:21].reshape(4, 3), y[21:] * 1e4
        spans = [span(pull, length) for pull, length in zip(pulls, lengths)]
        r = [(tops[i] + strings[i] + spans[i][0] - tops[i + 1] - strings[i + 1]) / 100 for i in range(3)]
        for i in range(4):
            force = (pulls[i] if i < 3 else 0) - (spans[i - 1][1] if i else 0) - np.array([0, 0, weights[i] / 2])
            r.append((force - bears[i] * strings[i] / 3) / 1e4)
        return np.concatenate((*r, (strings**2).sum(1) / 9 - 1))

    guess = [(3.91, *(load[1:] * x / 2e4)) for x in (500, 300, 400)]
    strings = [[2.97, 0.19, -0.37], [0, 1.35, -2.68], [0, 1.34, -2.69], [-2.98, 0.15, -0.3]]
    y = newton(miss, np.concatenate((np.ravel(guess), np.ravel(strings), [3.9, 0.08, 0.08, 3.9])))
    assert np.abs(miss(y)).max() < 1e-12
    return y[9:21].reshape(4, 3), y[:3] * [1e3, -1e3, -1e3]  # pull along the line; on the string across and down


def lines():
    answers = {}
    for name, wind in (("rte_calm", 0.0), ("rte_wind", 300.0)):
        (own, pull), (theirs, their_pull) = (insulators(wind, natural) for natural in (True, False))
        of = answers[name] = {}
        for i in range(4):
            for j, c in enumerate("xyz"):
                of[f"clamp{i}.position.{c}"] = own[i, j], 1e-10, theirs[i, j]
        for j, c in enumerate("xyz"):
            of[f"from0.force.{c}"] = pull[j], 1e-9 * abs(pull[j]), their_pull[j]
    return answers


def answers():
    return {**moorpy(), **floors(), **risers(), **pulleys(), **otls(), **lines()}
