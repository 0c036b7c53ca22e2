"""Frequencies of a hanging chain, with and without a weight at its end, and of Beck's column.

Chain of length L that hangs from its upper end, y from the lower one, T = rho g y + M g:  (T u')' = -rho omega^2 u,  u(L) = 0 and at the end
T u' = -M omega^2 u. With z = 2 omega sqrt((y + M/rho)/g): u = A J0(z) + B Y0(z); without M omega_n = j_0n sqrt(g/L)/2.

Beck's column: a cantilever, EI = rhoA = L = 1, under a force p that stays tangential at its end: w'''' + p w'' = omega^2 w,
w = w' = 0 at 0, w'' = w''' = 0 at 1:
    2 omega^2 + p^2 + 2 omega^2 cosh(a) cos(b) + p omega sinh(a) sin(b) = 0,   a^2, b^2 = sqrt(p^2/4 + omega^2) -+ p/2.
The two lowest frequencies meet at the critical load, where it and its derivative by omega are 0: flutter.

Sources: Lamb, Hydrodynamics, 190 (chain: Bernoulli, 1733); Beck, Z. angew. Math. Phys. 3 (1952) 225.
Errors: the power series of u in y; the determinant of the boundary conditions for a solution in power series of x. Command: make.py columns
"""
import mpmath as mp

from common import case, newton, precisely, roots

g = mp.mpf("9.81")


def chain(rho, M, L, count):
    if M == 0:
        return [mp.besseljzero(0, n) * mp.sqrt(g / L) / 2 for n in range(1, count + 1)]
    def off(omega):
        top, end = [2 * omega * mp.sqrt((y + M / rho) / g) for y in (L, 0)]
        # at the end T u' = -M omega^2 u with dz/dy = 2 omega^2/(g z): u_z = -z u/2
        j, y = [-f(1, end) + end / 2 * f(0, end) for f in (mp.besselj, mp.bessely)]
        return j * mp.bessely(0, top) - y * mp.besselj(0, top)
    return roots(off, mp.sqrt(g / L) / 20, mp.sqrt(g / L) / 5, count)


def chain_by_series(rho, M, L, count):
    """T u'' + rho g u' + rho omega^2 u = 0 in powers of y/L, from u = 1 at the lower end."""
    mu = mp.mpf(M) / (rho * L)
    def top(omega):
        q = omega * omega * L / g
        if mu == 0:  # (n + 1)^2 c_(n+1) = -q c_n
            c, total, n = mp.mpf(1), mp.mpf(1), 0
            while abs(c) > mp.mpf(10) ** (-mp.mp.dps - 5):
                c *= -q / mp.mpf(n + 1) ** 2
                total, n = total + c, n + 1
            return total
        # powers of eta = log(1 + y/(mu L)), for which u'' + q mu exp(eta) u = 0; steps short enough for a series each
        u, slope, steps = mp.mpf(1), -q * mu, 8
        h = mp.log(1 + 1 / mu) / steps
        for k in range(steps):
            f, c = q * mu * mp.exp(k * h), [u, slope]
            weights = [f / mp.factorial(i) for i in range(60)]
            for n in range(58):
                c.append(-sum(weights[i] * c[n - i] for i in range(n + 1)) / ((n + 1) * (n + 2)))
            u, slope = mp.polyval(c[::-1], h), mp.polyval([n * c[n] for n in range(len(c) - 1, 0, -1)], h)
        return u
    return roots(top, mp.sqrt(g / L) / 20, mp.sqrt(g / L) / 5, count)


def beck(omega, p):
    middle = mp.sqrt(p * p / 4 + omega * omega)
    a, b = mp.sqrt(middle - p / 2), mp.sqrt(middle + p / 2)
    return 2 * omega**2 + p * p + 2 * omega**2 * mp.cosh(a) * mp.cos(b) + p * omega * mp.sinh(a) * mp.sin(b)


def beck_by_series(omega, p):
    """w''' and w'' at 1 of the solutions that start with x^2 and x^3."""
    columns = []
    for start in (2, 3):
        c = [mp.mpf(0)] * 4
        c[start] = mp.mpf(1)
        for n in range(4, 70):
            c.append((omega**2 * c[n - 4] - p * (n - 2) * (n - 3) * c[n - 2]) / (n * (n - 1) * (n - 2) * (n - 3)))
        columns.append((sum(n * (n - 1) * c[n] for n in range(70)), sum(n * (n - 1) * (n - 2) * c[n] for n in range(70))))
    return columns[0][0] * columns[1][1] - columns[0][1] * columns[1][0]


def critical(equation):
    derivative = lambda omega, p: mp.diff(lambda x: equation(x, p), omega, h=mp.mpf(10) ** (-mp.mp.dps // 3))
    omega, p = newton(lambda x: [equation(*x), derivative(*x)], [11, 20])
    return {"load": p, "omega": omega}


def cases():
    for mass in (0, 1):
        data = mp.mpf(2), mp.mpf(mass), mp.mpf(1), 4
        yield case(f"hanging chain, {mass} kg at its end", "roots", "Lamb, Hydrodynamics, 190", {"g": 9.81, "rho": 2, "mass": mass, "length": 1},
                   {"rho": "kg/m", "mass": "kg", "length": "m", "omega": "rad/s"},
                   [precisely(lambda: {"omega": chain(*data)}, 30), precisely(lambda: {"omega": chain_by_series(*data)}, 35)], "power series")
    units, source = {"load": "EI/L^2", "omega": "sqrt(EI/rhoA)/L^2"}, "Beck, Z. angew. Math. Phys. 3 (1952) 225"
    yield case("Beck's column, critical load", "roots", source, {}, units,
               [precisely(lambda equation=equation: critical(equation), 60) for equation in (beck, beck_by_series)], "power series")
    for p in (0, 5, 10, 15, 20):
        of = lambda equation: {"omega": roots(lambda x: equation(x, mp.mpf(p)), mp.mpf("0.5"), mp.mpf("0.2"), 3)}
        yield case(f"Beck's column, p = {p}", "roots", source, {"load": p}, units,
                   [precisely(lambda: of(beck), 30), precisely(lambda: of(beck_by_series), 35)], "power series")
