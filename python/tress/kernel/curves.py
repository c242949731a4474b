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


@dataclass(frozen=True, eq=False)
class ClosestOnCurve:
    """Closest points of Q queries: `parameter` (Q,), `points` (Q, 3), `distance` (Q,), all float64."""

    parameter: Array
    points: Array
    distance: Array


@dataclass(frozen=True, eq=False)
class CurveByLength:
    """A cubic whose parameter is the length from its start, and its greatest distance from the path it follows."""

    curve: Curve
    deviation: float


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


def closest_points(curve: Curve, *, queries: Any) -> ClosestOnCurve:
    """The closest point of the curve for every query (Q, 3); where several are equally close, any one of them.

    Newton's method on pieces of the spans, nearest piece first. **Limit:** a piece, one of 4 `degree` in a span,
    is searched from one start, so of two valleys of the distance in one piece the higher may be found.
    """
    points = checked(queries, name="queries", dtype=np.float64, shape=(None, 3))
    return ClosestOnCurve(*_answer(_core.nurbs_curve_closest, curve, points))


def lengths(curve: Curve, *, at: Any, accuracy: float = 1e-9) -> Array:
    """(Q,) float64: length from the start of the curve to parameters `at` (Q,), to within about `accuracy`."""
    return _answer(_core.nurbs_curve_lengths, curve, _numbers(at, "at"), _positive(accuracy, "accuracy"))


def length(curve: Curve, *, accuracy: float = 1e-9) -> float:
    """Length of the whole curve, to within about `accuracy`.

    >>> length(curve([[0, 0, 0], [3, 4, 0]], degree=1))
    5.0
    """
    return float(lengths(curve, at=[curve.domain[1]], accuracy=accuracy)[0])


def parameters_at(curve: Curve, *, lengths: Any, accuracy: float = 1e-9) -> Array:
    """(Q,) float64: the parameters at `lengths` (Q,) from the start of the curve, 0 to its length."""
    wanted = _numbers(lengths, "lengths")
    return _answer(_core.nurbs_curve_parameters, curve, wanted, _positive(accuracy, "accuracy"))


def by_arc_length(curve: Curve, *, accuracy: float = 1e-6) -> CurveByLength:
    """The same path as a cubic of weights 1 whose parameter is the length from its start, 0 to its length.

    Spans are doubled until points at equal lengths are within `accuracy`; at 1,024 spans between two creases it stops,
    and `deviation` tells what was reached. Raises `InputError` for a curve without length.
    """
    arrays, deviation = _answer(_core.nurbs_curve_by_arc_length, curve, _positive(accuracy, "accuracy"))
    return CurveByLength(_curve(arrays, 3), deviation)


def fit(
    points: Any,
    *,
    count: int,
    degree: int = 3,
    parameters: Any = None,
    knots: Any = None,
    fix_ends: bool = True,
    smoothness: float = 0.0,
) -> Curve:
    """The curve with `count` control points, of weights 1, that is nearest to `points` (Q, 3) in least squares.

    Point i belongs to `parameters[i]`, by default from 0 to 1 in proportion to the chords. Without `knots` every span
    gets about as many points. `fix_ends` puts the first and last control point on the first and last point (the knots
    must then be clamped). `smoothness` weighs the squares of the second differences of the control points, as if
    there were as many of them as points; it also settles control points that no point is near, which otherwise raise
    `InputError`. **Limit:** parameters are taken as given, not improved.

    >>> t = np.linspace(0, 1, 20)
    >>> arch = np.column_stack([t, t * (1 - t), 0 * t])
    >>> fit(arch, count=3, degree=2, parameters=t).points[1].round(9).tolist()
    [0.5, 0.5, 0.0]
    """
    given = checked(points, name="points", dtype=np.float64, shape=(None, 3))
    at = _core.nurbs_chord_parameters(given) if parameters is None else parameters
    at = checked(at, name="parameters", dtype=np.float64, shape=(len(given),))
    vector = knots_for(at, count=count, degree=degree) if knots is None else _numbers(knots, "knots")
    if len(vector) != count + degree + 1:
        raise InputError(f"{len(vector)} knots were given; {count + degree + 1} were expected.")
    settings = (_not_negative(smoothness, "smoothness"), bool(fix_ends))
    return _curve(_refused(_core.nurbs_fit_curve, (vector, degree), at, given, *settings), degree)


def knots_for(parameters: Any, *, count: int, degree: int) -> Array:
    """(count + degree + 1,) float64: clamped knots with about as many of the `parameters` (Q,) in every span."""
    at = np.sort(_numbers(parameters, "parameters"))
    return _refused(_core.nurbs_knots_for, at, checked_degree(degree), count)


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
    return _refused(function, arrays, *rest)


def _refused(function: Any, *arguments: Any) -> Any:
    try:
        return function(*arguments)
    except ValueError as error:
        raise InputError(f"The curve cannot be used: {error}.") from error


def _positive(value: float, name: str) -> float:
    if not 0 < value < np.inf:
        raise InputError(f"{name} is {value}; a positive number was expected.")
    return float(value)


def _not_negative(value: float, name: str) -> float:
    if not 0 <= value < np.inf:
        raise InputError(f"{name} is {value}; a number not below 0 was expected.")
    return float(value)


def checked_degree(degree: int) -> int:
    """The degree, refused outside 1 to 7."""
    if not 1 <= degree <= 7:
        raise InputError(f"The degree is {degree}; 1 to 7 was expected.")
    return int(degree)


def _numbers(value: Any, name: str) -> Array:
    return checked(value, name=name, dtype=np.float64, shape=(None,))
