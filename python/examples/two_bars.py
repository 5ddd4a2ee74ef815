"""A scheme for two bars of different material against the exact motion: the force of their contact, in numbers and,
with the name of a file, as a picture.

    python two_bars.py [force.png]
"""

import sys

import numpy as np
from numpy.typing import NDArray

import dalembert

Pair = tuple[float, float]
Array = NDArray[np.float64]


def contact_force(
    lengths: Pair, moduli: Pair, densities: Pair, speed: float, gap: float, cells: tuple[int, int], end: float
) -> tuple[Array, Array]:
    """Return times and contact forces of central differences with lumped masses; the ends of a closed contact move
    together. The first bar moves towards the second one."""
    speeds = np.sqrt(np.divide(moduli, densities))
    steps = np.divide(lengths, cells)
    dt = 0.9 * (steps / speeds).min()
    masses = [np.full(n + 1, rho * h) for n, rho, h in zip(cells, densities, steps)]
    for mass in masses:
        mass[[0, -1]] /= 2
    u = [np.zeros(n + 1) for n in cells]
    v = [np.full(cells[0] + 1, float(speed)), np.zeros(cells[1] + 1)]
    times, forces = np.arange(int(end / dt)) * dt, []
    for _ in times:
        for k in range(2):
            pull = moduli[k] * np.diff(u[k]) / steps[k]
            v[k] += dt * (np.append(pull, 0) - np.insert(pull, 0, 0)) / masses[k]
        depth = u[0][-1] + dt * v[0][-1] - (gap + u[1][0] + dt * v[1][0])
        force = max(depth, 0) / dt**2 / (1 / masses[0][-1] + 1 / masses[1][0])
        v[0][-1] -= dt * force / masses[0][-1]
        v[1][0] += dt * force / masses[1][0]
        u = [u[k] + dt * v[k] for k in range(2)]
        forces.append(force)
    return times, np.array(forces)


# OpenFOAM's benchmark 7.1.2.
chain = dalembert.Chain("openfoam-7-1-2")
history = chain.solve()
times, ours = contact_force((10, 10), (49, 100), (0.01, 0.01), 0.1, 0.01, (400, 400), 0.5)
exact = history.value("force.1", times)

contact = history.contacts[0]
closed = times[np.flatnonzero(ours)]
print(f"exact: contact from {contact['impact']:.4f} to {contact['release']:.4f}, force {contact['peak_force']:.6f}")
print(f"scheme: contact from {closed[0]:.4f} to {closed[-1]:.4f}, force {np.median(ours[ours > 0.5 * ours.max()]):.6f}")
print(f"difference of the forces: {np.abs(ours - exact).mean() / np.abs(exact).mean():.1%} in the mean")
slope = history.derivatives_at("body.2.modulus", 0.2, "force.1").right["force.1"][0]
print(f"the force at t = 0.2 changes by {slope * 100 / exact.max():.1%} of itself with the modulus of the second bar")

if len(sys.argv) > 1:
    import matplotlib.pyplot as plt

    plt.plot(times, ours, lw=0.8, label="central differences, 2 × 400 elements")
    plt.plot(times, exact, "k", lw=1.5, label="exact")
    plt.xlabel("t")
    plt.ylabel("contact force")
    plt.legend()
    plt.savefig(sys.argv[1], dpi=150)
