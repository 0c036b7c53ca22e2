"""Beams of reference/field.json: their right answers from the published inputs, by other means than vlbeam's. Called by field.py.

* Statics by shooting: a beam that stretches and bends, Reissner's in the plane (ZAMP 23, 1972), Simo's in space (CMAME 49, 1985), by
  DOP853 with a relative tolerance of 1e-13. GA = inf is the beam that vlbeam has (no shear); a finite GA is that of programs with shear.
  What is unknown at the first end is found by Newton's method while the load grows. The uncertainty is what a tolerance of 1e-11 changes.
* A force that moves over a simply supported beam: the series of its modes (Fryba, Vibration of Solids and Structures under Moving Loads).
* A bar that falls as a pendulum: its equation of motion, rigid; the uncertainty is what the bar's stiffness leaves.
* Motions of soft beams by own elements: cubic Hermite elements of the axis, consistent masses, five Gauss points, DOP853 in time. The
  uncertainty is what refinement changes.

Each answer is (answer, uncertainty) or (answer, uncertainty, answer of the model that printed the number).
"""
import math

import numpy as np
from numpy.polynomial.legendre import leggauss
from scipy.integrate import solve_ivp

INF = math.inf


# ---------------------------------------------------------------------------------------------------------------- shooting
def newton(miss, x, tolerance=1e-13):
    """Root of `miss` by Newton's method with a Jacobian of differences, down to rounding."""
    x = np.array(x, float)
    for _ in range(60):
        r = np.array(miss(x))
        J = np.empty((len(x), len(x)))
        for i in range(len(x)):
            step = 1e-7 * max(1, abs(x[i]))
            y = x.copy()
            y[i] += step
            J[:, i] = (np.array(miss(y)) - r) / step
        change = np.linalg.solve(J, r)
        x -= change
        if np.all(np.abs(change) <= tolerance * np.maximum(1, np.abs(x))):
            break
    return x


def shoot(integrate, miss, wanted, x, steps=10):
    """`wanted` of the state that `integrate(x, share of the load, tolerance)` gives, x such that `miss(state, share)` vanishes, and what
    a hundredfold tolerance changes of it."""
    x, before = np.array(x, float), None
    for share in np.linspace(1 / steps, 1, steps):
        guess = x if before is None else 2 * x - before
        before, x = x, newton(lambda u: miss(integrate(u, share, 1e-9), share), guess, 1e-8)
    found = []
    for tolerance in (1e-11, 1e-13):
        x = newton(lambda u: miss(integrate(u, 1, tolerance), 1), x)
        found.append(np.array(wanted(integrate(x, 1, tolerance))))
    return found[1], np.abs(found[1] - found[0])


def last(f, length, start, tolerance):
    return solve_ivp(f, (0, length), start, method="DOP853", rtol=tolerance, atol=tolerance / 10).y[:, -1]


# ------------------------------------------------------------------------------------------------------------------- plane
def plane(EA, EI, force, load=(0, 0), GA=INF):
    """x, y, theta, M along a beam. The part beyond s pulls with force - load s; load is per unstretched length."""
    def f(s, state):
        _, _, theta, M = state
        Fx, Fy = force[0] - load[0] * s, force[1] - load[1] * s
        c, sn = math.cos(theta), math.sin(theta)
        stretch, shear = 1 + (Fx * c + Fy * sn) / EA, (-Fx * sn + Fy * c) / GA
        dx, dy = c * stretch - sn * shear, sn * stretch + c * shear
        return [dx, dy, M / EI, -(dx * Fy - dy * Fx)]
    return f


def cantilever(L, EA, EI, force=(0, 0), load=(0, 0), GA=INF, steps=12):
    """x, y, theta of the end of a cantilever along x, under a dead force at its end and a dead load per length."""
    def integrate(x, share, tolerance):
        pull = [share * (P + q * L) for P, q in zip(force, load)]
        return last(plane(EA, EI, pull, [share * q for q in load], GA), L, [0, 0, 0, x[0] * EI / L], tolerance)
    return shoot(integrate, lambda state, share: [state[3] * L / EI], lambda state: state[:3], [0], steps)


