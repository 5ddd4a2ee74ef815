"""The order of convergence of a scheme: the mean error of its contact stress over a bounce, on meshes each twice as
fine as the last.

    python convergence_order.py
"""

import numpy as np
from scheme import leapfrog

import dalembert

history = dalembert.Problem(length=1, wave_speed=1, gravity=1, impact_speed=3, time=3).solve()
before = None
print("elements   mean error   order")
for cells in (25, 50, 100, 200, 400):
    times, ours = leapfrog(1, 1, 1, 3, cells, end=2.5)
    error = np.abs(ours - history.strain(times)).mean()
    order = "" if before is None else f"{np.log2(before / error):.2f}"
    print(f"{cells:8}   {error:10.2e}   {order:>5}")
    before = error
