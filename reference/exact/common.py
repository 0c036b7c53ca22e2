"""What the modules of this folder share: cases with measured errors, integration of ordinary differential equations, Newton's method.

A case is solved by two or more methods (other digits, step, number of terms, or other equations); the first gives the values. The error of a
value is the largest difference of the others from it, with what its rounding adds; of a list, the largest of its members.
Values are printed to the digits that their errors allow, 15 at most. Needs mpmath.
"""
import mpmath as mp

DIGITS = 15  # printed at most
mp.mp.dps = 40


def precisely(solve, digits=40):
    """A method that calls solve with so many decimal digits."""
    def run():
        with mp.workdps(digits):
            return solve()
    return run


def printed(value, error):
    """The value rounded to what its error allows, and the error of what is printed."""
    value, error = mp.mpf(value), mp.mpf(error)
    if abs(value) < mp.mpf(10) ** -30:
        value = mp.mpf(0)
    size = 0 if value == 0 else int(mp.floor(mp.log10(abs(value)))) + 1  # digits before the point
    digits = DIGITS
    if error > 0:
        digits = min(digits, size + int(mp.floor(-mp.log10(error))))
    rounded = float(mp.nstr(value, digits)) if digits > 0 else 0.0
    return rounded, float(mp.nstr(1.05 * (error + abs(value - rounded)), 2))


def compare(first, others):
    if isinstance(first, (list, tuple)):
        pairs = [compare(a, [b[i] for b in others]) for i, a in enumerate(first)]
        return [p[0] for p in pairs], max(p[1] for p in pairs)
    return printed(first, max(abs(mp.mpf(first) - mp.mpf(b)) for b in others))


def case(name, kind, source, parameters, units, methods, error_by):
    """The entry of exact.json. Each method returns a dictionary of values, the later ones not necessarily all; error_by names them."""
    answers = [method() for method in methods]
    values, errors = {}, {}
    for key, value in answers[0].items():
        others = [a[key] for a in answers[1:] if key in a]
        if not others:
            raise ValueError(f"{name}: nothing measures the error of {key}")
        values[key], errors[key] = compare(value, others)
    return {"case": name, "kind": kind, "source": source, "parameters": parameters, "units": units, "values": values, "error": errors,
            "error_by": error_by}


def integrate(rates, state, start, end, steps, order=10):
    """The state at the end, by Gragg's midpoint rule extrapolated to an even order (Bulirsch and Stoer) in equal steps."""
    h = (end - start) / steps
    counts = [2 * (k + 1) for k in range(order // 2)]
    for i in range(steps):
        t = start + i * h
        first = rates(t, state)
        table = []
        for j, n in enumerate(counts):
            step = h / n
            before, here = state, [a + step * b for a, b in zip(state, first)]
            for m in range(1, n):
                rate = rates(t + m * step, here)
                before, here = here, [a + 2 * step * b for a, b in zip(before, rate)]
            rate = rates(t + h, here)
            row = [[(a + b + step * c) / 2 for a, b, c in zip(before, here, rate)]]
            for k in range(1, j + 1):
                weight = counts[j - k] ** 2 / (h / h * (counts[j] ** 2 - counts[j - k] ** 2))
                row.append([a + weight * (a - b) for a, b in zip(row[k - 1], table[j - 1][k - 1])])
            table.append(row)
        state = table[-1][-1]
    return state


def newton(residual, x):
    """The root of as many equations as unknowns near x."""
    x = [mp.mpf(a) for a in x]
    for _ in range(60):
        f = residual(x)
        columns = []
        for i in range(len(x)):
            h = mp.mpf(10) ** (-mp.mp.dps // 2) * max(1, abs(x[i]))
            columns.append([(a - b) / h for a, b in zip(residual([a + h * (i == j) for j, a in enumerate(x)]), f)])
        change = mp.lu_solve(mp.matrix(columns).T, mp.matrix(f))
        x = [a - b for a, b in zip(x, change)]
        if max(abs(c) / max(1, abs(a)) for c, a in zip(change, x)) < mp.mpf(10) ** (-0.8 * mp.mp.dps):
            return x
    raise ArithmeticError("Newton's method does not converge")


def bracketed(function, a, b):
    """The root between a and b, where the signs differ: bisection to a small interval, then the secant method inside it."""
    fa = function(a)
    for _ in range(12):
        c = (a + b) / 2
        fc = function(c)
        if fa * fc <= 0:
            b = c
        else:
            a, fa = c, fc
    root = mp.findroot(function, (a, b), solver="secant", tol=mp.mpf(10) ** (-2 * mp.mp.dps), maxsteps=100, verify=False)
    if not a <= root <= b:
        raise ArithmeticError("the root has left its bracket")
    return root


def roots(function, start, step, wanted):
    """The first roots above start, by changes of sign: two within one step are not seen."""
    found, a = [], mp.mpf(start)
    fa = function(a)
    while len(found) < wanted:
        b = a + step
        fb = function(b)
        if fa * fb < 0:
            found.append(bracketed(function, a, b))
        a, fa = b, fb
    return found
