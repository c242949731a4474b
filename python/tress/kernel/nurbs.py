"""B-spline and NURBS surfaces (patches) of degree 1 to 7, clamped or not; one, or thousands in one call.

A patch has rows of control points along u and columns along v: `points` (U, V, 3). `Patches` holds many patches of any
sizes in flat arrays; functions that answer many questions take it, and run on every core with the same bits on any
number. Every function raises `InputError` for arrays that make no surface and for parameters outside the domain.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np

from tress import _core  # type: ignore[attr-defined]
from tress.base.errors import InputError
from tress.kernel.arrays import checked
from tress.kernel.curves import checked_degree, knots_for, reversed_knots, uniform_knots

Array = np.ndarray[Any, Any]


@dataclass(frozen=True, eq=False)
class Patch:
    """A rational tensor-product B-spline surface; `patch()` makes one of whatever is known.

    `points` (U, V, 3) float64, metres; `weights` (U, V) float64, positive; `knots_u` (U + degree_u + 1,) and `knots_v`
    (V + degree_v + 1,) float64, not decreasing; degrees 1 to 7.
    """

    points: Array
    weights: Array
    knots_u: Array
    knots_v: Array
    degree_u: int
    degree_v: int

    @property
    def domain_u(self) -> tuple[float, float]:
        """First and last parameter along u."""
        return float(self.knots_u[self.degree_u]), float(self.knots_u[-self.degree_u - 1])

    @property
    def domain_v(self) -> tuple[float, float]:
        """First and last parameter along v."""
        return float(self.knots_v[self.degree_v]), float(self.knots_v[-self.degree_v - 1])

    def reversed_u(self) -> "Patch":
        """The same surface with u running backwards over the same domain; normals turn round."""
        knots = reversed_knots(self.knots_u, *self.domain_u)
        return Patch(self.points[::-1], self.weights[::-1], knots, self.knots_v, self.degree_u, self.degree_v)

    def transposed(self) -> "Patch":
        """The same surface with u and v exchanged; normals turn round."""
        points, weights = self.points.transpose(1, 0, 2), self.weights.T
        return Patch(points, weights, self.knots_v, self.knots_u, self.degree_v, self.degree_u)


@dataclass(frozen=True, eq=False)
class Patches:
    """S patches, one after the other in flat arrays; `Patches.of` makes them of single ones.

    `points` (N, 3) and `weights` (N,) float64, each patch row by row along u; `counts` (S, 2) int64, control points
    along u and v; `degrees` (S, 2) int64; `knots_u`, `knots_v` float64, all vectors one after the other.
    """

    points: Array
    weights: Array
    counts: Array
    degrees: Array
    knots_u: Array
    knots_v: Array

    @classmethod
    def of(cls, patches: "list[Patch]") -> "Patches":
        """The flat form of single patches."""

        def joined(parts: list[Array], shape: tuple[int, ...]) -> Array:
            return np.concatenate([np.asarray(part, np.float64).reshape(shape) for part in parts] or [np.zeros(0)])

        return cls(
            joined([p.points for p in patches], (-1, 3)).reshape(-1, 3),
            joined([p.weights for p in patches], (-1,)),
            np.array([p.points.shape[:2] for p in patches], np.int64).reshape(-1, 2),
            np.array([(p.degree_u, p.degree_v) for p in patches], np.int64).reshape(-1, 2),
            joined([p.knots_u for p in patches], (-1,)),
            joined([p.knots_v for p in patches], (-1,)),
        )

    def __len__(self) -> int:
        """Number of patches."""
        return len(self.counts)

    def __getitem__(self, index: int) -> Patch:
        """One patch; views of the flat arrays."""
        index = range(len(self))[index]
        (u, v), (degree_u, degree_v) = self.counts[index].tolist(), self.degrees[index].tolist()
        sizes = [np.prod(self.counts, axis=1), *(self.counts + self.degrees + 1).T]
        point, knot_u, knot_v = (slice(int(s[:index].sum()), int(s[: index + 1].sum())) for s in sizes)
        points, weights = self.points[point].reshape(u, v, 3), self.weights[point].reshape(u, v)
        return Patch(points, weights, self.knots_u[knot_u], self.knots_v[knot_v], degree_u, degree_v)


@dataclass(frozen=True, eq=False)
class ClosestOnPatch:
    """Closest points of Q queries: parameters `uv` (Q, 2), `points` (Q, 3), `distance` (Q,), all float64."""

    uv: Array
    points: Array
    distance: Array


def patch(
    points: Any,
    *,
    degree_u: int = 3,
    degree_v: int = 3,
    weights: Any = None,
    knots_u: Any = None,
    knots_v: Any = None,
) -> Patch:
    """A checked patch. Without `weights` they are 1; without knots they are clamped and uniform over 0 to 1.

    >>> square = patch([[[0, 0, 0], [0, 1, 0]], [[1, 0, 0], [1, 1, 0]]], degree_u=1, degree_v=1)
    >>> evaluate(square, uv=[[0.25, 0.5]]).tolist()
    [[0.25, 0.5, 0.0]]
    """
    net = checked(points, name="points", dtype=np.float64, shape=(None, None, 3))
    made = Patch(
        net,
        np.ones(net.shape[:2]) if weights is None else weights,
        uniform_knots(len(net), degree=degree_u) if knots_u is None else knots_u,
        uniform_knots(net.shape[1], degree=degree_v) if knots_v is None else knots_v,
        degree_u,
        degree_v,
    )
    made = _checked_patch(made)
    answer(_core.nurbs_check_surfaces, Patches.of([made]))
    return made


def check(patches: Patch | Patches) -> None:
    """Raises `InputError` where the arrays make no patches, with the first patch and what is wrong with it."""
    answer(_core.nurbs_check_surfaces, patches)


def evaluate_grid(patches: Patch | Patches, *, u: Any, v: Any) -> Array:
    """(S, m, n, 3) float64: points of every patch at all pairs of fractions (0 to 1) `u` (m,) and `v` (n,)."""
    fractions_u, fractions_v = _fractions(u, "u"), _fractions(v, "v")
    found = answer(_core.nurbs_grids, patches, fractions_u, fractions_v)
    return found.reshape(-1, len(fractions_u), len(fractions_v), 3)


def evaluate(patches: Patch | Patches, *, uv: Any, index: Any = None) -> Array:
    """(Q, 3) float64: the points at parameters `uv` (Q, 2) of patches `index` (Q,), by default the first."""
    return answer(_core.nurbs_points, patches, *_queries(uv, index))


def derivatives(patches: Patch | Patches, *, uv: Any, index: Any = None) -> Array:
    """(Q, 6, 3) float64: the point and its derivatives along u, v, uu, uv, vv, where `evaluate` gives the point.

    At a knot they are those of the span after it; at the end of the domain, of the span before.
    """
    return answer(_core.nurbs_derivatives, patches, *_queries(uv, index)).reshape(-1, 6, 3)


def normals(patches: Patch | Patches, *, uv: Any, index: Any = None) -> Array:
    """(Q, 3) float64: unit normals, along du x dv, where `evaluate` gives the point.

    Where a row or column of control points has collapsed to one point, the limit from inside; zero only where the patch
    has no area.
    """
    return answer(_core.nurbs_normals, patches, *_queries(uv, index))


def refine(patch: Patch, *, knots_u: Any = (), knots_v: Any = ()) -> Patch:
    """The same surface with more knots inside its domain along u and v; all are inserted at once.

    Points move by rounding alone (1e-15 of their size). Raises `InputError` where a knot would occur more often than
    the degree. Source: the Oslo algorithm, Cohen, Lyche, Riesenfeld 1980.

    >>> square = patch([[[0, 0, 0], [0, 1, 0]], [[1, 0, 0], [1, 1, 0]]], degree_u=1, degree_v=1)
    >>> refine(square, knots_u=[0.25, 0.75]).points.shape
    (4, 2, 3)
    """
    more = [checked(knots, name=name, dtype=np.float64, shape=(None,)) for knots, name in _named(knots_u, knots_v)]
    return _patch(answer(_core.nurbs_surface_refined, patch, *more), patch)


def closest_points(patch: Patch, *, queries: Any) -> "ClosestOnPatch":
    """The closest point of the patch for every query (Q, 3); where several are equally close, any one of them.

    Newton's method on cells of the spans, nearest cell first. **Limit:** a cell, one of 2 degree_u x 2 degree_v in a
    span, is searched from one start, so of two valleys of the distance in one cell the higher may be found.
    """
    points = checked(queries, name="queries", dtype=np.float64, shape=(None, 3))
    return ClosestOnPatch(*answer(_core.nurbs_surface_closest, patch, points))


def fit(
    points: Any,
    *,
    uv: Any,
    counts: tuple[int, int],
    degrees: tuple[int, int] = (3, 3),
    knots_u: Any = None,
    knots_v: Any = None,
    fix_corners: bool = False,
    smoothness: float = 0.0,
) -> Patch:
    """The patch with `counts` control points, of weights 1, that is nearest to `points` (Q, 3) in least squares.

    Point i belongs to parameters `uv[i]` (`grid_parameters` makes them for a grid of points). Without knots the spans
    along u and along v get about as many points each. `fix_corners` puts the four corners on the points nearest to them
    in parameters (the knots must then be clamped). `smoothness` weighs the squares of the second differences of the
    control points, as if there were as many of them as points; it also settles control points that no point is near,
    which otherwise raise `InputError`.
    """
    given = checked(points, name="points", dtype=np.float64, shape=(None, 3))
    at = checked(uv, name="uv", dtype=np.float64, shape=(len(given), 2))
    vectors = []
    for side, (knots, name) in enumerate(_named(knots_u, knots_v)):
        vector = knots_for(at[:, side], count=counts[side], degree=degrees[side]) if knots is None else knots
        vectors.append((_checked_knots(vector, name, counts[side], degrees[side]), degrees[side]))
    if not 0 <= smoothness < np.inf:
        raise InputError(f"smoothness is {smoothness}; a number not below 0 was expected.")
    try:
        fitted = _core.nurbs_fit_surface(*vectors, at, given, float(smoothness), bool(fix_corners))
    except ValueError as error:
        raise InputError(f"The patch cannot be fitted: {error}.") from error
    points, weights, (knots_u, knots_v) = fitted
    return Patch(points.reshape(*counts, 3), weights.reshape(counts), knots_u, knots_v, *degrees)


def grid_parameters(points: Any) -> Array:
    """(m, n, 2) float64: parameters, 0 to 1, of a grid of points (m, n, 3): chord lengths, averaged over its lines."""
    grid = checked(points, name="points", dtype=np.float64, shape=(None, None, 3))
    u = np.mean([_core.nurbs_chord_parameters(np.ascontiguousarray(line)) for line in grid.swapaxes(0, 1)], axis=0)
    v = np.mean([_core.nurbs_chord_parameters(line) for line in grid], axis=0)
    return np.stack(np.meshgrid(u, v, indexing="ij"), axis=-1)


def clamp(patch: Patch) -> Patch:
    """The same surface with clamped knots, so that its corners are its outermost control points."""
    return _patch(answer(_core.nurbs_surface_clamped, patch), patch)


def _patch(arrays: Any, old: Patch) -> Patch:
    points, weights, (knots_u, knots_v) = arrays
    counts = (len(knots_u) - old.degree_u - 1, len(knots_v) - old.degree_v - 1)
    return Patch(points.reshape(*counts, 3), weights.reshape(counts), knots_u, knots_v, old.degree_u, old.degree_v)


def answer(function: Any, patches: Patch | Patches, *rest: Any) -> Any:
    """What the core's `function` says about the patches; its refusals as `InputError`."""
    many = Patches.of([_checked_patch(patches)]) if isinstance(patches, Patch) else patches
    arrays = (
        checked(many.points, name="points", dtype=np.float64, shape=(None, 3)),
        checked(many.weights, name="weights", dtype=np.float64, shape=(None,)),
        checked(many.counts, name="counts", dtype=np.int64, shape=(None, 2)),
        checked(many.degrees, name="degrees", dtype=np.int64, shape=(len(many.counts), 2)),
        *(
            checked(knots, name=name, dtype=np.float64, shape=(None,))
            for knots, name in _named(many.knots_u, many.knots_v)
        ),
    )
    try:
        return function(arrays, *rest)
    except ValueError as error:
        raise InputError(f"The patches cannot be used: {error}.") from error


