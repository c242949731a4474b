"""B-spline and NURBS curves of degree 1 to 7, clamped or not.

A curve has `points` (N, 3), positive `weights` (N,), `knots` (N + degree + 1,) that do not decrease, and a `degree`.
Its parameter runs over the domain, from knot `degree` to knot N. It is clamped, and starts at its first point, where
the first knot occurs `degree + 1` times. Every function raises `InputError` for arrays that make no curve and for
parameters outside the domain.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np

from tress import _core  # type: ignore[attr-defined]
from tress.base.errors import InputError
from tress.kernel.arrays import checked

Array = np.ndarray[Any, Any]


@dataclass(frozen=True, eq=False)
class Curve:
    """A rational B-spline curve; `curve()` makes one of whatever is known.

    `points` (N, 3) float64, in metres; `weights` (N,) float64, positive; `knots` (N + degree + 1,) float64; `degree` 1
    to 7.
    """

    points: Array
    weights: Array
    knots: Array
    degree: int

    @property
    def domain(self) -> tuple[float, float]:
        """First and last parameter."""
        return float(self.knots[self.degree]), float(self.knots[-self.degree - 1])

    def reversed(self) -> "Curve":
        """The same curve, run through from its end to its start over the same domain."""
        low, high = self.domain
        return Curve(self.points[::-1], self.weights[::-1], reversed_knots(self.knots, low, high), self.degree)


def curve(points: Any, *, degree: int = 3, weights: Any = None, knots: Any = None) -> Curve:
    """A checked curve. Without `weights` they are 1; without `knots` they are clamped and uniform over 0 to 1.

    >>> line = curve([[0, 0, 0], [2, 0, 0]], degree=1)
    >>> evaluate(line, at=[0.25]).tolist()
    [[0.5, 0.0, 0.0]]
    """
    given = checked(points, name="points", dtype=np.float64, shape=(None, 3))
    made = Curve(
        given,
        np.ones(len(given)) if weights is None else checked(weights, name="weights", dtype=np.float64, shape=(None,)),
        uniform_knots(len(given), degree=degree)
        if knots is None
        else checked(knots, name="knots", dtype=np.float64, shape=(None,)),
        int(degree),
    )
    _answer(_core.nurbs_check_curve, made)
    return made


def evaluate(curve: Curve, *, at: Any) -> Array:
    """(Q, 3) float64: the points at parameters `at` (Q,)."""
    return _answer(_core.nurbs_curve_points, curve, _numbers(at, "at"))


def derivatives(curve: Curve, *, at: Any) -> Array:
    """(Q, 3, 3) float64: point, first and second derivative at parameters `at` (Q,).

    At a knot they are those of the span after it; at the end of the domain, of the span before.
    """
    return _answer(_core.nurbs_curve_derivatives, curve, _numbers(at, "at")).reshape(-1, 3, 3)


def refine(curve: Curve, *, knots: Any) -> Curve:
    """The same curve with more `knots` (K,), which lie inside its domain; all are inserted at once.

    The points move by rounding alone (1e-15 of their size). Raises `InputError` where a knot would occur more often
    than the degree. Source: the Oslo algorithm, Cohen, Lyche, Riesenfeld 1980.

    >>> line = curve([[0, 0, 0], [2, 0, 0]], degree=1)
    >>> refine(line, knots=[0.5]).points[:, 0].tolist()
    [0.0, 1.0, 2.0]
    """
    return _curve(_answer(_core.nurbs_curve_refined, curve, _numbers(knots, "knots")), curve.degree)


def over_knots(curve: Curve, *, knots: Any) -> Curve:
    """The same curve over another knot vector, which holds every knot of `curve` inside its own domain.

    That domain may be a part of the old one: so a curve is cut.
    """
    return _curve(_answer(_core.nurbs_curve_over, curve, _numbers(knots, "knots")), curve.degree)


def clamp(curve: Curve) -> Curve:
    """The same curve with clamped knots, so that it starts at its first point and ends at its last."""
    return _curve(_answer(_core.nurbs_curve_clamped, curve), curve.degree)


def uniform_knots(count: int, *, degree: int) -> Array:
    """(count + degree + 1,) float64: clamped knots over 0 to 1 with equally spaced inner knots.

    >>> uniform_knots(4, degree=2).tolist()
    [0.0, 0.0, 0.0, 0.5, 1.0, 1.0, 1.0]
    """
    if checked_degree(degree) >= count:
        raise InputError(f"{count} control points were given for degree {degree}; at least {degree + 1} were expected.")
    inner = np.linspace(0, 1, count - degree + 1)
    return np.concatenate([np.zeros(degree), inner, np.ones(degree)])


def reversed_knots(knots: Array, low: float, high: float) -> Array:
    """The knots of the same domain, `low` to `high`, run through backwards; both ends exactly."""
    mirrored = low + (high - knots[::-1])
    mirrored[knots[::-1] == low] = high
    return mirrored


def _curve(arrays: tuple[Array, Array, Array], degree: int) -> Curve:
    return Curve(*arrays, degree)


def _answer(function: Any, curve: Curve, *rest: Any) -> Any:
    arrays = (
        checked(curve.points, name="points", dtype=np.float64, shape=(None, 3)),
        checked(curve.weights, name="weights", dtype=np.float64, shape=(None,)),
        checked(curve.knots, name="knots", dtype=np.float64, shape=(None,)),
        checked_degree(curve.degree),
    )
    try:
        return function(arrays, *rest)
    except ValueError as error:
        raise InputError(f"The curve cannot be used: {error}.") from error


def checked_degree(degree: int) -> int:
    """The degree, refused outside 1 to 7."""
    if not 1 <= degree <= 7:
        raise InputError(f"The degree is {degree}; 1 to 7 was expected.")
    return int(degree)


def _numbers(value: Any, name: str) -> Array:
    return checked(value, name=name, dtype=np.float64, shape=(None,))
