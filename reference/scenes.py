#!/usr/bin/env python3
"""Writes reference/scenes.json: what the numbers of scenes/*.json should be, by closed forms, by independent programs, or
judged by their own convergence; and reference/winch.json, the path of the weight in scenes/winch.json. Needs mpmath.

    scenes.py
"""
import json
import math
import os

import mpmath as mp

mp.mp.dps = 30
here = os.path.dirname(os.path.abspath(__file__))


def read(name):
    with open(os.path.join(here, name)) as file:
        return json.load(file)


def scene(name):
    return read(os.path.join("..", "scenes", name + ".json"))


def smooth_step(s):
    return s**4 * (35 - 84 * s + 70 * s**2 - 20 * s**3) if 0 < s < 1 else mp.mpf(s >= 1)


def wave_at_free_end(given, speed, length, t):
    """d'Alembert: what a rod whose one end moves as `given` does at its free end."""
    terms = (mp.mpf(-1) ** n * given(t - (2 * n + 1) * length / speed) for n in range(20))
    return 2 * mp.fsum(terms)


def pulled_bar():
    given = scene("pulled_bar")
    motion = given["supports"][0]["motion"]
    f = lambda t: motion["direction"][0] * motion["value"] * smooth_step(mp.mpf(t) / motion["ramp"])
    return 1 + wave_at_free_end(f, mp.mpf(1), mp.mpf(1), given["duration"])


def torsion():
    given = scene("torsion")
    drive, material = given["spin"]["drives"][0]["angle"], given["beam"]["material"]
    shear = mp.mpf(material["youngs_modulus"]) / (2 * (1 + mp.mpf(material["poisson_ratio"])))
    f = lambda t: drive["value"] * smooth_step(mp.mpf(t) / drive["ramp"])
    return wave_at_free_end(f, mp.sqrt(shear / material["density"]), mp.mpf(1), given["duration"])


def winch():
    """Path of a pendulum whose length l(t) is given: l a'' + 2 l' a' + g sin a = 0. Gravity and winch start smoothly."""
    given = scene("winch")
    feed, growth = given["supports"][0]["feed"], given["gravity_ramp"]
    speed, start = mp.mpf(str(feed["rate"])), mp.mpf(str(feed["ramp"]))
    (x, y), ramp = given["beam"]["curve"]["end"], mp.mpf(str(growth))
    step_rate = lambda s: 140 * (s * (1 - s)) ** 3

    def swing(begin, until, state, gravity, length):
        def rates(t, at):
            l, change = length(t)
            return [at[1], -(2 * change * at[1] + gravity(t) * mp.sin(at[0])) / l]
        return [mp.odefun(rates, begin, state, tol=mp.mpf(10) ** -14)(t) for t in until]

    whole = mp.hypot(x, y)
    starting = lambda t: (whole + speed * t * smooth_step(t / start),
                          speed * smooth_step(t / start) + speed * t * step_rate(t / start) / start)
    running = lambda t: (whole + speed * t, speed)
    g = -mp.mpf(str(given["gravity"][1]))
    state, = swing(0, [ramp], [mp.asin(x / whole), mp.mpf(0)], lambda t: g * smooth_step(t / ramp), starting)
    state, = swing(ramp, [start], state, lambda t: g, starting)
    times = [start + (given["duration"] - start) * k / 20 for k in range(21)]
    states = swing(start, times, state, lambda t: g, running)
    return [{"t": float(t), "x": float(running(t)[0] * mp.sin(angle)), "y": float(-running(t)[0] * mp.cos(angle))}
            for t, (angle, _) in zip(times, states)]


def lead_screw():
    """A rigid screw with a nut that does not turn: (I + m l^2) theta'' = T - m g l, l the way of a radian. Gravity and
    torque grow alike, S(t/ramp), whose second integral over the ramp is 5/36 of its square."""
    given = scene("lead_screw")
    nut, load, length = given["sliding_joints"][0], given["loads"][0]["magnitude"], mp.mpf(1)
    lead, ramp, t = mp.mpf(str(nut["pitch"])) / (2 * mp.pi), mp.mpf(str(load["ramp"])), given["duration"]
    inertia = mp.mpf(str(given["beam"]["section"]["rhoIp"])) * length + nut["mass"] * lead**2
    weight = nut["mass"] * mp.mpf(str(-given["gravity"][1]))
    turned = ramp**2 * 5 / 36 + ramp / 2 * (t - ramp) + (t - ramp) ** 2 / 2
    return nut["position"] - lead * (load["value"] - weight * lead) / inertia * turned


