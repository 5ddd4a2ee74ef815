"""`compare` gives what the command reports, bit for bit, whatever form the data have."""

import json
import pickle

import numpy as np
import pytest

import dalembert

SCENE = "doyen-ern-piperno"
ROD = dalembert.Problem(length=1, wave_speed=1, impact_speed=1, time=4)  # contact on [0, 2], v = t - 2 after it
T = np.arange(5.0)


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    """A scheme's data, off in clock and size: in a file, and as columns."""
    t = np.linspace(0, 6, 401)
    data = dalembert.solve(SCENE, to=7).columns(t * 0.99, ["u_end", "v_end", "force", "E_total"], "right")
    data = {"t": t} | {name: values * 1.01 for name, values in data.items()}
    path = tmp_path_factory.mktemp("data") / "run.csv"
    rows = zip(*(values.tolist() for values in data.values()))
    path.write_text("\n".join([",".join(data), *(",".join(map(repr, row)) for row in rows)]) + "\n")
    return path, data


def test_the_report_is_that_of_the_command(command, run, tmp_path):
    path, data = run
    np.savez(tmp_path / "run.npz", **data)
    (tmp_path / "archive").write_bytes((tmp_path / "run.npz").read_bytes())
    for file in (path, tmp_path / "run.npz", tmp_path / "archive"):
        ours = dalembert.compare(SCENE, file, axis="down", energy_scale="1/2", window=0.1)
        asked = ("compare", SCENE, str(file), "--axis", "down", "--energy-scale", "1/2", "--window", "0.1")
        assert ours.report == json.loads(command(*asked, "--format", "json").stdout)
        assert ours.table() == repr(ours) == command(*asked).stdout
    assert ours.contacts[0]["theirs"]["peak_force"] > ours.contacts[0]["ours"]["peak_force"]


def test_a_wrong_clock_is_said(run):
    _, data = run
    t = np.linspace(0, 6, 401)
    true = dalembert.solve(SCENE, to=6).columns(t, list(data)[1:], "right")
    hints = dalembert.compare(SCENE, {"t": 1.03 * t} | dict(true), to=6).hints
    assert [hint["kind"] for hint in hints] == ["clock"] and hints[0]["value"] == pytest.approx(0.03, rel=0.2)


def test_every_form_of_data_is_the_same(run):
    path, data = run
    pandas = pytest.importorskip("pandas")
    expected = dalembert.compare(SCENE, path).report
    names = list(data)
    table = np.rec.fromarrays(list(data.values()), names=names)
    given = {
        "dict": (data,),
        "recarray": (table,),
        "DataFrame": (pandas.DataFrame(data | {"note": "text"}),),
        "ndarray": (np.column_stack(list(data.values())),),
        "values": (data["t"], {name: data[name] for name in names[1:]}),
    }
    for form, arguments in given.items():
        columns = ",".join(f"{name}={k}" for k, name in enumerate(names)) if form == "ndarray" else None
        report = dalembert.compare(SCENE, *arguments, map=columns).report
        # A column that is not used is named.
        notes = ["not used: note"] if form == "DataFrame" else []
        assert report | {"file": 0} == expected | {"file": 0, "notes": notes}, form
    alone = dalembert.compare(SCENE, data["t"], data["u_end"], quantity="u")
    assert alone.norms["u_end"] == expected["quantities"][0]
    np.testing.assert_array_equal(alone.difference["u_end"], data["u_end"] - alone.ours["u_end"])


def test_both_limits_of_a_reference():
    for numbers in ({}, {"exact": True}):
        golden = dalembert.reference(SCENE, np.linspace(0, 4, 13), **numbers)
        for norms in dalembert.compare(SCENE, golden).norms.values():
            assert (norms["linf"]["relative"] or 0) <= (1e-15 if numbers else 0), norms


def test_a_field_and_several_sources():
    x = np.linspace(0, 1, 5)
    field = ROD.solve().grid(x, T)
    c = dalembert.compare(ROD, T, {"u": field.u, "v": field.v}, x=x)
    assert c.x.tolist() == [*x] * 5 and c.norms["u"]["linf"]["absolute"] == 0
    steps = [4 / n * np.arange(n + 1) for n in (40, 80)]
    runs = [{"t": t, "u": np.maximum(t - 2, 0) + t[1] ** 2} for t in steps]
    orders = dalembert.compare(ROD, runs).orders
    assert orders[0]["l2"] == pytest.approx(2, abs=1e-9)
    assert dalembert.compare(ROD, runs, widths=[0.4, 0.1]).orders[0]["l2"] == pytest.approx(1, abs=1e-9)


def test_limits_are_those_of_the_command(command, run, tmp_path):
    path, _ = run
    c = dalembert.compare(SCENE, path, to=6)
    limits = {"u": {"l2": 0.001, "linf_off_jumps": 10}, "force": {"l1": 1e-6}}
    asked = ",".join(f"{name}.{norm}={bound!r}" for name, norms in limits.items() for norm, bound in norms.items())
    said = command("compare", SCENE, str(path), "--to", "6", "--fail-above", asked).stderr
    failures = c.fails_above(limits)
    assert [f"failed: {line}" for line in failures] == said.splitlines() and len(failures) == 2
    with pytest.raises(AssertionError, match="expected u.l2 ≤ 1e-3, found"):
        c.assert_below(limits)
    assert c.fails_above({"u": {"l2": 10}, "missed": 0}) == [] and c.assert_below({}) is None
    assert c.assert_above({"coverage": 0.99}) is None
    with pytest.raises(AssertionError, match="expected data up to t = 14"):
        dalembert.compare(SCENE, path).assert_above({"coverage": 0})
    for limits, said in [
        ({"w": {"l2": 1}}, "found a bound of w, expected one of u_end"),
        ({"u": {"l3": 1}}, "found `u.l3=1.0`, expected QUANTITY.NORM=BOUND"),
        ({"u": {"l2": -1}}, "expected QUANTITY.NORM=BOUND"),
        ({"u": {"l2": float("nan")}}, "expected QUANTITY.NORM=BOUND"),
    ]:
        with pytest.raises(ValueError, match=said):
            c.fails_above(limits)


