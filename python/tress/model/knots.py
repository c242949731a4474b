"""Knot vectors: what makes one valid, and what it says.

A knot vector of n control points and degree p has n + p + 1 numbers that do not decrease, as in the literature and in
USD; the surface lives over its domain, from knot p to knot n.
"""

from typing import Any

import numpy as np

from tress.base.errors import InputError

Array = np.ndarray[Any, Any]

MAX_DEGREE = 7


def degree_of(knots: Array, *, count: int) -> int:
    """The degree that a knot vector has over `count` control points.

    >>> degree_of(np.array([0, 0, 0, 0, 1, 1, 1, 1]), count=4)
    3
    """
    return len(knots) - count - 1


def domain_of(knots: Array, *, count: int) -> tuple[float, float]:
    """First and last parameter of the surface."""
    return float(knots[degree_of(knots, count=count)]), float(knots[count])


def check_knots(knots: Array, *, count: int, where: str) -> None:
    """Raises `InputError` in one sentence where `knots` is no knot vector of degree 1 to 7 over `count` points."""
    degree = degree_of(knots, count=count)
    if degree < 1:
        raise InputError(f"{where} has {len(knots)} knots for {count} points; at least {count + 2} were expected.")
    if degree > min(MAX_DEGREE, count - 1):
        raise InputError(
            f"{where} has {len(knots)} knots for {count} points, which is degree {degree}; "
            f"degree 1 to {min(MAX_DEGREE, count - 1)} was expected."
        )
    steps = np.diff(knots)
    if (steps < 0).any():
        place = int(np.argmax(steps < 0))
        raise InputError(f"{where} decreases from {knots[place]} to {knots[place + 1]}; rising numbers were expected.")
    if not knots[degree] < knots[count]:
        raise InputError(f"{where} spans nothing, from {knots[degree]} to {knots[count]}.")
    values, repeated = np.unique(knots, return_counts=True)
    inside = (values > knots[degree]) & (values < knots[count])
    most = np.where(inside, degree, degree + 1)
    if (repeated > most).any():
        worst = int(np.argmax(repeated - most))
        raise InputError(
            f"{where} repeats {values[worst]} {repeated[worst]} times; at most {most[worst]} were expected."
        )
