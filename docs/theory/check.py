#!/usr/bin/env python3
"""Checks equations of these pages in arithmetic of 60 digits, by differences alone (mpmath). Nothing here is of core/.

    check.py        prints the largest deviation of each equation from what it says; fails where one is too large

r_v and the y are differences of the curve itself; forces are Lagrange's equations of the sums, differentiated.
"""

import random
import sys

from mpmath import atan2, binomial, cos, cot, exp, legendre, mp, mpf, nstr, pi, polyroots, sin, sqrt, tanh, taylor

mp.dps = 60
random.seed(3)
H = mpf(10) ** -15
WEIGHTS = [mpf(1), mpf("0.8"), mpf("1.2"), mpf("1.05")]
REFERENCE = mpf("0.05"), mpf("1.1")  # where transported weights are given
EA, EI, RHO_A, GRAVITY = mpf(3), mpf("0.7"), mpf("1.3"), [mpf("0.2"), mpf("-0.9")]
failed = []


def say(what, deviation, bound):
    print(f"{what:72s} {nstr(deviation, 2)}")
    if not deviation <= bound:
        failed.append(what)


def number():
    return mpf(random.uniform(-1, 1))


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def plus(a, b, k=1):
    return [x + k * y for x, y in zip(a, b)]


def unit(n, size=10):
    return [mpf(i == n) for i in range(size)]


def largest(a, b):
    return max(abs(x - y) for x, y in zip(a, b))


def difference(f, h=H):
    a, b = f(h), f(-h)
    return [(x - y) / (2 * h) for x, y in zip(a, b)] if isinstance(a, list) else (a - b) / (2 * h)


def second(f, h=H):
    a, b, c = f(h), f(-h), f(mpf(0))
    return [(x + y - 2 * z) / h**2 for x, y, z in zip(a, b, c)]


def gauss(n):
    points = []
    for x in sorted(polyroots(taylor(lambda z: legendre(n, z), 0, n)[::-1], maxsteps=500, extraprec=500)):
        slope = n * (x * legendre(n, x) - legendre(n - 1, x)) / (x * x - 1)
        points.append(((1 + x) / 2, 1 / ((1 - x * x) * slope**2)))
    return points


# Chapter 1. Coordinates: r_A, s_A, r_B, s_B, two components each, x_A, x_B.


def blossom(c, s, t, u):
    def between(a, b, p):
        return a * (1 - p) + b * p

    a = [between(c[i], c[i + 1], s) for i in range(3)]
    b = [between(a[i], a[i + 1], t) for i in range(2)]
    return between(*b, u)


def weights(q, kind):
    if kind == "frozen":
        return WEIGHTS
    start, end = REFERENCE
    a, b = ((x - start) / (end - start) for x in q[8:])
    return [blossom(WEIGHTS, *at) for at in ((a, a, a), (a, a, b), (a, b, b), (b, b, b))]


def shapes(u, w):
    """f_i and three derivatives by u, (1.4) and (1.5)."""
    v = 1 - u
    b = [[v**3, 3 * u * v * v, 3 * u * u * v, u**3],
         [-3 * v * v, 3 * v * v - 6 * u * v, 6 * u * v - 3 * u * u, 3 * u * u],
         [6 * v, 6 * u - 12 * v, 6 * v - 12 * u, 6 * u], [mpf(-6), mpf(18), mpf(-18), mpf(6)]]
    total = [dot(w, b[n]) for n in range(4)]
    found = []
    for top in ([w[0] * x[0] + w[1] * x[1] for x in b], [w[0] * x[1] / 3 for x in b],
                [w[2] * x[2] + w[3] * x[3] for x in b], [-w[3] * x[2] / 3 for x in b]):
        f = []
        for n in range(4):
            f.append((top[n] - sum(binomial(n, k) * total[k] * f[n - k] for k in range(1, n + 1))) / total[0])
        found.append(f)
    return found


def combine(f, n, e, l):
    return [(f[0][n] * e[c] + f[2][n] * e[4 + c] + l * (f[1][n] * e[2 + c] + f[3][n] * e[6 + c])) / l**n for c in (0, 1)]