def hanging_cable():
    """The force on each section, EA (lambda - 1), is the weight below it, rhoA g (L - s). Four seconds behind the ramp of two the
    slowest mode, omega = pi/2 sqrt(EA/rhoA)/L = 7.0 rad/s with the damping ratio 0.2 omega/2, is left with 8/pi^2 of the elongation
    times 2 x 0.70/(2 omega) exp(-4 x 0.70 omega), 6e-11 m at most."""
    section = scene("hanging_cable")["beam"]["section"]
    return -(1 + section["rhoA"] * G / (2 * section["EA"]))


def moving_force():
    """Modes of the simply supported Euler-Bernoulli beam under a force that moves over it, at the force."""
    given = scene("moving_force")
    section, load = given["beam"]["section"], given["loads"][0]
    speed, t, force = mp.mpf(load["x"]["rate"]), mp.mpf(given["duration"]), mp.mpf(load["magnitude"]["value"])
    EI, rhoA = mp.mpf(section["EI"]), mp.mpf(section["rhoA"])
    total = mp.mpf(0)
    for n in range(1, 401):
        k = n * mp.pi
        free, forced = k**2 * mp.sqrt(EI / rhoA), k * speed
        total += mp.sin(k * speed * t) * (mp.sin(forced * t) - forced / free * mp.sin(free * t)) / (free**2 - forced**2)
    return -2 * force / rhoA * total


def line_masses(given):
    """Of a rope's section [kg/m], and its length by the points of its axis [m]."""
    points = given["beam"]["curve"]["points"]
    lengths = [mp.hypot(b[0] - a[0], b[1] - a[1]) for a, b in zip(points, points[1:])]
    return mp.mpf(str(given["beam"]["section"]["rhoA"])), lengths


G = mp.mpf("9.81")


def over_a_ring(given, heavy, light, turning=0):
    """How far an inextensible rope runs towards its start: (M + I/r^2) s'' = g (m1 - m2 + rhoA (l1 - l2 + 2 s))."""
    rhoA, (first, second) = line_masses(given)
    whole = heavy + light + rhoA * (first + second) + turning
    drive, growth = G * (heavy - light + rhoA * (first - second)) / whole, 2 * G * rhoA / whole
    return first + drive / growth * (mp.cosh(mp.sqrt(growth) * given["duration"]) - 1)


def atwood():
    given = scene("atwood")
    pulley = given["sliding_joints"][0]["pulley"]
    return over_a_ring(given, 2, 1, mp.mpf(str(pulley["inertia"])) / mp.mpf(str(pulley["radius"])) ** 2)


def movable_pulley():
    """Lagrange's equation of the weight on the bight: between supports 0.4 m apart it hangs y deep, and the end of the
    rope rises by 2 sqrt(0.04 + y^2)."""
    given = scene("movable_pulley")
    half = lambda y: mp.sqrt(mp.mpf("0.04") + y**2)

    def rates(_, at):
        y, speed = at
        u, u_y = 2 * y / half(y), mp.mpf("0.08") / half(y) ** 3
        return [speed, (3 * G - u * G - u * u_y * speed**2) / (3 + u**2)]
    return mp.odefun(rates, 0, [mp.mpf(1), mp.mpf(0)])(mp.mpf(str(given["duration"])))[0]


def zipline():
    """A bead on the ellipse that a cable without mass and of constant length draws between its ends."""
    given = scene("zipline")
    _, lengths = line_masses(given)
    points = [mp.matrix(point) for point in given["beam"]["curve"]["points"]]
    whole, start, end = mp.fsum(lengths), points[0], points[2]
    centre, half = (start + end) / 2, whole / 2
    focal = mp.norm(end - start) / 2
    along = (end - start) / (2 * focal)
    across = mp.matrix([-along[1], along[0]])
    small = mp.sqrt(half**2 - focal**2)
    place = lambda u: centre + along * (half * mp.cos(u)) + across * (small * mp.sin(u))
    from_centre = points[1] - centre
    dot = lambda a, b: a[0] * b[0] + a[1] * b[1]
    first = mp.atan2(dot(from_centre, across) / small, dot(from_centre, along) / half)

    def rates(_, at):
        u, speed = at
        r_u = along * (-half * mp.sin(u)) + across * (small * mp.cos(u))
        r_uu = along * (-half * mp.cos(u)) - across * (small * mp.sin(u))
        return [speed, (-G * r_u[1] - dot(r_u, r_uu) * speed**2) / dot(r_u, r_u)]
    u = mp.odefun(rates, 0, [first, mp.mpf(0)])(mp.mpf(given["duration"]))[0]
    return place(u)


