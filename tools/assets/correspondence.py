"""Where on the head each of the 468 landmarks lies, found by asking the landmark network about rendered heads.

Each picture shows a random head; the network puts its points on it; each point is cast back to the triangle that shows
there, and so to a place on the mean head at rest. Over all pictures the geometric median is taken, left and right are
averaged, and the result is put on the outer skin. Points of the face's outline follow the silhouette instead of the
skin: on the far side of a turned head they slide by centimetres and are left out there.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import distance_transform_edt
from scipy.optimize import linear_sum_assignment

from tools.assets.nearest import nearest_on_mesh
from tools.assets.portraits import FACE_PX, SIZE, Portrait, Subject, portrait
from tools.assets.zbuffer import barycentric
from tress.head.crop import Crop
from tress.head.face_mesh import crop_of_landmarks
from tress.head.landmarks import COUNT, FACE_OVAL
from tress.head.network import LandmarkModel

FAR_YAW_RAD = np.radians(8)
OFF_MESH_PX = 12.0
CROP_OF_FACE = 1.9


@dataclass(frozen=True)
class Correspondence:
    """`triangle` (468,), `barycentric` (468, 3), and `spread_m` (468,): the median distance of single pictures from it.

    `mirror` (468,): each point's counterpart on the other side. `depth` (2,): gain and slope g, h so that the true
    depth towards the camera is nearly g z + h y + constant, of the network's z and of y (up) in the picture.
    """

    triangle: NDArray[np.int64]
    barycentric: NDArray[np.float64]
    spread_m: NDArray[np.float64]
    mirror: NDArray[np.int64]
    depth: NDArray[np.float64]


def correspondence(subject: Subject, heads: NDArray[np.float64], *, model: LandmarkModel, seed: int) -> Correspondence:
    """From one picture of each of `heads` (N, V, 3); about 0.15 s a picture."""
    rng = np.random.default_rng(seed)
    seen = [_cast_back(subject, portrait(subject, head, rng), model) for head in heads]
    places = np.stack([sight.places for sight in seen])
    median = np.stack([geometric_median(places[:, k]) for k in range(COUNT)])
    mirror = mirrored_points(median)
    median = (median + median[mirror] * [-1, 1, 1]) / 2
    outer = subject.triangles[_outer_skin(subject)]
    triangle, weights = nearest_on_mesh(median, subject.rest, outer)
    on_skin = np.einsum("nk,nkd->nd", weights, subject.rest[outer[triangle]])
    spread = np.nanmedian(np.linalg.norm(places - on_skin, axis=2), axis=0)
    return Correspondence(np.flatnonzero(_outer_skin(subject))[triangle], weights, spread, mirror, _depth_law(seen))


def _outer_skin(subject: Subject) -> NDArray[np.bool_]:
    hidden = subject.eyeballs | (subject.masks["inside"] > 0.5)
    return ~hidden[subject.triangles].any(axis=1)


@dataclass(frozen=True)
class _Sight:
    """One picture: `places` (468, 3) on the mean head at rest, metres, NaN for points that do not count; the network's
    `z` and `y` (up), and the true depth `z_true` (468,), all px."""

    places: NDArray[np.float64]
    z: NDArray[np.float64]
    y: NDArray[np.float64]
    z_true: NDArray[np.float64]


def _cast_back(subject: Subject, picture: Portrait, model: LandmarkModel) -> _Sight:
    x, y = picture.points[:, :2].T @ (subject.masks["face"] / subject.masks["face"].sum())
    found = model.landmarks(picture.image, Crop((float(x), float(y)), CROP_OF_FACE * FACE_PX, 0.0))
    found = model.landmarks(picture.image, crop_of_landmarks(found))
    xy = found.points[:, :2].astype(np.float64)
    column, row = np.clip(xy.astype(int), 0, SIZE - 1).T
    distance, (near_row, near_column) = distance_transform_edt(picture.shown.triangle < 0, return_indices=True)
    triangle = picture.shown.triangle[near_row[row, column], near_column[row, column]]
    corners = subject.triangles[triangle]
    weights = np.clip(barycentric(xy, picture.points[corners][..., :2]), 0, 1)
    weights /= weights.sum(axis=1, keepdims=True)
    places = np.einsum("nk,nkd->nd", weights, subject.rest[corners])
    places[distance[row, column] > OFF_MESH_PX] = np.nan
    places[far_outline(picture.yaw)] = np.nan
    if found.score < 0.5:
        places[:] = np.nan
    depth = np.einsum("nk,nk->n", weights, picture.points[corners][..., 2])
    return _Sight(places, found.points[:, 2].astype(np.float64), -xy[:, 1], depth)


def _depth_law(seen: list[_Sight]) -> NDArray[np.float64]:
    """Gain and slope (2,) by least squares over all counting points, every picture with a constant of its own."""
    rows = []
    for sight in seen:
        counts = np.isfinite(sight.places).all(axis=1)
        if counts.any():
            table = np.column_stack([sight.z, sight.y, sight.z_true])[counts]
            rows.append(table - table.mean(axis=0))
    table = np.concatenate(rows)
    return np.linalg.lstsq(table[:, :2], table[:, 2])[0]


def far_outline(yaw: float) -> list[int]:
    """The outline's points on the far side of a head that is turned by `yaw` radians (to its own left positive)."""
    if abs(yaw) < FAR_YAW_RAD:
        return []
    half = len(FACE_OVAL) // 2
    return list(FACE_OVAL[1:half] if yaw > 0 else FACE_OVAL[half + 1 :])


def geometric_median(points: NDArray[np.float64], *, rounds: int = 30) -> NDArray[np.float64]:
    """The point (3,) with the least sum of distances to `points` (N, 3), rows with NaN left out; Weiszfeld's
    iteration.
    """
    known = points[np.isfinite(points).all(axis=1)]
    if len(known) == 0:
        raise ValueError("A landmark was never seen on the rendered heads.")
    median = np.median(known, axis=0)
    for _ in range(rounds):
        weight = 1 / np.linalg.norm(known - median, axis=1).clip(min=1e-6)
        median = weight @ known / weight.sum()
    return median


def mirrored_points(points: NDArray[np.float64]) -> NDArray[np.int64]:
    """For each point (N, 3) the one nearest to its mirror image in x, one to one and there and back again."""
    image = points * [-1, 1, 1]
    cost = np.linalg.norm(image[:, None] - points[None], axis=2)
    _, partner = linear_sum_assignment(cost + cost.T)
    if not np.array_equal(partner[partner], np.arange(len(points))):
        raise ValueError("The landmarks are not symmetric enough to be paired left and right.")
    return partner