def position(x, q, kind):
    l = q[9] - q[8]
    return combine(shapes((x - q[8]) / l, weights(q, kind)), 0, q, l)


class Point:
    """Motion at u by the equations of chapter 1."""

    def __init__(self, u, q, rate, kind):
        l, l_rate = q[9] - q[8], rate[9] - rate[8]
        w = weights(q, kind)
        f = shapes(u, w)
        self.s = [[f[i][n] * (l if i % 2 else 1) / l**n for n in range(3)] for i in range(4)]
        self.r, self.r_x, self.r_xx, self.r_xxx = (combine(f, n, q, l) for n in range(4))
        if kind == "frozen":
            def g(n, e):
                return [f[1][n] * e[2 + c] + f[3][n] * e[6 + c] for c in (0, 1)]

            d = [[x * l**n for x in combine(f, n, q, l)] for n in range(4)]
            y_a = [plus([-x * (1 - u) / l for x in d[1]], g(0, q), -1)]
            y_b = [plus([-x * u / l for x in d[1]], g(0, q))]
            y_a.append([(d[1][c] / l - d[2][c] * (1 - u) / l - g(1, q)[c]) / l for c in (0, 1)])
            y_b.append([(-d[1][c] / l - d[2][c] * u / l + g(1, q)[c]) / l for c in (0, 1)])
            y_a.append([(2 * d[2][c] / l - d[3][c] * (1 - u) / l - g(2, q)[c]) / l**2 for c in (0, 1)])
            y_b.append([(-2 * d[2][c] / l - d[3][c] * u / l + g(2, q)[c]) / l**2 for c in (0, 1)])
            u_rate = -(rate[8] * (1 - u) + rate[9] * u) / l
            u_rate2 = -2 * u_rate * l_rate / l
            r_u = [x * l for x in combine(f, 1, rate, l)]
            self.r_v = [2 * l_rate * g(0, rate)[c] + 2 * u_rate * (r_u[c] + l_rate * g(1, q)[c]) + u_rate**2 * d[2][c] +
                        u_rate2 * d[1][c] for c in (0, 1)]
        else:
            at_a, at_b = shapes(mpf(0), w), shapes(mpf(1), w)
            k_a, k_b = combine(at_a, 2, q, l), combine(at_b, 2, q, l)
            j_a, j_b = combine(at_a, 3, q, l), combine(at_b, 3, q, l)
            y_a = [[-(self.s[0][n] * q[2 + c] + self.s[1][n] * k_a[c]) for c in (0, 1)] for n in range(3)]
            y_b = [[-(self.s[2][n] * q[6 + c] + self.s[3][n] * k_b[c]) for c in (0, 1)] for n in range(3)]
            a, b = rate[8:]
            matter = (plus(rate[0:2], q[2:4], -a) + plus(rate[2:4], k_a, -a) + plus(rate[4:6], q[6:8], -b) +
                      plus(rate[6:8], k_b, -b))
            h_a, h_b = combine(at_a, 2, matter, l), combine(at_b, 2, matter, l)
            alpha = ([k_a[c] * a * a - 2 * rate[2 + c] * a for c in (0, 1)] + [-2 * h_a[c] * a - j_a[c] * a * a for c in (0, 1)] +
                     [k_b[c] * b * b - 2 * rate[6 + c] * b for c in (0, 1)] + [-2 * h_b[c] * b - j_b[c] * b * b for c in (0, 1)])
            self.r_v = combine(f, 0, alpha, l)
        self.columns = [[[self.s[j // 2][n] * (j % 2 == c) for c in (0, 1)] for j in range(8)] + [y_a[n], y_b[n]] for n in range(3)]
        self.v, self.v_x = ([sum(self.columns[n][j][c] * rate[j] for j in range(10)) for c in (0, 1)] for n in (0, 1))


# Chapter 2


def energy(r_x, r_xx):
    g, cross = dot(r_x, r_x), r_x[0] * r_xx[1] - r_x[1] * r_xx[0]
    return EA * ((g - 1) / 2) ** 2 / 2 + EI * cross**2 / g**3 / 2


def stresses(r_x, r_xx):
    g, cross = dot(r_x, r_x), r_x[0] * r_xx[1] - r_x[1] * r_xx[0]
    along = EA * (g - 1) / 2 - 3 * EI * cross**2 / g**4
    bend = EI * cross / g**3
    return [along * r_x[0] + bend * r_xx[1], along * r_x[1] - bend * r_xx[0]], [-bend * r_x[1], bend * r_x[0]]


def lagrangian(q, rate, kind, rule):
    l, total = q[9] - q[8], mpf(0)
    for u, weight in rule:
        at = Point(u, q, rate, kind)
        total += weight * l * (RHO_A * dot(at.v, at.v) / 2 - energy(at.r_x, at.r_xx) + RHO_A * dot(GRAVITY, at.r))
    return total


def lagranges_equations(q, rate, acceleration, kind, rule):
    def momentum(j, t):
        there = [a + b * t + c * t * t / 2 for a, b, c in zip(q, rate, acceleration)]
        then = plus(rate, acceleration, t)
        return difference(lambda h: lagrangian(there, plus(then, unit(j), h), kind, rule))

    return [difference(lambda t, j=j: momentum(j, t)) - difference(lambda h, j=j: lagrangian(plus(q, unit(j), h), rate, kind, rule))
            for j in range(10)]


def residual(q, rate, acceleration, kind, rule, variational=False, ends=False):
    """M q'' - Q of (2.6), with what (2.11) and (2.12) add, or with the ends of (5.2) and (5.4)."""
    l, l_rate, r = q[9] - q[8], rate[9] - rate[8], [mpf(0)] * 10
    for u, weight in rule:
        at = Point(u, q, rate, kind)
        n, n_x, n_xx = at.columns
        p, m = stresses(at.r_x, at.r_xx)
        a = [sum(n[j][c] * acceleration[j] for j in range(10)) + at.r_v[c] - GRAVITY[c] for c in (0, 1)]
        for j in range(10):
            r[j] += weight * l * (RHO_A * dot(n[j], a) + dot(p, n_x[j]) + dot(m, n_xx[j]))
        if variational:
            c = rate[8] * (1 - u) + rate[9] * u
            for j in range(10):
                r[j] += weight * RHO_A * (l_rate * dot(n[j], at.v) + l * c * (dot(n_x[j], at.v) + dot(n[j], at.v_x)))
            per_length = RHO_A * dot(at.v, at.v) / 2 - energy(at.r_x, at.r_xx) + RHO_A * dot(GRAVITY, at.r)
            along = RHO_A * (dot(at.v, at.v_x) + dot(GRAVITY, at.r_x)) - dot(p, at.r_xx) - dot(m, at.r_xxx)
            r[9] -= weight * (per_length + l * u * along)
            r[8] -= weight * (l * (1 - u) * along - per_length)
    for u, sign, mark in ((mpf(1), 1, 9), (mpf(0), -1, 8)) if ends else ():
        at = Point(u, q, rate, kind)
        for j in range(10):
            r[j] += sign * rate[mark] * RHO_A * dot(at.columns[0][j], at.v)
        r[mark] -= sign * (RHO_A * dot(at.v, at.v) / 2 - energy(at.r_x, at.r_xx) + RHO_A * dot(GRAVITY, at.r))
    return r


def check_an_element():
    q = [mpf(0), mpf(0), mpf("1.05"), mpf("0.1"), mpf("0.6"), mpf("0.2"), mpf("0.9"), mpf("0.4"), mpf("0.2"), mpf("0.9")]
    rate, acceleration = [number() for _ in range(10)], [number() for _ in range(10)]
    x = mpf("0.37")
    for kind in ("frozen", "transported"):
        at = Point((x - q[8]) / (q[9] - q[8]), q, rate, kind)
        found = [difference(lambda h, j=j: position(x, plus(q, unit(j), h), kind)) for j in (8, 9)]
        say(f"(1.11), (1.14)  y_A and y_B, {kind}", max(largest(a, b) for a, b in zip(found, at.columns[0][8:])), 1e-25)
        say(f"(1.12), (1.16)  r_v, {kind}", largest(second(lambda t: position(x, plus(q, rate, t), kind)), at.r_v), 1e-20)
        for points in (3, 5):
            rule = gauss(points)
            say(f"(2.11) to (2.13)  against Lagrange's equations, {kind}, {points} points",
                largest(lagranges_equations(q, rate, acceleration, kind, rule),
                        residual(q, rate, acceleration, kind, rule, variational=True)), 1e-24)
        rule = gauss(24)
        say(f"(5.2), (5.4)  ends, against (2.11) with 24 points, {kind}",
            largest(residual(q, rate, acceleration, kind, rule, variational=True),
                    residual(q, rate, acceleration, kind, rule, ends=True)), 1e-12)
    p, m = stresses(at.r_x, at.r_xx)
    found = [difference(lambda h, c=c: energy(plus(at.r_x, unit(c, 2), h), at.r_xx)) for c in (0, 1)]
    found += [difference(lambda h, c=c: energy(at.r_x, plus(at.r_xx, unit(c, 2), h))) for c in (0, 1)]
    say("(2.3)  p and m", largest(found, p + m), 1e-25)


def check_a_joint():
    """Two elements in any motion: what the virtual work's equations leave of the power of the energy."""
    rule = gauss(24)
    for kind in ("frozen", "transported"):
        for kink in (False, True):
            a, i, b = [mpf(0), mpf(0), mpf(1), mpf("0.2")], [mpf("0.5"), mpf("0.1"), mpf("1.05"), mpf("0.3")], [mpf("0.8"), mpf("0.3"), mpf("0.9"), mpf("0.7")]
            behind = [number() for _ in range(2)] if kink else None

            def both(of_a, of_i, of_b, other, x_a, x, x_b):
                return of_a + of_i + [x_a, x], of_i[:2] + (other or of_i[2:]) + of_b + [x, x_b]

            q = both(a, i, b, [mpf("0.9"), mpf("-0.1")] if kink else None, mpf(0), mpf("0.5"), mpf("0.85"))
            values = [[number() for _ in range(4)] for _ in range(6)]
            x_rate, x_rate2 = number(), number()
            rates = both(*values[:3], behind, mpf(0), x_rate, mpf(0))
            accelerations = both(*values[3:], behind, mpf(0), x_rate2, mpf(0))

            def total(t):
                found = mpf(0)
                for at_0, rate, acceleration in zip(q, rates, accelerations):
                    there = [p + v * t + c * t * t / 2 for p, v, c in zip(at_0, rate, acceleration)]
                    then = plus(rate, acceleration, t)
                    for u, weight in rule:
                        at = Point(u, there, then, kind)
                        found += weight * (there[9] - there[8]) * (RHO_A * dot(at.v, at.v) / 2 + energy(at.r_x, at.r_xx) -
                                                                   RHO_A * dot(GRAVITY, at.r))
                return found

            power = sum(dot(residual(p, v, c, kind, rule), v) for p, v, c in zip(q, rates, accelerations))
            left, right = Point(mpf(1), q[0], rates[0], kind), Point(mpf(0), q[1], rates[1], kind)
            jump = energy(right.r_x, right.r_xx) - energy(left.r_x, left.r_xx)  # W+ - W-
            lost = difference(total) - power
            if not kink:
                say(f"(5.9)  power that the virtual work loses, {kind}, {nstr(lost, 6)} W", abs(lost + x_rate * jump), 1e-10)
            flux = [x_rate * RHO_A * (m - p) for m, p in zip(left.v, right.v)]
            on_x = (-x_rate * RHO_A * (dot(left.r_x, left.v) - dot(right.r_x, right.v)) -
                    RHO_A * (dot(left.v, left.v) - dot(right.v, right.v)) / 2 - jump)
            say(f"(5.7)  energy with force and flux, {kind}{', kink' if kink else ''}",
                abs(lost - dot(flux, rates[0][4:6]) - on_x * x_rate), 1e-10)


def check_the_rest():
    # (3.3) to (3.5) in space
    a, b = [mpf("1.1"), mpf("0.3"), mpf("0.2")], [mpf("0.4"), mpf("-0.9"), mpf("0.5")]

    def cross(x, y):
        return [x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]]

    def gradients(x, y):
        g, f = dot(x, x), cross(x, y)
        p = plus([EA * (g - 1) / 2 * c - 3 * EI * dot(f, f) / g**4 * c for c in x], cross(y, f), EI / g**3)
        return p + [EI / g**3 * c for c in cross(f, x)]

    g, s, h = dot(a, a), dot(a, b), dot(b, b)
    w_g, w_s, w_h = EA / 4 * (g - 1) + EI / 2 * (3 * s * s / g**4 - 2 * h / g**3), -EI * s / g**3, EI / (2 * g**2)
    w_gg, w_gs, w_gh = EA / 4 + EI / 2 * (6 * h / g**4 - 12 * s * s / g**5), 3 * EI * s / g**4, -EI / g**3
    w_ss, worst = w_gh, mpf(0)
    for j in range(3):
        by_a = difference(lambda t, j=j: gradients(plus(a, unit(j, 3), t), b))
        by_b = difference(lambda t, j=j: gradients(a, plus(b, unit(j, 3), t)))
        for i in range(3):
            same = i == j
            pp = 2 * w_g * same + 4 * w_gg * a[i] * a[j] + 2 * w_gs * (a[i] * b[j] + b[i] * a[j]) + w_ss * b[i] * b[j]
            pm = w_s * same + 2 * w_gs * a[i] * a[j] + 4 * w_gh * a[i] * b[j] + w_ss * b[i] * a[j]
            mm = 2 * w_h * same + w_ss * a[i] * a[j]
            worst = max(worst, abs(by_a[i] - pp), abs(by_b[i] - pm), abs(by_b[3 + i] - mm))
    say("(3.5)  second derivatives of the strain energy", worst, 1e-24)

    turn = pi * 40 / 180
    for name, w, stretch in (("(8.1)  even", (turn * cot(turn / 4) - 1) / 3, 1), ("(8.2)  exact", (1 + 2 * cos(turn / 2)) / 3, 2 * sin(turn / 2) / turn)):
        e = [mpf(1), mpf(0), mpf(0), stretch, cos(turn), sin(turn), -stretch * sin(turn), stretch * cos(turn)]
        off = [combine(shapes(mpf(k) / 100, [1, w, w, 1]), n, e, turn) for k in range(101) for n in (0, 1)]
        far, uneven = (max(abs(sqrt(dot(p, p)) - 1) for p in off[n::2]) for n in (0, 1))
        say(f"{name} arc of 40 degrees, off the circle; uneven by {nstr(uneven, 2)}", far, 1e-6)

    def rest(x_a, x_b):
        return [sin(x_a), 1 - cos(x_a), cos(x_a), sin(x_a), sin(x_b), 1 - cos(x_b), cos(x_b), sin(x_b), x_a, x_b]

    x_a, x_b, x = mpf("0.2"), mpf("0.9"), mpf("0.4")
    for kind in ("frozen", "transported"):
        at = Point((x - x_a) / (x_b - x_a), rest(x_a, x_b), [mpf(0)] * 10, kind)
        by_b = plus([at.s[2][0] * cos(x_b) - at.s[3][0] * sin(x_b), at.s[2][0] * sin(x_b) + at.s[3][0] * cos(x_b)], at.columns[0][9])
        say(f"(8.5)  rest shape by x_B, {kind}", largest(by_b, difference(lambda h: position(x, rest(x_a, x_b + h), kind))), 1e-25)

    j, gi, xa, xb, va, vb, acc = mpf("1.3"), mpf("0.7"), mpf("0.2"), mpf("0.9"), number(), number(), [number() for _ in range(4)]
    angles, rates = [number(), number()] + [xa, xb], [number(), number(), va, vb]

    def of_spin(q, v):
        l = q[3] - q[2]
        tau = (q[1] - q[0]) / l
        w_a, w_b = v[0] - tau * v[2], v[1] - tau * v[3]
        return j * l / 6 * (w_a**2 + w_a * w_b + w_b**2) - gi * l / 2 * tau**2

    def by_lagrange(k):
        def momentum(t):
            there = [p + v * t + c * t * t / 2 for p, v, c in zip(angles, rates, acc)]
            return difference(lambda h: of_spin(there, plus(plus(rates, acc, t), unit(k, 4), h)))

        return difference(momentum) - difference(lambda h: of_spin(plus(angles, unit(k, 4), h), rates))

    def by_virtual_work(k):
        def angle(y, q):
            return q[0] + (q[1] - q[0]) / (q[3] - q[2]) * (y - q[2])

        total, l = mpf(0), xb - xa
        tau = (angles[1] - angles[0]) / l
        for u, weight in gauss(6):
            y = xa + u * l
            path = lambda t: [angle(y, [p + v * t + c * t * t / 2 for p, v, c in zip(angles, rates, acc)])]  # noqa: E731
            by_k = difference(lambda h: angle(y, plus(angles, unit(k, 4), h)))
            total += weight * l * (j * second(path)[0] * by_k)
            total += weight * l * gi * tau * difference(
                lambda h: difference(lambda d: angle(y + d, plus(angles, unit(k, 4), h))))
        return total

    tau = (angles[1] - angles[0]) / (xb - xa)
    w_b = rates[1] - tau * vb
    say("(10.3)  flux on the angle", abs(by_lagrange(1) - by_virtual_work(1) - j * vb * w_b), 1e-20)
    say("(10.3)  flux on the mark", abs(by_lagrange(3) - by_virtual_work(3) + j * vb * tau * w_b + j * w_b**2 / 2 - gi * tau**2 / 2), 1e-20)

    def torsion(i, n):
        phi = (2 * i - 1) * pi / (2 * n)
        return 100 * (sqrt(6 * (1 - cos(phi)) / (2 + cos(phi))) / phi - 1)

    say("(11.5)  mode 2 of 9 elements less mode 1 of 3, in %", abs(torsion(2, 9) - torsion(1, 3)), 1e-40)
    print("        modes 1, 1, 2, 2, 5 of 3, 4, 9, 10, 10 elements, in %:", *(nstr(torsion(*at), 5) for at in ((1, 3), (1, 4), (2, 9), (2, 10), (5, 10))))

    mu, phi, tension = mpf("0.3"), mpf("1.1"), mpf(2)
    ahead = tension * exp(mu * phi)
    contact = sqrt((ahead * cos(phi) - tension) ** 2 + (ahead * sin(phi)) ** 2)
    t, k = tanh(mu * phi / 2), sin(phi / 2) ** 2
    say("(12.12) friction at a kink", abs(ahead - tension - contact * t / sqrt(t * t + k * (1 - t * t))), 1e-40)


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def direction(a):
    return [x / sqrt(dot(a, a)) for x in a]


def carried(a, b, v):
    """(16.1)."""
    k = dot(b, v) / (1 + dot(a, b))
    return [x - k * (y + z) for x, y, z in zip(v, a, b)]


def turned(t, angle, v):
    return plus([cos(angle) * x for x in v], cross(t, v), sin(angle))


def across(t, v):
    return direction(plus(v, t, -dot(t, v)))


def check_frames():
    vector = lambda: [number() for _ in range(3)]  # noqa: E731
    a, b = direction(vector()), direction(vector())
    v = across(a, vector())
    axis = cross(a, b)
    by_rodrigues = plus(plus([dot(a, b) * x for x in v], cross(axis, v)), axis, dot(axis, v) / (1 + dot(a, b)))
    say("(16.1)  smallest rotation", largest(carried(a, b, v), by_rodrigues), 1e-50)

    t0 = direction(vector())
    d0, s0, s1, s2, phi = across(t0, vector()), plus(t0, vector(), mpf("0.4")), vector(), vector(), [number() for _ in range(3)]
    slope = lambda t: [x + t * y + t * t * z for x, y, z in zip(s0, s1, s2)]  # noqa: E731
    angle = lambda t: phi[0] + t * phi[1] + t * t * phi[2]  # noqa: E731

    def potential(s):
        size = sqrt(dot(s, s))
        return [-x / (size * (size + dot(t0, s))) for x in cross(t0, s)]

    def section(s, at):
        t = direction(s)
        return turned(t, at, carried(t0, t, d0))

    d, rate = section(s0, phi[0]), difference(lambda h: section(slope(h), angle(h)))
    say("(16.2)  spin about the tangent", abs(dot(direction(s0), cross(d, rate)) - phi[1] - dot(potential(s0), s1)), 1e-25)
    by = [difference(lambda h: potential(plus(s0, unit(k, 3), h))) for k in range(3)]
    curl = [by[1][2] - by[2][1], by[2][0] - by[0][2], by[0][1] - by[1][0]]
    monopole = lambda s: [x / dot(s, s) ** mpf("1.5") for x in s]  # noqa: E731
    say("(16.3)  its curl", largest(curl, [-x for x in monopole(s0)]), 1e-25)

    def momentum(s, v, w):
        return w + dot(potential(s), v)

    v0 = lambda t: plus(s1, [2 * t * x for x in s2])  # noqa: E731
    w0 = lambda t: phi[1] + 2 * t * phi[2]  # noqa: E731
    p = lambda t: momentum(slope(t), v0(t), w0(t))  # noqa: E731
    by_lagrange = difference(lambda h: [p(h) * x for x in potential(slope(h))])
    by_slope = [difference(lambda h: momentum(plus(s0, unit(k, 3), h), s1, phi[1]) ** 2 / 2) for k in range(3)]
    ours = plus([difference(p) * x for x in potential(s0)], cross(s1, monopole(s0)), p(mpf(0)))
    say("(16.8)  inertia about the tangent", largest(plus(by_lagrange, by_slope, -1), ours), 1e-25)

    l, beta, ends = mpf("0.7"), mpf("0.2"), []
    q = [vector(), plus(t0, vector(), mpf("0.3")), None, plus(t0, vector(), mpf("0.3"))]
    q[2] = plus(q[0], plus(t0, vector(), mpf("0.2")), l)

    def axis_at(u, q):
        v = 1 - u
        b = v**3 + 3 * v * v * u, l * v * v * u, u**3 + 3 * u * u * v, -l * u * u * v
        return [dot(b, [part[c] for part in q]) for c in range(3)]

    slope_at = lambda u, q: [x / l for x in difference(lambda h: axis_at(u + h, q))]  # noqa: E731
    for s in (q[1], q[3]):
        ends.append(across(direction(s), vector()))

    def frame(u, q, ends):
        m, t = direction(slope_at(mpf("0.5"), q)), direction(slope_at(u, q))
        at_a, at_b = (carried(direction(s), m, d) for s, d in zip((q[1], q[3]), ends))
        twist = atan2(dot(m, cross(at_a, at_b)), dot(at_a, at_b))
        return t, carried(m, t, turned(m, u * twist + 4 * u * (1 - u) * beta, at_a)), twist, m

    u, h = mpf("0.3"), mpf(10) ** -12
    t, f, twist, m = frame(u, q, ends)
    r_x, r_xx = slope_at(u, q), [x / l for x in difference(lambda d: slope_at(u + d, q), h)]
    k = [x / sqrt(dot(r_x, r_x)) ** 3 for x in cross(r_x, r_xx)]
    torsion = (twist + 4 * (1 - 2 * u) * beta) / (l * sqrt(dot(r_x, r_x))) - dot(m, k) / (1 + dot(m, t))
    by_frame = dot(cross(t, f), difference(lambda d: frame(u + d, q, ends)[1], h)) / (l * sqrt(dot(r_x, r_x)))
    say("(16.5)  torsion is how the frame turns", abs(torsion - by_frame), 1e-15)


if __name__ == "__main__":
    check_an_element()
    check_a_joint()
    check_the_rest()
    check_frames()
    sys.exit(f"too far off: {', '.join(failed)}" if failed else 0)
