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
# Scenes that no problem of single bodies can hold.
WITH_A_RIGID_MASS = {"saint-venant-mass", "saint-venant-mass-1", "saint-venant-mass-2", "saint-venant-mass-4"}


def rod(**values) -> dalembert.Problem:
    return dalembert.Problem(**{**ROD, **values})


def test_numbers_of_every_type_are_the_same_problem():
    for speed in (3, 3.0, Fraction(3), Decimal("3.0"), "3", "6/2", np.int64(3), np.float32(3)):
        exact = dalembert.Problem(**{**ROD, "impact_speed": speed}).solve(exact=True)
        assert exact.contacts["release"].tolist() == [2]
    tenth = dalembert.Problem(**{**ROD, "length": 0.1}).solve(exact=True)
    assert tenth.contacts["release"].tolist() == [Fraction(1, 5)]


def test_a_float32_is_its_shortest_decimal():
    """0.1 in single precision is 1/10, wherever a number is given."""
    tenth = np.float32(0.1)
    assert float(tenth) != 0.1
    assert rod(length=tenth) == rod(length=0.1) and rod(length=np.float16(0.1)) == rod(length=0.1)
    assert rod(impact_speed=None, velocity=np.float32([(0, -0.1), (1, -0.1)])).velocity[0] == (0, -0.1)
    for numbers in ({}, {"exact": True}):
        history = rod().solve(**numbers)
        for times in (tenth, np.float32([0.1]), [tenth]):
            assert np.ravel(history.strain(times)).tolist() == [history.strain(0.1)]
        assert history.field(tenth, tenth) == history.field(0.1, 0.1)
    found = dalembert.sweep(rod(), "bounce_time", length=np.float32([0.1, 0.3]))["bounce_time"]
    assert found.tolist() == pytest.approx([0.2, 0.6], rel=1e-15)
    assert dalembert.reference(rod(), np.float32([0.1]), "t", exact=True)["t"][0] == Fraction(1, 10)


def test_a_problem_is_frozen():
    p = rod()
    for name, said in [
        ("length", r"assignment to length, expected replace\(length=…\)"),
        ("dampng", r"`dampng`, expected one of length, .*\(did you mean damping\?\)"),
        ("round_trip", "round_trip, which follows from others"),
    ]:
        with pytest.raises(AttributeError, match=said):
            setattr(p, name, 2)
    with pytest.raises(AttributeError, match="does not change"):
        del p.length
    with pytest.raises(TypeError, match="did you mean damping"):
        p.replace(dampng=1)
    assert p == rod() and vars(p).keys() == vars(rod()).keys() and p.solve().contacts["release"][0] == 2
    with pytest.raises(AttributeError, match="a History does not change"):
        p.solve().end = 3


def test_a_parameter_has_its_path_too():
    assert rod().replace(**{"impact.speed": 4, "gravity.acceleration": 2}) == rod(impact_speed=4, gravity=2)
    ours, theirs = (rod().solve().derivatives(name).left["t"].tolist() for name in ("impact.speed", "impact_speed"))
    assert ours == theirs
    with pytest.raises(TypeError, match=r"did you mean impact.speed\?"):
        rod().replace(**{"impact.sped": 4})


def test_a_problem_is_a_scene_file():
    compared = 0
    for name in dalembert.scenes():
        first, *others = dalembert.Problem.bodies(name)
        if others or name in WITH_A_RIGID_MASS:
            with pytest.raises(ValueError, match="bodies"):
                dalembert.Problem.from_scene(name)
            continue
        problem = dalembert.Problem.from_scene(name)
        assert problem == first
        if repr(problem).startswith("<body of a chain: length="):
            assert dalembert.Problem.from_scene(problem.to_toml()) == problem
            with pytest.raises(ValueError, match="no scene file"):
                problem.replace(time="7/3").to_toml()
            continue
        for changed in (problem, problem.replace(time="7/3"), problem.replace(impacts=3, length=problem.length)):
            again = dalembert.Problem.from_scene(changed.to_toml())
            assert again == changed and again.title == problem.title
            compared += 1
    assert compared > 60


