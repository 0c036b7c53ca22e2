"""Inextensible rods that slide through a frictionless sleeve, bent by weights at their ends.

The sleeve is short and inclined by a; theta is the angle of the tangent that leads away from it, to the horizontal, P the weight at the end:
    EI theta'^2/2 = P (sin theta - sin theta_end),   l = int dtheta/sqrt(2 P (sin theta - sin theta_end)/EI)  from theta_end to theta at the sleeve
(a on the upper side, -a on the lower). With l the potential energy V of an arm changes by dV/dl = P sin theta_end: P sin(theta) at the sleeve
less EI theta'^2/2 there, the configurational force. The rod is in balance where dV/dl of both arms are the same.
arm scale           weights at both ends: P_1 sin theta_1 = P_2 sin theta_2, lengths l_1 + l_2 = L
rod in a sleeve     the other end bears nothing: theta_end = 0, l = int dtheta/sqrt(2 P sin theta/EI) from 0 to a, an elliptic integral of k^2 = 1/2

Source: Bosi, Misseroni, Dal Corso, Bigoni, Proc. R. Soc. A 470 (2014) 20140232 (arm scale).
Errors: shooting with the configurational forces; quadrature. Command: make.py sleeves
"""
import mpmath as mp

from common import bracketed, case, newton, precisely
from elastica import shoot


def side(P, EI, start, end):
    """Length, and the place of the end from the sleeve, of a rod that leaves it at the angle start and ends at the angle end, start > end."""
    # theta = end + u^2 leaves nothing singular
    rate = lambda u: mp.sqrt(2 * P / EI * mp.sinc(u * u / 2) * mp.cos(end + u * u / 2))
    part = lambda f: mp.quad(lambda u: 2 * f(end + u * u) / rate(u), [0, mp.sqrt(start - end)], method="gauss-legendre")
    return part(lambda _: 1), part(mp.cos), part(mp.sin)


def arms(EI, incline, low, high, x):
    """Both where the lower one ends at the angle x and dV/dl is the same of both."""
    return side(low, EI, -incline, x), side(high, EI, incline, mp.asin(low * mp.sin(x) / high))


def arm_scale(EI, L, incline, low, high):
    """Of the equilibria the one of the shortest lower arm, on which the weight low hangs."""
    steepest = -mp.pi / 2 if high >= low else -mp.asin(high / low)  # the upper arm's end hangs down there
    length = lambda x: sum(arm[0] for arm in arms(EI, incline, low, high, x)) - L
    with mp.workdps(15):
        angles = [-incline + (steepest + incline) * (i + mp.mpf(10) ** -6) / 40 for i in range(41)]
        signs = [length(x) for x in angles]
    i = next((i for i in range(40) if signs[i] * signs[i + 1] < 0), None)
    if i is None:
        raise ArithmeticError("no equilibrium")
    x = bracketed(length, angles[i + 1], angles[i])
    (a, xa, ya), (b, xb, yb) = arms(EI, incline, low, high, x)
    other = mp.asin(low * mp.sin(x) / high)
    slope = lambda P, start, end: P * mp.cos(end) / mp.diff(lambda e: side(P, EI, start, e)[0], end, h=mp.mpf(10) ** -12)
    return {"low_arm": a, "high_arm": b, "low_angle": x, "high_angle": other, "low_end": [-xa, ya], "high_end": [xb, yb],
            "second_derivative": slope(low, -incline, x) + slope(high, incline, other)}


def arm_scale_by_shooting(EI, L, incline, low, high, guess):
    """Moments at the sleeve and the length of the lower arm, from the configurational forces there."""
    arm = lambda P, start, mu, l: shoot("inextensible", 0, EI, (0, -P), start, mu, l, 24)
    def off(x):
        balance = (low + high) * mp.sin(incline) + (x[0] ** 2 - x[1] ** 2) / (2 * EI)
        return [arm(low, -incline, x[0], x[2])[3], arm(high, incline, x[1], L - x[2])[3], balance]
    m, n, a = newton(off, guess)
    one, two = arm(low, -incline, m, a), arm(high, incline, n, L - a)
    return {"low_arm": a, "high_arm": L - a, "low_angle": one[2], "high_angle": two[2], "low_end": [-one[0], one[1]], "high_end": two[:2]}


def free_length(P, EI, incline):
    """Of a rod whose other end is free: theta_end = 0."""
    phi, scale = mp.asin(mp.sqrt(2) * mp.sin((mp.pi / 2 - incline) / 2)), mp.sqrt(EI / P)
    F, E = mp.ellipk(0.5) - mp.ellipf(phi, 0.5), mp.ellipe(0.5) - mp.ellipe(phi, 0.5)
    return {"length": scale * F, "end": [scale * mp.sqrt(2 * mp.sin(incline)), scale * (2 * E - F)], "moment": mp.sqrt(2 * P * EI * mp.sin(incline))}


def cases():
    sleeve = "Bosi et al., Proc. R. Soc. A 470 (2014) 20140232: dV/dl = P sin theta_end"
    units = {"EI": "N m^2", "length, arms, ends": "m", "weights, P": "N", "inclination": "degrees", "angles": "rad", "moment": "N m", "second_derivative": "N/m"}
    for low, guess in (("1.5", (-0.13, -1.6, 0.1)), ("1.3", (-0.3, -1.5, 0.3))):
        data = mp.mpf(1), mp.mpf(2), mp.pi / 6, mp.mpf(low), mp.mpf(1)
        yield case(f"arm scale, {low} N and 1 N", "roots", sleeve, {"EI": 1, "length": 2, "inclination": 30, "low_weight": float(low), "high_weight": 1}, units,
                   [precisely(lambda: arm_scale(*data), 30), precisely(lambda: arm_scale_by_shooting(*data, guess), 24), precisely(lambda: arm_scale(*data), 25)],
                   "shooting with the configurational forces; the second derivative (negative: not stable) with 30 and 25 digits")
    for degrees in (15, 30, 60, 90):
        incline = degrees * mp.pi / 180
        data = mp.mpf(1), mp.mpf(1), incline

        def in_other_ways():
            length, *end = side(*data, mp.mpf(0))
            mu = newton(lambda m: [shoot("inextensible", 0, 1, (0, -1), incline, m[0], length, 24)[3]], [-mp.sqrt(2 * mp.sin(incline))])[0]
            return {"length": length, "end": end, "moment": -mu}

        yield case(f"rod in a sleeve, {degrees} degrees", "closed form", sleeve, {"EI": 1, "P": 1, "inclination": degrees}, units,
                   [lambda: free_length(*data), precisely(in_other_ways, 24)],
                   "quadrature of the lengths, shooting of the moment")
