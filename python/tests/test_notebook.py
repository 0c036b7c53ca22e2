"""What notebooks show: pictures, tables, and a bar while a run goes on."""

import subprocess
import sys
import types

import numpy as np
import pytest
import vlbeam
from vlbeam import _notebook


@pytest.fixture(scope="module")
def falling():
    scene = vlbeam.scene("falling_beam")
    scene.beam.elements = 8
    scene.duration = 0.2
    scene.output(interval=0.01, configurations=[0, 0.1, 0.2])
    return vlbeam.run(scene)


def test_plots_say_what_they_show(falling):
    pytest.importorskip("matplotlib").use("Agg")
    shapes = falling.plot()
    assert (shapes.get_xlabel(), shapes.get_ylabel()) == ("x (m)", "y (m)")
    assert [line.get_label() for line in shapes.get_lines() if not line.get_label().startswith("_")] == ["0 s", "0.1 s", "0.2 s"]
    np.testing.assert_allclose(shapes.get_lines()[-2].get_xydata()[-1], falling.end[-1], atol=1e-12)
    np.testing.assert_allclose(shapes.get_lines()[-1].get_xydata()[-1], falling.mass_position[-1], atol=1e-12)
    ends = falling.plot("end.x", "end.y")
    assert [text.get_text() for text in ends.get_legend().get_texts()] == ["end x", "end y"]
    energies = falling.plot("energy")
    assert "gravity" in [text.get_text() for text in energies.get_legend().get_texts()] and energies.get_ylabel() == "energy (J)"
    parts = [line.get_ydata() for line in energies.get_lines()]
    np.testing.assert_allclose(sum(parts[:-1]), parts[-1], atol=1e-12)
    with pytest.raises(ValueError, match="one figure has one unit"):
        falling.plot("end.x", "energy.total")
    assert falling.plot("end.x", ax=ends) is ends


def test_a_plot_has_all_that_slides():
    pytest.importorskip("matplotlib").use("Agg")
    r = vlbeam.run(vlbeam.scene("two_trolleys"))
    dots = [line.get_xydata()[0] for line in r.plot().get_lines() if line.get_marker() == "o"]
    assert len(dots) == 2 * len(r.shape_times)
    np.testing.assert_allclose(dots[0], r.mass_position[0], atol=1e-12)
    assert not np.allclose(dots[0], dots[1])


def test_equilibria_have_no_seconds():
    pytest.importorskip("matplotlib").use("Agg")
    r = vlbeam.run(vlbeam.scene("cable_through_ring"))
    assert r.plot().get_lines()[0].get_label() == "0" and r.plot("end.y").get_xlabel() == "equilibrium"


def test_a_plot_in_space_names_its_plane():
    pytest.importorskip("matplotlib").use("Agg")
    scene = vlbeam.scene("drill_stem")
    scene.duration = 0.01
    scene.output = {"configurations": [0, 0.01]}
    assert " plane" in vlbeam.run(scene).plot().get_title()


def test_frames(falling):
    pytest.importorskip("pandas")
    frame = falling.to_pandas()
    assert frame.index.name == "t" and frame.index.tolist() == falling.t.tolist()
    assert frame["end.y"].tolist() == falling.end[:, 1].tolist()
    assert frame.attrs["units"]["energy.total"] == "J" and list(frame) == falling.names


def test_html_has_a_picture_and_a_table(falling):
    pytest.importorskip("matplotlib")
    page = falling._repr_html_()
    assert page.startswith("<b>Falling beam") and "<svg" in page and "joint position" in page and "<table>" in page
    assert falling._repr_html_() == page


def test_converge_is_an_object():
    pytest.importorskip("matplotlib").use("Agg")
    found = vlbeam.converge(vlbeam.scene("pendulum"), "end.y", 1e-4)
    assert isinstance(found, vlbeam.Convergence) and found.unit == "m" and found["answer"] == found.answer
    assert repr(found).startswith(f"end.y at t = 0.5 s: {found.answer:.10g} +- ") and "reached" in repr(found)
    assert "<svg" in found._repr_html_() and found.plot().get_xlabel() == "work (element evaluations)"
    assert {"answer", "levels", "plot"} <= set(dir(found))
    pytest.importorskip("pandas")
    assert len(found.to_pandas()) == len(found.levels)


@pytest.mark.parametrize("package, call", [("matplotlib", "r.plot()"), ("pandas", "r.to_pandas()")])
def test_what_is_optional_is_named_when_it_is_missing(package, call):
    code = (f"import sys; sys.modules[{package!r}] = None\nimport vlbeam\nr = vlbeam.run(vlbeam.scene('pendulum'))\n"
            f"assert '<table>' in r._repr_html_()\n{call}")
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert f"ImportError: this needs {package}: pip install 'vlbeam[" in done.stderr


class Handle:
    """What a notebook shows, as a list."""

    def __init__(self):
        self.shown = []

    def display(self, what, display_id):
        assert display_id
        self.update(what)
        return self

    def update(self, what):
        self.shown.append(what._repr_html_())


@pytest.fixture
def notebook(monkeypatch):
    handle = Handle()
    shell = types.SimpleNamespace(kernel=object())
    monkeypatch.setitem(sys.modules, "IPython", types.SimpleNamespace(get_ipython=lambda: shell, display=handle))
    monkeypatch.setattr(_notebook, "_LATER", 0)
    return handle


@pytest.mark.parametrize("call, words, step", [  # steps short enough for a busy machine to show some of the way
    (lambda s: vlbeam.run(s), "run: ", 2e-6), (lambda s: vlbeam.converge(s, "end.y", 1e-3), "converge: ", 1e-5),
    (lambda s: vlbeam.sweep(s, {"/beam/elements": [20] * 4}, jobs=1), "sweep: ", 1e-5)])
def test_a_bar_in_notebooks(notebook, call, words, step):
    scene = vlbeam.scene("falling_beam")
    scene.integrator.generalized_alpha(step=step)
    call(scene)
    assert len(notebook.shown) > 2 and words in notebook.shown[0] and notebook.shown[0].startswith("<progress")
    assert notebook.shown[-1] == ""  # it goes away


def test_no_bar_where_none_is_wanted(notebook):
    vlbeam.run(vlbeam.scene("pendulum"), progress=False)
    assert notebook.shown == []


def test_an_exception_of_the_bar_ends_the_run(monkeypatch):
    class Stop(Exception):
        pass

    class Bad:
        def __enter__(self):
            def stop(*_):
                raise Stop
            return stop

        def __exit__(self, *_):
            pass

    monkeypatch.setattr(vlbeam, "_bar", lambda *_: Bad())
    scene = vlbeam.scene("falling_beam")
    scene.integrator.generalized_alpha(step=1e-6)
    with pytest.raises(Stop):
        vlbeam.run(scene)
