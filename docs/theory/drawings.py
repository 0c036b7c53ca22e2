#!/usr/bin/env python3
"""Draws the figures of the theory: an element with its marks, and an event before and after.

    drawings.py [FOLDER]        writes element.svg and event.svg (default: beside this file)

The curves are those of the elements: rational cubics, cut by de Casteljau's rule and merged by the point fit.
"""

import math
import sys
from pathlib import Path

INK, SOFT, ONE, TWO = "#1b2126", "#6b747c", "#0b5a86", "#a33b12"


def bernstein(u):
    v = 1 - u
    return v**3, 3 * u * v * v, 3 * u * u * v, u**3


def combine(coefficients, points):
    return tuple(sum(c * p[k] for c, p in zip(coefficients, points)) for k in (0, 1))


class Element:
    """Nodal coordinates (r_A, s_A, r_B, s_B), length l and weights."""

    def __init__(self, r_a, s_a, r_b, s_b, length, w=(1, 1, 1, 1)):
        self.nodes, self.length, self.w = (r_a, s_a, r_b, s_b), length, w

    def points(self):
        (r_a, s_a, r_b, s_b), l, w = self.nodes, self.length, self.w
        c, d = l * w[0] / (3 * w[1]), l * w[3] / (3 * w[2])
        return r_a, (r_a[0] + c * s_a[0], r_a[1] + c * s_a[1]), (r_b[0] - d * s_b[0], r_b[1] - d * s_b[1]), r_b

    def at(self, u):
        weighted = [b * w for b, w in zip(bernstein(u), self.w)]
        total = sum(weighted)
        return combine([x / total for x in weighted], self.points())

    def slope(self, u, h=1e-5):
        a, b = self.at(u - h), self.at(u + h)
        return (b[0] - a[0]) / (2 * h * self.length), (b[1] - a[1]) / (2 * h * self.length)


def point_fit(element, u, through):
    """Weights (k_0, k_1, k_2, 1) of least |k - 1| by which the element passes through a point at u."""
    (r_a, s_a, r_b, s_b), l = element.nodes, element.length
    v = 1 - u
    rows, rest = [], []
    for k in (0, 1):
        a, b = r_a[k] - through[k], r_b[k] - through[k]
        rows.append((v**3 * a + l * u * v * v * s_a[k], 3 * u * v * v * a, 3 * u * u * v * b))
        rest.append(-(u**3 * b - l * u * u * v * s_b[k] + sum(rows[-1])))
    gram = [[sum(x * y for x, y in zip(p, q)) for q in rows] for p in rows]
    det = gram[0][0] * gram[1][1] - gram[0][1] ** 2
    y = ((gram[1][1] * rest[0] - gram[0][1] * rest[1]) / det, (gram[0][0] * rest[1] - gram[0][1] * rest[0]) / det)
    return (*(1 + rows[0][i] * y[0] + rows[1][i] * y[1] for i in range(3)), 1)


class Picture:
    """Lengths of the model in, pixels out; y goes up."""

    def __init__(self, width, height, scale, left, base, title, description):
        self.scale, self.left, self.base = scale, left, base
        self.parts = [
            f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" viewBox="0 0 {width} {height}" role="img">',
            f"<title>{title}</title><desc>{description}</desc>",
            f'<rect width="{width}" height="{height}" fill="#ffffff"/>',
            '<defs><marker id="arrow" viewBox="0 0 10 10" refX="9" refY="5" markerWidth="7" markerHeight="7" orient="auto-start-reverse">'
            f'<path d="M0,1 L10,5 L0,9 z" fill="{INK}"/></marker></defs>',
            f'<g font-family="Liberation Serif, STIX, Times New Roman, DejaVu Serif, serif" font-size="17" fill="{INK}">',
        ]

    def to(self, p):
        return self.left + self.scale * p[0], self.base - self.scale * p[1]

    def line(self, points, colour=INK, width=1.5, dash="", arrow="", model=True):
        at = [self.to(p) if model else p for p in points]
        path = " ".join(f"{x:.1f},{y:.1f}" for x, y in at)
        more = f' stroke-dasharray="{dash}"' if dash else ""
        more += ' marker-end="url(#arrow)"' if arrow in ("end", "both") else ""
        more += ' marker-start="url(#arrow)"' if arrow == "both" else ""
        self.parts.append(f'<polyline points="{path}" fill="none" stroke="{colour}" stroke-width="{width}"{more}/>')

    def curve(self, element, colour, width=3.5, dash="", start=0.0, end=1.0):
        self.line([element.at(start + (end - start) * k / 60) for k in range(61)], colour, width, dash)

    def node(self, p, hollow=False, radius=5.0, colour=INK):
        x, y = self.to(p)
        fill = "#ffffff" if hollow else colour
        self.parts.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{radius}" fill="{fill}" stroke="{colour}" stroke-width="2"/>')

    def text(self, p, words, anchor="middle", model=True, size=0, colour=""):
        x, y = self.to(p) if model else p
        more = (f' font-size="{size}"' if size else "") + (f' fill="{colour}"' if colour else "")
        self.parts.append(f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}"{more}>{words}</text>')

    def save(self, path):
        path.write_text("\n".join([*self.parts, "</g>", "</svg>", ""]), encoding="utf-8")


