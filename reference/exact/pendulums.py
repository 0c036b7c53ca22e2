"""Pendulums: a weight on a massless elastic string, and one that is hoisted, the string's length L(t) given.

phi from the vertical, r the distance from the support, l = r/L the stretch, T(l) = EA l (l^2 - 1)/2 (green) or EA (l - 1) (engineering):
    r'' = r phi'^2 + g cos(phi) - T/m,   phi'' = -(g sin(phi) + 2 r' phi')/r;      inextensible: r = L(t)
Hoisted from rest: L(t) = L_0 - u t S(t/T_r), S(s) = s^4 (35 - 84 s + 70 s^2 - 20 s^3), then L_0 - u t.
If L changes little in a swing, the action of the swing stays: J = 16 m sqrt(g L^3) (E(k) - (1 - k^2) K(k)), k = sin(amplitude/2); for small
amplitudes L^(3/4) amplitude is constant.
Amplitudes are |phi| where phi' = 0.

Source: Landau and Lifshitz, Mechanics, 49 (adiabatic invariants); the equations from Lagrange's.
Errors: Cartesian coordinates (tension as a force) in shorter steps. Command: make.py pendulums
"""
import math

import mpmath as mp

from common import case, integrate

G = 9.81


def tension(law, EA, l):
    return EA * l * (l * l - 1) / 2 if law == "green" else EA * (l - 1)


def given_length(L0, speed, ramp):
    """L, L' and L'' at t."""
    def at(t):
        if t >= ramp:
            return L0 - speed * t, -speed, 0.0
        s = t / ramp
        S, dS, ddS = s**4 * (35 - 84 * s + 70 * s**2 - 20 * s**3), 140 * s**3 * (1 - s) ** 3, 420 * s**2 * (1 - s) ** 2 * (1 - 2 * s)
        return L0 - speed * t * S, -speed * (S + s * dS), -speed * (2 * dS + s * ddS) / ramp
    return at


def polar(law, EA, m, length):
    def rates(t, q):
        r, phi, v, w = q
        L, rate, second = length(t)
        if law == "inextensible":
            return [rate, w, second, -(G * math.sin(phi) + 2 * rate * w) / L]
        return [v, w, r * w * w + G * math.cos(phi) - tension(law, EA, r / L) / m, -(G * math.sin(phi) + 2 * v * w) / r]
    return rates


def cartesian(law, EA, m, length):
    def rates(t, q):
        x, y, u, v = q
        L, rate, second = length(t)
        r2 = x * x + y * y
        if law == "inextensible":  # x x'' + y y'' = L L'' + L'^2 - x'^2 - y'^2
            pull = (-G * y - L * second - rate * rate + u * u + v * v) / r2
        else:
            r = math.sqrt(r2)
            pull = tension(law, EA, r / L) / (m * r)
        return [u, v, -pull * x, -pull * y - G]
    return rates


def motion(law, EA, m, length, start, times, step, coordinates):
    """Places at times, and the turns of phi with their times, in steps not above this one that end at all of times."""
    x, y = start
    if coordinates == "polar":
        rates, state = polar(law, EA, m, length), [math.hypot(x, y), math.atan2(x, -y), 0.0, 0.0]
        place = lambda q: [q[0] * math.sin(q[1]), -q[0] * math.cos(q[1])]
        angle, turning = lambda q: q[1], lambda q: q[3]
    else:
        rates, state = cartesian(law, EA, m, length), [x, y, 0.0, 0.0]
        place = lambda q: q[:2]
        angle, turning = lambda q: math.atan2(q[0], -q[1]), lambda q: (q[1] * q[2] - q[0] * q[3]) / -(q[0] ** 2 + q[1] ** 2)
    t, places, turns = 0.0, [], []
    for end in times:
        count = math.ceil((end - t) / step - 1e-9)
        h, first = (end - t) / count, t
        for i in range(count):
            t = first + i * h
            after = integrate(rates, state, t, t + h, 1)
            if turning(state) * turning(after) < 0:
                a, b, fa, fb = 0.0, h, turning(state), turning(after)
                for _ in range(8):  # regula falsi, Illinois
                    c = (a * fb - b * fa) / (fb - fa)
                    inner = integrate(rates, state, t, t + c, 1)
                    fc = turning(inner)
                    if abs(fc) < 1e-15:
                        break
                    if fc * fb < 0:
                        a, fa = b, fb
                    else:
                        fa /= 2
                    b, fb = c, fc
                turns.append((t + c, abs(angle(inner))))
            state = after
        t = end
        places.append(place(state))
    return places, turns


def action(L, amplitude):
    k2 = mp.sin(mp.mpf(amplitude) / 2) ** 2
    return mp.sqrt(mp.mpf(L) ** 3) * (mp.ellipe(k2) - (1 - k2) * mp.ellipk(k2))


def hoisted(law, EA, m, data, start, times, step, coordinates):
    length = given_length(*data)
    places, turns = motion(law, EA, m, length, start, times, step, coordinates)
    last = [turn for turn in turns if turn[0] < 57][-1]
    first = turns[1]
    L0, L1 = length(first[0])[0], length(last[0])[0]
    return {"places": [p for place in places[1:] for p in place], "first_full_swing": list(first), "last_swing_before_57": list(last), "growth": last[1] / first[1],
            "growth_of_small_swings": (L0 / L1) ** 0.75, "action_ratio": action(L1, last[1]) / action(L0, first[1])}


def cases():
    source = "Landau and Lifshitz, Mechanics, 49; Lagrange's equations"
    units = {"EA": "N", "mass": "kg", "length": "m", "start, places": "m (x, y in turn)", "t": "s", "swings": "s, rad", "speed": "m/s", "ramp": "s"}
    for law in ("green", "engineering"):
        times, start = [0.25 * i for i in range(1, 9)], (0.6, -0.8)
        of = lambda step, kind: {"places": [p for place in motion(law, 200.0, 1.0, lambda t: (1.0, 0.0, 0.0), start, times, step, kind)[0] for p in place]}
        yield case(f"elastic pendulum, {law}", "ode", source, {"g": 9.81, "law": law, "EA": 200, "mass": 1, "length": 1, "start": start, "t": times}, units,
                   [lambda: of(0.0125, "polar"), lambda: of(0.01, "cartesian")], "Cartesian coordinates in shorter steps")
    data, start = (math.hypot(0.8, 7.9599), 0.08, 2.0), (0.8, -7.9599)
    times = [2.0] + [10.0 * i for i in range(1, 7)]
    for law, steps in (("inextensible", (0.05, 0.04)), ("green", (0.0125, 0.01))):
        of = lambda step, kind: hoisted(law, 8e5, 60.0, data, start, times, step, kind)
        yield case(f"hoisted pendulum, {law}", "ode", source, {"g": 9.81, "law": law, **({"EA": 8e5} if law == "green" else {}), "mass": 60, "length": data[0],
                   "speed": 0.08, "ramp": 2, "start": start, "t": times[1:]}, units, [lambda: of(steps[0], "polar"), lambda: of(steps[1], "cartesian")],
                   "Cartesian coordinates in shorter steps")
