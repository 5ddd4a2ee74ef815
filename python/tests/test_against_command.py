"""Every number that the module gives is the one that the command prints, bit for bit, where both take the same numbers.
The command settles together all that it prints, and the module each table by itself: where that takes longer numbers
on one side, which the bound of the run shows, both are the same within the accuracy of 1e-9 that they promise."""

import json
import math
import os
import random
from concurrent.futures import ThreadPoolExecutor
from decimal import Decimal
from fractions import Fraction

import numpy as np
import pytest

import dalembert

EVENTS = ("t", "v_end", "h", "h_rate")
CONTACTS = (
    "impact", "release", "duration", "impact_velocity", "release_velocity", "impulse", "peak_strain", "e_P", "e_E2",
    "translational_part", "energy_kept", "E_total_after", "E_h_after", "E_z_after",
)  # fmt: skip


def values(rng: random.Random, damped: bool) -> dict:
    """A problem; numbers of every type."""
    small = lambda: rng.choice([Fraction(rng.randint(1, 40), rng.randint(1, 12)), Decimal(rng.randint(1, 400)) / 100])
    rod = {"length": small(), "wave_speed": small(), "impact_speed": small()}
    if rng.random() < 0.8:
        rod["gravity"] = rng.choice([small(), rng.randint(1, 10), round(rng.uniform(0.1, 10), 3)])
    if damped:
        rod["damping"] = round(rng.uniform(0.01, 1) * float(rod["wave_speed"]) / float(rod["length"]), 4)
    return rod


def toml(rod: dict, impacts: int) -> str:
    text = lambda value: f'"{value}"' if isinstance(value, Fraction) else str(value)
    entry = lambda name: f"{name.removeprefix('impact_')} = {text(rod[name])}\n"
    line = lambda *names: "".join(entry(name) for name in names if name in rod)
    scene = "[rod]\n" + line("length", "wave_speed", "damping") + "[impact]\n" + line("impact_speed")
    if "gravity" in rod:
        scene += f"[gravity]\nacceleration = {text(rod['gravity'])}\n"
    return scene + f"[run]\nimpacts = {impacts}\n"


def same(ours, theirs, bound=math.inf) -> None:
    """The same double; where the bound leaves no digit the command prints 0."""
    if theirs is None:
        assert ours is None or ours is np.ma.masked
    elif ours != theirs:
        assert theirs == 0 and abs(ours) <= bound, (ours, theirs)


def until(scene, last):
    """The end of the run in which the command answers up to `last`: it follows a damped rod for a quarter of a round
    trip more, so that its last strip ends later."""
    return float(last) + 0.5 if scene == "figure-4-r02" else last


def near(ours, theirs, scale) -> None:
    if theirs is None:
        assert ours is np.ma.masked
    else:
        assert ours == pytest.approx(theirs, rel=1e-9, abs=1e-9 * scale)


def tables(answer: dict) -> dict:
    """The rows of the command's answer, and the names of their numbers, by the name of the module's table."""
    return {
        "events": (answer["events"], EVENTS),
        "contacts": (answer["contacts"], CONTACTS),
        "stress_history": (answer["stress"]["pieces"], ("start", "end", "strain_start", "strain_end")),
    }


def answers(command, problems: list, *options: str):
    """Problems with the command's answers, which come from as many processes at a time as there are cores."""
    asked = ("solve", "-", "--format", "json", *options)
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        for problem, run in zip(problems, pool.map(lambda problem: command(*asked, scene=toml(*problem)), problems)):
            assert run.returncode == 0, run.stderr
            yield dalembert.Problem(**problem[0], impacts=problem[1]), json.loads(run.stdout)


@pytest.mark.parametrize("damped", [False, True])
def test_random_problems_in_doubles(command, damped):
    rng = random.Random(1878 + damped)
    exactly = 0
    for problem, expected in answers(command, [(values(rng, damped), rng.randint(1, 4)) for _ in range(500)]):
        count = 0
        for table, (rows, names) in tables(expected).items():
            history = problem.solve()
            ours = getattr(history, table)
            assert len(ours) == len(rows)
            alike = history.error_estimate == expected["error_estimate"]
            for name in names:
                scale = np.max(np.abs(ours[name].filled(0)), initial=1)
                for value, row in zip(ours[name], rows, strict=True):
                    same(value, row[name], 1e-9 * scale) if alike else near(value, row[name], scale)
                count += alike
        exactly += count > 0
        assert problem.solve().events["kind"].tolist() == [event["kind"] for event in expected["events"]]
    assert exactly > 400