def frenet(L, EA, EI, P):
    """As cantilever, down by P, for Green's strain and a bending energy of the curvature per deformed length: with the stretch l,
    W = EA (l^2 - 1)^2/8 + EI (theta'/l)^2/2, so that M = EI theta'/l^2 and N = EA (l^2 - 1) l/2 - EI theta'^2/l^3."""
    def f(s, state):
        _, _, theta, M = state
        c, sn = math.cos(theta), math.sin(theta)
        N, l = -P * sn, 1.0
        for _ in range(50):
            change = (EA * (l * l - 1) * l / 2 - M * M * l / EI - N) / (EA * (3 * l * l - 1) / 2 - M * M / EI)
            l -= change
            if abs(change) < 1e-16:
                break
        return [l * c, l * sn, M * l * l / EI, l * c * P]
    integrate = lambda x, share, tolerance: last(f, L, [0, 0, 0, x[0] * EI], tolerance)
    return shoot(integrate, lambda state, share: [state[3] / EI], lambda state: state[:3], [-1.49 * P / EI], 1)


def plane_problems():
    answers = {}
    both = lambda sure, shear, i: (sure[0][i], sure[1][i], shear[0][i])

    L, b, E = 2, 0.1, 2.07e11
    EA, EI = E * b * b, E * b**4 / 12
    end, unsure = cantilever(L, EA, EI, (0, -3 * EI / L**2))
    answers["tip_force"] = {"end.x": (end[0] - L, unsure[0]), "end.y": (end[1], unsure[1])}
    end, unsure = frenet(L, EA, EI, 3 * EI / L**2)
    answers["tip_force_green"] = {"end.x": (end[0] - L, unsure[0]), "end.y": (end[1], unsure[1])}

    end, unsure = cantilever(2, 1e6, 833.3333333333333, load=(0, -78 * 9.81))
    answers["self_weight_cable"] = {"end.x": (end[0] - 2, unsure[0])}

    b, h, E, rho = 1e-2, 1e-3, 200e9, 7.8e3
    end, unsure = cantilever(1, E * b * h, E * b * h**3 / 12, load=(0, -rho * b * h * 9.81))
    answers["self_weight_strip"] = {"end.x": (end[0] - 1, unsure[0]), "end.y": (end[1], unsure[1])}

    own, theirs = (cantilever(10, 1e4, 100, load=(0, -9.806), GA=GA, steps=100) for GA in (INF, 1e4))
    answers["self_weight_beamdyn"] = {"end.x": (own[0][0] - 10, own[1][0], theirs[0][0] - 10),
                                      "end.y": (-own[0][1], own[1][1], -theirs[0][1])}

    own, theirs = (cantilever(5, 4.8e8, 9.346e6, (0, -600e3), GA=GA) for GA in (INF, 3.231e8))
    answers["geradin"] = {"end.y": both(own, theirs, 1), "end.x": (5 - own[0][0], own[1][0], 5 - theirs[0][0]),
                          "angles.end": (-own[0][2], own[1][2], -theirs[0][2])}

    L, h, w, E, nu = 2, 0.5, 0.1, 2.07e11, 0.3
    EA, EI, GA = E * h * w, E * w * h**3 / 12, 10 * (1 + nu) / (12 + 11 * nu) * E * h * w / (2 * (1 + nu))
    small, large = ([cantilever(L, EA, EI, (0, P * h**3), GA=k) for k in (INF, GA)] for P in (5e5, 5e8))
    answers["thick_small"] = {"end.y": both(*small, 1)}
    answers["thick_large"] = {"end.x": (L - large[0][0][0], large[0][1][0], L - large[1][0][0]), "end.y": both(*large, 1)}

    for load in (1, 2, 5, 10):  # theirs without stretch
        own, theirs = (cantilever(1, EA, 1, (0, -load)) for EA in (1e8, INF))
        answers[f"mattiasson_{load}"] = {"end.y": (-own[0][1], own[1][1], -theirs[0][1]),
                                         "end.x": (1 - own[0][0], own[1][0], 1 - theirs[0][0])}

    answers["rollup"] = {"end.x": (-10.0, 0.0)}  # a full circle: closed form
    answers["lee_frame"], answers["l_frame"] = lee_frame(), l_frame()
    return answers


