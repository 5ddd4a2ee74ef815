"""Whole chains: the numbers of the command, closed forms, and what is refused."""

import json
import pickle
from decimal import Decimal
from fractions import Fraction

import numpy as np
import pytest

import dalembert

BARS = "openfoam-7-1-2"
MASS = "saint-venant-mass"


@pytest.fixture
def command(tmp_path):
    """The command, with its answer as JSON."""

    def run(*arguments):
        path = tmp_path / "answer.json"
        assert dalembert._core.main(["dalembert", *arguments, "--quiet", "-o", str(path)]) == 0
        return json.loads(path.read_text())

    return run


def same(ours, theirs):
    """The same, where the command prints 0 for a number that is zero within its bound."""
    assert len(ours) == len(theirs)
    numbers = [abs(value) for value in theirs if isinstance(value, float)]
    for mine, other in zip(ours, theirs):
        mine = None if mine is np.ma.masked else mine
        assert mine == other or other == 0 and abs(mine) <= 1e-12 * max(1, *numbers), (mine, other)


@pytest.mark.parametrize("scene", [BARS, MASS, "schwarz-three-bars", "code-aster-sdnl111-a-spring"])
def test_tables_and_columns_are_those_of_the_command(command, scene):
    history = dalembert.Chain(scene).solve()
    found = command("solve", scene)
    for table, names in [
        ("events", ("node", "t", "gap_rate_before", "gap_rate_after")),
        ("contacts", ("node", "impact", "release", "impulse", "peak_force", "peak_time")),
    ]:
        ours = getattr(history, table)
        for name in names:
            same(list(ours[name]), [row[name] for row in found[table]])
    times = [Fraction(k, 7) * Fraction(str(history.chain.values["time"])) for k in range(8)]
    names = [name for name in history.chain.quantities if name != "t"]
    columns = history.columns(times, ["t", "side", *names])
    rows = command("reference", scene, "--times", ",".join(map(str, times)))
    for column, theirs in zip(columns.values(), zip(*rows["rows"]), strict=True):
        same(column.tolist(), theirs)


def test_numbers_of_every_system():
    chain = dalembert.Chain(BARS)
    expected = Fraction(27, 70)
    assert chain.solve(exact=True).contacts["release"].tolist() == [expected]
    assert chain.solve(exact=True, digits=20).contacts["release"].tolist() == [expected]
    release = chain.solve(digits=30).contacts["release"][0]
    assert release == pytest.approx(Decimal(27) / Decimal(70), rel=Decimal("1e-29"))
    [(low, high)] = chain.solve(certified=True).contacts["release"].tolist()
    assert Fraction(low) <= expected <= Fraction(high)
    # Fractions do not hold a mass on a bar: with digits these stand in for them.
    value = dalembert.Chain(MASS).solve(exact=False, digits=20).value("force.1", "1/2")
    assert isinstance(value, Decimal) and float(value) == pytest.approx(np.exp(-1 / 12), rel=1e-15)


def test_shapes_sides_and_fields():
    history = dalembert.Chain(BARS).solve(exact=True)
    assert history.value("force.1", 0.2) == Fraction(7, 170)
    assert history.value("force.1", [[0.05, 0.2]]).shape == (1, 2)
    assert history.value("force.1", 0.1, side="left") == 0
    assert list(history.columns(0.2, "gap")) == ["gap.bottom", "gap.1", "gap.top"]
    assert list(history.columns([], "end.2")) == ["u_end.2", "v_end.2"]
    field = history.field(1, np.array([1, 9])[:, None], [0.05, 0.2, 0.25])
    assert field.strain.shape == (2, 3) and field.strain[1, 1] == Fraction(-1, 1190)
    pieces, series = dalembert.Chain(MASS).solve().force_pieces(1)
    assert len(pieces) == len(series) and pieces["start"][0] == 0 and len(series[0]) > 5


def test_other_values():
    chain = dalembert.Chain(BARS)
    longer = chain.replace({"joint.1.gap": Fraction(1, 50), "time": 1})
    assert (longer.values["joint.1.gap"], chain.values["joint.1.gap"]) == (0.02, 0.01)
    assert longer.solve(exact=True).events["t"].tolist() == [Fraction(1, 5), Fraction(17, 35)]
    assert longer == pickle.loads(pickle.dumps(longer)) != chain
    history = pickle.loads(pickle.dumps(longer.solve(digits=10)))
    assert history.numbers == "digits" and history.end == 1
    assert [body.mass is None for body in dalembert.Chain(MASS).bodies] == [True, False]
    # Z = 7/10 and 1: the force changes with the speed by 7/17.
    found = chain.solve(exact=True).derivatives("body.1.velocity", "contacts")
    assert found.right["peak_force"].tolist() == [Fraction(7, 17)]