NUMBERS = {
    "exact": ({"exact": True}, ("--exact",), Fraction),
    "digits": ({"digits": 50}, ("--digits", "50"), lambda text: str(Decimal(text))),
    "certified": ({"certified": True}, ("--certified",), lambda number: (Decimal(number["lo"]), Decimal(number["hi"]))),
}


@pytest.mark.parametrize("numbers", NUMBERS)
def test_random_problems_in_long_numbers(command, numbers):
    rng = random.Random(1746)
    options, asked, read = NUMBERS[numbers]
    for problem, expected in answers(command, [(values(rng, False), 3) for _ in range(400)], *asked):
        history = problem.solve(**options)
        for table, (rows, names) in tables(expected).items():
            for ours, row in zip(getattr(history, table), rows, strict=True):
                for name in names:
                    value = None if ours[name] is np.ma.masked else ours[name]
                    value = str(value) if isinstance(value, Decimal) else value
                    wanted = None if row[name] is None else read(row[name])
                    if numbers == "certified" and None not in (value, wanted):
                        # An end of the command moves out to its printed value.
                        printed = Decimal(row[name]["value"])
                        wanted = tuple(own if end == printed else end for own, end in zip(value, wanted, strict=True))
                    assert type(value) is type(wanted) and value == wanted, (table, name)


@pytest.mark.parametrize("scene", ["doyen-ern-piperno", "getfem-dynamic-contact", "figure-4-r02"])
@pytest.mark.parametrize("side", ["left", "right"])
def test_values_at_times(command, scene, side):
    # As texts, which stand for what they spell in both.
    times = list(map(repr, np.linspace(0.05, 1.9, 38).tolist()))
    listed = ",".join(times)
    # As the command does, a history for each quantity: an answer may leave longer numbers for those after it.
    history = lambda: dalembert.solve(scene, to=until(scene, times[-1]))
    x = [0, history().scales["length"] / 2]
    ours = {
        "strain": [history().strain(times, side)],
        "end": history().ground_end(times, side),
        "top": history().top_end(times, side),
        "centre": history().centre(times),
        "energy": history().energy(times),
        "field": history().grid(x, times, side),
    }
    for quantity, columns in ours.items():
        points = ("--points", ",".join(map(str, x))) if quantity == "field" else ()
        asked = ("--quantity", quantity, "--times", listed, "--side", side, *points)
        run = command("sample", scene, *asked, "--uncertainty", "--format", "json")
        found = json.loads(run.stdout)
        # Each column has its bounds after it, with the keys first; with a material there are stresses too.
        names = [column["name"] for column in found["columns"]]
        first = names.index("x_uncertainty" if quantity == "field" else "side") + 1
        for j, column in enumerate(columns):
            for value, row in zip(column.ravel(), found["rows"], strict=True):
                same(value, *row[first + 2 * j : first + 2 * j + 2])


@pytest.mark.parametrize("scene", ["doyen-ern-piperno", "figure-4-r02"])
@pytest.mark.parametrize("kind", ["averages", "p1"])
def test_means_and_projections(command, scene, kind):
    times = [0.3, 1.25, 1.9]
    x = np.linspace(0, dalembert.solve(scene).scales["length"], 5)
    ours = dalembert.solve(scene, to=until(scene, times[-1])).grid(x, times, kind=kind)
    listed = [",".join(map(repr, map(float, values))) for values in (times, x)]
    asked = ("--times", listed[0], "--points", listed[1], "--field", kind, "--format", "json")
    found = json.loads(command("reference", scene, *asked).stdout)
    for j, column in enumerate(ours, start=3):
        assert column.shape == (3, len(x) - (kind == "averages"))
        for value, row in zip(column.ravel(), found["rows"], strict=True):
            same(value, row[j], found["columns"][j]["bound"])


def test_refusals_have_the_text_of_the_command(command):
    scene = "[rod]\nlength = {}\nwave_speed = 1\n[impact]\nspeed = 3\n"
    for length in (-1, '"1 m"', "nan", '"1/0"', "1e99", "[1]", "true"):
        run = command("solve", "-", scene=scene.format(length))
        with pytest.raises(ValueError) as refused:
            dalembert.solve(scene.format(length))
        said = " ".join(run.stderr.split())
        assert str(refused.value).split(": ", 1)[1] in said or str(refused.value) in said
    with pytest.raises(ValueError, match="found length = -1, expected a length above zero"):
        dalembert.Problem(length=-1, wave_speed=1, impact_speed=3)
