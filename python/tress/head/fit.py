"""Fits the statistical head to landmarks: scaled orthography in turn with regularised least squares for the shape.

How it works: the pose is refined by Gauss-Newton with the shape held; then, with the pose held, shape and expression
are linear in the landmarks and solved with a Gaussian prior on both. A handful of rounds converges. Points of the
face's outline on the far side follow the silhouette, not the skin: they count nothing once the head is turned. The
network's depth counts a little, after a linear correction found on rendered heads; it halves the error of the yaw.

The cranium carries no landmarks. It is prior, but must not stick out of the person mask: vertices of its silhouette
that do are pulled inwards, less a margin for the hair that lies on it, and the shape is solved once more.

Why not perspective: a portrait is taken from well over a metre, where the error is under the landmarks' noise. Limits:
landmark noise hides most of the identity; expect 1 to 3 % of the eye distance at the landmarks, 2° of yaw, and some 5
mm at the cranium. Past about 60° of yaw the landmarks themselves are guesses.
"""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tress.base.params import Params, param
from tress.head.cranium import inward_pull, reshaped_cranium
from tress.head.landmarks import FACE_OVAL, FaceLandmarks
from tress.head.pose import refined_pose, similarity_pose
from tress.head.statistical import StatisticalHead, load_statistical_head


@dataclass(frozen=True)
class FitParams(Params):
    """How the head is fitted."""

    rounds: int = param(6, low=1, high=50, doc="Rounds of pose and shape in turn.")
    noise: float = param(0.005, low=1e-4, high=0.1, unit="m", doc="Trust in the landmarks: their error on the head.")
    expression_spread: float = param(0.35, low=0.01, high=2.0, doc="Standard deviation of each expression.")
    depth_weight: float = param(0.2, low=0.0, high=1.0, doc="How much the landmarks' own depth counts.")
    far_yaw: float = param(0.14, low=0.0, high=1.6, unit="rad", doc="Turn from which the far outline counts nothing.")
    mask_margin: float = param(0.004, low=0.0, high=0.05, unit="m", doc="Distance kept from the person mask's edge.")
    mask_rounds: int = param(3, low=0, high=20, doc="Rounds that pull the cranium into the person mask.")
    cranium_scale: float = param(1.0, low=0.7, high=1.4, doc="Size of the cranium over what was fitted.")
    cranium_tilt: float = param(0.0, low=-0.6, high=0.6, unit="rad", doc="Nod of the cranium against the face.")


@dataclass(frozen=True)
class FittedHead:
    """A head in the view frame: metres, x right, y up, z towards the camera, origin the head's centre.

    `positions_in_view` (V, 3) float64; `triangles` (F, 3) int32; `corner_uv` (F, 3, 2) float32; `masks` by name (V,)
    float32 in [0, 1]: scalp, face, ears, lips, eyes, neck, inside. `xy_from_view` (3, 4) float64 with last row 0 0 0
    1: u = s x + cx, v = -s y + cy, px. `view_from_head` (4, 4) float64: the rotation from the upright head frame.
    `shape` (K,) and `expression` (E,) float64: coefficients. `landmarks`: what it was fitted to;
    `error_of_eye_distance`: their mean distance from the fitted head over the eyes' distance; `inter_ocular_px`: that
    distance as seen from the front. `yaw`, `pitch`, `roll`: radians, to the person's left, down, towards the person's
    left shoulder.
    """

    positions_in_view: NDArray[np.float64]
    triangles: NDArray[np.int32]
    corner_uv: NDArray[np.float32]
    masks: Mapping[str, NDArray[np.float32]]
    xy_from_view: NDArray[np.float64]
    view_from_head: NDArray[np.float64]
    shape: NDArray[np.float64]
    expression: NDArray[np.float64]
    landmarks: FaceLandmarks
    error_of_eye_distance: float
    inter_ocular_px: float
    yaw: float
    pitch: float
    roll: float

    @property
    def px_per_metre(self) -> float:
        """The scale of the picture at the head."""
        return float(self.xy_from_view[0, 0])

    @property
    def positions_in_head(self) -> NDArray[np.float64]:
        """Vertices (V, 3) in the upright head frame, metres."""
        return self.positions_in_view @ self.view_from_head[:3, :3]

    def project(self, points: NDArray[np.floating]) -> NDArray[np.float64]:
        """Points (..., 3) of the view frame as x, y (..., 2), px."""
        return points @ self.xy_from_view[:2, :3].T + self.xy_from_view[:2, 3]


def fit_head(
    landmarks: FaceLandmarks,
    *,
    person_mask: NDArray[np.floating] | None = None,
    params: FitParams | None = None,
    head: StatisticalHead | None = None,
) -> FittedHead:
    """The head behind `landmarks`; about 50 ms, deterministic.

    `person_mask` (H, W): probability of a person at each pixel of the picture; without it the cranium is prior alone.
    Source of the scheme: Blanz et al. 2004, A statistical method for robust 3D surface reconstruction from sparse data.
    """
    params = params or FitParams()
    head = head or load_statistical_head()
    solver = _ShapeSolver(head, landmarks, params)
    solver.run()
    if person_mask is not None:
        solver.keep_inside(np.asarray(person_mask))
    return solver.fitted()


