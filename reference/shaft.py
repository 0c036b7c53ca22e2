#!/usr/bin/env python3
"""Writes the exact solutions that the studies moving_string, torsion and rotating_load compare with:
reference/moving_beam_frequencies.json, torsion_errors.json, rotating_load.json. Needs mpmath.

    shaft.py
"""
import json
import os

import mpmath as mp

mp.mp.dps = 30
here = os.path.dirname(os.path.abspath(__file__))


def write(name, content):
    with open(os.path.join(here, name), "w") as file:
        json.dump(content, file, indent=1)
        file.write("\n")


# Axially moving, tensioned, simply supported beam: EJ w'''' + (rhoA v^2 - F) w'' + 2 rhoA v w_xt + rhoA w_tt = 0.

length, radius, density, tension = mp.mpf(1), mp.mpf("0.005"), mp.mpf(2700), mp.mpf(1000)
area = mp.pi * radius**2
rhoA, second_moment = density * area, mp.pi * radius**4 / 4


def characteristic(omega, EJ, v):
    """Determinant of the boundary conditions for w = sum A_j exp(i (k_j x + omega t)); real but for a constant phase."""
    k = mp.polyroots([EJ, 0, tension - rhoA * v**2, -2 * rhoA * v * omega, -rhoA * omega**2], maxsteps=200, extraprec=60)
    rows = [[1, k_j**2, mp.expj(k_j * length), k_j**2 * mp.expj(k_j * length)] for k_j in k]
    vandermonde = mp.mpf(1)
    for i in range(4):
        for j in range(i):
            vandermonde *= k[i] - k[j]
    return mp.det(mp.matrix(rows)) / vandermonde


def beam_frequencies(EJ, v, count):
    """The lowest `count` frequencies [Hz]: sign changes of the determinant, of which one phase is taken out."""
    phase = mp.sqrt(characteristic(mp.mpf(1), EJ, v) ** 2)
    phase /= abs(phase)

    def real(omega):
        return mp.re(characteristic(omega, EJ, v) / phase)

    found, omega, step = [], mp.mpf(1), mp.mpf(8)
    before = real(omega)
    while len(found) < count:
        after = real(omega + step)
        if before * after < 0:
            found.append(mp.findroot(real, (omega, omega + step), solver="anderson", tol=1e-40) / (2 * mp.pi))
        omega, before = omega + step, after
    return found


def string_frequency(v):
    c2 = tension / rhoA
    return (c2 - v**2) / (2 * length * mp.sqrt(c2)) if v**2 < c2 else None


def finite_elements(EJ, v, elements):
    """Frequencies of cubic Hermite elements of the linear equation in a fixed frame, in exact arithmetic."""
    h = length / elements
    shapes = [[1, 0, -3, 2], [0, h, -2 * h, h], [0, 0, 3, -2], [0, 0, -h, h]]  # coefficients of u^0 to u^3

    def derive(p, n):
        for _ in range(n):
            p = [i * c for i, c in enumerate(p)][1:]
        return [mp.mpf(c) for c in p]

    def integral(p, a, q, b):
        p, q = derive(p, a), derive(q, b)
        total = sum(x * y / (i + j + 1) for i, x in enumerate(p) for j, y in enumerate(q))
        return total * h ** (1 - a - b)

    n = 2 * (elements + 1)
    M, C, K = mp.zeros(n), mp.zeros(n), mp.zeros(n)
    for e in range(elements):
        for i in range(4):
            for j in range(4):
                p, q = shapes[i], shapes[j]
                M[2 * e + i, 2 * e + j] += rhoA * integral(p, 0, q, 0)
                C[2 * e + i, 2 * e + j] += rhoA * v * (integral(p, 0, q, 1) - integral(p, 1, q, 0))
                K[2 * e + i, 2 * e + j] += EJ * integral(p, 2, q, 2) + (tension - rhoA * v**2) * integral(p, 1, q, 1)
    free = [i for i in range(n) if i not in (0, n - 2)]
    pick = lambda A: mp.matrix([[A[i, j] for j in free] for i in free])
    M, C, K = pick(M), pick(C), pick(K)
    m = len(free)
    inverse = M**-1
    scale = mp.mpf(1000)
    companion = mp.zeros(2 * m)
    MK, MC = inverse * K, inverse * C
    for i in range(m):
        companion[i, m + i] = 1
        for j in range(m):
            companion[m + i, j] = -MK[i, j] / scale**2
            companion[m + i, m + j] = -MC[i, j] / scale
    values = mp.eig(companion, left=False, right=False)
    return sorted(mp.im(z) * scale / (2 * mp.pi) for z in values if mp.im(z) > abs(z) / 10**6)


