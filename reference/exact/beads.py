"""Beads that slide without friction on rigid wires.

straight    s = s_0 + v_0 t + g sin(a) t^2/2 down a wire inclined by a
circular    a pendulum of length R: phi from the lowest point, phi_0 at rest at first, k = sin(phi_0/2), w = sqrt(g/R):
            sin(phi/2) = k cd(w t), period 4 K(k)/w, force of the wire m (g cos phi + R phi'^2), at the bottom m g (3 - 2 cos phi_0)
rotating    a straight wire through the axis turns at w, the bead at r_0 at rest on it: r = r_0 cosh(w t), force across it 2 m w r'. In a
            vertical plane, horizontal at first: r'' = w^2 r - g sin(w t), r = r_0 cosh(w t) + g (sin(w t) - sinh(w t))/(2 w^2),
            force across it m (2 w r' + g cos(w t))
hoop        a vertical hoop of radius R turns about its vertical diameter at w: the bead rests at cos phi = g/(w^2 R), and swings about that with
            the frequency w sin phi (small amplitudes)

Source: Whittaker, Analytical Dynamics, chapter 4; elliptic functions: NIST DLMF 22.19.
Errors: against the equations of motion, of the turning wire in space-fixed coordinates, integrated in steps of order 10. Command: make.py beads
"""
import mpmath as mp

from common import case, integrate, newton, precisely

g = mp.mpf("9.81")


def circular(R, m, phi0, times):
    k2, w = mp.sin(phi0 / 2) ** 2, mp.sqrt(g / R)
    phi = [2 * mp.asin(mp.sqrt(k2) * mp.ellipfun("cd", w * t, m=k2)) for t in times]
    force = [m * g * (3 * mp.cos(p) - 2 * mp.cos(phi0)) for p in phi]
    return {"angle": [phi0 - p for p in phi], "x": [R - R * mp.sin(p) for p in phi], "y": [-R * mp.cos(p) for p in phi], "force": force,
            "period": 4 * mp.ellipk(k2) / w, "speed_bottom": mp.sqrt(2 * g * R * (1 - mp.cos(phi0))), "force_bottom": m * g * (3 - 2 * mp.cos(phi0))}


def circular_by_steps(R, m, phi0, times):
    rates = lambda _, q: [q[1], -g / R * mp.sin(q[0])]
    at = lambda t: integrate(rates, [phi0, mp.mpf(0)], mp.mpf(0), t, 40)
    states = [at(t) for t in times]
    quarter = newton(lambda t: [at(t[0])[0]], [mp.mpf(1.11) * mp.pi / 2 * mp.sqrt(R / g)])[0]
    force = lambda q: m * (g * mp.cos(q[0]) + R * q[1] ** 2)
    return {"angle": [phi0 - q[0] for q in states], "x": [R - R * mp.sin(q[0]) for q in states], "y": [-R * mp.cos(q[0]) for q in states],
            "force": [force(q) for q in states], "period": 4 * quarter, "speed_bottom": -R * at(quarter)[1], "force_bottom": force(at(quarter))}


def rotating(w, r0, m, gravity, t):
    r = r0 * mp.cosh(w * t) + gravity / (2 * w * w) * (mp.sin(w * t) - mp.sinh(w * t))
    v = r0 * w * mp.sinh(w * t) + gravity / (2 * w) * (mp.cos(w * t) - mp.cosh(w * t))
    return {"r": r, "rate": v, "force": m * (2 * w * v + gravity * mp.cos(w * t))}