def it(letter, below=""):
    low = f'<tspan dy="5" font-size="12">{below}</tspan>' if below else ""
    return f'<tspan font-style="italic">{letter}</tspan>{low}'


def bold(letter, below=""):
    low = f'<tspan dy="5" font-size="12">{below}</tspan>' if below else ""
    return f'<tspan font-weight="bold">{letter}</tspan>{low}'


def moved(p, x, y):
    return p[0] + x, p[1] + y


def draw_element(path):
    picture = Picture(760, 470, 330, 70, 275, "A variable-length element",
                      "A bent element between its ends A and B in space, with position and slope vectors, and below it the "
                      "interval of material coordinates from x_A to x_B on the line of the whole beam.")
    element = Element((0.2, 0.02), (0.85, 0.95), (1.55, 0.3), (0.95, -0.95), 1.3, (1, 0.9, 1.15, 1.05))
    # neighbours, in outline
    picture.curve(Element((-0.12, -0.28), (0.9, 0.5), element.nodes[0], element.nodes[1], 0.45), SOFT, 2)
    picture.curve(Element(element.nodes[2], element.nodes[3], (1.9, -0.12), (0.7, -0.9), 0.5), SOFT, 2)
    p = element.points()
    picture.line(p, SOFT, 1, "2 4")
    for k, there in ((1, (-12, -8)), (2, (12, -8))):
        picture.node(p[k], True, 3.5, SOFT)
        x, y = picture.to(p[k])
        picture.text((x + there[0], y + there[1]), bold("P", str(k)), "middle", False, colour=SOFT)
    picture.curve(element, ONE)
    for u, name, side in ((0.0, "A", -1), (1.0, "B", 1)):
        at, s = element.at(u), element.nodes[1 if u == 0 else 3]
        size = math.hypot(*s)
        picture.line([at, moved(at, 0.27 * s[0] / size, 0.27 * s[1] / size)], INK, 2, arrow="end")
        picture.node(at)
        x, y = picture.to(at)
        picture.text((x + side * 14, y + (0 if u == 0 else -12)), bold("r", name), "end" if u == 0 else "start", False)
        tip = picture.to(moved(at, 0.27 * s[0] / size, 0.27 * s[1] / size))
        picture.text((tip[0] + 10, tip[1] + (18 if u == 0 else 4)), bold("s", name), "start", False)
    u = 0.55
    at = element.at(u)
    picture.node(at, True, 4.5, TWO)
    picture.text(moved(at, 0.02, -0.085), f'{bold("r")}({it("x")}, {it("t")})', colour=TWO)
    # origin
    corner = (-0.13, -0.42)
    picture.line([corner, moved(corner, 0.16, 0)], INK, 1.5, arrow="end")
    picture.line([corner, moved(corner, 0, 0.16)], INK, 1.5, arrow="end")
    picture.line([corner, element.at(0)], SOFT, 1, "6 4", "end")
    picture.text(moved(corner, -0.035, -0.05), "O")
    # the line of material coordinates
    y, a, b = 405, 190, 585
    picture.line([(60, y), (700, y)], INK, 1.5, arrow="end", model=False)
    picture.text((706, y + 5), it("x"), "start", False)
    picture.line([(a, y), (b, y)], ONE, 4, model=False)
    for x, name in ((a, "A"), (b, "B")):
        picture.line([(x, y - 7), (x, y + 7)], INK, 2, model=False)
        picture.text((x, y + 28), f'{it("x", name)}<tspan dy="-5">({it("t")})</tspan>', "middle", False)
        picture.line([(x + 4, y - 17), (x + 44, y - 17)], INK, 1.5, arrow="end", model=False)
        picture.text((x + 52, y - 13), f'<tspan font-style="italic">ẋ</tspan><tspan dy="5" font-size="12">{name}</tspan>', "start", False, 15)
    mark = a + u * (b - a)
    picture.line([(mark, y - 6), (mark, y + 6)], TWO, 3, model=False)
    picture.text((mark, y + 28), it("x"), "middle", False, colour=TWO)
    picture.line([(a, y + 42), (b, y + 42)], SOFT, 1.2, arrow="both", model=False)
    picture.text(((a + b) / 2, y + 60), f'{it("l")} = {it("x", "B")}<tspan dy="-5"> − </tspan>{it("x", "A")}', "middle", False)
    picture.text((mark, y - 17), f'{it("u")} = ({it("x")} − {it("x", "A")}<tspan dy="-5">)/{it("l")}</tspan>', "middle", False, 15, TWO)
    picture.save(path)