def test_derivatives_of_simultaneous_events():
    """Bars that meet at once: each joint has the derivatives of its own events."""
    history = dalembert.Chain("schwarz-three-bars").solve(exact=True)
    found = history.derivatives("body.1.velocity")
    by_event = {(row["node"], row["kind"]): slope for row, slope in zip(history.events, found.left["t"])}
    assert by_event["joint 1", "impact"] == Fraction(-1, 500000) and by_event["joint 2", "impact"] == 0


def test_references(tmp_path):
    pandas = pytest.importorskip("pandas")
    frame = dalembert.reference(BARS, [0.1, 0.25])
    assert frame["side"].tolist() == ["left", "right", "both"] and "force.1" in frame
    assert "upwards" in frame.attrs["meanings"]["u_top.2"]
    path = tmp_path / "golden.csv"
    dalembert.write_reference(path, dalembert.Chain(BARS), [0.1, 0.25], ["t", "force.1"])
    assert pandas.read_csv(path, comment="#")["force.1"].tolist() == frame["force.1"].tolist()
    with pytest.raises(ValueError, match="found a chain with other values"):
        dalembert.write_reference(path, dalembert.Chain(BARS).replace({"gravity": 1}), [0.1])


def test_doubles_of_events_are_the_events():
    """A time of an event that was computed, even in another order, stands for the event, whose limits differ."""
    history = dalembert.Chain(BARS).solve()
    impact, release = history.events["t"].astype(float)
    limits = {side: history.value("force.1", [impact, 0.1, release, 27 / 70], side) for side in ("left", "right")}
    exact = dalembert.Chain(BARS).solve(exact=True)
    for k, t in enumerate(["1/10", "1/10", "27/70", "27/70"]):
        for side, found in limits.items():
            assert abs(found[k] - float(exact.value("force.1", t, side))) < 1e-12
    # Text is what it spells, to the last digit.
    late = exact.value("force.1", "0.1000000000000000000001", "left")
    assert late == exact.value("force.1", "1/10", "right") != exact.value("force.1", "1/10", "left")
    for refused in [lambda: history.value("force.1", 0.1, None), lambda: dalembert.solve("paper-weak").strain(1, None)]:
        with pytest.raises(ValueError, match="found side = None, expected left or right"):
            refused()


def test_what_is_refused():
    chain = dalembert.Chain(BARS)
    history = chain.solve()
    for refused, said in [
        (lambda: dalembert.Chain("paper-weak"), "found a rod on rigid ground"),
        (lambda: chain.replace({"body.3.length": 1}), "found the value body.3.length"),
        (lambda: chain.replace({"joint.1.gap": -1}), "gap"),
        (lambda: chain.solve(to=-1), "time"),
        (lambda: dalembert.Chain(MASS).solve(exact=True), "fractions"),
        (lambda: history.value("force.9", 0), "found the quantity force.9"),
        (lambda: history.columns(0, "force.9"), "found the quantity force.9"),
        (lambda: history.columns(2, "force.1"), "2"),
        (lambda: history.field(3, 0, 0), "expected a body from 1, the lowest, to 2"),
        (lambda: history.field(1, 11, 0), "11"),
        (lambda: history.force_pieces(2), "found node 2"),
        (lambda: history.derivatives("length"), "found the value rod.length"),
        (lambda: history.value("force.1", float("nan")), "found time NaN, expected a finite number"),
        (lambda: history.field(1, np.array([1.0, np.inf]), 0.2), "found point inf, expected a finite number"),
        (lambda: dalembert.reference(BARS, [float("nan")]), "found time nan, expected a finite number"),
        (lambda: history.derivatives_at("gravity", 0.2, []), "found no names"),
        (lambda: dalembert.Chain("[[body]]\nlength = \n"), "line 2"),
        (lambda: chain.solve(certified=True).derivatives("joint.1.gap"), "need not be proved"),
    ]:
        with pytest.raises(ValueError, match=said):
            refused()
    for refused, said in [
        (lambda: dalembert.Chain(5), "found a scene of type int"),
        (lambda: chain.replace("joint.1.gap"), "expected a mapping of names to numbers"),
    ]:
        with pytest.raises(TypeError, match=said):
            refused()
    with pytest.raises(AttributeError, match="a Chain does not change"):
        chain.bodies = ()
