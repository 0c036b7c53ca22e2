"""What a run gave, and what `converge` found."""

import html
import io
import json
from pathlib import Path

from . import _drawing
from ._optional import needs


class Record(dict):
    """A dictionary whose keys are attributes, too."""

    __getattr__ = dict.__getitem__

    def __getattribute__(self, name):
        try:
            return super().__getattribute__(name)
        except KeyError:
            raise AttributeError(name) from None

    def __dir__(self):
        return [*self, *super().__dir__()]


class ComputationFailed(RuntimeError):
    """The computation broke down. `result` holds what was computed until then, up to the last good state."""

    def __init__(self, message, result):
        super().__init__(message)
        self.result = result


def _as_html(summary, draw):
    """A picture by matplotlib, where it is there, and the summary below it."""
    picture = ""
    try:
        from matplotlib import rc_context
        from matplotlib.figure import Figure
    except ImportError:
        pass
    else:
        figure = Figure(figsize=(6.4, 3.6), layout="constrained")
        draw(figure.add_subplot())
        svg = io.StringIO()
        with rc_context({"svg.hashsalt": "vlbeam"}):  # the same result, the same picture
            figure.savefig(svg, format="svg", metadata={"Date": None})
        picture = svg.getvalue()[svg.getvalue().index("<svg"):]
    rows = "".join(f"<tr><th style='text-align:left'>{html.escape(name)}</th><td style='text-align:left'>{html.escape(value)}</td></tr>"
                   for name, value in summary)
    return f"<div>{picture}<table>{rows}</table></div>"


class _OfSamples(dict):
    """What is known of samples by name; what is known of "end" holds for "end.y", too."""

    def __missing__(self, name):
        whole = name.rpartition(".")[0] if isinstance(name, str) else ""
        if not whole:
            raise KeyError(name)
        return self[whole]


class _Group:
    """Samples below a path: `r.energy` with `r.energy.total`."""

    def __init__(self, run, tree, path):
        self._run, self._tree, self._path = run, tree, path

    def __getattr__(self, name):
        if name.startswith("_") or name not in self._tree:
            raise AttributeError(f"{name!r} is not sampled here; there are: {', '.join(self._tree)}")
        path = f"{self._path}{name}"
        below = self._tree[name]
        value = _Group(self._run, below, path + "/") if below else self._run.samples(path)
        self.__dict__[name] = value
        return value

    def __dir__(self):
        return list(self._tree)

    def __repr__(self):
        return f"<{self._path.rstrip('/') or 'samples'}: {', '.join(self._tree)}>"


