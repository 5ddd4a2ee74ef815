"""The examples, run as a user would; blocks of a sweep give the same bytes from any number of workers."""

import pathlib
import subprocess
import sys
from fractions import Fraction

import numpy as np
import pytest

import dalembert

EXAMPLES = pathlib.Path(__file__).resolve().parents[1] / "examples"


def output(name: str) -> str:
    return subprocess.run([sys.executable, EXAMPLES / name], capture_output=True, text=True, check=True).stdout


def test_the_readme(tmp_path, monkeypatch):
    """All of its Python, with data that are off by a thousandth."""
    pytest.importorskip("pandas")
    pytest.importorskip("matplotlib").use("Agg")
    monkeypatch.chdir(tmp_path)
    scene = dalembert.solve("doyen-ern-piperno")
    for name, steps in [("run", 14001), ("coarse", 1401), ("fine", 2801)]:
        t = np.linspace(0, 14, steps)
        u, f = 1.001 * scene.ground_end(t).u_end, -900 * scene.strain(t)
        np.savetxt("run.csv", np.column_stack([t, u, f])) if name == "run" else np.savez(name, t=t, u=u, force=f)
    text = (EXAMPLES.parent / "README.md").read_text()
    blocks = [block.split("```")[0] for block in text.split("```python\n")[1:]]
    assert len(blocks) == 4
    names = {}
    for block in blocks:
        exec(block, names)
    assert names["m"].contacts["release"].tolist() == [2, 5, 8, 11]
    assert names["rod"].impact_speed == Fraction(4, 3)


def test_own_scheme():
    assert "contact from 0 to 2.0, peak v_x = -5.0" in output("own_scheme.py")


def test_two_bars():
    lines = output("two_bars.py").splitlines()
    assert lines[0] == "exact: contact from 0.1000 to 0.3857, force 0.041176"
    assert float(lines[2].split()[4].rstrip("%")) < 2
    # d ln f/d ln E = Z₁/2(Z₁ + Z₂) with Z = 0.7 and 1.
    assert f"{0.5 * 0.7 / 1.7:.1%}" in lines[3]


def test_convergence_order():
    orders = [float(line.split()[-1]) for line in output("convergence_order.py").splitlines()[2:]]
    # Between that of a jump spread over cells and that of a smooth solution.
    assert len(orders) == 4 and all(0.5 < order < 1.2 for order in orders)


def test_restitution_over_speed():
    undamped = [float(line.split()[1]) for line in output("restitution_over_speed.py").splitlines()[1:]]
    # r = 0, μ = 12.5 ≥ μ₀ = 2: E_z/E = μ₀²/3μ² of what is left.
    assert undamped[-1] == pytest.approx(np.sqrt(1 - 4 / (3 * 12.5**2)), abs=1e-6)


def test_two_workers_give_the_bytes_of_one(monkeypatch):
    dask = pytest.importorskip("dask.distributed")
    monkeypatch.syspath_prepend(str(EXAMPLES))
    monkeypatch.setenv("PYTHONPATH", str(EXAMPLES))
    from sweep_with_dask import bounce, sweep

    speeds, dampings = np.meshgrid(np.geomspace(0.05, 12.5, 30), [0, 0.1, 0.3])
    points = np.column_stack([speeds.ravel(), dampings.ravel()])
    with dask.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster:
        with dask.Client(cluster) as client:
            answers = sweep(client, points, blocks=7)
    assert answers.tobytes() == bounce(points).tobytes()
