"""What the module does with Python's own things: types, shapes, errors, threads, Ctrl-C, pickles."""

import pickle
import signal
import subprocess
import sys
import threading
import time
from decimal import Decimal
from fractions import Fraction

import numpy as np
import pytest

import dalembert

ROD = dict(length=1, wave_speed=1, gravity=1, impact_speed=3)


def rod(**values) -> dalembert.Problem:
    return dalembert.Problem(**{**ROD, **values})


def test_numbers_of_every_type_are_the_same_problem():
    for speed in (3, 3.0, Fraction(3), Decimal("3.0"), "3", "6/2", np.int64(3), np.float32(3)):
        exact = dalembert.Problem(**{**ROD, "impact_speed": speed}).solve(exact=True)
        assert exact.contacts["to"].tolist() == [2]
    tenth = dalembert.Problem(**{**ROD, "length": 0.1}).solve(exact=True)
    assert tenth.contacts["to"].tolist() == [Fraction(1, 5)]


def test_kinds_of_answers():
    rod = dalembert.Problem(**ROD)
    # v_x(0,t) = −(μ + g t)/c until the wave comes back.
    assert rod.solve().strain("1/3") == -10 / 3
    assert rod.solve(exact=True).strain(Fraction(1, 3)) == Fraction(-10, 3)
    assert rod.solve(digits=20).strain("1/3") == Decimal("-3.3333333333333333333")
    lo, hi = rod.solve(certified=True).strain("1/3")
    assert lo < hi and Fraction(lo) <= Fraction(-10, 3) <= Fraction(hi)
    assert rod.solve(exact=True).strain([[0, 0.1], ["1/3", 1]]).shape == (2, 2)


def test_shapes_and_sides():
    history = dalembert.solve("getfem-dynamic-contact", to=3)
    t, x = np.linspace(0, 3, 12).reshape(3, 4), np.linspace(0, 1, 5)
    field = history.field(x, t)
    assert field.strain.shape == (3, 4, 5) and field.strain.flags.c_contiguous
    assert field.displacement[1, 2, 3] == history.field(x[3], t[1, 2]).displacement
    assert isinstance(history.strain(0.5), float)
    assert (history.strain(1, "left"), history.strain(1, "right")) == (0, -0.5)
    np.testing.assert_array_equal(history.strain(range(3)), history.strain(np.arange(3.0)))
    assert history.strain(np.float32(0.5)) == history.strain(0.5)
    np.testing.assert_array_equal(history.strain(t[:, ::2]), history.strain(t)[:, ::2])


def test_tables():
    history = dalembert.solve("getfem-dynamic-contact", to=12)
    assert history.contacts["from"].tolist() == [1, 4, 7, 10] and history.contacts["to"].tolist() == [2, 5, 8, 11]
    assert np.isnan(history.flights["to"][-1]) and history.events.dtype.names[0] == "time"
    assert history.stress_history["strain_from"].tolist() == [0, -0.5, 0, -0.5, 0, -0.5, 0, -0.5, 0]
    assert not dalembert.Problem(length=1, wave_speed=1, displacement=[(0, 1), (1, 1)], time=1).solve().events.size
    assert "getfem-dynamic-contact" in dalembert.scenes()


def test_a_reference_ends_where_its_last_time_is_spelt():
    # 0.7 is 7/10, and the nearest double is less: v_x(0,t) = -(3 + t) at both.
    for times in ([0.5, 0.7], np.array([0.7]), np.float32([0.5]), ["7/10", Decimal("0.25")]):
        table = dalembert.reference("paper-strong", times, ["t", "strain"], "right", exact=True)
        assert [-3 - t for t in table["t"]] == list(table["strain"])
    assert list(dalembert.reference("paper-strong", [0.7], ["t"], "right", exact=True)["t"]) == [Fraction(7, 10)]