def moving_beam():
    rows = []
    number = lambda x: None if x is None else float(mp.nstr(x, 15))
    for modulus in (70, 71):
        EJ = mp.mpf(modulus) * 10**9 * second_moment
        for v in range(0, 80, 5):
            beam = beam_frequencies(EJ, mp.mpf(v), 3) if v < 79 else [None] * 3
            string = string_frequency(mp.mpf(v))
            elements = finite_elements(EJ, mp.mpf(v), 4)[:2]
            elements_string = finite_elements(mp.mpf(0), mp.mpf(v), 4)[0] if string else None
            rows.append([modulus, v, number(string), *map(number, beam), number(elements_string), *map(number, elements)])
    return {
        "source": "Simply supported beam of circular section that moves at v along its axis under the tension F: exact "
                  "frequencies from the determinant of its boundary conditions, string_f1 = (c^2 - v^2)/(2 l c), and four "
                  "cubic Hermite elements of the same linear equation; 30 digits (reference/shaft.py)",
        "parameters": {"length": 1, "radius": 0.005, "density": 2700, "tension": 1000},
        "units": {"E": "GPa", "v": "m/s", "f": "Hz"},
        "columns": ["E", "v", "string_f1", "beam_f1", "beam_f2", "beam_f3", "string_f1_elements4", "beam_f1_elements4",
                    "beam_f2_elements4"],
        "rows": rows,
    }


def torsion():
    rows = []
    for n in range(1, 11):
        row = []
        for mode in range(1, min(n, 5) + 1):
            phi = (2 * mode - 1) * mp.pi / (2 * n)
            ratio = mp.sqrt(6 * (1 - mp.cos(phi)) / (2 + mp.cos(phi))) / phi
            row.append(float(mp.nstr(100 * (ratio - 1), 15)))
        rows.append(row)
    return {
        "source": "Torsion of a shaft fixed at one end and free at the other, linear elements with consistent mass: "
                  "f_h/f - 1 = sqrt(6 (1 - cos phi)/(2 + cos phi))/phi - 1, phi = (2 i - 1) pi/(2 N) (reference/shaft.py)",
        "errors_percent": rows,
    }


# A simply supported beam under the load P exp(i omega t) that moves at v: EJ U'''' + rhoA U_tt = P exp(i omega t)
# delta(z - v t), U = U_1 + i U_2, at rest at t = 0; in units l = 1, v = 1, P l^3/(48 EJ) = 1.

def deflection(a, k_omega, t, z, modes):
    """By its modes; a = v/v_cr, v_cr = (pi/l) sqrt(EJ/rhoA), k_omega = omega l/(2 pi v)."""
    omega = 2 * mp.pi * k_omega
    total = mp.mpc(0)
    for n in range(1, modes + 1):
        natural, moving = n**2 * mp.pi / a, n * mp.pi

        def response(nu):
            if abs(natural**2 - nu**2) < mp.mpf(10) ** -20:
                return (mp.sin(natural * t) / natural - t * mp.expj(nu * t)) / (2j * nu) * -1
            return (mp.expj(nu * t) - mp.cos(natural * t) - 1j * nu / natural * mp.sin(natural * t)) / (natural**2 - nu**2)

        q = (response(omega + moving) - response(omega - moving)) / 1j
        total += q * mp.sin(moving * z)
    # P/(rhoA l) over P l^3/(48 EJ) is 48 EJ/(rhoA l^4) = 48/(pi a)^2 in these units
    return total * 48 / (mp.pi * a) ** 2


def rotating_load():
    sets = []
    for a, k_omega in ((mp.mpf("0.5"), mp.mpf(1)), (mp.mpf("1.5"), mp.mpf("0.5"))):
        rows = []
        for i in range(1, 101):
            t = mp.mpf(i) / 100
            load, middle = (deflection(a, k_omega, t, z, 400) for z in (t, mp.mpf("0.5")))
            rows.append([float(t)] + [float(mp.nstr(x, 13)) for x in (load.real, load.imag, middle.real, middle.imag)])
        sets.append({"a": float(a), "k_omega": float(k_omega), "rows": rows})
    return {
        "source": "Modal solution, 400 modes, of the simply supported Euler-Bernoulli beam under a load that moves and "
                  "rotates about it, deflections over P l^3/(48 EJ) (reference/shaft.py)",
        "columns": ["z_over_l", "load_U1", "load_U2", "middle_U1", "middle_U2"],
        "sets": sets,
    }


mp.mp.dps = 30
write("moving_beam_frequencies.json", moving_beam())
write("torsion_errors.json", torsion())
mp.mp.dps = 20
write("rotating_load.json", rotating_load())