@pytest.mark.parametrize("numbers", [{}, {"exact": True}, {"certified": True}])
def test_what_a_history_hands_out_does_not_change_it(numbers):
    """Tables refuse to be written to; all other arrays, frames and mappings are copies or refuse it too."""
    history = dalembert.solve("doyen-ern-piperno", **numbers)
    compared = 0
    for table in ("events", "contacts", "flights", "stress_history"):
        before = getattr(history, table).tolist()
        name = getattr(history, table).dtype.names[0]
        for write in (
            lambda array: array[name].__setitem__(0, 7),
            lambda array: array.__setitem__(0, array[1]),
            lambda array: array[name].__setitem__(0, np.ma.masked),
            lambda array: array.data[name].__setitem__(0, 7),
            lambda array: setattr(array, "mask", True),
        ):
            with pytest.raises(ValueError, match="read-only"):
                write(getattr(history, table))
            compared += 1
        frame = history.to_frame(table)
        frame.loc[0, name] = None
        history.reasons(table).clear()
        assert getattr(history, table).tolist() == before
    assert compared == 20
    for ask in (lambda: history.columns([0.1, 0.2], ["h"])["h"], lambda: history.field([0, 1], 0.5).u):
        before = ask().tolist()
        ask()[:] = 0
        assert ask().tolist() == before
    with pytest.raises(TypeError):
        history.scales["time"] = 0
    history.warnings.append("no")
    assert "no" not in history.warnings


def test_an_absent_number_has_a_reason():
    """Where the command prints a reason, the number is masked, and the reason is there."""
    held = dalembert.solve("paper-strong", to=1)
    assert held.contacts["release"].mask.tolist() == [True] and held.contacts["impact"].tolist() == [0]
    assert set(held.reasons().values()) == {"the contact does not end within this history"}
    assert (0, "e_P") in held.reasons() and (0, "impulse") not in held.reasons()
    assert held.to_frame().attrs["reasons"]["e_P"] == {0: "the contact does not end within this history"}
    flights = dalembert.solve("getfem-dynamic-contact", to=12)
    last = len(flights.flights) - 1
    assert flights.reasons("flights")[last, "landing"] == "the flight does not end within this history"
    assert held.reasons("events") == {}
    exact = dalembert.solve("paper-strong", to=1, exact=True)
    assert exact.contacts["release"].tolist() == [None] and exact.reasons() == held.reasons()
    # A rod that is dropped from rest has no derivative by a speed that may only grow, from one side.
    jumps = dalembert.solve("doyen-ern-piperno").derivatives("impact_speed", "contacts")
    for (side, row, name), why in jumps.reasons.items():
        assert getattr(jumps, side)[name][row] is np.ma.masked and why in ("infinite", "jumps", "not settled")
    unfinished = held.derivatives("gravity", "contacts")
    assert unfinished.left["release"].mask.all() and unfinished.left_error["release"].mask.all()
    assert unfinished.reasons["left", 0, "release"] == "there is no number"


def test_sides_are_words():
    history = dalembert.solve("paper-strong")
    for numbers in ({}, {"exact": True}, {"digits": 20}, {"certified": True}):
        found = dalembert.solve("paper-strong", **numbers).columns([1, 2], ["side", "strain"])
        assert found["side"].tolist() == ["both", "left", "right"]
    assert history.columns(2, "side", "left")["side"].tolist() == ["left"]
    frame = dalembert.reference("paper-strong", [2])
    assert frame["side"].tolist() == ["left", "right"]


