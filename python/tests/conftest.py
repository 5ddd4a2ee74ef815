import os
import pathlib
import subprocess

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]


@pytest.fixture(scope="session")
def command():
    """Runs the command `dalembert` on a scene given as text."""
    program = os.environ.get("DALEMBERT", str(ROOT / "target" / "debug" / "dalembert"))

    def run(*arguments: str, scene: str = "") -> subprocess.CompletedProcess:
        return subprocess.run([program, *arguments], input=scene, capture_output=True, text=True)

    return run
