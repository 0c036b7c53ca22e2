"""Figures of results, by matplotlib."""

import numpy as np

from ._optional import needs

_ENERGIES = ("kinetic", "axial", "bending", "torsion", "gravity", "dissipated", "total", "supplied")
_AXES = "xyz"


def _axes(ax):
    if ax is not None:
        return ax
    return needs("matplotlib.pyplot", "plot").subplots(layout="constrained")[1]


def label(name):
    """A name as a legend says it: "joint_position" is "joint position", "end.y" is "end y"."""
    return name.replace("_", " ").replace(".", " ")


def result(r, names, ax):
    if not names and not r.shape_times and _several(r):
        names = [name for name in r.names if name.endswith("end.x") or name.endswith("end.y")]
    elif not names and not r.shape_times:
        names = ["end." + _AXES[k] for k in range(r.end.shape[1])] if np.isnan(r.joint_position).all() else ["joint_position"]
    if not names:
        return _shapes(r, _axes(ax))
    if list(names) == ["energy"]:
        names = ["energy." + part for part in _ENERGIES if part in dir(r.energy) and (part == "total" or np.any(r["energy." + part] != 0))]
    return _histories(r, names, _axes(ax))


def _histories(r, names, ax):
    units = {name: unit for name, unit in r._run.columns()}
    values = {name: r[name] for name in names}
    told = {units.get(name, "-") for name in names}
    if len(told) > 1:
        raise ValueError(f"one figure has one unit; these have {', '.join(sorted(told))}: {', '.join(names)}")
    for name, column in values.items():
        ax.plot(r.t, column, label=label(name.removeprefix("energy.") if len(names) > 1 else name))
    unit = told.pop()
    time = "equilibrium" if _statics(r) else "t (s)"
    what = label(names[0]) if len(names) == 1 else "energy" if names[0].startswith("energy.") else "value"
    ax.set(xlabel=time, ylabel=f"{what} ({unit})", title=r.title)
    if len(names) > 1:
        ax.legend()
    return ax


def _statics(r):
    return "load_factor" in r.names


def _several(r):
    """Whether the scene has several beams and bodies."""
    return "end.x" not in r.names


def _joints(r, dimension):
    """Places of all that slides, and of bodies: a list of arrays of shape (samples, dimension)."""
    axes = _AXES[:dimension]
    if _several(r):
        stems = [name[:-2] for name in r.names if name.endswith(".place.x") or (name.count(".") == 2 and name.endswith(".position.x"))]
        return [np.column_stack([r[f"{stem}.{axis}"] for axis in axes]) for stem in stems]
    several = [k for k in range(len(r.names)) if f"joint{k}_mass_position_x" in r.names]
    if several:
        return [np.column_stack([r[f"joint{k}_mass_position_{axis}"] for axis in axes]) for k in several]
    return [r.mass_position] if "mass_position.x" in r.names else []


def _shapes(r, ax):
    shapes = [r.shape(k) for k in range(len(r.shape_times))]
    across, up, plane = 0, 1, ""
    dimension = shapes[0].r.shape[1]
    if dimension == 3:
        points = np.concatenate([shape.r for shape in shapes])
        across, up = sorted(np.argsort(np.ptp(points, axis=0), kind="stable")[-2:])
        plane = f", {_AXES[across]}{_AXES[up]} plane"
    places = _joints(r, dimension)
    unit = "" if _statics(r) else " s"
    times = sorted({shape.t for shape in shapes})  # of several beams there is a shape each
    colours = needs("matplotlib", "plot").colormaps["viridis"](np.linspace(0, 0.85, len(times)))
    for k, shape in enumerate(shapes):
        colour, first = colours[times.index(shape.t)], k == 0 or shapes[k - 1].t != shape.t
        ax.plot(shape.r[:, across], shape.r[:, up], color=colour, label=f"{shape.t:.4g}{unit}" if first else None)
        if not first:
            continue
        sample = np.flatnonzero(np.isclose(r.t, shape.t, rtol=0, atol=1e-9 * r.t[-1]))
        for place in places if sample.size else []:
            ax.plot(place[sample[0], across], place[sample[0], up], "o", color=colour)
    ax.set(xlabel=f"{_AXES[across]} (m)", ylabel=f"{_AXES[up]} (m)", title=r.title + plane)
    low, high = ax.get_ylim()
    left, right = ax.get_xlim()
    if 0.05 < (high - low) / (right - left) < 20:  # a small deflection keeps a scale of its own
        ax.set_aspect("equal", adjustable="datalim")
    if len(times) <= 12:
        ax.legend(fontsize="small")
    return ax


def convergence(found, ax):
    ax = _axes(ax)
    for kind, marker in (("mesh", "o"), ("time", "s"), ("quadrature", "^")):
        rows = [level for level in found.levels if level.refined == kind and level.get("error_bound")]
        if rows:
            ax.plot([row.work for row in rows], [row.error_bound for row in rows], marker, label=f"{kind} refined")
    ax.axhline(found.error, color="0.5", label="error wanted")
    ax.set(xscale="log", yscale="log", xlabel="work (element evaluations)", ylabel=f"bound of the error ({found.unit})",
           title=f"{label(found.quantity)} at {found.t:g} s")
    ax.legend()
    return ax