def lee_frame(EA=4.32e7, EI=1.44e7, L=120, a=24, P=18e3):
    """Two legs with pinned feet and a rigid corner, a dead force down at a from the corner (Lee, Manuel & Rossow 1968). Unknown: the force
    and the angle at the first foot."""
    def integrate(x, share, tolerance):
        force = (x[0] * 1e3, x[1] * 1e3)
        corner = last(plane(EA, EI, force), L, [0, 0, math.pi / 2 + x[2], 0], tolerance)
        corner[2] -= math.pi / 2
        loaded = last(plane(EA, EI, force), a, corner, tolerance)
        foot = last(plane(EA, EI, (force[0], force[1] + share * P)), L - a, loaded, tolerance)
        return np.concatenate((loaded, foot))
    (u, w), unsure = shoot(integrate, lambda z, share: [(z[4] - L) / L, (z[5] - L) / L, z[7] / EI * L], lambda z: (z[0] - a, z[1] - L),
                           [0, 0, 0], 50)
    return {"girder.places.load.position.x": (u, unsure[0]), "girder.places.load.position.y": (w, unsure[1])}


def l_frame():
    """A clamped leg and one upright, with a dead force along the first at the end of the second."""
    E, b, h, nu = 2.1e11, 0.1, 0.05, 0.3
    EA, EI, GA = E * b * h, E * b * h**3 / 12, 10 * (1 + nu) / (12 + 11 * nu) * b * h * E / (2 * (1 + nu))

    def end(GA):
        def integrate(x, share, tolerance):
            law = plane(EA, EI, (share * 1e6, 0), GA=GA)
            corner = last(law, 1, [0, 0, 0, x[0] * EI], tolerance)
            corner[2] += math.pi / 2
            return last(law, 1, corner, tolerance)
        return shoot(integrate, lambda z, share: [z[3] / EI], lambda z: [z[1] - 1], [0], 20)
    own, theirs = end(INF), end(GA)
    return {"post.end.y": (own[0][0], own[1][0], theirs[0][0])}


# ------------------------------------------------------------------------------------------------------------------- space
def hat(w):
    return np.array([[0, -w[2], w[1]], [w[2], 0, -w[0]], [-w[1], w[0], 0]])


def space_cantilever(until, C, K, force, curvature=lambda u: 0.0, speed=lambda u: 1.0, angle=0.0, steps=10):
    """Place of the end of a cantilever from the origin in the plane x-y at rest, u from 0 to `until` along it, its length growing with
    `speed`, its curvature in that plane, its angle to x at first. C = EA, GA, GA; K = GJ, EI, EI in the axes of the section."""
    soft, K, force = 1 / np.array(C, float), np.array(K, float), np.array(force, float)
    c, s = math.cos(angle), math.sin(angle)
    first = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1.0]]).ravel()
    scale = K.max() / until

    def integrate(x, share, tolerance):
        F = share * force

        def f(u, z):
            A = z[3:12].reshape(3, 3)
            tangent = A @ (soft * (A.T @ F) + [1, 0, 0])
            bend = (A.T @ z[12:]) / K + [0, 0, curvature(u)]
            return speed(u) * np.concatenate((tangent, (A @ hat(bend)).ravel(), -np.cross(tangent, F)))
        return last(f, until, np.concatenate((np.zeros(3), first, x * scale)), tolerance)
    return shoot(integrate, lambda z, share: z[12:] / scale, lambda z: z[:3], np.zeros(3), steps)