def draw_event(path):
    picture = Picture(760, 500, 132, 50, 130, "A length-control event",
                      "Above: before the event the element behind the joint is 1.5 standard lengths long and the one ahead half of one. "
                      "Below: the first is cut at one standard length, the node ahead of the joint is deleted and its two elements are one.")
    # one smooth beam, in standard lengths
    def axis(x):
        return x, 0.34 * math.sin(1.75 * x - 0.6)

    def slope(x, h=1e-6):
        a, b = axis(x - h), axis(x + h)
        return (b[0] - a[0]) / (2 * h), (b[1] - a[1]) / (2 * h)

    def between(a, b):
        return Element(axis(a), slope(a), axis(b), slope(b), b - a)

    names = ("i−2", "i−1", "i", "i+1", "i+2", "i+3")
    before = [0.0, 1.0, 2.5, 3.0, 4.0, 5.0]
    old = [between(a, b) for a, b in zip(before, before[1:])]
    for part, colour in zip(old, (SOFT, ONE, TWO, TWO, SOFT)):
        picture.curve(part, colour)
    for x, name in zip(before, names):
        joint = x == 2.5
        picture.node(axis(x), not joint, 8 if joint else 5)
        px, py = picture.to(axis(x))
        picture.text((px, py + (30 if joint else 26)), it(name), "middle", False)
    px, py = picture.to(axis(2.5))
    s = slope(2.5)
    n = math.hypot(*s)
    picture.line([(px + 10 * s[0] / n, py - 10 * s[1] / n - 22), (px + 54 * s[0] / n, py - 54 * s[1] / n - 22)], INK, 2, arrow="end", model=False)
    picture.text((px + 54 * s[0] / n + 6, py - 54 * s[1] / n - 26), f'<tspan font-style="italic">ẋ</tspan><tspan dy="5" font-size="12">i</tspan>', "start", False)
    picture.text((14, 28), "before", "start", False, 18)
    tall = 222
    xa, xb = picture.to(axis(1.0))[0], picture.to(axis(2.5))[0]
    picture.line([(xa, tall), (xb, tall)], ONE, 1.2, arrow="both", model=False)
    picture.text(((xa + xb) / 2, tall - 7), f'1.5 (1 + {it("η")}) {it("L", "std")}', "middle", False, 16, ONE)

    down = Picture(760, 500, 132, 50, 366, "", "")
    down.parts = picture.parts
    cut = 2.0
    u = (cut - 1.0) / 1.5
    whole = old[1]
    new_node, new_slope = whole.at(u), whole.slope(u)
    down.curve(old[0], SOFT)
    down.curve(old[4], SOFT)
    down.curve(Element(whole.nodes[0], whole.nodes[1], new_node, new_slope, 1.0), ONE)
    down.curve(Element(new_node, new_slope, whole.nodes[2], whole.nodes[3], 0.5), ONE)
    down.curve(old[2], TWO, 1.6, "5 4")
    down.curve(old[3], TWO, 1.6, "5 4")
    merged = Element(old[2].nodes[0], old[2].nodes[1], old[3].nodes[2], old[3].nodes[3], 1.5)
    lost = old[2].nodes[2]
    merged.w = point_fit(merged, 0.5 / 1.5, lost)
    down.curve(merged, TWO)
    for p, name, joint in ((axis(0.0), "i−2", False), (axis(1.0), "i−1", False), (new_node, "H", False),
                           (axis(2.5), "i", True), (axis(4.0), "i+2", False), (axis(5.0), "i+3", False)):
        down.node(p, not joint, 8 if joint else 5)
        px, py = down.to(p)
        down.text((px, py + (30 if joint else 26)), it(name), "middle", False)
    x, y = down.to(lost)
    for sign in (-1, 1):
        down.line([(x - 6, y - 6 * sign), (x + 6, y + 6 * sign)], INK, 2, model=False)
    down.text((x, y + 25), "deleted", "middle", False, 15)
    x, y = down.to(new_node)
    down.text((x + 10, y - 10), "cut: new node", "start", False, 15)
    down.text((14, 268), "after", "start", False, 18)
    tall = 470
    for a, b, words, colour in ((axis(1.0), new_node, it("L", "std"), ONE), (axis(2.5), axis(4.0), "one element, new weights", TWO)):
        xa, xb = down.to(a)[0], down.to(b)[0]
        down.line([(xa, tall), (xb, tall)], colour, 1.2, arrow="both", model=False)
        down.text(((xa + xb) / 2, tall - 7), words, "middle", False, 16, colour)
    down.save(path)


def main():
    folder = Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).parent
    draw_element(folder / "element.svg")
    draw_event(folder / "event.svg")


if __name__ == "__main__":
    main()
