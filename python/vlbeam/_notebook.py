"""A progress bar in notebooks: Jupyter's, or what shows rich output as it does."""

import html
import sys
import time

_LATER = 0.5  # s: what is done sooner needs no bar


class Bar:
    """Called with the fraction done, negative where it is not known, and a text; a context, which takes the bar away."""

    def __init__(self, title, show, clock=time.monotonic):
        self._title, self._show, self._clock, self._start, self._handle = title, show, clock, clock(), None

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self._handle is not None:
            self._handle.update(_Html(""))

    def __call__(self, fraction, text):
        seconds = self._clock() - self._start
        if seconds < _LATER:
            return
        known = f'value="{fraction:.4f}"' if fraction >= 0 else ""
        left = f", about {seconds * (1 - fraction) / fraction:.0f} s left" if fraction > 0.01 else ""
        words = f"{self._title}: {text or f'{100 * fraction:.0f} %'}, {seconds:.0f} s{left}"
        shown = _Html(f'<progress max="1" {known} style="width:16em"></progress> {html.escape(words)}')
        if self._handle is None:
            self._handle = self._show(shown)
        else:
            self._handle.update(shown)


class _Html:
    def __init__(self, text):
        self._text = text

    def _repr_html_(self):
        return self._text

    def __repr__(self):
        return ""


class _Silent:
    """No bar: what takes its place is None."""

    def __enter__(self):
        return None

    def __exit__(self, *_):
        pass


def bar(title, wanted):
    """A bar, in notebooks, where it is wanted."""
    ipython = sys.modules.get("IPython")
    shell = ipython.get_ipython() if ipython else None
    in_notebook = shell is not None and hasattr(shell, "kernel")
    if not (wanted and in_notebook):
        return _Silent()
    return Bar(title, lambda shown: ipython.display.display(shown, display_id=True))
