"""Scaled orthography of a head: rotation, scale and place, from points whose shape is known."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from tress.head.definite import solve_definite


@dataclass(frozen=True)
class Pose:
    """x_view = rotation @ x_head; u = scale x + cx, v = -scale y + cy, and the seen depth is scale z + cz, all px.

    `rotation` (3, 3): first the nod, then the turn, then the lean. `scale` px per metre, `offset` (3,) = cx, cy, cz px.
    """

    rotation: NDArray[np.float64]
    scale: float
    offset: NDArray[np.float64]

    @property
    def yaw(self) -> float:
        """How far the head is turned to its own left, radians (it then looks to the right of the picture)."""
        return float(-np.arcsin(np.clip(self.rotation[2, 0], -1, 1)))

    @property
    def pitch(self) -> float:
        """How far the head nods down, radians."""
        return float(np.arctan2(self.rotation[2, 1], self.rotation[2, 2]))

    @property
    def roll(self) -> float:
        """How far the head, turned and nodding, leans towards its own left shoulder in the picture, radians."""
        return float(-np.arctan2(self.rotation[1, 0], self.rotation[0, 0]))

    def seen(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Points (N, 3) of the head frame as u, v and depth (N, 3), px."""
        return points @ self.rotation.T * (self.scale * np.array([1.0, -1.0, 1.0])) + self.offset


def similarity_pose(points: NDArray[np.float64], target: NDArray[np.float64], *, weight: NDArray[np.float64]) -> Pose:
    """The pose that brings `points` (N, 3) closest to `target` (N, 3) (u, v, depth, px), in closed form (Umeyama
    1991).
    """
    share = weight / weight.sum()
    flipped = target * [1.0, -1.0, 1.0]
    mean_p, mean_t = share @ points, share @ flipped
    p, t = points - mean_p, flipped - mean_t
    u, spread, vt = np.linalg.svd((t * share[:, None]).T @ p)
    sign = np.array([1.0, 1.0, np.sign(np.linalg.det(u @ vt))])
    rotation = (u * sign) @ vt
    scale = float((spread * sign).sum() / (share @ (p**2).sum(axis=1)))
    offset = (mean_t - scale * rotation @ mean_p) * [1.0, -1.0, 1.0]
    return Pose(rotation, scale, offset)


def refined_pose(
    pose: Pose,
    points: NDArray[np.float64],
    target: NDArray[np.float64],
    *,
    weight: NDArray[np.float64],
    depth_weight: float,
    rounds: int = 3,
) -> Pose:
    """`pose` after Gauss-Newton steps on the weighted squares of u, v and, counted by `depth_weight`, of the depth.

    A whisper of damping keeps the rotation where points in a plane or very few points leave it open, and the depth
    where it counts nothing.
    """
    axes = np.array([1.0, -1.0, 1.0])
    root = np.sqrt(weight)[:, None] * np.array([1.0, 1.0, np.sqrt(depth_weight)])
    for _ in range(rounds):
        turned = points @ pose.rotation.T
        residual = (target - pose.seen(points)) * root
        columns = [np.cross(axis, turned) * pose.scale for axis in np.eye(3)]
        columns += [turned, *(np.broadcast_to(axis, points.shape) * axes for axis in np.eye(3))]
        jacobian = np.stack([column * axes * root for column in columns], axis=-1).reshape(-1, 7)
        normal = np.einsum("ni,nj->ij", jacobian, jacobian)
        normal[np.arange(3), np.arange(3)] += 1e-4 * np.trace(normal[:3, :3]) / 3 + 1e-12
        normal[6, 6] += 1e-9 * normal[5, 5]
        step = solve_definite(normal, np.einsum("ni,n->i", jacobian, residual.ravel()))
        rotation = Rotation.from_rotvec(step[:3]).as_matrix() @ pose.rotation
        pose = Pose(rotation, max(pose.scale + float(step[3]), 1e-6), pose.offset + step[4:])
    return pose