class _ShapeSolver:
    """What one fit carries along: the bases at the landmarks, the pose, the coefficients, and pulls on the cranium."""

    def __init__(self, head: StatisticalHead, landmarks: FaceLandmarks, params: FitParams) -> None:
        self._head, self._landmarks, self._params = head, landmarks, params
        components = [head.shape_components, head.expression_components]
        self._basis = np.concatenate([head.at_landmarks(part) for part in components])
        self._rest = head.at_landmarks(head.mean)
        self._shape_count = len(head.shape_components)
        spread = np.full(len(self._basis), params.expression_spread)
        spread[: self._shape_count] = 1.0
        self._prior = spread**-2
        self._coefficients = np.zeros(len(self._basis))
        self._target = corrected_target(landmarks, head.landmark_depth)
        self._depth_weight = params.depth_weight if np.ptp(landmarks.points[:, 2]) > 0 else 0.0
        self._weight = landmarks.weights.astype(np.float64)
        self._pose = similarity_pose(self._rest, self._target, weight=self._weight)
        self._pulls = (np.zeros((0, len(self._basis))), np.zeros(0))

    def run(self) -> None:
        """Rounds of pose and shape in turn."""
        for _ in range(self._params.rounds):
            points = self._rest + np.tensordot(self._coefficients, self._basis, axes=1)
            weight = self._weight * near_side(self._pose.yaw, self._params.far_yaw)
            self._pose = refined_pose(self._pose, points, self._target, weight=weight, depth_weight=self._depth_weight)
            self._coefficients = self._solve(weight)

    def keep_inside(self, mask: NDArray) -> None:
        """Pulls the cranium into the mask and solves again, a few times."""
        for _ in range(self._params.mask_rounds):
            vertices, rows, distance = inward_pull(
                self._positions(), self._pose, mask, head=self._head, margin=self._params.mask_margin
            )
            if len(vertices) == 0:
                return
            basis = np.concatenate(
                [self._head.shape_components[:, vertices], np.zeros_like(self._head.expression_components[:, vertices])]
            )
            along = np.einsum("knc,nc->nk", basis, rows)
            trust = 1 / (0.004 * np.sqrt(max(len(vertices) / 40, 1.0)))
            self._pulls = (along * trust, (distance + along @ self._coefficients) * trust)
            self.run()

    def fitted(self) -> FittedHead:
        """The record, in the view frame."""
        upright = self._positions()
        upright = upright - self._head.center(upright)
        shift = self._head.center(self._positions())
        params = self._params
        upright = reshaped_cranium(upright, head=self._head, scale=params.cranium_scale, tilt=params.cranium_tilt)
        pose = self._pose
        center = pose.seen(shift[None])[0]
        camera = np.array([[pose.scale, 0, 0, center[0]], [0, -pose.scale, 0, center[1]], [0, 0, 0, 1.0]])
        view_from_head = np.eye(4)
        view_from_head[:3, :3] = pose.rotation
        eyes = self._head.eyes(upright)
        eye_distance_px = float(np.linalg.norm(eyes[0] - eyes[1])) * pose.scale
        return FittedHead(
            positions_in_view=upright @ pose.rotation.T,
            triangles=self._head.triangles,
            corner_uv=self._head.corner_uv,
            masks=self._head.masks,
            xy_from_view=camera,
            view_from_head=view_from_head,
            shape=self._coefficients[: self._shape_count],
            expression=self._coefficients[self._shape_count :],
            landmarks=self._landmarks,
            error_of_eye_distance=self._error_px() / eye_distance_px,
            inter_ocular_px=eye_distance_px,
            yaw=pose.yaw,
            pitch=pose.pitch,
            roll=pose.roll,
        )

    def _solve(self, weight: NDArray[np.float64]) -> NDArray[np.float64]:
        """Coefficients of the least squares in metres, with the pose held."""
        pose, params = self._pose, self._params
        root = np.sqrt(weight)[:, None] * np.array([1, 1, np.sqrt(self._depth_weight)]) / params.noise
        axes = np.array([1.0, -1.0, 1.0])
        residual = (self._target - pose.seen(self._rest)) / pose.scale * axes * root
        rows = (self._basis @ pose.rotation.T * root).reshape(len(self._basis), -1).T
        effective = np.sqrt(INDEPENDENT_POINTS / max(float(weight.sum()), INDEPENDENT_POINTS))
        rows = np.concatenate([rows * effective, self._pulls[0]])
        values = np.concatenate([residual.ravel() * effective, self._pulls[1]])
        normal = rows.T @ rows + np.diag(self._prior)
        return np.asarray(np.linalg.solve(normal, rows.T @ values), np.float64)

    def _positions(self) -> NDArray[np.float64]:
        shape, expression = np.split(self._coefficients, [self._shape_count])
        return self._head.positions(shape=shape, expression=expression)

    def _error_px(self) -> float:
        points = self._rest + np.tensordot(self._coefficients, self._basis, axes=1)
        weight = self._weight * near_side(self._pose.yaw, self._params.far_yaw)
        distance = np.linalg.norm((self._target - self._pose.seen(points))[:, :2], axis=1)
        return float(weight @ distance / weight.sum())


INDEPENDENT_POINTS = 200.0
"""The landmarks' errors go together: 468 of them tell no more than about so many would on their own."""


def corrected_target(landmarks: FaceLandmarks, depth_law: NDArray[np.float64]) -> NDArray[np.float64]:
    """u, v and depth (468, 3) px: the network's depth after the linear correction found on rendered heads."""
    target = landmarks.points.astype(np.float64)
    gain, slope = depth_law
    right, left = landmarks.eyes
    down = np.array([-(left - right)[1], (left - right)[0]]) / max(np.linalg.norm(left - right), 1e-9)
    target[:, 2] = gain * target[:, 2] - slope * (target[:, :2] @ down)
    return target


def near_side(yaw: float, far_yaw: float) -> NDArray[np.float64]:
    """Weights (468,): 0 for the points of the outline on the far side of a head turned by more than `far_yaw`, else
    1.
    """
    weight = np.ones(468)
    if abs(yaw) > far_yaw:
        half = len(FACE_OVAL) // 2
        weight[list(FACE_OVAL[1:half] if yaw > 0 else FACE_OVAL[half + 1 :])] = 0
    return weight