def bends():
    """The bend of 45 degrees (Bathe & Bolourchi, IJNME 14, 1979) under a force across its plane. GJ: of the polar moment (GXBeam), or of
    the torsion constant (NAFEMS)."""
    answers = {}
    R, an, EA, EI = 100, math.pi / 4, 1e7, 1e7 / 12
    rest = np.array([R * math.sin(an), -R * (1 - math.cos(an)), 0])

    def bend(P, GJ, GA=INF):
        end, unsure = space_cantilever(R * an, (EA, GA, GA), (GJ, EI, EI), (0, 0, P), lambda u: -1 / R, steps=8 if P < 1000 else 24)
        return end - rest, unsure

    (own, unsure), (theirs, _) = bend(600, 5e6 / 6), bend(600, 5e6 / 6, 5e6)
    answers["bend45_gxbeam"] = {"end.y": (-own[1], unsure[1], -theirs[1]), "end.x": (own[0], unsure[0], theirs[0]),
                                "end.z": (own[2], unsure[2], theirs[2])}
    for P in (300, 450, 600, 3000):
        own, unsure = bend(P, 7.03e5)
        answers[f"bend45_nafems_{P}"] = {"end.y": (-own[1], unsure[1]), "end.x": (own[0], unsure[0]), "end.z": (own[2], unsure[2])}
        if P == 600:
            theirs, _ = bend(P, 7.03e5, 41.66667e5)
            answers["bend45_sonneville"] = {"end." + c: (own[i], unsure[i], theirs[i]) for i, c in enumerate("xyz")}

    # the parabola y = a x + b x^2 through the three points by which BeamDyn and Kynema give the bend
    (x1, y1), (x2, y2) = (3.82683e1, -7.61205), (7.07107e1, -2.92893e1)
    b = (y2 / x2 - y1 / x1) / (x2 - x1)
    a = y1 / x1 - b * x1
    speed = lambda u: math.sqrt(1 + (a + 2 * b * u)**2)
    both = [space_cantilever(x2, (1e7, GA, GA), (8.333e5,) * 3, (0, 0, 600), lambda u: 2 * b / speed(u)**3, speed, math.atan(a), 8)
            for GA in (INF, 41.6667e5)]
    own, theirs = (end - [x2, y2, 0] for end, _ in both)
    answers["bend45_beamdyn"] = {"end." + c: (own[i], both[0][1][i], theirs[i]) for i, c in enumerate("xyz")}
    return answers


def princeton():
    """The Princeton beam (Dowell & Traybar 1975), its torsional stiffness 0.198 G (Iy + Iz); theirs with shear, GA = G A."""
    answers = {}
    L, h, w, E, nu = 0.508, 12.3777e-3, 3.2024e-3, 71.7e9, 0.31
    A, Iy, Iz, G = h * w, h * w**3 / 12, w * h**3 / 12, E / (2 * (1 + nu))
    for name, F in (("f2", 8.896), ("f3", 13.345)):
        for degrees in (0, 15, 30, 45, 60, 75, 90):
            t = math.radians(degrees)
            (own, unsure), (theirs, _) = (space_cantilever(L, (E * A, GA, GA), (0.198 * G * (Iy + Iz), E * Iy, E * Iz),
                                                           (0, -F * math.cos(t), F * math.sin(t)), steps=3) for GA in (INF, G * A))
            answers[f"princeton_{name}_{degrees}"] = {
                "end." + c: (own[i], unsure[i], theirs[i]) for i, c in ((1, "y"), (2, "z")) if abs(own[i]) > 1e-9}
    return answers


# ----------------------------------------------------------------------------------------------------------- moving forces
def moving_force(P, L, EI, rhoA, v, t, modes):
    """Deflection of the middle at t, the force from the first support at t = 0; no damping."""
    n = np.arange(1, modes + 1)
    own, forced = (n * math.pi / L)**2 * math.sqrt(EI / rhoA), n * math.pi * v / L
    vibrates = np.sin(forced * t) - forced / own * np.sin(own * t)
    return float(np.sum(2 * P / (rhoA * L) * np.sin(n * math.pi / 2) / (own**2 - forced**2) * vibrates))


def moving_forces():
    """Modes of a linear beam; what is not linear is of the order of (pi w/L)^2, w the largest deflection: a share of the deflection, and
    of the phase of the vibration."""
    answers = {}

    # XC: IPE 200 (EN 10365) with its fillets, steel
    b, h, tw, tf, r = 0.1, 0.2, 5.6e-3, 8.5e-3, 12e-3
    inner = h - 2 * tf
    corner, middle = r * r * (1 - math.pi / 4), r * (10 - 3 * math.pi) / (12 - 3 * math.pi)
    A = 2 * b * tf + inner * tw + 4 * corner
    fillet = r**4 * (1 / 3 - math.pi / 16 - 1 / (9 * (4 - math.pi))) + corner * (inner / 2 - middle)**2
    I = (b * h**3 - (b - tw) * inner**3) / 12 + 4 * fillet
    F, L, v, EI, rhoA = 700, 12, 1.8, 2.1e11 * I, 7850 * A
    sag = F * L**3 / (48 * EI)
    vibration = sag * math.pi * v / L / ((math.pi / L)**2 * math.sqrt(EI / rhoA))
    of = answers["moving_load"] = {}
    for share in (10, 25, 48, 75, 90):
        t = share / 100 * L / v
        value, less = (-moving_force(F, L, EI, rhoA, v, t, modes) for modes in (2000, 1000))
        phase = (math.pi / L)**2 * math.sqrt(EI / rhoA) * t
        of[f"places.mid.position.y@{t:g}"] = value, abs(value - less) + (math.pi * sag / L)**2 * (sag + phase * vibration)

    # Code_Aster: a thousandth of the force runs, and the deflection is multiplied; theirs is the first mode alone
    P, L, EI, rhoA, v = 48000, 10, 1e6, 100, 10
    of = answers["aster_sdll07"] = {}
    for t in (0.1, 0.2, 0.5):
        value, less, one = (moving_force(P, L, EI, rhoA, v, t, modes) for modes in (2000, 1000, 1))
        of[f"places.middle.position.y@{t:g}"] = value, abs(value - less) + (math.pi * value / 1000 / L)**2 * value, one
    return answers


