"""Sums and rounding as docs/file-format-vectors.md has them."""

import math


def total(numbers) -> float:
    """One after the other: sum() is more exact from Python 3.12 on."""
    result = 0.0
    for x in numbers:
        result += x
    return result


def nearest(x: float) -> float:
    """Halves away from 0; what is not finite stays as it is."""
    if not math.isfinite(x):
        return x
    down = math.floor(abs(x))
    return math.copysign(down + (abs(x) - down >= 0.5), x)
