"""Pictures by matplotlib, in the colours of ``dalembert plot``."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Sequence

import numpy as np

if TYPE_CHECKING:
    import matplotlib.axes

LINES = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000")
CONTACT = "#c6c6c6"
SAMPLES = 2000
# Beyond these powers of ten an axis says the power beside it: stiff rods are in contact for microseconds.
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
        # The waves in a stiff rod would not be seen beside a flight of hundreds of round trips.
        start, last = history._core.span()
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
    names = [quantities] if isinstance(quantities, str) else list(quantities)
    for contact in history.contacts:
        until = last if contact["release"] is None else min(_float(contact["release"]), last)
        begin = max(_float(contact["impact"]), start)
        if begin < (last if np.isnan(until) else until):
            ax.axvspan(begin, last if np.isnan(until) else until, color=CONTACT, alpha=0.5, linewidth=0)
    # Both limits of a jump, so that it is drawn upright.
    columns = history.columns(["t", *names], _lifted(history, times))
    axis = [_float(value) for value in columns["t"]]
    for k, name in enumerate(names):
        ax.plot(axis, [_float(value) for value in columns[name]], color=LINES[k % len(LINES)], label=name)
    ax.set(xlabel="t", xlim=(start, last))
    ax.ticklabel_format(scilimits=POWERS)
    ax.legend()
    return ax


def _lifted(history: Any, times: np.ndarray[Any, Any]) -> Any:
    """Times to draw at: equal steps, and every event between them."""
    events = [_float(value) for value in history.events["t"]]
    inside = [value for value in events if times[0] <= value <= times[-1]]
    return np.unique(np.concatenate([times, inside]))
