"""What a reader and a type checker see."""

import inspect
import pathlib
import subprocess
import sys

import pytest

import dalembert

HERE = pathlib.Path(__file__).resolve().parent

#: Sections that the format of numpydoc asks for and that would say nothing here.
LEFT_OUT = {
    "ES01",  # an extended summary
    "EX01",  # an example for each method
    "SA01",  # see also
    "SA04",  # a description in See Also
    "GL08",  # of private names
    "RT02",  # a name of what is returned
    "RT03",  # a description of what a property returns
    "PR08", "PR09",  # capitals and full stops of one-word descriptions
    "SS05", "SS06",  # the mood of a noun; one line
}

#: Classes that functions make: nobody calls them.
MADE = {("dalembert.History", "PR01"), ("dalembert.ChainHistory", "PR01"), ("dalembert.Comparison", "PR01")}


def documented():
    for name in dalembert.__all__:
        thing = getattr(dalembert, name)
        yield f"dalembert.{name}"
        if inspect.isclass(thing):
            for method, value in vars(thing).items():
                if not method.startswith("_") and (inspect.isfunction(value) or isinstance(value, classmethod)):
                    yield f"dalembert.{name}.{method}"


def test_docstrings_are_numpydoc():
    validate = pytest.importorskip("numpydoc.validate")
    names = list(documented())
    assert len(names) > 25
    faults = [
        f"{name}: {code} {text}"
        for name in names
        for code, text in validate.validate(name)["errors"]
        if code not in LEFT_OUT and (name, code) not in MADE
    ]
    assert not faults, "\n".join(faults)


WRONG = """
import dalembert
dalembert.solve("paper-strong", exakt=True)
"""

#: What is installed beside ours counts as anything: reading its types takes a minute.
SKIPPED = """
[mypy]
strict = true
[mypy-dask.*,distributed.*,matplotlib.*,pandas.*,xarray.*]
follow_imports = skip
ignore_missing_imports = true
"""


def test_types(tmp_path):
    pytest.importorskip("mypy")
    (tmp_path / "mypy.ini").write_text(SKIPPED)
    (tmp_path / "wrong.py").write_text(WRONG)

    def check(*files):
        return subprocess.run([sys.executable, "-m", "mypy", *files], capture_output=True, text=True, cwd=tmp_path)

    found = check("-p", "dalembert")
    assert found.returncode == 0, found.stdout
    found = check(*map(str, sorted((HERE.parent / "examples").glob("*.py"))), "wrong.py")
    lines = found.stdout.splitlines()
    assert [line.split(":")[0] for line in lines if ": error:" in line] == ["wrong.py"], found.stdout
    assert "exakt" in found.stdout