def test_units_and_meanings():
    pytest.importorskip("pandas"), pytest.importorskip("xarray")
    steel = dalembert.solve("doyen-ern-piperno")
    attrs = steel.to_frame().attrs
    assert (attrs["units"]["peak_force"], attrs["units"]["e_P"], attrs["units"]["impact"]) == ("N", "", "s")
    assert attrs["meanings"]["release"] == "time at which a contact ends" and attrs["title"] == steel.problem.title
    assert dalembert.reference("paper-strong", [1]).attrs["units"]["force"] == "per ρS"
    data = steel.to_xarray([0, 10], [0, 0.5])
    assert data.u.attrs == {"units": "m", "long_name": "displacement, upwards"}
    assert (data.v.units, data.strain.units, data.t.units, data.x.units) == ("m/s", "", "s", "m")
    for table in ("events", "contacts", "flights", "stress_history"):
        frame = steel.to_frame(table)
        described = set(frame.columns) - {"kind", "t_error"}
        assert described <= set(frame.attrs["units"]) & set(frame.attrs["meanings"])


def test_golden_files_are_those_of_the_command(command, tmp_path):
    """Byte for byte, from a name and from a problem."""
    times = np.linspace(0, 2, 9)
    (tmp_path / "times").write_text("\n".join(map(str, times.tolist())))
    compared = 0
    for ending in ("csv", "json", "npz"):
        ours, theirs = tmp_path / f"ours.{ending}", tmp_path / f"theirs.{ending}"
        for given, asked in [
            ({}, []),
            ({"t": times}, ["--times-from", str(tmp_path / "times")]),
            ({"t": [0.5, "1/3"], "names": ["t", "h"], "side": "left", "exact": True},
             ["--times", "0.5,1/3", "--quantity", "t,h", "--side", "left", "--exact"]),
            ({"t": 0.5, "x": [0, 0.25, 1], "digits": 20}, ["--times", "0.5", "--points", "0,0.25,1", "--digits", "20"]),
        ]:  # fmt: skip
            dalembert.write_reference(ours, "paper-strong", **given)
            assert command("reference", "paper-strong", *asked, "-o", str(theirs)).returncode == 0
            assert ours.read_bytes() == theirs.read_bytes()
            compared += 1
    assert compared == 12
    dalembert.write_reference(tmp_path / "rod.csv", rod(), 0.5, "strain")
    text = (tmp_path / "rod.csv").read_text()
    assert "# scene: length = 1\n" in text and text.splitlines()[-2:] == ["strain", "-3.5"]
    for refused, said in [({"names": "strian"}, "strian"), ({"t": -1}, "^t, row 1: found time -1")]:
        with pytest.raises(ValueError, match=said):
            dalembert.write_reference(ours, "paper-strong", **{"t": 0.5} | refused)


def test_profiles_are_points_of_any_kind():
    points = [[0, -1], [1, -2]]
    given = [points, tuple(map(tuple, points)), np.array(points), np.array(points, float), list(np.array(points))]
    for velocity in given:
        rod = dalembert.Problem(length=1, wave_speed=1, gravity=1, velocity=velocity)
        assert rod.velocity == ((0, -1), (1, -2))
    with pytest.raises(TypeError, match="expected points .x, value., an array of shape"):
        dalembert.Problem(length=1, wave_speed=1, velocity=[0, -1])


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
    field = history.grid(x, t)
    assert field.strain.shape == (3, 4, 5) and field.strain.flags.c_contiguous
    assert field.u[1, 2, 3] == history.field(x[3], t[1, 2]).u
    assert isinstance(history.field(0.5, 1).strain, float)
    assert isinstance(history.strain(0.5), float)
    assert (history.strain(1, "left"), history.strain(1, "right")) == (0, -0.5)
    np.testing.assert_array_equal(history.strain(range(3)), history.strain(np.arange(3.0)))
    assert history.strain(np.float32(0.5)) == history.strain(0.5)
    np.testing.assert_array_equal(history.strain(t[:, ::2]), history.strain(t)[:, ::2])