# --------------------------------------------------------------------------------------------------------------- pendulums
def pendulum(rate, t):
    """x - 1 and y of the end of a bar of 1 m from the horizontal: theta'' = -rate sin(theta)."""
    theta = last(lambda t, y: [y[1], -rate * math.sin(y[0])], t, [math.pi / 2, 0], 1e-13)[0]
    return math.sin(theta) - 1, -math.cos(theta)


def pendulums(g=9.81, EA=1e8, EI=1e5):
    """A uniform bar of 1 kg; and one of 1 g with 1 kg at its middle, as which the reference solution takes the first. What a bar gives: the
    moment of a uniform one that falls is rhoA g L^2/27 at most, and it bends about twice as far as at rest; its pull is 3 m g at most, and
    what that stretches it slows it down by half as much: by so much of the way that it has turned at its fastest, sqrt(2 rate)."""
    answers = {"aster_sdnl100": {}, "aster_sdnl100_mass_at_centre": {}}
    light = 1e-3
    for t in (0.4186, 0.8372, 1.2558, 1.6744):
        uniform, middle, alone = (pendulum(rate, t) for rate in (1.5 * g, g * (1 + light) / 2 / (1 / 4 + light / 3), 2 * g))
        bends, stretches = 2 * g / 27 / (math.pi**2 * EI), 3 * g / EA * (1 + t * math.sqrt(4 * g) / 2)
        for i, quantity in enumerate(("end.x", "end.y")):
            answers["aster_sdnl100"][f"{quantity}@{t:g}"] = uniform[i], bends + stretches, alone[i]
            answers["aster_sdnl100_mass_at_centre"][f"{quantity}@{t:g}"] = middle[i], light * bends + stretches
    return answers