def _checked_patch(patch: Patch) -> Patch:
    """The patch with contiguous arrays whose shapes belong together; values are left to the core."""
    points = checked(patch.points, name="points", dtype=np.float64, shape=(None, None, 3))
    weights = checked(patch.weights, name="weights", dtype=np.float64, shape=points.shape[:2])
    rows, columns = points.shape[:2]
    knots_u = _checked_knots(patch.knots_u, "knots_u", rows, patch.degree_u)
    knots_v = _checked_knots(patch.knots_v, "knots_v", columns, patch.degree_v)
    return Patch(points, weights, knots_u, knots_v, patch.degree_u, patch.degree_v)


def _checked_knots(knots: Any, name: str, count: int, degree: int) -> Array:
    vector = checked(knots, name=name, dtype=np.float64, shape=(None,))
    if len(vector) != count + checked_degree(degree) + 1:
        expected = f"{count + degree + 1} for {count} control points of degree {degree}"
        raise InputError(f"{name} has {len(vector)} knots; {expected} were expected.")
    return vector


def _queries(uv: Any, index: Any) -> tuple[Array, Array]:
    pairs = checked(uv, name="uv", dtype=np.float64, shape=(None, 2))
    chosen = np.zeros(len(pairs), np.int64) if index is None else index
    return checked(chosen, name="index", dtype=np.int64, shape=(len(pairs),)), pairs


def _fractions(value: Any, name: str) -> Array:
    given = checked(value, name=name, dtype=np.float64, shape=(None,))
    if given.size and not (given.min() >= 0 and given.max() <= 1):
        raise InputError(f"{name} runs from {given.min()} to {given.max()}; fractions from 0 to 1 were expected.")
    return given


def _named(knots_u: Any, knots_v: Any) -> tuple[tuple[Any, str], tuple[Any, str]]:
    return (knots_u, "knots_u"), (knots_v, "knots_v")