def container_crane():
    """A pendulum whose length and pivot are given: l a'' + 2 l' a' + g sin a + X'' cos a = 0; the rope's mass is left out."""
    given = scene("container_crane")
    support = given["supports"][0]
    way, feed = support["motion"], support["feed"]
    slope = lambda s: 140 * (s * (1 - s)) ** 3 if 0 < s < 1 else mp.mpf(0)
    integral = lambda s: s**5 * (7 - 14 * s + 10 * s**2 - mp.mpf("2.5") * s**3) if s < 1 else s - mp.mpf("0.5")
    rest = -mp.mpf(given["beam"]["curve"]["end"][1])
    mass = given["point_masses"][0]["mass"]
    stretch = 1 + mass * G / mp.mpf(str(given["beam"]["section"]["EA"]))

    def of(part, t):
        ramp, rate = mp.mpf(part["rate_ramp"]), mp.mpf(str(part["rate"]))
        return rate * ramp * integral(t / ramp), rate * smooth_step(t / ramp), rate * slope(t / ramp) / ramp

    def rates(t, at):
        a, speed = at
        fed, fed_rate, _ = of(feed, t)
        length, length_rate = (rest + fed) * stretch, fed_rate * stretch
        return [speed, (-2 * length_rate * speed - G * mp.sin(a) - of(way, t)[2] * mp.cos(a)) / length]
    ramp, until = mp.mpf(way["rate_ramp"]), mp.mpf(given["duration"])
    middle = mp.odefun(rates, 0, [mp.mpf(0), mp.mpf(0)])(ramp)
    a, _ = mp.odefun(rates, ramp, middle)(until)
    length = (rest + of(feed, until)[0]) * stretch
    return of(way, until)[0] + length * mp.sin(a), -length * mp.cos(a)


def mooring_line():
    """Weight in water of the part of an inextensible chain that hangs: it leaves the ground along it (Irvine 1981)."""
    given = scene("mooring_line")
    _, lengths = line_masses(given)
    section, fluid = given["beam"]["section"], given["fluid"]
    weight = G * (mp.mpf(str(section["rhoA"])) - mp.mpf(str(fluid["density"])) * mp.mpf(str(fluid["area"])))
    reach, height = [mp.mpf(c) for c in given["beam"]["curve"]["points"][2]]
    hanging = lambda pull: pull / weight * mp.sinh(mp.acosh(1 + height * weight / pull))
    span = lambda pull: pull / weight * mp.acosh(1 + height * weight / pull)
    pull = mp.findroot(lambda h: mp.fsum(lengths) - hanging(h) + span(h) - reach, 1000)
    return weight * hanging(pull)


def three_guides():
    """Tensions around guides in the ratio e^(mu phi) of all the angles, of a cable without mass."""
    given = scene("three_guides")
    points = [mp.matrix(point) for point in given["beam"]["curve"]["points"]]
    motion = given["supports"][0]["motion"]
    way = motion["rate"] * (given["duration"] - mp.mpf(str(motion["rate_ramp"])) / 2)
    direction = mp.matrix(motion["direction"])
    points[-1] += direction / mp.norm(direction) * way
    pieces = [(b - a) / mp.norm(b - a) for a, b in zip(points, points[1:])]
    angles = [mp.acos(a[0] * b[0] + a[1] * b[1]) for a, b in zip(pieces, pieces[1:])]
    mu = mp.mpf(str(given["sliding_joints"][0]["friction"]["coefficient"]))
    return 10 * mp.exp(mu * mp.fsum(angles)) * pieces[-1][1]


def moving_string():
    """Steady deflection of a tensioned beam that runs through its supports, under a force in the middle: with the stretch
    lambda, EI/lambda^4 w'''' - (EA e - rhoA c^2) w'' = F delta, c the rate of the material coordinate."""
    given = scene("moving_string")
    section, material = given["beam"]["section"], given["beam"]["material"]
    area = mp.pi * mp.mpf(section["radius"]) ** 2
    EA, rhoA = area * material["youngs_modulus"], area * material["density"]
    EI = EA * mp.mpf(section["radius"]) ** 2 / 4
    stretch = mp.findroot(lambda x: EA * (x**3 - x) / 2 - given["flow"]["tension"], 1)
    rate = given["flow"]["velocity"] / stretch
    tension, bending, length = EA * (stretch**2 - 1) / 2 - rhoA * rate**2, EI / stretch**4, 1 / stretch
    k, force = mp.sqrt(tension / bending), mp.mpf(given["loads"][0]["magnitude"]["value"])
    return force * length / (4 * tension) - force / (2 * tension * k) * mp.tanh(k * length / 2)


def rotating_load():
    rows = read("rotating_load.json")
    column = rows["columns"].index("load_U1")
    row = next(row for row in rows["sets"][0]["rows"] if abs(row[0] - 0.75) < 1e-9)
    return row[column] * 1e-4


def spin_up():
    """Tip of a beam whose clamp turns, from its offset in the frame of the clamp."""
    angle = scene("spin_up")["supports"][0]["motion"]["angle"]
    t, at_6 = mp.mpf(6), (mp.mpf("-0.0169693837"), mp.mpf("-0.5435661989"))
    turn = angle["value"] + angle["acceleration"] * t**2 / 2 + angle["amplitude"] * mp.cos(2 * mp.pi * angle["frequency"] * t)
    return mp.sin(turn) * (10 + at_6[0]) + mp.cos(turn) * at_6[1]