@pytest.mark.parametrize("numbers", [{}, {"exact": True}])
def test_points_and_times_are_broadcast(numbers):
    history = dalembert.solve("getfem-dynamic-contact", to=3, **numbers)
    x, t = np.linspace(0, 1, 5), np.linspace(0, 3, 7)
    grid = history.grid(x, t)
    compared = 0
    for points, times in [
        (x, t[:, None]), (x[:, None], t), (x[:, None, None], t[None, :, None]), (x, t[:5]), (0.25, t), (x, 1.5),
        (x[None, :], t[:5]), (x[:1], t), (np.broadcast_to(x, (7, 5)), t[:, None]), (x[:, None], t[:5]),
    ]:
        field = history.field(points, times)
        where = np.broadcast(np.asarray(points), np.asarray(times))
        assert field.strain.shape == where.shape
        for (point, time), strain, velocity in zip(where, np.ravel(field.strain), np.ravel(field.v)):
            one = history.field(point, time)
            assert (one.strain, one.v) == (strain, velocity)
            compared += 1
    assert compared == 194
    np.testing.assert_array_equal(grid.strain, history.field(x, t[:, None]).strain)
    with pytest.raises(ValueError, match="broadcast"):
        history.field(x, t)


def test_a_problem_shows_its_values():
    rod = dalembert.Problem(length=0.1, modulus="1/3", density=2, damping=Decimal("0.2"), impact_speed=1, time="7/2")
    assert (rod.length, rod.modulus, rod.density, rod.area, rod.damping) == (0.1, Fraction(1, 3), 2, None, 0.2)
    assert (rod.wave_speed, rod.time, rod.impacts, rod.top) == (np.sqrt(1 / 6), 3.5, None, "free")
    assert repr(rod) == (
        "Problem(length=0.1, modulus=Fraction(1, 3), density=2, damping=0.2, impact_speed=1, time=3.5)"
    )
    named = {"Problem": dalembert.Problem, "Fraction": Fraction}
    shown = {name: repr(dalembert.Problem.bodies(name)[0]) for name in dalembert.scenes()}
    rods = [name for name, text in shown.items() if text.startswith("Problem(")]
    assert len(rods) > 20 and all(text.startswith("<body of a chain: ") for text in shown.values() if text[0] != "P")
    for name in rods:
        problem = dalembert.Problem.from_scene(name)
        again = eval(repr(problem), named)
        assert again == problem and hash(again) == hash(problem) and again.replace(time=77) != problem
    held = dalembert.Problem.from_scene("getfem-dynamic-contact")
    assert held.top == "fixed" and held.displacement[-1][1] == 0 and "top='fixed'" in repr(held)
    standing = dalembert.Problem(length=1, wave_speed=1, gravity=2, strain=[(0, -2), (1, 0)], time=9)
    assert standing.strain == ((0, -2), (1, 0)) and standing.displacement is None
    assert standing.solve(exact=True).strain(7) == -2 and standing.replace(strain=[(0, 0), (1, 0)]) != standing


def test_frames_and_datasets():
    pandas, xarray = pytest.importorskip("pandas"), pytest.importorskip("xarray")
    history = dalembert.solve("getfem-dynamic-contact", to=12)
    frame = history.to_frame().query("impact > 3 and release < 9")
    assert isinstance(frame, pandas.DataFrame) and frame["release"].tolist() == [5, 8]
    assert history.to_frame("events")["kind"].tolist()[:2] == ["impact", "release"]
    data = history.to_xarray([0, 0.5, 1], [1, 1.5])
    assert history.columns([1, 2], "h")["h"].tolist() == history.h([1, 2]).tolist()
    assert isinstance(data, xarray.Dataset) and float(data.strain.sel(x=0, t=1.5)) == -0.5


def test_pictures():
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("agg")
    from matplotlib import pyplot

    history = dalembert.solve("doyen-ern-piperno")
    ax = history.plot(["strain", "h"], pyplot.subplots()[1])
    strain, centre = ax.get_lines()
    assert strain.get_color() == "#0072b2" and centre.get_label() == "h"
    # The jump at the first release is drawn upright: v_x = -5/9 before, 0 after.
    at = np.isclose(strain.get_xdata(), 2 / 3, atol=1e-12, rtol=0)
    assert np.allclose(np.asarray(strain.get_ydata())[at], [-5 / 9, 0])
    assert len(ax.patches) == len(history.contacts)
    mesh = dalembert.solve("paper-strong").plot("xt").collections[0]
    assert mesh.get_clim() == (-5, 5)
    # A steel rod is on the ground for 0.4 ms of 0.14 s: what shows its waves is drawn, and numbers say their power.
    steel = dalembert.solve("steel-bar")
    assert steel.plot("xt", pyplot.subplots()[1]).get_xlim()[1] < 0.001 < steel.plot("h").get_xlim()[1]
    ax = steel.plot("strain", pyplot.subplots()[1], end=0.0008)
    ax.figure.canvas.draw()
    assert [axis.get_offset_text().get_text() != "" for axis in (ax.xaxis, ax.yaxis)] == [True, True]
    pyplot.close("all")


