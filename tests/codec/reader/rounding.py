"""Sums and rounding as docs/file-format-vectors.md defines them."""

import math


def total(numbers) -> float:
    """Adds in sequence with plain rounding. From Python 3.12 on, sum() is more exact."""
    result = 0.0
    for x in numbers:
        result += x
    return result


def nearest(x: float) -> float:
    """Rounds halves away from 0 and leaves what is not finite unchanged."""
    if not math.isfinite(x):
        return x
    down = math.floor(abs(x))
    return math.copysign(down + (abs(x) - down >= 0.5), x)