def block_and_tackle():
    """Lagrange's equations of the block (x, y), whose sheaves are 0.2 m apart, on an inextensible rope without mass: the
    counterweight is S(x, y) - L below the last ring, S the length of the four falls."""
    given = scene("block_and_tackle")
    points = [mp.matrix([mp.mpf(str(c)) for c in point]) for point in given["beam"]["curve"]["points"]]
    block, weight = mp.mpf(given["blocks"][0]["mass"]), mp.mpf(given["point_masses"][0]["mass"])
    falls = [(points[0], 0), (points[2], 0), (points[2], mp.mpf("0.2")), (points[4], mp.mpf("0.2"))]

    def rates(_, at):
        x, y, vx, vy = at
        slope, turn = [mp.mpf(0)] * 2, mp.mpf(0)  # of S, and v.S''v
        for ring, shift in falls:
            dx, dy = x + shift - ring[0], y - ring[1]
            l = mp.hypot(dx, dy)
            along = (dx * vx + dy * vy) / l
            slope = [slope[0] + dx / l, slope[1] + dy / l]
            turn += (vx**2 + vy**2 - along**2) / l
        # (M 1 + m S' S'^T) a = -M g e_y - m (g + v.S''v) S'
        sx, sy = slope
        a = mp.matrix([[block + weight * sx**2, weight * sx * sy], [weight * sx * sy, block + weight * sy**2]])
        push = weight * (G + turn)
        ax, ay = mp.lu_solve(a, mp.matrix([-push * sx, -block * G - push * sy]))
        return [vx, vy, ax, ay]
    start = [points[1][0], points[1][1], mp.mpf(0), mp.mpf(0)]
    return mp.odefun(rates, 0, start)(mp.mpf(str(given["duration"])))[1]


def table(given, t):
    """A monotone cubic through the pairs of a time and a value, at rest at its ends: value, rate and acceleration."""
    times, values = [[mp.mpf(str(pair[i])) for pair in given["table"]] for i in (0, 1)]
    steps = [b - a for a, b in zip(times, times[1:])]
    chords = [(b - a) / h for a, b, h in zip(values, values[1:], steps)]
    slopes = [mp.mpf(0)] * len(times)
    for i in range(1, len(times) - 1):  # Fritsch & Butland 1984
        if chords[i - 1] * chords[i] > 0:
            near, far = 2 * steps[i] + steps[i - 1], steps[i] + 2 * steps[i - 1]
            slopes[i] = (near + far) / (near / chords[i - 1] + far / chords[i])
    for i, h in enumerate(steps):
        if t <= times[i + 1]:
            s = (t - times[i]) / h
            rise = chords[i] - slopes[i], slopes[i + 1] - chords[i]
            a, b = slopes[i], 2 * rise[0] - rise[1]
            c = rise[1] - rise[0]
            return (values[i] + h * s * (a + s * (b + c * s)), a + s * (2 * b + 3 * c * s), (2 * b + 6 * c * s) / h)
    return values[-1], mp.mpf(0), mp.mpf(0)


def kite():
    """A point on a tether of given length under a constant force upwards, in space: m r'' = F - T r/l, l = l(t)."""
    given = scene("kite")
    mass = mp.mpf(given["point_masses"][0]["mass"])
    lift = mp.mpf(str(given["loads"][0]["magnitude"]["value"])) / mass - G
    start, turning = [mp.mpf(c) for c in given["beam"]["curve"]["end"]], mp.mpf(str(given["initial_velocity"]["rotation"]))
    rest = mp.sqrt(mp.fsum(c**2 for c in start))

    def rates(t, at):
        r, v = at[:3], at[3:]
        fed, rate, growth = table(given["supports"][0]["feed"], t)
        length, speed2 = rest + fed, mp.fsum(c**2 for c in v)
        # (r.r)'' = 2 (v.v + r.r'') = 2 (l'^2 + l l'')
        pull = (speed2 + lift * r[2] - rate**2 - length * growth) / length**2
        return v + [-pull * r[0], -pull * r[1], lift - pull * r[2]]
    at = start + [-turning * start[1], turning * start[0], mp.mpf(0)]
    times = [mp.mpf(pair[0]) for pair in given["supports"][0]["feed"]["table"]]
    for begin, until in zip(times, times[1:]):  # its acceleration jumps between them
        at = list(mp.odefun(rates, begin, at)(until))
    return at


