"""Hanging cables without bending stiffness, and a weight that slides along one.

Weight w per reference length, s the reference length from the left end, (H, V(s)) the tension, V = V_0 + w s, T = sqrt(H^2 + V^2), and
    dx/ds = l(T) H/T,   dy/ds = l(T) V/T
with the stretch l of
    inextensible  l = 1,    engineering  T = EA (l - 1)  (Irvine),    green  T = EA l (l^2 - 1)/2  (of W = EA (l^2 - 1)^2/8).
H and V_0 put the right end in its place. A weight P on a frictionless ring at s_1 has the same T on both sides, hence the same l, and the
same H as it is vertical: V = -P/2 on the left, P/2 on the right; H and s_1 put the end in its place.
The integral of dx has closed forms where l = 1 + T/EA: H (asinh(V/H)/w + s/EA); in V, those of dy: T/w + V^2/(2 EA w). For green,
dT = EA (3 l^2 - 1)/2 dl and T dT = V dV give dy = l dT/w: y = EA (3 l^4/8 - l^2/4)/w; x = H int l ds/T by quadrature.

Source: Irvine, Cable Structures, 1981, chapter 1; the green law from the equations above.
Errors: against dx/ds, dy/ds integrated in 40 steps of order 10, with H and V_0 (or s_1) found anew. V_left and V_right are what the ends bear
of the weight. Command: make.py catenary
"""
import mpmath as mp

from common import case, integrate, newton, precisely


def stretch(law, EA, T):
    if law == "inextensible":
        return mp.mpf(1)
    if law == "engineering":
        return 1 + T / EA
    a = T / EA  # l^3 - l - 2 a = 0, one real root above 1; Cardano's cancels for small T: Newton from a start above the root
    l = 1 + a
    for _ in range(200):
        change = (l**3 - l - 2 * a) / (3 * l * l - 1)
        l -= change
        if abs(change) < mp.mpf(10) ** (2 - mp.mp.dps):
            return l
    raise ArithmeticError("no stretch")


def span(law, EA, w, H, V, W):
    """x, y from where the vertical force is V to where it is W."""
    T, S = mp.hypot(H, V), mp.hypot(H, W)
    if law == "green":
        height = lambda l: EA * (3 * l**4 / 8 - l * l / 4) / w
        # V = H sinh u: ds = T du/w
        x = mp.quad(lambda u: stretch(law, EA, H * mp.cosh(u)), mp.linspace(mp.asinh(V / H), mp.asinh(W / H), 5), method="gauss-legendre") * H / w
        return x, height(stretch(law, EA, S)) - height(stretch(law, EA, T))
    soft = 0 if law == "inextensible" else 1 / EA
    return H * ((mp.asinh(W / H) - mp.asinh(V / H)) / w + soft * (W - V) / w), (S - T) / w + soft * (W * W - V * V) / (2 * w)


def span_by_steps(law, EA, w, H, V, W, steps=40):
    def rates(_, state):
        T = mp.hypot(H, state[2])
        l = stretch(law, EA, T)
        return [l * H / T, l * state[2] / T, w]
    return integrate(rates, [mp.mpf(0), mp.mpf(0), V], mp.mpf(0), (W - V) / w, steps)[:2]


def cable(law, EA, w, L, width, height, span):
    """Between (0, 0) and (width, height)."""
    off = lambda h: [a - b for a, b in zip(span(law, EA, w, h[0], h[1], h[1] + w * L), (width, height))]
    H, V = newton(off, [w * width / 2, w * L * (height - L) / (2 * L)])
    x, y = span(law, EA, w, H, V, V + w * L / 2)
    lx, ly = span(law, EA, w, H, V, mp.mpf(0)) if V < 0 < V + w * L else (mp.nan, mp.nan)
    return {"H": H, "V_left": -V, "V_right": V + w * L, "middle": [x, y], "lowest": [lx, ly]}


def sliding(law, EA, w, P, L, width, height, span):
    """H, where the ring is, how much of the cable is on its left."""
    left = lambda h: span(law, EA, w, h[0], -P / 2 - w * h[1], -P / 2)
    right = lambda h: span(law, EA, w, h[0], P / 2, P / 2 + w * (L - h[1]))
    off = lambda h: [left(h)[0] + right(h)[0] - width, left(h)[1] + right(h)[1] - height]
    H, s = newton(off, [(P + w * L) * width / L / 3, L / 2 - height / 2])
    return {"H": H, "s": s, "ring": left([H, s]), "tension": mp.hypot(H, P / 2), "stretch": stretch(law, EA, mp.hypot(H, P / 2))}


def cases():
    source = {"inextensible": "catenary", "engineering": "Irvine, Cable Structures, chapter 1",
              "green": "dx/ds = l H/T, dy/ds = l V/T with T = EA l (l^2 - 1)/2"}
    units = {"EA": "N", "w": "N/m", "length": "m", "width": "m", "height": "m", "P": "N", "H, V, tension": "N", "points": "m", "s": "m"}
    by = "integration in steps of order 10, with its own H and V or s"
    for law, width, height in (("inextensible", 1, 0), ("engineering", 1, 0), ("green", 1, 0), ("inextensible", 1, 0.3), ("engineering", 1, 0.3), ("green", 1, 0.3)):
        data = law, mp.mpf(10), mp.mpf(1), mp.mpf(1.5), mp.mpf(width), mp.mpf(height)
        given = {"law": law, **({} if law == "inextensible" else {"EA": 10}), "w": 1, "length": 1.5, "width": width, "height": height}
        yield case(f"catenary, {law}, ends at heights 0 and {height}", "roots", source[law], given, units,
                   [precisely(lambda: cable(*data, span), 25), precisely(lambda: cable(*data, span_by_steps), 20)], by)
    for law in ("inextensible", "engineering", "green"):
        data = law, mp.mpf(50), mp.mpf(1), mp.mpf(2), mp.mpf(1.5), mp.mpf(1), mp.mpf(0.3)
        given = {"law": law, **({} if law == "inextensible" else {"EA": 50}), "w": 1, "P": 2, "length": 1.5, "width": 1, "height": 0.3}
        yield case(f"weight that slides on a cable, {law}", "roots", f"two catenaries with the same tension at the ring; {source[law]}", given, units,
                   [precisely(lambda: sliding(*data, span), 25), precisely(lambda: sliding(*data, span_by_steps), 20)], by)
