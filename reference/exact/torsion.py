"""Torsion of a uniform shaft: its frequencies, those of linear elements, and the twist by a point torque that rests or moves.

    rho J theta_tt = G J theta_xx + T delta(x - a),   c = sqrt(G/rho)
Frequencies: fixed at both ends n c/(2 L), fixed and free (2 n - 1) c/(4 L), free at both ends n c/(2 L) after rigid rotation.
N linear elements, h = L/N, phi = omega h/c of the exact mode:
    consistent mass  omega h/c = sqrt(6 (1 - cos phi)/(2 + cos phi)),    lumped mass  2 sin(phi/2).
Torque T at a, static: fixed at both ends theta(x) = T x (L - a)/(G J L) for x < a, T a (L - x)/(G J L) beyond; fixed and free T min(x, a)/(G J).
Torque that enters at 0 and moves at v = beta c over a shaft fixed at both ends, at rest before: with x and a over L, tau = c t/L, and the static twist
S(x, a) = min(x, a) (1 - max(x, a)), continued in a as an odd function of period 2,
    theta G J/(T L) = (S(x, beta tau) - beta S(x, tau))/(1 - beta^2)   until beta tau = 1;   at beta = 1 the limit (S - tau dS/da)/2.

Source: Timoshenko, Vibration Problems in Engineering, torsional vibration of shafts; the modal series of a moving
torque is summed by the Fourier series of S.
Errors: shooting, eigenvalues of the elements' matrices, elements (exact at nodes in statics), waves of mirror images. Needs numpy. Command: make.py torsion
"""
import mpmath as mp
import numpy as np

from common import case, integrate, precisely, roots


def frequencies(c, L, ends, count):
    return [(n if ends != "fixed-free" else n - mp.mpf(1) / 2) * c / (2 * L) for n in range(1, count + 1)]


def discrete(c, L, ends, elements, mass, count):
    result = []
    for f in frequencies(c, L, ends, min(count, elements - (ends == "fixed-fixed"))):
        phi = 2 * mp.pi * f * L / (elements * c)
        scaled = mp.sqrt(6 * (1 - mp.cos(phi)) / (2 + mp.cos(phi))) if mass == "consistent" else 2 * mp.sin(phi / 2)
        result.append(scaled * c * elements / L / (2 * mp.pi))
    return result


def discrete_by_matrices(c, L, ends, elements, mass, count):
    N, h = elements, mp.mpf(L) / elements
    K, M = mp.matrix(N + 1), mp.matrix(N + 1)
    on, off = (h / 3, h / 6) if mass == "consistent" else (h / 2, mp.mpf(0))
    for e in range(N):
        for i, j in ((0, 0), (0, 1), (1, 0), (1, 1)):
            K[e + i, e + j] += c * c / h * (1 if i == j else -1)
            M[e + i, e + j] += on if i == j else off
    a, b = {"fixed-fixed": (1, N), "fixed-free": (1, N + 1), "free-free": (0, N + 1)}[ends]
    values = sorted(abs(x) for x in mp.eig(M[a:b, a:b] ** -1 * K[a:b, a:b], left=False, right=False))
    return [mp.sqrt(x) / (2 * mp.pi) for x in values[(ends == "free-free"):][:count]]


def static(x, a):
    """Fixed at both ends, a continued."""
    a = a - 2 * mp.floor(a / 2)
    return -static(x, 2 - a) if a > 1 else min(x, a) * (1 - max(x, a))


def slope(x, a):
    """dS/da."""
    a = a - 2 * mp.floor(a / 2)
    return slope(x, 2 - a) if a > 1 else (1 - x if a < x else -x)


def moving(beta, x, tau):
    return (static(x, tau) - tau * slope(x, tau)) / 2 if beta == 1 else (static(x, beta * tau) - beta * static(x, tau)) / (1 - beta**2)


def moving_by_images(beta, x, tau):
    """Waves without supports of T and its mirror images at 2 m +- beta s: each adds half of the time s for which |x - place| < tau - s."""
    total = mp.mpf(0)
    for m in range(-int(tau) - 2, int(tau) + 3):
        for sign in (1, -1):
            low, high = mp.mpf(0), tau
            for side in (1, -1):  # s (1 - side sign beta) < tau - side (x - 2 m)
                factor, bound = 1 - side * sign * beta, tau - side * (x - 2 * m)
                if factor > 0:
                    high = min(high, bound / factor)
                elif factor < 0:
                    low = max(low, bound / factor)
                elif bound <= 0:
                    high = low
            total += sign * max(high - low, 0) / 2
    return total


