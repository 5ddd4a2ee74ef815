"""The numbers against routes that share no code with them."""

import numpy as np
import pytest
from scipy.integrate import fixed_quad
from scipy.special import iv

import dalembert


def printed_stress(t: float, r: float, mu: float, g: float, trip: float) -> float:
    """``v_x(0,t)`` by (2.28), c = 1: the sum over rays, and its integral, round trip by round trip."""

    def rays(tau, passed):
        echoes = ((-1) ** j * iv(0, r * np.sqrt(tau**2 - (j * trip) ** 2)) for j in range(1, passed + 1))
        return iv(0, r * tau) + 2 * sum(echoes)

    trips = int(t / trip)
    ends = [*(trip * np.arange(trips + 1)), t]
    integrand = lambda s, passed: np.exp(r * (t - s)) * rays(s, passed)
    parts = (fixed_quad(integrand, a, b, (k,), n=40)[0] for k, (a, b) in enumerate(zip(ends, ends[1:])))
    return float(np.exp(-r * t) * (-mu * rays(t, trips) - g * sum(parts)))


@pytest.mark.parametrize(("r", "mu", "g"), [(0.2, 1, 1), (1.3, 0.7, 0), (2.9, 1, 0.1)])
def test_stress_against_the_integral_of_the_paper(r, mu, g):
    length, trip = 0.5, 1.0
    rod = dalembert.Problem(length=length, wave_speed=1, damping=r, gravity=g, impact_speed=mu)
    history = rod.solve(first_contact=True)
    times = np.linspace(0.01, float(history.end) * 0.999, 40)
    expected = [printed_stress(t, r, mu, g, trip) for t in times]
    np.testing.assert_allclose(history.strain(times), expected, rtol=0, atol=1e-11 * (mu + g))


def leapfrog(cells: int, r: float, mu: float, g: float, end: float) -> np.ndarray:
    """Displacements at `end` by central differences with the step of the mesh, c = L = 1; the ground end is held at
    zero where it would go below."""
    dx = 1 / cells
    old, now = np.full(cells + 1, 0.0), None
    acceleration = lambda v: np.diff(np.concatenate(([v[1]], v, [v[-2]])), 2) / dx**2 - g
    velocity = np.full(cells + 1, -float(mu))
    velocity[0] = 0
    now = old + dx * velocity + dx**2 / 2 * (acceleration(old) - 2 * r * velocity)
    now[0] = max(now[0], 0)
    for _ in range(round(end / dx) - 1):
        new = (2 * now - (1 - r * dx) * old + dx**2 * acceleration(now)) / (1 + r * dx)
        new[0] = max(new[0], 0)
        old, now = now, new
    return now


@pytest.mark.parametrize("end", [1.5, 3.0])
def test_displacement_against_finite_differences(end):
    r, mu, g = 0.2, 3, 1
    history = dalembert.Problem(length=1, wave_speed=1, damping=r, gravity=g, impact_speed=mu, time=end).solve()
    errors = []
    for cells in (100, 200, 400):
        exact = history.grid(np.linspace(0, 1, cells + 1), end).u
        errors.append(np.abs(leapfrog(cells, r, mu, g, end) - exact).max())
    # The scheme is of first order where the contact opens: each doubling halves its error.
    assert errors[0] < 0.05
    assert errors[1] < 0.6 * errors[0] and errors[2] < 0.6 * errors[1]


def test_energy_is_its_integral():
    history = dalembert.solve("doyen-ern-piperno")
    x = np.linspace(0, 10, 4001)
    for t in (0.3, 1.1, 2.9):
        field = history.grid((x[1:] + x[:-1]) / 2, t)
        h, rate = history.centre(t)
        width, c = x[1] - x[0], 30
        vibration = 0.5 * width * np.sum((field.v - rate) ** 2 + c**2 * field.strain**2)
        assert history.energy(t).E_z == pytest.approx(vibration, rel=2e-3)
        assert rate == pytest.approx(field.v.mean(), abs=2e-2)
        assert history.energy(t).E_total == pytest.approx(500, rel=1e-12)
