"""Random curves and patches with awkward knots, and the same ones in SciPy and openNURBS."""

import numpy as np
import rhino3dm
from scipy.interpolate import BSpline

from tress.kernel.curves import Curve, curve
from tress.kernel.nurbs import Patch, patch


def random_knots(rng, degree, *, clamped):
    """Up to four spans of unequal length; inner knots repeated up to `degree` times, unclamped ends at random."""
    breaks = np.cumsum(rng.uniform(0.2, 1.0, rng.integers(2, 6))) - rng.uniform(0, 2)
    inner = np.repeat(breaks[1:-1], rng.integers(1, degree + 1, len(breaks) - 2))

    def end(value, sign):
        same = degree + 1 if clamped else rng.integers(1, degree + 2)
        beyond = np.cumsum(rng.uniform(0.1, 1.0, degree + 1 - same))
        return np.sort(np.concatenate([np.full(same, value), value + sign * beyond]))

    return np.concatenate([end(breaks[0], -1), inner, end(breaks[-1], 1)])


def random_curve(seed, *, degree=None, clamped=None, rational=True) -> Curve:
    """A curve of random degree, knots, weights from 1/3 to 3, and points in a cube of 2 m."""
    rng = np.random.default_rng(seed)
    degree = int(rng.integers(1, 8)) if degree is None else degree
    knots = random_knots(rng, degree, clamped=bool(rng.integers(2)) if clamped is None else clamped)
    count = len(knots) - degree - 1
    weights = 3.0 ** rng.uniform(-1, 1, count) if rational else None
    return curve(rng.uniform(-1, 1, (count, 3)), degree=degree, weights=weights, knots=knots)


def random_patch(seed, *, degrees=None, clamped=None, rational=True) -> Patch:
    """A patch of random degrees, knots, weights from 1/3 to 3, and points in a cube of 2 m."""
    rng = np.random.default_rng(seed)
    degrees = rng.integers(1, 8, 2).tolist() if degrees is None else degrees
    ends = rng.integers(0, 2, 2).astype(bool) if clamped is None else (clamped, clamped)
    knots = [random_knots(rng, degree, clamped=end) for degree, end in zip(degrees, ends, strict=True)]
    counts = [len(vector) - degree - 1 for vector, degree in zip(knots, degrees, strict=True)]
    weights = 3.0 ** rng.uniform(-1, 1, counts) if rational else None
    return patch(
        rng.uniform(-1, 1, (*counts, 3)),
        degree_u=degrees[0],
        degree_v=degrees[1],
        weights=weights,
        knots_u=knots[0],
        knots_v=knots[1],
    )


def parameters(domain, count, *, seed=0):
    """Both ends of a domain and random parameters between them, (count,)."""
    inner = np.random.default_rng(seed).uniform(*domain, count - 2)
    return np.concatenate([[domain[0]], inner, [domain[1]]])


def random_uv(patch, count, *, seed=0):
    """The four corners of a domain and random pairs inside, (count + 4, 2)."""
    rng = np.random.default_rng(seed)
    corners = [(u, v) for u in patch.domain_u for v in patch.domain_v]
    inside = np.stack([rng.uniform(*patch.domain_u, count), rng.uniform(*patch.domain_v, count)], axis=1)
    return np.concatenate([corners, inside])


def rhino_curve(curve: Curve):
    """The curve in openNURBS: homogeneous points, without the first and the last knot."""
    made = rhino3dm.NurbsCurve(3, True, curve.degree + 1, len(curve.points))
    for i, (point, weight) in enumerate(zip(curve.points, curve.weights, strict=True)):
        made.Points[i] = rhino3dm.Point4d(*point * weight, weight)
    for i, knot in enumerate(curve.knots[1:-1]):
        made.Knots[i] = knot
    return made


def rhino_surface(patch: Patch):
    """The patch in openNURBS: homogeneous points, without the first and the last knots."""
    rows, columns = patch.weights.shape
    made = rhino3dm.NurbsSurface.Create(3, True, patch.degree_u + 1, patch.degree_v + 1, rows, columns)
    for i in range(rows):
        for j in range(columns):
            weight = patch.weights[i, j]
            made.Points[(i, j)] = rhino3dm.Point4d(*patch.points[i, j] * weight, weight)
    for vector, knots in ((made.KnotsU, patch.knots_u), (made.KnotsV, patch.knots_v)):
        for i, knot in enumerate(knots[1:-1]):
            vector[i] = knot
    return made


def scipy_curve(curve: Curve) -> BSpline:
    """The homogeneous curve in SciPy: (w x, w y, w z, w) of a parameter."""
    homogeneous = np.column_stack([curve.points * curve.weights[:, None], curve.weights])
    return BSpline(curve.knots, homogeneous, curve.degree)


def boehm(curve: Curve, knot) -> Curve:
    """One knot inserted by Böhm's algorithm, written from the textbook's ratios; for knots of the inner domain."""
    knots, degree = curve.knots, curve.degree
    old = np.column_stack([curve.points * curve.weights[:, None], curve.weights])
    span = np.searchsorted(knots, knot, side="right") - 1
    new = np.zeros((len(old) + 1, 4))
    for i in range(len(new)):
        if i <= span - degree:
            share = 1.0
        elif i > span:
            share = 0.0
        else:
            share = (knot - knots[i]) / (knots[i + degree] - knots[i])
        new[i] += share * old[min(i, len(old) - 1)] + (1 - share) * old[i - 1 if i else 0]
    return Curve(new[:, :3] / new[:, 3:], new[:, 3], np.insert(knots, span + 1, knot), degree)