def rotating_by_steps(w, r0, m, gravity, t):
    """In space-fixed x, y: the wire's force N across the wire holds y cos(w t) = x sin(w t)."""
    def force(t, q):
        c, s = mp.cos(w * t), mp.sin(w * t)
        return m * (2 * w * (q[2] * c + q[3] * s) + gravity * c)
    def rates(t, q):
        N = force(t, q) / m
        return [q[2], q[3], -N * mp.sin(w * t), N * mp.cos(w * t) - gravity]
    q = integrate(rates, [r0, mp.mpf(0), mp.mpf(0), r0 * w], mp.mpf(0), t, 30)
    # holding the wire is not imposed: x, y leave it by the error of the steps
    return {"r": q[0] * mp.cos(w * t) + q[1] * mp.sin(w * t), "rate": q[2] * mp.cos(w * t) + q[3] * mp.sin(w * t), "force": force(t, q)}


def hoop(w, R):
    cosine = g / (w * w * R)
    return {"angle": mp.acos(cosine), "frequency": w * mp.sqrt(1 - cosine**2) / (2 * mp.pi)}


def hoop_by_potential(w, R):
    V = lambda phi: -g / R * mp.cos(phi) - w * w / 2 * mp.sin(phi) ** 2
    phi = newton(lambda x: [mp.diff(V, x[0])], [mp.pi / 3])[0]
    return {"angle": phi, "frequency": mp.sqrt(mp.diff(V, phi, 2)) / (2 * mp.pi)}


def cases():
    source = "Whittaker, Analytical Dynamics, chapter 4"
    units = {"s, x, y, r": "m", "angle": "rad", "t": "s", "period": "s", "force": "N", "rate, speed": "m/s", "mass": "kg", "w": "rad/s", "frequency": "Hz"}
    times = [mp.mpf(i) / 10 for i in range(1, 6)]
    s0, slope = mp.mpf("0.1"), mp.sin(mp.pi / 6)
    yield case("bead on a straight wire", "closed form", "s = s_0 + g sin(a) t^2/2", {"g": 9.81, "inclination": 30, "s_0": 0.1, "t": [float(t) for t in times]},
               {**units, "inclination": "degrees"}, [lambda: {"s": [s0 + g * slope * t * t / 2 for t in times]},
               precisely(lambda: {"s": [integrate(lambda _, q: [q[1], g * slope], [s0, mp.mpf(0)], mp.mpf(0), t, 5)[0] for t in times]}, 24)], "integration")
    for start, mass in (*((k * mp.pi / 16, 0.8) for k in (1, 2, 3, 4, 6)), (mp.mpf(0), 1)):
        data = mp.mpf(2), mp.mpf(mass), mp.pi / 2 - start, [mp.mpf(i) / 4 for i in range(1, 7)]
        yield case(f"bead on a circular wire, from {float(start * 180 / mp.pi):g} degrees below the horizontal", "closed form", "NIST DLMF 22.19; " + source,
                   {"g": 9.81, "radius": 2, "mass": mass, "start": float(start), "t": [float(t) for t in data[3]],
                    "places": "angle from the horizontal radius at the left, x from its end, y from the centre"},
                   {**units, "radius": "m", "start": "rad"}, [lambda: circular(*data), precisely(lambda: circular_by_steps(*data), 24)], "integration")
    for gravity in (mp.mpf(0), g):
        data = mp.mpf(4), mp.mpf("0.5"), mp.mpf("0.5"), gravity, mp.mpf("0.4")
        yield case(f"bead on a wire that turns, {'vertical plane' if gravity else 'without gravity'}", "closed form", source + ": r'' = w^2 r - g sin(w t)",
                   {"g": float(gravity), "w": 4, "r_0": 0.5, "mass": 0.5, "t": 0.4}, units,
                   [lambda: rotating(*data), precisely(lambda: rotating_by_steps(*data), 24)], "integration in space-fixed coordinates")
    yield case("bead on a hoop that turns about its vertical diameter", "closed form", source, {"g": 9.81, "w": 4, "radius": 1}, {**units, "radius": "m"},
               [lambda: hoop(mp.mpf(4), mp.mpf(1)), lambda: hoop_by_potential(mp.mpf(4), mp.mpf(1))], "derivatives of the potential by differences")
