"""Fits the statistical head to landmarks: scaled orthography in turn with regularised least squares for the shape.

How it works: the pose is refined by Gauss-Newton with the shape held; then, with the pose held, shape and expression
are linear in the landmarks and solved with a Gaussian prior on both. A handful of rounds converges. Points of the
face's outline on the far side follow the silhouette, not the skin: they count nothing once the head is turned. The
network's depth counts a little, after a linear correction found on rendered heads; it halves the error of the yaw.

The cranium carries no landmarks. It is prior, but must not stick out of the person mask: vertices of its silhouette
that do are pulled inwards, and by the thickness of the hair that lies on it, and the shape is solved once more.

The perspective of the camera, whose distance is a setting, is taken off the landmarks and put back on the fitted head
(see `perspective`); the solvers know orthography alone.

Limits: landmark noise hides most of the identity; expect 1 to 3 % of the eye distance at the landmarks, 2° of yaw, and
some 4 mm at the cranium. Past about 60° of yaw the landmarks themselves are guesses.
"""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tress.base.params import Params, param
from tress.base.report import Report
from tress.head.cranium import inward_pull, mask_distance, reshaped_cranium
from tress.head.definite import solve_definite
from tress.head.landmark_basis import landmark_basis, near_side, side_products
from tress.head.landmarks import FaceLandmarks
from tress.head.perspective import enlargement, seen_in_perspective, without_perspective
from tress.head.pose import refined_pose, similarity_pose
from tress.head.statistical import StatisticalHead, load_statistical_head

PROFILE_YAW = np.radians(40)
DEEP_PITCH = np.radians(25)
POOR_ERROR = 0.06
"""Of the eyes' distance."""
INDEPENDENT_POINTS = 200.0
"""The landmarks' errors go together: 468 of them tell no more than about so many would on their own."""
INDEPENDENT_PULLS = 40
PULL_NOISE_M = 0.0025
"""How exactly so many independent vertices of the cranium are to follow the person mask."""


@dataclass(frozen=True)
class FitParams(Params):
    """How the head is fitted."""

    rounds: int = param(6, low=1, high=50, doc="Rounds of pose and shape in turn.")
    noise: float = param(0.005, low=1e-4, high=0.1, unit="m", doc="Trust in the landmarks: their error on the head.")
    expression_spread: float = param(0.35, low=0.01, high=2.0, doc="Standard deviation of each expression.")
    depth_weight: float = param(0.2, low=0.0, high=1.0, doc="How much the landmarks' own depth counts.")
    far_yaw: float = param(0.14, low=0.0, high=1.6, unit="rad", doc="Turn from which the far outline counts nothing.")
    camera_distance: float = param(2.0, low=0.3, high=1000.0, unit="m", doc="Distance of the camera from the head.")
    mask_margin: float = param(0.006, low=0.0, high=0.05, unit="m", doc="Hair between skull and person mask's edge.")
    mask_rounds: int = param(4, low=0, high=20, doc="Rounds that pull the cranium into the person mask.")
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
    report: Report | None = None,
) -> FittedHead:
    """The head behind `landmarks`; about 50 ms, deterministic.

    `person_mask` (H, W): probability of a person at each pixel of the picture; without it the cranium is prior alone. A
    near profile, a deep nod and landmarks that fit badly are fitted all the same and reported as warnings.
    Source of the scheme: Blanz et al. 2004, A statistical method for robust 3D surface reconstruction from sparse data.
    """
    params = params or FitParams()
    head = head or load_statistical_head()
    solver = _ShapeSolver(head, landmarks, params)
    solver.run(rounds=params.rounds)
    if person_mask is not None:
        solver.keep_inside(np.asarray(person_mask))
    fitted = solver.fitted()
    if report is not None:
        for warning in doubts(fitted):
            report.warn(warning)
    return fitted


