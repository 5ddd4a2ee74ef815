"""Pictures with matplotlib, in the colours of ``dalembert plot``."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Sequence

import numpy as np

if TYPE_CHECKING:
    import matplotlib.axes

LINES = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000")
CONTACT = "#c6c6c6"
SAMPLES = 2000
#: Powers of ten outside of which an axis has its power beside it: contacts of stiff rods take microseconds.
POWERS = (-3, 4)


def _float(value: Any) -> float:
    return float(value[0] if isinstance(value, tuple) else value)


def draw(
    history: Any,
    quantities: str | Sequence[str],
    ax: matplotlib.axes.Axes | None,
    start: float | None,
    end: float | None,
) -> matplotlib.axes.Axes:
    if ax is None:
        from matplotlib import pyplot

        ax = pyplot.subplots()[1]
    if start is None and end is None and quantities == "xt":
        # A flight of hundreds of round trips would hide the waves in a stiff rod.
        start, last = history._compiled.span()
    else:
        start, last = start or 0.0, min(_float(history.end), np.inf if end is None else end)
    times = np.linspace(start, last, SAMPLES)
    if isinstance(quantities, str) and quantities == "xt":
        from matplotlib.ticker import ScalarFormatter

        length = float(history.problem.length)
        points = np.linspace(0.0, length, 201)
        strain = np.array(np.vectorize(_float)(history.grid(points, times[::2]).strain), dtype=float)
        peaks = [abs(_float(peak)) for peak in history.contacts["peak_strain"]]
        most = max([float(np.abs(strain).max()), *peaks]) or 1.0
        mesh = ax.pcolormesh(times[::2], points, strain.T, cmap="RdBu_r", vmin=-most, vmax=most, shading="nearest")
        numbers = ScalarFormatter()
        numbers.set_powerlimits(POWERS)
        ax.figure.colorbar(mesh, ax=ax, label="v_x", format=numbers)
        ax.set(xlabel="t", ylabel="x")
        ax.ticklabel_format(scilimits=POWERS)
        return ax
    for impact, release in history.contacts[["impact", "release"]].tolist():
        begin, until = max(_float(impact), start), last if release is None else min(_float(release), last)
        if begin < until:
            ax.axvspan(begin, until, color=CONTACT, alpha=0.5, linewidth=0)
    names = [quantities] if isinstance(quantities, str) else quantities
    # A jump is drawn upright through both of its limits.
    columns = history.columns(_with_events(history, times), ["t", *names])
    axis = [_float(value) for value in columns.pop("t")]
    for k, (name, values) in enumerate(columns.items()):
        ax.plot(axis, [_float(value) for value in values], color=LINES[k % len(LINES)], label=name)
    ax.set(xlabel="t", xlim=(start, last))
    ax.ticklabel_format(scilimits=POWERS)
    ax.legend()
    return ax


def _with_events(history: Any, times: np.ndarray[Any, Any]) -> Any:
    """Return the times and every event between them."""
    events = [_float(value) for value in history.events["t"]]
    inside = [value for value in events if times[0] <= value <= times[-1]]
    return np.unique(np.concatenate([times, inside]))
