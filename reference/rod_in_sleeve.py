#!/usr/bin/env python3
"""Writes reference/rod_in_sleeve.json: an inextensible rod that throws a weight out of its frictionless sleeve.

Koutsogiannakis, Papathanasiou and Dal Corso, arXiv 2410.22545, have such rods inextensible: of the rod on either side of the sleeve the
angle theta is all, and how much of it there is, l in front and L - l behind. With sigma = s/l from the sleeve on, e = (cos, sin) theta,
    r = l int_0^sigma e,   v = r_t + e l' (1 - sigma) at a material point,   L = int (rhoA v.v/2 - EI theta_s^2/2 - rhoA g y) + weight,
and behind it the same along -e with L - l. Lagrange's equations of l hold the configurational force M^2/(2 EI) of each side. theta is a
polynomial by its derivative in Legendre polynomials; integrals by Gauss points, gradients by complex steps, motion by Hamilton's equations and
Runge-Kutta steps of order 4. At first the rod is in equilibrium while the sleeve holds l.
The uncertainty is the change by two modes less on either side, or by steps longer by a third. Needs numpy.

    rod_in_sleeve.py
"""
import json
import os

import numpy as np

ROD = {"length": 3.0, "EI": 10.0, "rhoA": 0.05, "inclination_degrees": 30.0, "in_front": 1.2, "mass": 1.0, "gravity": 9.81}
TIMES = [0.1 * i for i in range(1, 10)]


class Side:
    """The rod in front of the sleeve (sign 1) or behind it (sign -1), with a weight at its end."""

    def __init__(self, modes, points, sign, weight):
        x, w = np.polynomial.legendre.leggauss(points)
        self.sigma, self.w, self.sign, self.weight = (x + 1) / 2, w / 2, sign, weight
        legendre = np.polynomial.legendre.Legendre.basis
        self.slope = np.array([legendre(k)(x) for k in range(modes)])  # theta_sigma, theta: mode by point
        self.angle = np.array([legendre(k).integ(lbnd=-1)(x) / 2 for k in range(modes)])
        # integrals from 0 to each point of what has given values at the points
        basis = np.array([legendre(k)(x) for k in range(points)])
        to_modes = np.array([(2 * k + 1) * self.w * basis[k] for k in range(points)])
        self.integral = np.array([legendre(k).integ(lbnd=-1)(x) / 2 for k in range(points)]).T @ to_modes

    def at(self, length, modes):
        """e, n (point in the last axis) and positions, of one configuration or of many."""
        theta = np.deg2rad(ROD["inclination_degrees"]) + modes @ self.angle
        e = self.sign * np.stack([np.cos(theta), np.sin(theta)])
        n = self.sign * np.stack([-np.sin(theta), np.cos(theta)])
        return e, n, length[..., None] * (e @ self.integral.T)

    def velocity(self, length, modes, length_rate, rates):
        """Of the points, and of the end."""
        e, n, _ = self.at(length, modes)
        turn = n * (rates @ self.angle)
        inner = length_rate * (e @ self.integral.T) + length[..., None] * (turn @ self.integral.T) + e * (length_rate * (1 - self.sigma))
        return inner, length_rate * (e @ self.w) + length * (turn @ self.w)

    def kinetic(self, length, modes, length_rate, rates):
        inner, end = self.velocity(length, modes, length_rate, rates)
        return ROD["rhoA"] / 2 * length * ((inner**2).sum(0) @ self.w) + self.weight / 2 * (end**2).sum(0)

    def potential(self, length, modes):
        e, _, r = self.at(length, modes)
        bending = ROD["EI"] / 2 / length * ((modes @ self.slope) ** 2 @ self.w)
        return bending + ROD["gravity"] * (ROD["rhoA"] * length * (r[1] @ self.w) + self.weight * length * (e[1] @ self.w))

    def mass(self, length, modes, length_by_l):
        """The mass matrix in (l', rates)."""
        e, n, _ = self.at(length, modes)
        rows = [length_by_l * (e @ self.integral.T + e * (1 - self.sigma))]
        ends = [length_by_l * (e @ self.w)]
        for shape in self.angle:
            rows.append(length * ((n * shape) @ self.integral.T))
            ends.append(length * ((n * shape) @ self.w))
        rows, ends = np.array(rows), np.array(ends)
        return ROD["rhoA"] * length * np.einsum("icp,jcp,p->ij", rows, rows, self.w) + self.weight * ends @ ends.T


