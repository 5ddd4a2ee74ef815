"""What numbers, arrays and sides may be."""

from __future__ import annotations

from decimal import Decimal
from fractions import Fraction
from typing import Any, Literal, Sequence, Union

import numpy as np

Array = np.ndarray[Any, np.dtype[Any]]
Number = Union[int, float, Fraction, Decimal, str]
Numbers = Union[Number, Sequence[Any], Array]
Points = Union[Sequence["tuple[Number, Number]"], Array]
Maybe = Union[Number, None]
Side = Literal["left", "right"]