def paid_out_line():
    """Elastic catenary (Irvine 1981) of a line between two places of one height. The winch tells the
    tension at its outlet."""
    given = scene("paid_out_line")
    section, span = given["beam"]["section"], mp.mpf(given["beam"]["curve"]["end"][0])
    weight = mp.mpf(str(section["rhoA"])) * G
    length, EA = span + given["supports"][0]["feed"]["table"][-1][1], mp.mpf(section["EA"])
    reach = lambda h: 2 * h / weight * mp.asinh(weight * length / (2 * h)) + h * length / EA
    h = mp.findroot(lambda x: reach(x) - span, weight * length / 3)
    return mp.hypot(h, weight * length / 2)


def spinning_tether():
    """Angular momentum of a weight on a straight tether of given length, whose mass counts and which stretches by the pull of
    the weight: (m + rhoA l/3) l^2 a' is constant, l = s (1 + m (a'^2 l - s'')/EA)."""
    given = scene("spinning_tether")
    section, feed, first = given["beam"]["section"], given["supports"][0]["feed"], mp.mpf(given["beam"]["curve"]["end"][0])
    EA, rhoA, mass = (mp.mpf(str(x)) for x in (section["EA"], section["rhoA"], given["point_masses"][0]["mass"]))
    turning, duration = mp.mpf(str(given["initial_velocity"]["rotation"])), mp.mpf(given["duration"])
    inertia = lambda l: (mass + rhoA * l / 3) * l**2
    momentum = turning * inertia(first)

    def state(t):
        fed, _, growth = table(feed, t)
        length, rate = first + fed, mp.mpf(0)
        for _ in range(40):  # a contraction by the strain
            rate = momentum / inertia(length)
            length = (first + fed) * (1 + mass * (rate**2 * length - growth) / EA)
        return length, rate
    last = mp.mpf(feed["table"][-1][0])
    angle = mp.quad(lambda t: state(t)[1], mp.linspace(0, last, 6) + [duration])
    return state(duration)[0] * mp.cos(angle)


def spring():
    """Castigliano: where a small force F along z takes the end of an inextensible helix, by the moment (r_end - r) x F: a
    share along the tangent twists it, the rest bends it."""
    given = scene("spring")
    curve, material = given["beam"]["curve"], given["beam"]["material"]
    number = lambda part, key: mp.mpf(str(part[key]))
    radius, rise = number(curve, "radius"), number(curve, "pitch") / (2 * mp.pi)
    turn, wire = mp.radians(number(curve, "to_degrees")), number(given["beam"]["section"], "radius")
    E = number(material, "youngs_modulus")
    EI = E * mp.pi * wire**4 / 4
    GJ = EI / (1 + number(material, "poisson_ratio"))
    slope = mp.sqrt(radius**2 + rise**2)  # arc length a radian

    def energy(at):
        arm = radius * (mp.cos(turn) - mp.cos(at)), radius * (mp.sin(turn) - mp.sin(at))
        moment = arm[1], -arm[0]  # (r_end - r) x e_z
        twist = (-moment[0] * radius * mp.sin(at) + moment[1] * radius * mp.cos(at)) / slope
        return (twist**2 / GJ + (moment[0] ** 2 + moment[1] ** 2 - twist**2) / EI) * slope
    return rise * turn + given["loads"][0]["magnitude"]["value"] * mp.quad(energy, mp.linspace(0, turn, 21))


# Several beams and bodies.
def integrated(rates, state, until, steps=20000):
    """Classical Runge-Kutta steps of y' = rates(t, y), in floats: good to 1e-10 here."""
    h = float(until) / steps
    y = [float(value) for value in state]
    along = lambda by, rate: [a + by * b for a, b in zip(y, rate)]
    for i in range(steps):
        t = i * h
        a = rates(t, y)
        b = rates(t + h / 2, along(h / 2, a))
        c = rates(t + h / 2, along(h / 2, b))
        d = rates(t + h, along(h, c))
        y = [v + h / 6 * (p + 2 * q + 2 * r + s) for v, p, q, r, s in zip(y, a, b, c, d)]
    return y


def double_atwood():
    """Inextensible strings without mass: the joint of the lower one, from the weight at its start."""
    upper, lower = scene("double_atwood")["beams"]
    m1 = mp.mpf(upper["point_masses"][0]["mass"])
    m2, m3 = (mp.mpf(mass["mass"]) for mass in lower["point_masses"])
    wheel = mp.mpf(str(lower["sliding_joints"][0]["mass"]))
    both = 4 * m2 * m3 / (m2 + m3)
    a = G * (both + wheel - m1) / (m1 + wheel + both)  # of the first weight, upwards
    b = both / 2 * (G - a) / m2 - G + a  # of the second one from the wheel, upwards
    t = mp.mpf(str(scene("double_atwood")["duration"]))
    return lower["sliding_joints"][0]["position"] - b * t**2 / 2


