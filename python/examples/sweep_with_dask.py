"""A sweep over many machines: Dask maps blocks of points over its workers. Each point is solved by itself, so that the
answer is the same, byte for byte, for any number of workers and blocks.

    python sweep_with_dask.py [address of a scheduler]
"""

import sys
from typing import Any

import numpy as np

import dalembert

Doubles = np.ndarray[Any, np.dtype[Any]]


def bounce(points: Doubles) -> Doubles:
    """Return bounce time and e_E² of each point (μ, r); nan where there is none."""
    rod = dalembert.Problem(length=1, wave_speed=1, gravity=1, impact_speed=1)
    answers = np.empty((len(points), 2))
    for answer, (speed, damping) in zip(answers, points):
        contacts = rod.replace(impact_speed=speed, damping=damping).solve(first_contact=True).contacts
        answer[:] = [contacts[name].filled(np.nan)[0] for name in ("release", "e_E2")]
    return answers


def sweep(client: Any, points: Doubles, blocks: int) -> Doubles:
    return np.concatenate(client.gather(client.map(bounce, np.array_split(points, blocks))))


if __name__ == "__main__":
    from dask.distributed import Client

    speeds, dampings = np.meshgrid(np.geomspace(0.05, 12.5, 500), [0, 0.1, 0.2, 0.3])
    points = np.column_stack([speeds.ravel(), dampings.ravel()])
    with Client(*sys.argv[1:2]) as client:
        answers = sweep(client, points, blocks=64)
    print(f"{len(answers)} points, {np.isfinite(answers[:, 0]).sum()} with a bounce")
    np.save("bounces.npy", answers)