def test_what_is_shown():
    shown = dir(dalembert)
    assert "solve" in shown and not {"np", "json", "os", "Any"} & set(shown)
    comparison = dalembert.compare("paper-strong", dalembert.reference("paper-strong", [0, 1, 2, 3]))
    assert {"norms", "difference", "report"} <= set(dir(comparison))
    page = dalembert.solve("doyen-ern-piperno")._repr_html_()
    assert page.count("<tr>") == 7 and "bouncing bar" in page and "0.666667" in page
    assert page.count('class="panel"') == 4


def test_the_command_of_the_wheel(command, tmp_path):
    """`python -m dalembert` prints what the command prints, with its exit codes."""
    for arguments in (["solve", "doyen-ern-piperno", "--exact"], ["explain", "figure-4-r02"], ["solve", "nothing"], []):
        line = [sys.executable, "-m", "dalembert", *arguments]
        # Elsewhere: beside the sources these would be imported, and not the wheel.
        ours = subprocess.run(line, capture_output=True, text=True, cwd=tmp_path)
        theirs = command(*arguments)
        assert (ours.stdout, ours.stderr, ours.returncode) == (theirs.stdout, theirs.stderr, theirs.returncode)


def test_tables():
    history = dalembert.solve("getfem-dynamic-contact", to=12)
    contacts = history.contacts
    assert contacts["impact"].tolist() == [1, 4, 7, 10] and contacts["release"].tolist() == [2, 5, 8, 11]
    assert history.flights["landing"][-1] is np.ma.masked and history.events.dtype.names[0] == "t"
    assert history.stress_history["strain_start"].tolist() == [0, -0.5, 0, -0.5, 0, -0.5, 0, -0.5, 0]
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


def test_histories_are_pickled():
    rng, compared = np.random.default_rng(7), 0
    for k in range(300):
        length, speed, gravity, damping = (Fraction(int(value), 12) for value in rng.integers(1, 60, 4))
        rod = dalembert.Problem(length=length, wave_speed=1, gravity=gravity, impact_speed=speed)
        numbers = [{}, {"exact": True}, {"digits": 20}][k % 3]
        if k % 3 != 1 and k % 2:
            rod = rod.replace(damping=damping / 10)
        history = rod.solve(first_contact=k % 5 > 0, **numbers)
        again = pickle.loads(pickle.dumps(history))
        assert again == history and again.numbers == history.numbers
        for ours, theirs in zip(history.events.tolist(), again.events.tolist(), strict=True):
            assert ours == theirs
            compared += 1
    assert compared > 450
    assert history != rod.solve(digits=21)


def test_files(tmp_path):
    path = tmp_path / "rod.toml"
    path.write_text("[rod]\nlength = 1\nwave_speed = 1\n[impact]\nspeed = 3\n")
    for scene in (path, str(path), path.read_text()):
        assert dalembert.solve(scene).contacts["release"].tolist() == [2]