def slider_crank():
    """Rigid members without loads keep their energy: it is that of the crank's angle alone, whose time is a quadrature."""
    given = scene("slider_crank")
    crank, slider = given["bodies"]
    (r, _), (end, _) = crank["points"]["pin"], given["beams"][0]["curve"]["end"]
    r, l = mp.mpf(str(r)), mp.mpf(str(end)) - mp.mpf(str(r))
    m = given["beams"][0]["section"]["rhoA"] * l
    reach = lambda p: r * mp.cos(p) + mp.sqrt(l**2 - (r * mp.sin(p)) ** 2)

    def inertia(p):
        lean = r * mp.cos(p) / mp.sqrt(l**2 - (r * mp.sin(p)) ** 2)  # of the rod, over that of the crank
        slide = -r * mp.sin(p) - r * mp.sin(p) * lean
        middle = ((-r * mp.sin(p) + slide) / 2, r * mp.cos(p) / 2)
        rod = m * (middle[0] ** 2 + middle[1] ** 2) + m * l**2 / 12 * lean**2
        return mp.mpf(str(crank["inertia"])) + mp.mpf(str(slider["mass"])) * slide**2 + rod

    speed = crank["angular_velocity"]
    since = lambda p: mp.quad(lambda q: mp.sqrt(inertia(q) / inertia(0)) / speed, mp.linspace(0, p, 9))
    angle = mp.findroot(lambda p: since(p) - given["duration"], speed * given["duration"])
    return reach(angle)


def trolley_and_hook():
    """Lagrange's equations of a rope of given length without mass, and of the hook on it, under a trolley that is led."""
    given = scene("trolley_and_hook")
    jib, rope = given["beams"]
    hook, x = given["bodies"][0], jib["sliding_joints"][0]["x"]
    m, j, e = hook["mass"], hook["inertia"], hook["points"]["eye"][1]
    length = (rope["curve"]["start"][1] - rope["curve"]["end"][1]) * (1 + m * float(G) / rope["section"]["EA"])
    step = lambda s: float(smooth_step(min(max(s, 0.0), 1.0))) if s < 1 else 1.0
    push = lambda t: x["rate"] * 140 * (t * (1 - t)) ** 3 if t < x["rate_ramp"] else 0.0  # its ramp takes 1 s

    def rates(t, y):
        p, q, p1, q1, _, speed = y
        g, a = float(G) * step(t / given["gravity_ramp"]), push(t)
        c, s = math.cos(p - q), math.sin(p - q)
        f = -e * s * q1**2 - g * math.sin(p) - a * math.cos(p)
        h = m * e * (length * s * p1**2 - g * math.sin(q) - a * math.cos(q))
        own, mixed = m * e * e + j, m * length * e * c  # length p2 + e c q2 = f; mixed p2 + own q2 = h
        det = length * own - e * c * mixed
        return [p1, q1, (f * own - e * c * h) / det, (length * h - mixed * f) / det, speed, a]

    start = jib["sliding_joints"][0]["position"]
    p, q, _, _, way, _ = integrated(rates, [0, 0, 0, 0, start, 0], given["duration"], 6000)
    return way + length * math.sin(p) + e * math.sin(q)


def platform_on_ropes(name):
    """Elastic ropes without mass, all alike, above and below a platform that they leave upright: how high it rests."""
    given = scene(name)
    body, up = given["bodies"][0], given.get("dimension", 2) - 1

    def pull(height):
        sum_ = mp.mpf(0)
        for rope, point in zip(given["beams"], body["points"].values()):
            start, end = rope["curve"]["start"], rope["curve"]["end"]
            drawn = mp.sqrt(mp.fsum((mp.mpf(str(a)) - mp.mpf(str(b))) ** 2 for a, b in zip(start, end)))
            way = [mp.mpf(str(a)) - mp.mpf(str(b)) for a, b in zip(start, point)]
            way[up] -= height
            now = mp.sqrt(mp.fsum(w**2 for w in way))
            sum_ += max(now / drawn - 1, 0) * rope["section"]["EA"] * way[up] / now
        return sum_ - body["mass"] * G

    drawn = mp.mpf(str(body["position"][up]))
    return mp.findroot(pull, (drawn - mp.mpf("0.01"), drawn - mp.mpf("0.001")), solver="anderson")


answers = []


def answer(name, quantity, value, uncertainty, kind, source, t=None):
    answers.append({"scene": name, "quantity": quantity, "t": scene(name)["duration"] if t is None else t,
                    "value": float(mp.nstr(mp.mpf(value), 16)), "uncertainty": uncertainty, "kind": kind,
                    "source": source})


codes, twin = read("ale_independent_codes.json"), read("ale_independent_codes.json")["ramped_twin"]
pendulum = read("flexible_pendulum.json")
answer("falling_beam", "joint_position", codes["green"]["joint_position"], 5e-6, "independent",
       "digits on which three codes agree (reference/ale_independent_codes.json)")
answer("falling_beam_ramped", "joint_position", twin["joint_position"], 5e-11, "independent",
       "p-version beam finite element (reference/ale_independent_codes.json)")