def frequencies_by_shooting(c, L, ends, count):
    """theta'' = -(omega/c)^2 theta from a fixed or free end to the other."""
    start = [mp.mpf(1), mp.mpf(0)] if ends == "free-free" else [mp.mpf(0), mp.mpf(1)]
    far = 0 if ends == "fixed-fixed" else 1
    end = lambda f: integrate(lambda _, q: [q[1], -((2 * mp.pi * f / c) ** 2) * q[0]], start, mp.mpf(0), mp.mpf(L), 20, 18)[far]
    return roots(end, 0.05 * c / L, 0.21 * c / L, count)


def twist_by_elements(ends, x, a, N=100):
    """Linear elements are exact at nodes: x and a are nodes. Solved in fractions of GJ/L."""
    K = np.diag([2.0] * (N + 1)) - np.diag([1.0] * N, 1) - np.diag([1.0] * N, -1)
    K[0, 0] = K[N, N] = 1
    free = slice(1, N if ends == "fixed-fixed" else N + 1)
    load = np.zeros(N + 1)
    load[round(a * N)] = 1
    result = np.zeros(N + 1)
    result[free] = np.linalg.solve(N * K[free, free], load[free])
    return [float(result[round(p * N)]) for p in x]


def cases():
    source = "Timoshenko, Vibration Problems in Engineering"
    G, rho, radius, L = mp.mpf(80e9), mp.mpf(7800), mp.mpf("0.01"), mp.mpf(1)
    c, GJ = mp.sqrt(G / rho), G * mp.pi * radius**4 / 2
    units = {"G": "Pa", "density": "kg/m^3", "radius": "m", "length": "m", "frequencies": "Hz", "torque": "N m", "twist": "rad", "x, a": "L", "tau": "L/c", "v": "c"}
    shaft = {"G": 80e9, "density": 7800, "radius": 0.01, "length": 1}
    for ends in ("fixed-fixed", "fixed-free", "free-free"):
        N = 8
        answer = lambda of: {"consistent": of(c, L, ends, N, "consistent", 4), "lumped": of(c, L, ends, N, "lumped", 4)}
        yield case(f"torsion, {ends}", "closed form", source, {**shaft, "ends": ends, "elements": N}, units,
                   [lambda: {"exact": frequencies(c, L, ends, 4), **answer(discrete)},
                    lambda: {"exact": precisely(lambda: frequencies_by_shooting(c, L, ends, 4), 24)(), **answer(discrete_by_matrices)}],
                   "shooting; eigenvalues of the elements' matrices")
    x = [mp.mpf(p) / 100 for p in (25, 60, 80)]
    for ends in ("fixed-fixed", "fixed-free"):
        of = lambda p, a: static(p, a) if ends == "fixed-fixed" else min(p, a)
        a = mp.mpf("0.6")
        yield case(f"torsion, {ends}, point torque", "closed form", source, {**shaft, "ends": ends, "torque": 100, "a": 0.6, "x": [float(p) for p in x]}, units,
                   [lambda: {"twist": [100 * L / GJ * of(p, a) for p in x]},
                    lambda: {"twist": [100 * L / GJ * p for p in twist_by_elements(ends, x, a)]}], "100 elements, exact at nodes")
    for beta in ("0.4", "1", "1.6"):
        b = mp.mpf(beta)
        taus = [mp.mpf(k) / 8 / b for k in (2, 4, 7)]
        answer = lambda of: {"twist_at_0.3": [of(b, mp.mpf("0.3"), t) for t in taus], "twist_at_0.55": [of(b, mp.mpf("0.55"), t) for t in taus]}
        yield case(f"torsion, torque that moves at {beta} c", "closed form", source + "; the modal series summed", {"v": float(b), "tau": [float(t) for t in taus]},
                   {**units, "twist": "T L/(G J)"}, [lambda: answer(moving), lambda: answer(moving_by_images)], "waves of mirror images")