# ------------------------------------------------------------------------------------------------------------ own elements
class Elements:
    """A straight beam of N cubic Hermite elements from the origin along x. Laws: "engineering", EA (l - 1)^2/2 + EI (theta')^2/2 with the
    stretch l; "green", EA (l^2 - 1)^2/8 + EI (theta'/l)^2/2, both per unstretched length, theta' the turn of the tangent."""

    def __init__(self, L, N, EA, EI, rhoA, dimension=2, law="engineering", gravity=None, hinged=False):
        self.EA, self.EI, self.law, self.hinged = EA, EI, law, hinged
        l = L / N
        x, w = leggauss(5)
        x, self.w = (x + 1) / 2, w / 2 * l
        shapes = np.array([1 - 3 * x**2 + 2 * x**3, l * (x - 2 * x**2 + x**3), 3 * x**2 - 2 * x**3, l * (x**3 - x**2)]).T
        self.D = np.array([(-6 * x + 6 * x**2) / l, 1 - 4 * x + 3 * x**2, (6 * x - 6 * x**2) / l, 3 * x**2 - 2 * x]).T
        self.D2 = np.array([(-6 + 12 * x) / l**2, (-4 + 6 * x) / l, (6 - 12 * x) / l**2, (6 * x - 2) / l]).T
        self.of = np.array([np.arange(2 * e, 2 * e + 4) for e in range(N)])
        n = 2 * N + 2
        mass, weight = np.zeros((n, n)), np.zeros(n)
        for at in self.of:
            mass[np.ix_(at, at)] += rhoA * np.einsum("q,qi,qj->ij", self.w, shapes, shapes)
            weight[at] += rhoA * self.w @ shapes
        if hinged:
            mass[0] = mass[:, 0] = 0
            mass[0, 0] = 1
        self.inverse = np.linalg.inv(mass)
        self.start = np.zeros((n, dimension))
        self.start[0::2, 0], self.start[1::2, 0] = np.linspace(0, L, N + 1), 1
        self.force = np.zeros((n, dimension)) if gravity is None else np.outer(weight, gravity)

    def acceleration(self, q):
        r1, r2 = self.D @ q[self.of], self.D2 @ q[self.of]  # element, point, component
        a, b, d = (r1 * r1).sum(-1), (r1 * r2).sum(-1), (r2 * r2).sum(-1)
        if self.law == "engineering":
            stretch, power = self.EA * (1 - 1 / np.sqrt(a)), 2
        else:
            stretch, power = self.EA * (a - 1) / 2, 3
        area, h = a * d - b * b, a**-power  # (theta')^2 = area h, or (theta'/l)^2
        by_a, by_b, by_d = self.EI / 2 * (d * h - power * area * h / a), -self.EI * b * h, self.EI / 2 * a * h
        g1 = (stretch + 2 * by_a)[..., None] * r1 + by_b[..., None] * r2
        g2 = by_b[..., None] * r1 + 2 * by_d[..., None] * r2
        f = self.force.copy()
        np.add.at(f, self.of, -(np.swapaxes(self.w[:, None] * self.D, 0, 1) @ g1 + np.swapaxes(self.w[:, None] * self.D2, 0, 1) @ g2))
        if self.hinged:
            f[0] = 0
        return self.inverse @ f

    def run(self, times, velocity=None, tolerance=1e-9):
        n, shape = self.start.size, self.start.shape
        f = lambda t, y: np.concatenate((y[n:], self.acceleration(y[:n].reshape(shape)).ravel()))
        first = np.concatenate((self.start.ravel(), np.zeros(n) if velocity is None else velocity.ravel()))
        found = solve_ivp(f, (0, times[-1]), first, method="DOP853", rtol=tolerance, atol=tolerance / 100, t_eval=times)
        return found.y[:n].T.reshape(-1, *shape)


def pushed_beam():
    """A free soft beam that is pushed across at one end, at once. Waves of all lengths run from there, so elements help slowly: the
    uncertainty is all that three refinements differ by."""
    L, b, E = 2, 0.1, 2.07e6
    found = []
    for N in (48, 64, 96):
        beam = Elements(L, N, 0.1 * E * b * b, E * b**4 / 12, 7800 * b * b)
        beam.force[-2, 1] = -1000
        found.append(beam.run([0.05], tolerance=1e-8)[0][-2, 1])
    return {"end.y@0.05": (found[-1], max(found) - min(found))}


def chrono_pendulum():
    """A cable hinged at one end that falls while it turns. The uncertainty is the largest change from 32 to 48 elements until then. Theirs:
    Green's strain, curvature per deformed length, four elements, g = 9.8, and velocities of places of nodes only, slopes at rest."""
    A, E, times = 25e-6, 1.6e6, [0.02, 0.1, 0.2, 0.3, 0.5]

    def motion(N, theirs=False):
        cable = Elements(1, N, E * A, E * A * A / (4 * math.pi), 320 * A, 3, "green" if theirs else "engineering",
                         np.array([0, -9.8 if theirs else -9.81, 0]), hinged=True)
        velocity = np.zeros_like(cable.start)
        velocity[0::2, 2] = -4 * np.linspace(0, 1, N + 1)
        velocity[1::2, 2] = 0 if theirs else -4
        q = cable.run(times, velocity, 1e-7)
        return q[:, N, 1], q[:, -2, 2]  # y of the middle, z of the end
    fine, coarse, theirs = motion(48), motion(32), motion(4, theirs=True)
    answers = {}
    for i, quantity in enumerate(("places.mid.position.y", "end.z")):
        for k, t in enumerate(times):
            answers[f"{quantity}@{t:g}"] = fine[i][k], np.abs(fine[i] - coarse[i])[:k + 1].max(), theirs[i][k]
    return answers


def answers():
    return {**plane_problems(), **bends(), **princeton(), **moving_forces(), **pendulums(), "pushed_beam": pushed_beam(),
            "chrono_pendulum": chrono_pendulum()}
