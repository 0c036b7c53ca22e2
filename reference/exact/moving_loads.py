"""A force, and a mass, that run at v over a simply supported Euler-Bernoulli beam, which is straight and at rest when they enter.

Force P, deflection w downwards, W_n = n pi v/L, w_n = (n pi/L)^2 sqrt(EI/rhoA), alpha = W_1/w_1:
    w = 2 P/(rhoA L) sum sin(n pi x/L) (sin W_n t - W_n/w_n sin w_n t)/(w_n^2 - W_n^2);   the term with w_n = W_n (alpha = n) in the limit:
    (sin w_n t - w_n t cos w_n t)/(2 w_n^2).
Its static part, sum sin sin/n^4, is a polynomial; the rest falls like n^-5.
After it has left (t > L/v) each mode is free. Units: L = 1, the static deflection P L^3/(48 EI) under P in the middle.

Mass m, all of its acceleration across the beam: it bears m (g - w_tt - 2 v w_xt - v^2 w_xx) at x = v t. In the modes sin(n pi x/L) = s_n:
    (rhoA L/2) (q_n'' + w_n^2 q_n) = s_n m (g - sum (s_k q_k'' + 2 v s_k' q_k' + v^2 s_k'' q_k)).
Convergence in modes: w_xx has a kink below the mass, errors fall like N^-3; extrapolated from N and 2 N.

Sources: Fryba, Vibration of Solids and Structures under Moving Loads, chapters 1 and 2.
Errors: force: half as many terms, and the mean of alpha +- 1e-12; mass: half as many modes, half as many steps. Needs numpy for the mass.
Command: make.py moving_loads
"""
import mpmath as mp
import numpy as np

from common import case


def static(x, a):
    """Deflection at x of a unit force at a, over that of the middle under a force there."""
    x, a = min(x, a), max(x, a)
    return 8 * x * (1 - a) * (2 * a - a * a - x * x)


def force(alpha, x, place, terms):
    """Deflection over the static one at x when the force is at place."""
    total, factor = mp.mpf(0), 96 / mp.pi**4
    for n in range(1, terms + 1):
        phase = n * n * mp.pi * place / alpha  # w_n t
        shape = mp.sinpi(n * x)
        if n == alpha:
            total += shape * ((mp.sin(phase) - phase * mp.cos(phase)) / 2 - mp.sin(phase)) / n**4
        else:
            total += shape * (alpha**2 * mp.sinpi(n * place) / n**2 - alpha / n * mp.sin(phase)) / (n * n * (n * n - alpha**2))
    return static(x, place) + factor * total


def free(alpha, x, after, terms):
    """The same after the force has left, at t = after L/v: modes with their value and rate at t = L/v."""
    total, factor = mp.mpf(0), 96 / mp.pi**4
    for n in range(1, terms + 1):
        w = n * n * mp.pi / alpha  # times L/v
        if n == alpha:
            value, rate = (mp.sin(w) - w * mp.cos(w)) / 2 / n**4, w * w * mp.sin(w) / 2 / n**4
        else:
            value = (-alpha / n * mp.sin(w)) / (n * n * (n * n - alpha**2))
            rate = (n * mp.pi * (-1) ** n - alpha / n * w * mp.cos(w)) / (n * n * (n * n - alpha**2))
        total += mp.sinpi(n * x) * (value * mp.cos(w * (after - 1)) + rate / w * mp.sin(w * (after - 1)))
    return factor * total


