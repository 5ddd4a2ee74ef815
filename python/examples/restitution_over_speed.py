"""The coefficient of restitution over the impact speed, for several dampings: the curves of the paper's Figure 4, which
begin left of its dots. A rod without enough energy to come back to h = 0 has no e_E: nan.

    python restitution_over_speed.py [restitution.png]
"""

import sys

import numpy as np

import dalembert

speeds = np.geomspace(0.05, 12.5, 120)
dampings = [0, 0.1, 0.2, 0.3]
rod = dalembert.Problem(length=1, wave_speed=1, gravity=1, impact_speed=1)
found = dalembert.sweep(rod, "e_E2", impact_speed=speeds, damping=np.reshape(dampings, (4, 1)))
curves = dict(zip(dampings, np.sqrt(found["e_E2"].filled(np.nan))))

print("    μ  " + "".join(f"   r = {damping}" for damping in curves))
for k in range(0, len(speeds), 17):
    print(f"{speeds[k]:7.3f}" + "".join(f"{curve[k]:10.6f}" for curve in curves.values()))

if len(sys.argv) > 1:
    import matplotlib.pyplot as plt

    for damping, curve in curves.items():
        plt.semilogx(speeds, curve, label=f"r = {damping}")
    plt.xlabel("μ")
    plt.ylabel("e_E")
    plt.legend()
    plt.savefig(sys.argv[1], dpi=150)
