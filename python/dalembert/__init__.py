"""The exact reference for the bouncing elastic rod.

``v_tt + 2r v_t - c² v_xx = -g`` on ``0 < x < L`` with unilateral contact at ``x = 0``.

Numbers are given as int, float, ``fractions.Fraction``, ``decimal.Decimal`` or str. A float of Python or NumPy stands
for the shortest decimal that spells it: 0.1 and np.float32(0.1) are 1/10. All units are those of the input.

Examples
--------
>>> import dalembert
>>> m = dalembert.solve("getfem-dynamic-contact", to=12)
>>> m.strain([0.5, 1.5])
array([ 0. , -0.5])
"""

from ._answers import Centre, Derivatives, Energy, Field, GroundEnd, TopEnd
from ._chain import Chain, ChainHistory
from ._compare import Comparison, compare
from ._history import History
from ._problem import Problem, __version__, scenes
from ._solve import reference, solve, write_reference
from ._sweep import Sweep, sweep

__all__ = [
    "Centre", "Chain", "ChainHistory", "Comparison",
    "Derivatives", "Energy", "Field", "GroundEnd", "History", "Problem", "Sweep", "TopEnd",
    "compare", "reference", "scenes", "solve", "sweep", "write_reference",
]

for _name in __all__:
    globals()[_name].__module__ = "dalembert"


def __dir__() -> list[str]:
    return [*__all__, "__version__"]