def doubts(fitted: FittedHead) -> list[str]:
    """What a user should know before trusting a fit: one sentence each, none for an ordinary portrait."""
    found = []
    if abs(fitted.yaw) > PROFILE_YAW:
        found.append(f"The head is turned by {abs(np.degrees(fitted.yaw)):.0f}°: its far side is guessed.")
    if abs(fitted.pitch) > DEEP_PITCH:
        way = "down" if fitted.pitch > 0 else "up"
        found.append(f"The head looks {way} by {abs(np.degrees(fitted.pitch)):.0f}°: the cranium is uncertain.")
    if fitted.error_of_eye_distance > POOR_ERROR:
        found.append(f"The head fits its landmarks poorly ({fitted.error_of_eye_distance:.1%} of the eye distance).")
    return found


class _ShapeSolver:
    """What one fit carries along: the basis at the landmarks, the pose, the coefficients, and pulls on the cranium."""

    def __init__(self, head: StatisticalHead, landmarks: FaceLandmarks, params: FitParams) -> None:
        self._head, self._landmarks, self._params = head, landmarks, params
        self._basis = landmark_basis(head)
        count = self._basis.shape_count
        self._prior = np.full(len(self._basis.basis), params.expression_spread**-2)
        self._prior[:count] = 1.0
        self._coefficients = np.zeros(len(self._prior))
        self._given_target = corrected_target(landmarks, head.landmark_depth)
        self._target = self._given_target
        self._distance = params.camera_distance
        self._depth_weight = params.depth_weight if np.ptp(landmarks.points[:, 2]) > 0 else 0.0
        self._given = landmarks.weights.astype(np.float64)
        self._pose = similarity_pose(self._basis.rest, self._target, weight=self._given)
        self._products: dict[int, NDArray[np.float64]] = {}
        self._pull_matrix = np.zeros((len(self._prior), len(self._prior)))
        self._pull_values = np.zeros(len(self._prior))

    def run(self, *, rounds: int) -> None:
        """Rounds of pose and shape in turn."""
        for _ in range(rounds):
            points = self._basis.points(self._coefficients)
            self._target = without_perspective(self._given_target, points, self._pose, distance=self._distance)
            self._pose = refined_pose(
                self._pose, points, self._target, weight=self._weight(), depth_weight=self._depth_weight
            )
            self._coefficients = self._solve()

    def keep_inside(self, mask: NDArray) -> None:
        """Pulls the cranium into the mask and solves again, a few times."""
        edge = mask_distance(mask, px_per_metre=self._pose.scale)
        if edge is None:
            return
        held = np.zeros(len(self._head.mean), bool)
        for _ in range(self._params.mask_rounds):
            positions = self._positions()
            vertices, rows, distance = inward_pull(
                seen_in_perspective(positions, self._pose, distance=self._distance),
                self._pose,
                edge,
                head=self._head,
                margin=self._params.mask_margin,
                held=held,
            )
            if len(vertices) == 0:
                return
            held[vertices] = True
            along = np.zeros((len(self._prior), len(vertices)))
            along[: self._basis.shape_count] = np.einsum("knc,nc->kn", self._head.shape_components[:, vertices], rows)
            trust = 1 / (PULL_NOISE_M * np.sqrt(max(len(vertices) / INDEPENDENT_PULLS, 1.0)))
            reached = np.einsum("kn,k->n", along, self._coefficients)
            self._pull_matrix = np.einsum("kn,ln->kl", along, along) * trust**2
            self._pull_values = np.einsum("kn,n->k", along, distance + reached) * trust**2
            self.run(rounds=2)

    def fitted(self) -> FittedHead:
        """The record, in the view frame."""
        head, pose, params = self._head, self._pose, self._params
        positions = self._as_seen(self._positions())
        center = head.center(positions)
        upright = reshaped_cranium(positions - center, head=head, scale=params.cranium_scale, tilt=params.cranium_tilt)
        cx, cy, _ = pose.seen(center[None])[0]
        view_from_head = np.eye(4)
        view_from_head[:3, :3] = pose.rotation
        right_eye, left_eye = head.eyes(upright)
        eye_distance_px = float(np.linalg.norm(left_eye - right_eye)) * pose.scale
        return FittedHead(
            positions_in_view=upright @ pose.rotation.T,
            triangles=head.triangles,
            corner_uv=head.corner_uv,
            masks=head.masks,
            xy_from_view=np.array([[pose.scale, 0, 0, cx], [0, -pose.scale, 0, cy], [0, 0, 0, 1.0]]),
            view_from_head=view_from_head,
            shape=self._coefficients[: self._basis.shape_count],
            expression=self._coefficients[self._basis.shape_count :],
            landmarks=self._landmarks,
            error_of_eye_distance=self._error_px() / eye_distance_px,
            inter_ocular_px=eye_distance_px,
            yaw=pose.yaw,
            pitch=pose.pitch,
            roll=pose.roll,
        )

    def _side(self) -> int:
        """1 or -1 where the head is turned to its left or right so far that the far outline must not count, else 0."""
        return int(np.sign(self._pose.yaw)) if abs(self._pose.yaw) > self._params.far_yaw else 0

    def _weight(self) -> NDArray[np.float64]:
        return self._given * near_side(self._side())

    def _solve(self) -> NDArray[np.float64]:
        """Coefficients of the least squares in metres, with the pose held."""
        pose, weight = self._pose, self._weight()
        counted = np.array([1.0, 1.0, self._depth_weight])
        axes = np.array([1.0, -1.0, 1.0])
        trust = min(INDEPENDENT_POINTS / float(weight.sum()), 1.0) / self._params.noise**2
        in_head = (self._target - pose.seen(self._basis.rest)) / pose.scale * axes * counted @ pose.rotation
        metric = (pose.rotation.T * counted) @ pose.rotation
        normal = trust * np.einsum("ab,abkl->kl", metric, self._products_now()) + self._pull_matrix
        values = trust * np.einsum("kdn,nd->k", self._basis.basis, in_head * weight[:, None])
        values += self._pull_values
        return solve_definite(normal + np.diag(self._prior), values)

    def _products_now(self) -> NDArray[np.float64]:
        side = self._side()
        if (self._given == 1).all():
            return side_products(self._head, side)
        if side not in self._products:
            self._products[side] = self._basis.products(self._weight())
        return self._products[side]

    def _positions(self) -> NDArray[np.float64]:
        shape, expression = np.split(self._coefficients, [self._basis.shape_count])
        return self._head.positions(shape=shape, expression=expression)

    def _as_seen(self, positions: NDArray[np.float64]) -> NDArray[np.float64]:
        """`positions` (V, 3) enlarged across the camera's axis, so that orthography shows them in perspective."""
        factor = enlargement(positions, self._pose, distance=self._distance)[:, None]
        along = self._pose.rotation[2] * (positions * self._pose.rotation[2]).sum(axis=1)[:, None]
        return along + (positions - along) * factor

    def _error_px(self) -> float:
        weight = self._weight()
        points = self._basis.points(self._coefficients)
        seen = seen_in_perspective(points, self._pose, distance=self._distance)
        distance = np.linalg.norm(self._given_target[:, :2] - seen, axis=1)
        return float(np.sum(weight * distance) / weight.sum())


def corrected_target(landmarks: FaceLandmarks, depth_law: NDArray[np.float64]) -> NDArray[np.float64]:
    """u, v and depth (468, 3) px: the network's depth after the linear correction found on rendered heads."""
    target = landmarks.points.astype(np.float64)
    gain, slope = depth_law
    across = np.subtract(*landmarks.eyes[::-1])
    down = np.array([-across[1], across[0]]) / max(float(np.linalg.norm(across)), 1e-9)
    target[:, 2] = gain * target[:, 2] - slope * (target[:, :2] @ down)
    return target
