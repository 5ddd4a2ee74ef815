@REMARKS@from bisect import bisect_right
@FRACTIONS@
@CONSTANTS@SIGN = @SIGN@
TABLE = [
@ROWS@]
_FROM = [row[0] for row in TABLE]
_NEAR = @NEAR@


def _wave(s):
    """P and P' at s."""
    start, value, rate, slope = TABLE[max(bisect_right(_FROM, s) - 1, 0)]
    tau = s - start
    return value + (rate + slope * tau / 2) * tau, rate + slope * tau


def uExact(x, t, d=0):
    """The displacement (d=0), the strain (d=1) or the velocity (d=2) at x and t.

    Arrays of NumPy are broadcast against each other.
    """
    if hasattr(x, "__iter__") or hasattr(t, "__iter__"):
        from numpy import vectorize

        return vectorize(uExact, otypes=[@KIND@])(x, t, d)
    if not (0 <= x <= LENGTH * _NEAR and 0 <= t <= END * _NEAR):
        raise ValueError(f"found x = {x}, t = {t}, expected 0 <= x <= {LENGTH} and 0 <= t <= {END}")
    up, rise = _wave(t - x / WAVE_SPEED)
    down, fall = _wave(t + x / WAVE_SPEED - ROUND_TRIP)
    if d == 0:
        return (up + SIGN * down) / 2 + A + (B + D * x) * x
    if d == 1:
        return (SIGN * fall - rise) / (2 * WAVE_SPEED) + B + 2 * D * x
    if d == 2:
        return (rise + SIGN * fall) / 2
    raise ValueError(f"found d = {d}, expected 0, 1 or 2")