@pytest.mark.parametrize(
    ("error", "said", "act"),
    [
        (ValueError, "found length = -1, expected a length above zero", lambda: rod(length=-1)),
        (ValueError, "without a unit", lambda: rod(length="1 m")),
        (ValueError, "found length = NaN", lambda: rod(length=float("nan"))),
        (TypeError, "unexpected keyword argument 'lenght'", lambda: dalembert.Problem(**ROD, lenght=1)),
        (TypeError, "`lenght`, expected one of length", lambda: dalembert.Problem(**ROD).replace(lenght=1)),
        (TypeError, r"found length = \[1\], of type list", lambda: rod(length=[1])),
        (TypeError, "array of shape", lambda: rod(velocity=np.zeros((3, 3)))),
        (ValueError, "found velocity = NaN", lambda: rod(impact_speed=None, velocity=[(0, np.nan), (1, 0)])),
        (ValueError, "found time NaN, expected one between 0 and 8.0, ", lambda: rod().solve().strain(np.nan)),
        (ValueError, "expected one between 0 and 1.0, the rod's length", lambda: rod().solve().field(2, 1)),
        (ValueError, "found table 'contact', expected one of events", lambda: rod().solve().to_frame("contact")),
        (ValueError, "found side = up, expected left", lambda: dalembert.solve("paper-strong").strain(1, "up")),
        (TypeError, r"found names = \[0, 1\], of type list, expected a name or a sequence of names",
         lambda: rod().solve().columns(["strain"], [0, 1])),
        (ValueError, r"the quantity `strian`.*did you mean strain", lambda: rod().solve().columns(0, "strian")),
        (TypeError, "found names = 3, of type int", lambda: rod().solve().columns(0, 3)),
        (TypeError, "found by = 3, of type int, expected the name", lambda: rod().solve().derivatives(3)),
        (TypeError, "found digits = '20', of type str, expected an integer", lambda: rod().solve(digits="20")),
        (TypeError, "found exact = 1, of type int, expected True or False", lambda: rod().solve(exact=1)),
        (TypeError, "found accuracy = 'x', of type str, expected a float", lambda: rod().solve(accuracy="x")),
        (TypeError, "found quantities = 3, of type int", lambda: dalembert.sweep(rod(), 3)),
        (ValueError, "found the quantity `bounce_tme`.*did you mean bounce_time",
         lambda: dalembert.sweep(rod(), "bounce_tme")),
        (ValueError, "found time -1, expected one from 0 on",
         lambda: dalembert.sweep(rod(), "h", impact_speed=[1], time=-1)),
        (ValueError, "found time 1, expected none: bounce_time is not asked at a time",
         lambda: dalembert.sweep(rod(), ["h", "bounce_time"], impact_speed=[1], time=1)),
        (ValueError, "found time NaN", lambda: rod().solve().strain(np.ma.array([1.0, 2.0], mask=[False, True]))),
        (ValueError, "found kind = 3, expected points", lambda: rod().solve().grid(0, 0, kind=3)),
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
    print("interrupted", dalembert.solve("paper-strong").contacts["release"][0], flush=True)
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


def test_sweep_has_the_numbers_of_solve():
    """Over two values that are broadcast: what each problem by itself answers, within both bounds."""
    rod = dalembert.Problem(length=1, wave_speed=1, gravity=1, impact_speed=1)
    speeds, dampings = [0.5, "1", 2, Fraction(7, 3)], [[0], [0.1], [0.3]]
    found = dalembert.sweep(rod, ["bounce_time", "e_P"], impact_speed=speeds, damping=dampings)
    assert found["bounce_time"].shape == found.errors["e_P"].shape == (3, 4)
    bounces = 0
    for i, (damping,) in enumerate(dampings):
        for j, speed in enumerate(speeds):
            run = rod.replace(impact_speed=speed, damping=damping).solve(first_contact=True)
            if run.contacts["release"][0] is np.ma.masked:
                assert found["bounce_time"][i, j] is np.ma.masked and (i, j) in found.notes
                continue
            bounces += 1
            time_apart = abs(found["bounce_time"][i, j] - run.contacts["release"][0])
            assert time_apart <= found.errors["bounce_time"][i, j] + 1e-9 * run.contacts["release"][0]
            share_apart = abs(found["e_P"][i, j] - run.contacts["e_P"][0])
            assert share_apart <= found.errors["e_P"][i, j] + 1e-9
    assert bounces >= 8


def test_sweep_over_profiles():
    """The last two axes are a profile, the others are broadcast: what each problem by itself answers."""
    rod = dalembert.Problem(length=1, wave_speed=1, gravity=1, impact_speed=1)
    depths, gravities = np.array([1, 2, 3]), [[0], [1]]
    slopes = np.stack([np.zeros((3, 2)), np.stack([np.ones(3), -depths], axis=1)], axis=1)
    found = dalembert.sweep(rod, "bounce_time", displacement=slopes, gravity=gravities)["bounce_time"]
    assert found.shape == (2, 3)
    bounce = lambda **values: rod.replace(**values).solve().contacts["release"].filled(np.nan)[0]
    by_hand = [[bounce(displacement=slope, gravity=g) for slope in slopes]
               for g, in gravities]
    # Without gravity the wave from the free top is back after L/c; with it one rod stays on the ground.
    assert found[0].tolist() == [1, 1, 1] and found.count() == 5
    assert np.allclose(found.filled(np.nan), by_hand, rtol=1e-9, atol=0, equal_nan=True)
    # Profiles of their own numbers of points, and what holds the upper end.
    profiles = [[(0, 0), (1, "-0.4")], [(0, 0), (0.5, 0), (1, "-0.4")]]
    each = dalembert.sweep(rod, "bounce_time", velocity=[(0, -1), (1, -1)], displacement=profiles)["bounce_time"]
    assert each.shape == (2,) and each[0] != each[1]
    held = dalembert.sweep(rod, "bounce_time", top=["free", "fixed"], gravity=0)["bounce_time"]
    assert held[0] == 2 and held[0] != held[1]
    with pytest.raises(TypeError, match=r"found displacement of shape \(3,\), expected points \(x, value\) in"):
        dalembert.sweep(rod, "bounce_time", displacement=depths)


def test_sweep_over_the_stiffness_of_a_contact():
    soft = dalembert.Problem.from_scene("getfem-penalty")
    assert soft.stiffness == 20 and soft.replace(stiffness=40).stiffness == 40
    # The closed form of the demonstration: it leaves at 2 + ln(2 − e^−ω)/ω with ω = k c/EA.
    stiffness = np.array([2, 20, 1e3, 1e6])
    found = dalembert.sweep(soft, "release", stiffness=stiffness)
    expected = 2 + np.log(2 - np.exp(-stiffness)) / stiffness
    assert (abs(found["release"] - expected) <= found.errors["release"] + 1e-15).all()
    with pytest.raises(ValueError, match="found a stiffness of rigid ground"):
        rod().replace(stiffness=20)


def test_sweep_says_why_there_is_no_number():
    """A rod that is damped too much does not bounce; a value that is none is a point's own fault."""
    rod = dalembert.Problem(length=1, wave_speed=1, impact_speed=1)
    found = dalembert.sweep(rod, "bounce_time", damping=[0, 1.6], impact_speed=1)
    assert found["bounce_time"][0] == 2 and found["bounce_time"][1] is np.ma.masked
    assert found.errors["bounce_time"].mask.tolist() == [False, True]
    assert list(found.notes) == [(1,)] and "π" in found.notes[1,]
    assert dalembert.sweep(rod, "bounce_time")["bounce_time"].shape == ()
    assert "expected" in dalembert.sweep(rod, "bounce_time", length=[1, -1]).notes[1,]
    with pytest.raises(ValueError, match="found the quantity `bounce`, expected one of bounce_time"):
        dalembert.sweep(rod, "bounce")
    with pytest.raises(TypeError, match="found the parameter `speed`, expected one of"):
        dalembert.sweep(rod, "bounce_time", speed=[1])
    with pytest.raises(ValueError):
        dalembert.sweep(rod, "bounce_time", impact_speed=[1, 2], damping=[0, 0.1, 0.2])


def test_derivatives_at_times():
    """Behind the first front v_x(0,t) = -(mu + g t)/c, and v_t = -g t there."""
    exact = rod().solve(exact=True)
    found = exact.derivatives_at("gravity", [Fraction(1, 3), Fraction(1, 2)], ["strain", "h"])
    assert found.left["strain"].tolist() == found.right["strain"].tolist() == [Fraction(-1, 3), Fraction(-1, 2)]
    along = exact.derivatives_at("gravity", "1/2", ["v", "strain"], ["0.1", "0.9"])
    assert along.right["v"].tolist() == [Fraction(-1, 10), Fraction(-1, 2)]
    doubles = rod().solve().derivatives_at("gravity", 0.25, "strain")
    assert abs(doubles.left["strain"][0] + 0.25) <= doubles.left_error["strain"][0] + 1e-15
    with pytest.raises(ValueError, match="found the quantity `release`, expected one of t, side"):
        exact.derivatives_at("gravity", [1], ["release"])


def test_derivatives_are_difference_quotients():
    """Of a damped run: against two others next to it, and in fractions by hand: t_b = 2L/c."""
    damped = rod(damping="0.1", impacts=2)
    found = damped.solve().derivatives("impact_speed")
    step = Fraction(1, 10**4)
    after, before = (damped.replace(impact_speed=3 + way * step).solve(digits=30).events["t"] for way in (1, -1))
    for k, (left, right) in enumerate(zip(found.left["t"], found.right["t"])):
        quotient = float((after[k] - before[k]) / (2 * Decimal("1e-4")))
        # A central quotient is off by the third derivative times a sixth of the square of the step.
        assert left == right and abs(left - quotient) < 1e-6
        # In doubles a derivative is settled to 1e-5 of its natural size.
        assert found.left_error["t"][k] < 1e-5
    exact = rod().solve(exact=True).derivatives("length", "contacts")
    assert exact.left["release"].tolist() == [2] and exact.right_error["release"].tolist() == [0]
    with pytest.raises(ValueError, match="found the parameter `mass`, expected one of length"):
        rod().solve().derivatives("mass")


def test_bodies_of_a_chain_are_problems():
    striker, target = dalembert.Problem.bodies("openfoam-7-1-2")
    exact = target.solve(exact=True)
    assert exact.contacts["release"].tolist() == [Fraction(27, 70)]
    energies = [body.solve(exact=True).columns("1/2", "E_total", side="right")["E_total"] for body in (striker, target)]
    assert [energy[0] for energy in energies] == [Fraction(17553, 167042000), Fraction(4123, 10440125)]
    assert striker != target and target == pickle.loads(pickle.dumps(target)) == dalembert.Problem.bodies("openfoam-7-1-2")[1]
    # Equal bars: Zv/2 with Z = 0.7 and v = 0.1.
    softer = target.replace(modulus=49)
    assert softer.solve().contacts["peak_force"].tolist() == pytest.approx([0.035])
    assert softer != target
    with pytest.raises(ValueError, match="no scene file of a rod"):
        softer.to_toml()
    with pytest.raises(ValueError, match=r"chain of 2 bodies, expected dalembert.Chain\(scene\), or one of Problem.bodies"):
        dalembert.solve("openfoam-7-1-2")
    with pytest.raises(ValueError, match="damping of a body of a chain"):
        target.replace(damping=0.1)
    # A mass of six rods pushes with exp(−t/6) until the wave returns.
    (struck,) = dalembert.Problem.bodies("saint-venant-mass")
    pushed = struck.solve().columns([0.5, 1.5], "force_top", side="right")["force_top"]
    assert pushed == pytest.approx(np.exp([-0.5 / 6, -1.5 / 6]), rel=1e-12)
    (pile,) = dalembert.Problem.bodies("mpm-py-pile")
    assert pile.solve().columns(0.2, "force", side="right")["force"][0] == pytest.approx(2e4)
    assert "openfoam-7-1-2" in dalembert.scenes()


def test_golden_files_of_a_body(tmp_path):
    target = dalembert.Problem.bodies("openfoam-7-1-2")[1]
    dalembert.write_reference(tmp_path / "golden.csv", target, ["1/5"], ["t", "force"], "right", exact=True)
    assert (tmp_path / "golden.csv").read_text().splitlines()[-1] == "1/5,7/170"