class Rod:
    def __init__(self, modes):
        points = 2 * modes + 10
        self.modes, self.front, self.behind = modes, Side(modes, points, 1, ROD["mass"]), Side(modes, points, -1, 0.0)

    def parts(self, q):
        return q[..., 0], q[..., 1 : self.modes + 1], q[..., self.modes + 1 :]

    def lagrangian(self, q, rate):
        l, a, b = self.parts(q)
        l_rate, a_rate, b_rate = self.parts(rate)
        rest = ROD["length"] - l
        return self.front.kinetic(l, a, l_rate, a_rate) + self.behind.kinetic(rest, b, -l_rate, b_rate) - self.potential(q)

    def potential(self, q):
        l, a, b = self.parts(q)
        return self.front.potential(l, a) + self.behind.potential(ROD["length"] - l, b)

    @staticmethod
    def gradient(function, q):
        step = 1e-30
        return function(q + 1j * step * np.eye(q.size)).imag / step

    def mass(self, q):
        l, a, b = self.parts(q)
        n = self.modes
        front, behind = self.front.mass(l, a, 1), self.behind.mass(ROD["length"] - l, b, -1)
        m = np.zeros((2 * n + 1, 2 * n + 1))
        m[: n + 1, : n + 1] = front
        keep = np.r_[0, n + 1 : 2 * n + 1]
        m[np.ix_(keep, keep)] += behind
        return m

    def rates(self, q, p):
        rate = np.linalg.solve(self.mass(q), p)
        return rate, self.gradient(lambda many: self.lagrangian(many, rate), q)

    def equilibrium(self):
        q = np.zeros(2 * self.modes + 1)
        q[0] = ROD["in_front"]
        for _ in range(50):
            force = self.gradient(self.potential, q)[1:]
            hessian = np.array([(self.gradient(self.potential, q + h) - self.gradient(self.potential, q - h))[1:] / 2e-6 for h in 1e-6 * np.eye(q.size)[1:]])
            change = np.linalg.solve(hessian, force)
            q[1:] -= change * min(1.0, 0.5 / np.abs(change).max())
            if np.abs(change).max() < 1e-13:
                return q
        raise RuntimeError("no equilibrium")


def motion(modes, step):
    """l, the place of the weight and the energy at TIMES."""
    rod = Rod(modes)
    q, t, result = rod.equilibrium(), 0.0, []
    p = np.zeros_like(q)
    first = rod.potential(q)
    for until in TIMES:
        count = int(np.ceil((until - t) / step - 1e-9))
        h = (until - t) / count
        for _ in range(count):
            v1, f1 = rod.rates(q, p)
            v2, f2 = rod.rates(q + h / 2 * v1, p + h / 2 * f1)
            v3, f3 = rod.rates(q + h / 2 * v2, p + h / 2 * f2)
            v4, f4 = rod.rates(q + h * v3, p + h * f3)
            q = q + h / 6 * (v1 + 2 * v2 + 2 * v3 + v4)
            p = p + h / 6 * (f1 + 2 * f2 + 2 * f3 + f4)
        t = until
        l, a, _ = rod.parts(q)
        end = l * (rod.front.at(l, a)[0] @ rod.front.w)
        rate = np.linalg.solve(rod.mass(q), p)
        off = rate @ p / 2 + rod.potential(q) - first
        result.append((l, *end, off))
        print(modes, step, f"{t:.1f}", *result[-1], flush=True)
    return np.array(result)


if __name__ == "__main__":
    best = motion(8, 6e-5)
    change = np.maximum(np.abs(motion(6, 6e-5) - best), np.abs(motion(8, 8e-5) - best))[:, :3]
    here = os.path.dirname(os.path.abspath(__file__))
    answers = [{"t": t, "in_front": b[0], "x": b[1], "y": b[2], "uncertainty": float(c.max())} for t, b, c in zip(TIMES, best.tolist(), change)]
    with open(os.path.join(here, "rod_in_sleeve.json"), "w") as file:
        json.dump({"source": "reference/rod_in_sleeve.py: inextensible, in the formulation of Koutsogiannakis, Papathanasiou, Dal Corso, arXiv 2410.22545",
                   "units": {"t": "s", "in_front": "m", "x": "m", "y": "m"}, "rod": ROD, "motion": answers}, file, indent=1)
        file.write("\n")