def test_pickles():
    rod = dalembert.Problem(**ROD).replace(damping=Decimal("0.1"), time=4)
    again = pickle.loads(pickle.dumps(rod))
    assert again.damping_ratio == 0.2 and again.solve().events.tobytes() == rod.solve().events.tobytes()
    named = pickle.loads(pickle.dumps(dalembert.Problem.from_scene("figure-4-r02")))
    assert named.damping_ratio == 0.4


def test_files(tmp_path):
    path = tmp_path / "rod.toml"
    path.write_text("[rod]\nlength = 1\nwave_speed = 1\n[impact]\nspeed = 3\n")
    for scene in (path, str(path), path.read_text()):
        assert dalembert.solve(scene).contacts["to"].tolist() == [2]


@pytest.mark.parametrize(
    ("error", "said", "act"),
    [
        (ValueError, "found length = -1, expected a length above zero", lambda: rod(length=-1)),
        (ValueError, "without a unit", lambda: rod(length="1 m")),
        (ValueError, "found length = NaN", lambda: rod(length=float("nan"))),
        (TypeError, "unexpected keyword argument 'lenght'", lambda: dalembert.Problem(**ROD, lenght=1)),
        (TypeError, "unknown value `lenght`", lambda: dalembert.Problem(**ROD).replace(lenght=1)),
        (TypeError, r"found length = \[1\], of type list", lambda: rod(length=[1])),
        (TypeError, "array of shape", lambda: rod(velocity=np.zeros((3, 3)))),
        (ValueError, "found velocity = NaN", lambda: rod(impact_speed=None, velocity=[(0, np.nan), (1, 0)])),
        (ValueError, "found time NaN, expected one between 0 and 8.0", lambda: rod().solve().strain(np.nan)),
        (ValueError, "expected one between 0 and 1.0, the rod's length", lambda: rod().solve().field(2, 1)),
        (ValueError, "found side = up, expected left", lambda: dalembert.solve("paper-strong").strain(1, "up")),
        (TypeError, "found time = None", lambda: dalembert.solve("paper-strong").strain(None)),
        (ValueError, "found no file and no built-in scene", lambda: dalembert.solve("paper-stronk")),
        (ValueError, "line 2, column 8: found length = -1", lambda: dalembert.solve("[rod]\nlength=-1\n")),
        (ValueError, "either time or impacts", lambda: dalembert.solve("paper-strong", to=1, impacts=2)),
        (ValueError, "found -1 digits asked for", lambda: dalembert.solve("paper-strong", digits=-1)),
        (ValueError, "found impacts = 1.5", lambda: dalembert.solve("paper-strong", impacts=1.5)),
        (ValueError, "expected an undamped rod", lambda: dalembert.solve("figure-4-r02", exact=True)),
    ],
)
def test_refusals(error, said, act):
    with pytest.raises(error, match=said):
        act()


# A hundred thousand impacts of a chaotic rod in 40,000 digits take hours.
LONG = """
import signal, time, dalembert
signal.signal(signal.SIGINT, signal.default_int_handler)
print("solving", flush=True)
try:
    dalembert.solve("mu-3-2-chaotic", impacts=100000, digits=40000)
except KeyboardInterrupt:
    print("interrupted", dalembert.solve("paper-strong").contacts["to"][0], flush=True)
"""


def test_interrupt(tmp_path):
    # Elsewhere: beside the sources these would be imported, and not the wheel.
    child = subprocess.Popen([sys.executable, "-c", LONG], stdout=subprocess.PIPE, text=True, cwd=tmp_path)
    assert child.stdout.readline() == "solving\n"
    time.sleep(1)
    start = time.monotonic()
    child.send_signal(signal.SIGINT)
    assert child.stdout.readline() == "interrupted 2.0\n"
    assert time.monotonic() - start < 1
    assert child.wait(5) == 0


def test_others_run_while_a_history_is_solved():
    solver = threading.Thread(target=lambda: dalembert.solve("mu-3-2-chaotic", to=200, digits=30))
    solver.start()
    ticks = 0
    while solver.is_alive():
        ticks += 1
        time.sleep(1e-4)
    assert ticks > 10