def test_comparisons_are_pickled(run):
    """Results, limits and arrays come back, from arrays and from files, through a worker of Dask too."""
    path, data = run
    for source in (data, path):
        c = dalembert.compare(SCENE, source, to=6, fit=["wave_speed"])
        again = pickle.loads(pickle.dumps(c))
        assert again.report == c.report and again.table() == c.table() and again.warnings == c.warnings
        np.testing.assert_array_equal(again.difference["force"], c.difference["force"])
        limits = {"u": {"l2": 0.001}}
        assert again.fails_above(limits) == c.fails_above(limits) != []
    elsewhere = pickle.dumps(dalembert.compare(SCENE, path, to=6))
    path.rename(path.with_suffix(".moved"))
    try:  # The results do not need the file.
        assert pickle.loads(elsewhere).norms["u_end"]["l2"]["relative"] > 0
    finally:
        path.with_suffix(".moved").rename(path)
    dask = pytest.importorskip("dask.distributed")
    with dask.LocalCluster(n_workers=1, threads_per_worker=1, dashboard_address=None) as cluster:
        with dask.Client(cluster) as client:
            found = client.submit(dalembert.compare, SCENE, data, to=6).result()
    assert found.report == dalembert.compare(SCENE, data, to=6).report


def test_arrays_may_begin_at_any_byte(run):
    _, data = run
    unaligned = {}
    for name, column in data.items():
        shifted = np.empty(8 * len(column) + 1, np.uint8)[1:].view(np.float64)
        shifted[:] = column
        assert not shifted.flags.aligned
        unaligned[name] = shifted
    expected, found = (dalembert.compare(SCENE, source, to=6) for source in (data, unaligned))
    assert found.table() == expected.table()
    times = np.empty(17, np.uint8)[1:].view(np.float64)
    times[:] = [0.5, 1.5]
    history = dalembert.solve(SCENE, to=6)
    np.testing.assert_array_equal(history.strain(times, "right"), history.strain([0.5, 1.5], "right"))


def of(values, **options):
    return lambda: dalembert.compare(ROD, T, values, **{"quantity": "u", **options})


@pytest.mark.parametrize(
    ("error", "said", "act"),
    [
        (TypeError, "found values without a quantity", of(T, quantity=None)),
        (ValueError, "found no column of times", lambda: dalembert.compare(ROD, {"u": T})),
        (ValueError, "row 2, column 1: found time 0 after 1", lambda: dalembert.compare(ROD, dict(t=[1, 0], u=[0, 0]))),
        (ValueError, "row 5, column 2: found NaN", of(np.ma.array([0, 0, 0, 1, 2.0], mask=[0, 0, 0, 0, 1]))),
        (ValueError, r"found u of shape \(2, 5\), expected \(5, 2\), times by points",
         lambda: dalembert.compare(ROD, range(5), np.zeros((2, 5)), quantity="u", x=[0, 1])),
        (ValueError, "row 5, column 2: found NaN", of([0, 0, 0, 1, np.nan])),
        (ValueError, "`u`: found 4 rows, expected 5", of(T[1:])),
        (ValueError, r"`u`: found an array of shape \[5, 1\]", of(T[:, None])),
        (ValueError, "array of type <U1, expected numbers", of([*"abcde"])),
        (ValueError, "array of type complex128", of(T * 1j)),
        (ValueError, "found no quantity in the columns t, w", of(T, quantity="w")),
        (ValueError, "found axis = left, expected up or down", of(T, axis="left")),
        (ValueError, "found dt 0, expected more than zero", lambda: dalembert.compare(ROD, {"u": T}, dt=0)),
        (ValueError, "cannot be read", lambda: dalembert.compare(ROD, "nowhere.csv")),
        (TypeError, "found map = 3, of type int, expected a text such as", of(T, map=3)),
        (TypeError, r"found widths = 0.1, of type float, expected a sequence of numbers", of(T, widths=0.1)),
        (TypeError, r"found fit = 3, of type int, expected a name or a sequence of names", of(T, fit=3)),
        (TypeError, r"found fit = \[1\], of type list, expected a name", of(T, fit=[1])),
        (TypeError, r"found shift = \[\], of type list, expected a number", of(T, shift=[])),
        (ValueError, "found the parameter `dampng`, expected one of length.*did you mean damping", of(T, fit="dampng")),
        (TypeError, "found limits = 3, of type int, expected a mapping", lambda: of(T)().fails_above(3)),
        (TypeError, "found the limit u.l2 = 'x', of type str", lambda: of(T)().fails_above({"u": {"l2": "x"}})),
        (AttributeError, "one of files", lambda: dalembert.compare(ROD, [{"t": T, "u": T}] * 2).norms),
    ],
)
def test_refusals(error, said, act):
    with pytest.raises(error, match=said):
        act()