class Result(_Group):
    """What a run gave.

    Samples are numpy arrays: shape (samples,) for numbers, (samples, dimension) for vectors, in SI units, which `units`
    names. NaN stands where a quantity is not there, like `joint_position` once the mass has left the beam.
    """

    def __init__(self, run):
        tree, self.units, self.descriptions = {}, _OfSamples(), _OfSamples()
        for path, unit, description in run.paths():
            branch = tree
            for segment in path.split("/"):
                branch = branch.setdefault(segment, {})
            name = path.replace("/", ".")
            self.units[name], self.descriptions[name] = unit, description
        super().__init__(run, tree, "")

    def __getitem__(self, name):
        """Samples of one number by its name, shape (samples,): r["end.y"]. Raises InvalidInput for another name."""
        return self._run.column(name)

    def __dir__(self):
        return [*self._tree, *(name for name in dir(type(self)) if not name.startswith("_")), "units", "descriptions"]

    def __repr__(self):
        return self._run.summary()

    def _repr_html_(self):
        lines = [(line[2:16].strip(), line[18:]) for line in self._run.summary().splitlines()[1:]]
        return f"<b>{html.escape(self.title)}</b>" + _as_html([line for line in lines if line[0] != "steps"], lambda axes: self.plot(ax=axes))

    @property
    def title(self):
        """What the scene shows: its title."""
        return self._run.title

    @property
    def status(self):
        """completed, or separated where the mass has left the beam."""
        return self._run.status

    @property
    def names(self):
        """Names of all single numbers, as r["end.y"], `vlbeam converge` and `vlbeam plot` take them."""
        return [name for name, _ in self._run.columns()]

    @property
    def extremes(self):
        """Least and largest of each number over all steps, by name: a record with `least`, `least_at` [s], `largest` and
        `largest_at` [s]. Empty unless the scene asks for them: `scene.output.extremes = True`.
        """
        keys = ("least", "least_at", "largest", "largest_at")
        return {name: Record(zip(keys, values)) for name, values in self._run.extremes().items()}

    @property
    def shape_times(self):
        """Times [s] at which the whole shape was kept: those of /output/configurations."""
        return self._run.shape_times()

    def shape(self, index, points=8):
        """One shape that was kept, as points along the axis, `points` intervals an element.

        Gives a record with t [s] and arrays over the n points: x [m], the material coordinate, shape (n,); r [m], r_x [-]
        and v [m/s], shape (n, dimension); strain [-], tension [N], curvature [1/m], shear [N], moment [N m] and torque [N m], shape
        (n,).
        """
        times = self._run.shape_times()
        if not -len(times) <= index < len(times):
            raise IndexError(f"{len(times)} shapes were kept, numbered from 0: list their times in /output/configurations")
        return Record(self._run.shape(index % len(times), points))

    def report(self):
        """The report as `vlbeam run --report` writes it (`vlbeam.schema("run")`), as a dictionary."""
        return json.loads(self._run.report())

    @property
    def error(self):
        """How far the run may be off: a record with `time` and `mesh` [m], `trusted_until` [s], `quantities`; or None.

        Companions with longer steps and on coarser meshes tell it, where the run was checked.
        """
        return json.loads(self._run.report(), object_hook=Record).get("error")

    @property
    def warnings(self):
        """What the run warns of: records with `kind`, `message` and `remedy`."""
        return json.loads(self._run.report(), object_hook=Record)["warnings"]

    @property
    def events(self):
        """Length-control events and what else happened, as the report has them: records with `type` and `t` [s]."""
        return json.loads(self._run.report(), object_hook=Record)["events"]

    def csv(self):
        """The samples as CSV text, units in the first line."""
        return self._run.csv()

    def save(self, path):
        """Writes the report to a file, for `vlbeam plot` and `vlbeam compare`."""
        Path(path).write_text(self._run.report(), encoding="utf-8")

    def to_pandas(self):
        """The samples as a pandas.DataFrame: a row a sample, indexed by t [s]; a column a number, named as in r["end.y"].

        Units are in `frame.attrs["units"]`. Needs pandas: pip install 'vlbeam[pandas]'.
        """
        pandas = needs("pandas", "pandas")
        columns = self._run.columns()
        frame = pandas.DataFrame({name: self._run.column(name) for name, _ in columns}, index=pandas.Index(self.t, name="t"))
        frame.attrs["units"] = dict(columns)
        return frame

    def plot(self, *names, ax=None):
        """Draws by matplotlib, and returns the axes.

        names: of quantities of one unit, drawn against time: r.plot("end.x", "end.y"). "energy" stands for all parts of
        the energy. Without a name the shapes that were kept are drawn, with what slides on them; in space in the plane
        in which the beam reaches furthest, which the title names. Where no shape was kept, the place of the mass or of
        the beam's end is drawn.
        ax: axes to draw into; new ones if not given.
        """
        return _drawing.result(self, names, ax)


class Convergence(Record):
    """How far a quantity can be trusted: what `vlbeam converge` reports (`vlbeam.schema("converge")`).

    answer, uncertainty, error: in `unit`, of `quantity` at time `t` [s], or of an equilibrium. reached: whether the uncertainty is no more than
    the error wanted; if not, `reason` says why. setting: the cheapest one that keeps the error. levels: all that was run.
    Every key of the report is an attribute, and a key of a dictionary, too.
    """

    def __repr__(self):
        lines = [f"{self.quantity}{self._when()}: {self.answer:.10g} +- {self.uncertainty:.2g} {self.unit}"]
        lines += [f"  {name:<12}{value}" for name, value in self._summary()]
        return "\n".join(lines)

    def _when(self):
        return " of the equilibrium" if self.scene.get("analysis") == "statics" else f" at t = {self.t:g} s"

    def _summary(self):
        lines = [(name, f"+- {part.uncertainty:.2g} {self.unit}, " + (f"order {part.order:.3g}" if part.order else part.get("refusal", "no order")))
                 for name, part in self.parts.items() if part.uncertainty is not None]
        lines.append(("wanted", f"{self.error:.3g} {self.unit}: " + ("reached" if self.reached else f"not reached, {self.get('reason', '')}")))
        if self.get("setting"):
            lines.append(("cheapest", ", ".join(f"{name.replace('_', ' ')} {value:g}" for name, value in self.setting.items())))
        return lines

    def _repr_html_(self):
        head = f"<b>{html.escape(self.quantity)} = {self.answer:.10g} ± {self.uncertainty:.2g} {html.escape(self.unit)}</b>{self._when()}"
        return head + _as_html(self._summary(), lambda axes: self.plot(ax=axes))

    def to_pandas(self):
        """The runs as a pandas.DataFrame, a row a run. Needs pandas: pip install 'vlbeam[pandas]'."""
        return needs("pandas", "pandas").json_normalize(self.levels)

    def plot(self, ax=None):
        """Draws error against work by matplotlib, and returns the axes."""
        return _drawing.convergence(self, ax)