answer("pendulum", "end.y", pendulum["end"][1], 5e-11, "independent",
       "p-version beam finite element (reference/flexible_pendulum.json)")
# What is left of the vibration: its slowest mode decays as exp(-c omega^2 t/2), omega = pi/2 sqrt(EA/rhoA), by 3e-9 in the
# four seconds after the ramp, which leaves no more than 1e-3 m of it.
answer("hanging_cable", "end.y", hanging_cable(), 6e-11, "exact", "1 + w L/(2 EA): elongation in proportion to the weight below")
answer("pulled_bar", "end.x", pulled_bar(), 1e-12, "exact", "d'Alembert's solution of the bar, linear in space")
answer("torsion", "angle_end", torsion(), 1e-12, "exact", "d'Alembert's solution of the rod")
answer("incline", "joint_position", mp.mpf("0.1") + mp.mpf("9.81") / 4 * mp.mpf("0.25"), 1e-7, "exact",
       "s0 + g sin(30 deg) t^2/2 on a rigid wire; this one bends by 1e-8")
answer("ring", "joint_position", mp.hypot(mp.mpf("0.5"), mp.mpf("1.2")), 1e-7, "exact",
       "distance between the ring and the end of a rigid rod; this one is 4e-8 longer there")
answer("spin_up", "end.y", spin_up(), 1e-9, "independent",
       "p-version beam finite element: the tip is off by (-0.0169693837, -0.5435661989) m in the frame of the clamp", 6)
answer("moving_force", "load0_y", moving_force(), 1e-13, "exact", "400 modes of the linear beam")
answer("rotating_load", "load0_x", rotating_load(), 1e-10, "independent",
       "400 modes of the linear beam (reference/shaft.py)")
answer("bridge", "mass_position.y", read("bridge.json")["under_the_mass"][2]["y"], 2e-8, "independent",
       "48 modes of the linear beam with a moving mass (reference/bridge.py); the scene's own steps of 1e-4 s leave 5e-8", 0.3)
answer("moving_string", "load0_y", moving_string(), 1e-13, "exact",
       "steady linear deflection about the stretched state")

answer("shallow_arch", "load0_y", read("equilibria.json")["arch"]["height"], 1e-8, "independent",
       "shooting (reference/equilibria.py)", 1)
rolled = read("joints.json")
# the cable of reference/joints.py is the scene's; the rod is 2 m long
answer("cable_through_ring", "joint_position", rolled["ring"]["engineering"]["x"], 1e-13, "independent",
       "two elastic catenaries of one tension (reference/joints.py)", 1)
answer("rod_through_sleeve", "joint_position", 2 - mp.mpf(str(rolled["sleeve"]["degrees"]["30"]["length"])), 1e-11, "independent",
       "shooting (reference/joints.py)", 1)

end, turn = mp.matrix([-0.2, 1.6]), mp.atan2(1.6, -0.2)  # where the cable is drawn to, and by what it turns in the ring
answer("capstan", "reaction_end_y", 10 * mp.exp(0.3 * turn) * end[1] / mp.norm(end), 1e-3, "exact",
       "tensions in the ratio e^(mu phi) of a cable without mass; the scene's of 1e-4 kg/m leaves some 1e-4 N", 2)

path = winch()
answer("winch", "end.x", path[-1]["x"], 2e-4, "exact",
       "pendulum of given length; the scene's cable has 1e-4 of the weight's mass and stretches by as much", 3)

answer("lead_screw", "joint_position", lead_screw(), 3e-4, "exact",
       "a rigid screw; this one is stretched by 1.2e-4 under the weights, by which the load asks for 6e-4 more of what is "
       "left to lift it, and twisted by 5e-3 rad, which is 1.6e-4 m of the thread")

answer("atwood", "joint_position", atwood(), 1e-4, "exact",
       "two weights, a wheel and a rope of given length; the scene's swings by its elongation, some 2e-5 m")
answer("movable_pulley", "mass_position.y", -movable_pulley(), 1e-4, "independent",
       "Lagrange's equation of an inextensible rope without mass, by Taylor series to 30 digits (reference/scenes.py)")
answer("three_weights", "joint_position", mp.mpf("1.25"), 2e-4, "exact",
       "2 T sin(alpha) = 1.2 g, T = g: a triangle of sides 3, 4 and 5; the scene's rope is 1e-4 longer", 1)
answer("rope_off_peg", "joint_position", mp.mpf("0.9") - mp.mpf("0.1") * (mp.cosh(mp.sqrt(G) / 2) - 1), 1e-4, "exact",
       "s'' = g (l2 - l1 + 2 s)/L of an inextensible rope")
answer("mooring_line", "reaction_end_y", mooring_line(), 1, "exact",
       "inextensible catenary that leaves the ground along it; the scene's is 3e-5 longer, and lies 2e-4 m deep", 1)