def mass(ratio, alpha, places, modes, steps):
    """Deflections in the middle and under the mass, the force between, over P. Here rhoA = EI = 1, m g = 48; Gauss collocation, 4 stages, whose
    values R of the force follow from as many equations: q'' = B (2 s R - w^2 (q + c h q')) at the stages, B the same in all steps."""
    x, w = np.polynomial.legendre.leggauss(4)
    c, b = (x + 1) / 2, w / 2
    powers = np.vander(c, increasing=True)
    A = (powers * c[:, None] / np.arange(1, 5)) @ np.linalg.inv(powers)
    n = np.arange(1, modes + 1) * np.pi
    v, stiffness = float(alpha) * np.pi, n**4
    h = 1 / v / steps
    B = np.linalg.inv(np.eye(4) + stiffness[:, None, None] * h * h * (A @ A))
    stages = np.stack([B, h * A @ B, h * h * A @ A @ B])
    q, rate, result = np.zeros(modes), np.zeros(modes), []
    wanted = [round(place * steps) for place in places]
    for i in range(max(wanted)):
        phase = np.outer(n, (i + c) / steps)
        s, slope = np.sin(phase), 2 * v * n[:, None] * np.cos(phase)
        bend = -v * v * (n * n)[:, None] * s
        early = q[:, None] + h * np.outer(rate, c)
        to_force = s[:, :, None] * stages[0] + slope[:, :, None] * stages[1] + bend[:, :, None] * stages[2]
        elastic = stiffness[:, None] * early
        matrix = np.eye(4) / ratio + np.einsum("nij,nj->ij", to_force, 2 * s)
        R = np.linalg.solve(matrix, 48 / ratio - rate @ slope - (bend * early).sum(0) + np.einsum("nij,nj->i", to_force, elastic))
        second = np.einsum("nij,nj->ni", B, 2 * s * R - elastic)
        q, rate = q + h * rate + h * h * (second @ (b @ A)), rate + h * (second @ b)
        if i + 1 in wanted:
            result.append((np.sin(n / 2) @ q, np.sin(n * (i + 1) / steps) @ q))
    return np.array(result)


def extrapolated(ratio, alpha, places, modes, steps):
    coarse, fine = mass(ratio, alpha, places, modes // 2, steps), mass(ratio, alpha, places, modes, steps)
    best = (8 * fine - coarse) / 7
    return {"middle": best[:, 0].tolist(), "under_mass": best[:, 1].tolist()}


def by_modes(ratio, alpha, steps):
    """How the sum converges: the deflection in the middle, under the mass, from 8 modes to 128."""
    return {"middle_by_8_16_32_64_128_modes": [mass(ratio, alpha, (0.5,), 2**k, steps)[0, 0] for k in range(3, 8)]}


def cases():
    source = "Fryba, Vibration of Solids and Structures under Moving Loads"
    units = {"places, x": "L", "times": "L/v", "deflections": "P L^3/(48 EI)", "alpha": "pi/L sqrt(EI/rhoA)", "mass_ratio": "rhoA L"}
    half = mp.mpf(1) / 2
    places = [mp.mpf(i) / 4 for i in (1, 2, 3, 4)]
    for alpha in ("0.25", "0.5", "1", "1.5", "2"):
        a = mp.mpf(alpha)
        answer = lambda a, n: {"middle": [force(a, half, p, n) for p in places], "at_0.3": [force(a, mp.mpf("0.3"), p, n) for p in places],
                               "middle_after": [free(a, half, t, n) for t in (mp.mpf("1.25"), mp.mpf("1.5"))]}
        # below and above the resonance: the mean leaves an error of second order
        def near():
            below, above = [answer(a + sign * mp.mpf(10) ** -12, 1500) for sign in (-1, 1)]
            return {key: [(x + y) / 2 for x, y in zip(below[key], above[key])] for key in below}

        yield case(f"force that moves over a beam, alpha = {alpha}", "series", source + ", chapter 1",
                   {"alpha": float(a), "places": [float(p) for p in places], "x": [0.5, 0.3], "times": [1.25, 1.5]}, units,
                   [lambda: answer(a, 3000), lambda: answer(a, 1500), near], "half as many terms, and alpha +- 1e-12")
    for ratio, alpha in ((0.5, 0.5), (0.2, 0.25), (1.0, 1.0)):
        yield case(f"mass that moves over a beam, m/(rhoA L) = {ratio}, alpha = {alpha}", "ode", source + ", chapter 2, with 2 v w_xt + v^2 w_xx",
                   {"mass_ratio": ratio, "alpha": alpha, "places": [0.25, 0.5, 0.75, 0.9]}, units,
                   [lambda n=n, k=k: {**extrapolated(ratio, alpha, (0.25, 0.5, 0.75, 0.9), n, k), **by_modes(ratio, alpha, k)}
                    for n, k in ((512, 8000), (256, 8000), (512, 4000))], "256 and 512 modes extrapolated: 128 and 256, and half as many steps")
