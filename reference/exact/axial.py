"""Strings and tensioned beams that run along their axis at v between simple supports.

    w_tt + 2 v w_xt + (v^2 - 1) w_xx + k^2 w_xxxx = 0,   w = w_xx = 0 at x = 0, 1
lengths over L, v over c = sqrt(F/rhoA), times over L/c, k^2 = EI/(F L^2). With w = exp(i (omega t + beta x)):
    k^2 beta^4 + (1 - v^2) beta^2 - 2 v omega beta - omega^2 = 0.
Rows 1, beta^2, exp(i beta), beta^2 exp(i beta) of the four beta have the determinant 0. Divided by the Vandermonde determinant of the beta it is real
for real omega, and does not vanish where two beta meet. The string (k = 0): omega = n pi (1 - v^2). The lowest frequency is 0 at the critical
speed sqrt(1 + k^2 pi^2); below it the static operator is positive definite, hence all frequencies are real. At v = 0 they are
n pi sqrt(1 + k^2 n^2 pi^2).

Sources: Mote, J. Appl. Mech. 32 (1965) 463; Wickert and Mote, J. Appl. Mech. 57 (1990) 738.
Errors: Galerkin's method with sums of Legendre polynomials that vanish with their second derivatives at the supports; of the string the roots of its
characteristic equation. Command: make.py axial
"""
import mpmath as mp

from common import case, precisely, roots


def characteristic(omega, v, k):
    beta = mp.polyroots([k * k, 0, 1 - v * v, -2 * v * omega, -omega * omega], maxsteps=200, extraprec=100)
    e = [mp.exp(1j * b) for b in beta]
    vandermonde = mp.mpf(1)
    for i in range(4):
        for j in range(i):
            vandermonde *= beta[i] - beta[j]
    return (mp.det(mp.matrix([[1] * 4, [b * b for b in beta], e, [b * b * f for b, f in zip(beta, e)]])) / vandermonde).real


def frequencies(v, k, count):
    if k == 0:
        return [n * mp.pi * (1 - v * v) for n in range(1, count + 1)]
    return roots(lambda omega: characteristic(omega, v, k), mp.mpf(10) ** -6, mp.mpf("0.37"), count)


def string(v, count):
    """Two waves that cancel at both ends."""
    def equation(omega):
        a, b = mp.polyroots([1 - v * v, -2 * v * omega, -omega * omega])
        return (mp.expj(a) - mp.expj(b)) * mp.expj(-(a + b) / 2) / (2j * abs(a - b))
    return roots(lambda omega: equation(omega).real, mp.mpf("0.01"), mp.mpf("0.37"), count)


def galerkin(v, k, count, size):
    """The same from polynomials: M w_tt + G w_t + K w = 0, M and K symmetric, G antisymmetric."""
    # f_n = P_n + a P_(n+2) + b P_(n+4) on [-1, 1], f = f'' = 0 at both ends; derivatives twice those on [0, 1]
    second = lambda n: mp.mpf((n - 1) * n * (n + 1) * (n + 2)) / 8
    columns = []
    for n in range(size):
        p, q, r = second(n), second(n + 2), second(n + 4)
        b = (q - p) / (r - q)
        columns.append({n: mp.mpf(1), n + 2: -1 - b, n + 4: b})
    def derive(f):  # P_n' = (2 n - 1) P_(n-1) + (2 n - 5) P_(n-3) + ...
        g = {}
        for n, value in f.items():
            for m in range(n - 1, -1, -2):
                g[m] = g.get(m, 0) + 2 * value * (2 * m + 1)
        return g
    def product(f, g):
        return sum(value * g[n] / (2 * n + 1) for n, value in f.items() if n in g)
    slope = [derive(f) for f in columns]
    bend = [derive(f) for f in slope]
    M, G, K = mp.matrix(size), mp.matrix(size), mp.matrix(size)
    for i in range(size):
        for j in range(size):
            M[i, j], G[i, j] = product(columns[i], columns[j]), 2 * v * product(columns[i], slope[j])
            K[i, j] = (1 - v * v) * product(slope[i], slope[j]) + k * k * product(bend[i], bend[j])
    # w = exp(i omega t) y: omega^2 M y = (K + i omega G) y, in y and omega y
    big, inverse = mp.matrix(2 * size), M**-1
    big[:size, size:] = mp.eye(size)
    big[size:, :size], big[size:, size:] = inverse * K, inverse * G * 1j
    values = sorted(x.real for x in mp.eig(big, left=False, right=False) if x.real > 0)
    return values[:count]


def cases():
    source = "Mote, J. Appl. Mech. 32 (1965) 463; Wickert and Mote, J. Appl. Mech. 57 (1990) 738"
    units = {"v": "c", "k": "1", "frequencies": "rad per L/c", "critical_speed": "c"}
    for v in ("0", "0.3", "0.6"):
        speed = mp.mpf(v)
        yield case(f"moving string, v = {v} c", "closed form", source, {"v": float(v), "k": 0}, units,
                   [lambda: {"frequencies": frequencies(speed, 0, 4)}, lambda: {"frequencies": string(speed, 4)}], "the roots of its characteristic equation")
    for k in ("0.1", "0.5"):
        stiff = mp.mpf(k)
        critical = mp.sqrt(1 + stiff**2 * mp.pi**2)
        for v in ("0", "0.3", "0.6", "1.02"):
            speed = mp.mpf(v)
            yield case(f"moving beam, k = {k}, v = {v} c", "roots", source, {"v": float(v), "k": float(k)}, units,
                       [precisely(lambda: {"frequencies": frequencies(speed, stiff, 4), "critical_speed": critical}, 30),
                        precisely(lambda: {"frequencies": galerkin(speed, stiff, 4, 20),
                                           "critical_speed": mp.findroot(lambda u: static(u, stiff), critical * 1.001)}, 30)], "Galerkin's method, 20 polynomials")


def static(v, k):
    """Of the static equation with w = w_xx = 0: 0 where a half-wave of sine fits, (v^2 - 1) = k^2 pi^2 first."""
    return mp.sin(mp.sqrt(v * v - 1) / k)