answer("elevator", "end.y", -48 * (1 + 500 * G / mp.mpf(1e8)), 2e-4, "exact",
       "rope paid out and its stretch under the car; its own weight adds 1e-4 m")
answer("three_guides", "reaction_end_y", three_guides(), 1e-4, "exact",
       "tensions in the ratio e^(mu phi) of a cable without mass")
answer("zipline", "mass_position.x", zipline()[0], 2e-3, "independent",
       "bead on an ellipse, by Taylor series (reference/scenes.py): a cable without mass and of constant length; the scene's "
       "is up to 1e-3 longer")
answer("container_crane", "end.x", container_crane()[0], 2e-3, "independent",
       "pendulum of given length and pivot, by Taylor series (reference/scenes.py); the scene's rope has 1e-3 of the load's "
       "mass")

answer("block_and_tackle", "mass_position.y", block_and_tackle(), 2e-3, "independent",
       "Lagrange's equations of a block on an inextensible rope without mass, by Taylor series (reference/scenes.py); the "
       "scene's rope weighs 1e-3 of its loads and is up to 4e-4 longer")
answer("kite", "end.y", kite()[1], 2e-2, "independent",
       "a point on a tether of given length, by Taylor series (reference/scenes.py); the scene's has 4e-3 of the kite's mass and is up to 2e-4 longer")
answer("paid_out_line", "winch_start_tension", paid_out_line(), 1e-3, "exact",
       "elastic catenary (Irvine 1981)")
answer("spinning_tether", "end.x", spinning_tether(), 2e-3, "exact",
       "angular momentum of a weight on a straight tether of given length; the scene's swings as it starts unstretched")

answer("bead_on_helix", "joint_position", mp.mpf("0.5") + G / (2 * mp.sqrt((2 * mp.pi * mp.mpf("0.5"))**2 + 1)) * mp.mpf("1.44"),
       2e-5, "exact", "s0 + g sin(alpha) t^2/2 on a rigid wire that rises by sin(alpha) of its length")
answer("drill_string_in_curved_well", "energy.torsion", mp.mpf("1.5")**2 * 2 / 8, 1e-5, "exact",
       "M^2 L/(2 GIp): a round rod carries its torque from end to end, however it is bent; 0.8 m have been fed", 5)
answer("spring", "load0_z", spring(), 2e-5, "exact",
       "Castigliano's theorem on an inextensible helix, for a small force; the scene's moves by a twentieth of its height", 1)

judged = "vlbeam converge on meshes and steps finer than the scene's: its answer and uncertainty"
for name, quantity, value, uncertainty, t in (
        ("suspended_beam", "joint_position", 0.1551768503, 5.7e-7, 0.2),
        ("suspended_beam_friction", "joint_position", 0.1322521312, 2.0e-5, 0.2),
        ("semicircle", "joint_position", 1.15767569, 1.0e-4, 0.4),
        ("bead_on_wire", "mass_position.x", 0.4952973193, 2.0e-5, 0.4),
        ("sleeve", "joint_position", 0.3590491251, 1.8e-6, 0.3),
        ("rod_thrown_out", "joint_position", 0.969397359, 2.6e-4, 1),
        ("two_trolleys", "joint_position", 0.6911457935, 2.0e-6, 0.3),
        ("drill_stem", "end.x", 0.0004711695638, 4.6e-6, 0.2)):
    answer(name, quantity, value, uncertainty, "self-convergence", judged, t)

answer("double_atwood", "lower string.joint 0.position", double_atwood(), 1e-4, "exact",
       "inextensible strings without mass; those of the scene swing by their elongation, some 2e-5 m")
answer("slider_crank", "slider.position.x", slider_crank(), 1e-4, "independent",
       "rigid members keep their energy: the crank's angle by a quadrature (reference/scenes.py)")
answer("trolley_and_hook", "hook.position.x", trolley_and_hook(), 2e-3, "independent",
       "Lagrange's equations of a rigid jib and a rope without mass (reference/scenes.py); this jib gives way by 2 cm")
for name in ("cable_robot", "cable_robot_in_space"):
    answer(name, "platform.position." + ("z" if name.endswith("space") else "y"), platform_on_ropes(name), 2e-5, "exact",
           "elastic ropes without mass; those of the scene weigh 1 g a metre")

with open(os.path.join(here, "scenes.json"), "w") as file:
    json.dump({"source": "reference/scenes.py, which names the source of each", "answers": answers}, file, indent=1)
    file.write("\n")

with open(os.path.join(here, "winch.json"), "w") as file:
    json.dump({"source": "reference/scenes.py, winch(): pendulum of given length, integrated to 1e-14",
               "units": {"t": "s", "x": "m", "y": "m"}, "path": path}, file, indent=1)
    file.write("\n")
