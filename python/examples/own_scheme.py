"""A numerical scheme against the exact motion: the contact stress over a bounce, in numbers and, with the name of a
file, as a picture.

    python own_scheme.py [stress.png]
"""

import sys

import numpy as np
from scheme import leapfrog

import dalembert

history = dalembert.Problem(length=1, wave_speed=1, gravity=1, impact_speed=3, time=2.5).solve()
times, ours = leapfrog(1, 1, 1, 3, cells=200, end=2.5)
exact = history.strain(times)

bounce = history.contacts["release"][0]
print(f"exact: contact from 0 to {bounce}, peak v_x = {history.contacts['peak_strain'][0]}")
print(f"scheme: contact ends at {times[np.flatnonzero(ours)[-1]]:.3f}, peak v_x = {ours.min():.3f}")
print(f"greatest difference {np.abs(ours - exact).max():.2f}, in the mean {np.abs(ours - exact).mean():.3f}")

if len(sys.argv) > 1:
    import matplotlib.pyplot as plt

    plt.plot(times, ours, lw=0.8, label="central differences, 200 elements")
    plt.plot(times, exact, "k", lw=1.5, label="exact")
    plt.xlabel("t")
    plt.ylabel("v_x(0,t)")
    plt.legend()
    plt.savefig(sys.argv[1], dpi=150)
