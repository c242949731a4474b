"""The photograph that the tests of the head share, and heads whose landmarks are known exactly."""

import numpy as np
import skimage.data
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from tress.head.fit import FitParams
from tress.head.landmarks import FaceLandmarks, landmarks_of
from tress.head.pose import Pose
from tress.head.statistical import StatisticalHead


def astronaut() -> NDArray[np.uint8]:
    """512 x 512, one face, its eyes 43 px apart."""
    return skimage.data.astronaut()


def random_pose(rng: np.random.Generator) -> Pose:
    """Within 30° of the camera, 1,000 to 3,000 px a metre."""
    angles = rng.uniform(-1, 1, 3) * np.radians([25, 30, 20])
    rotation = Rotation.from_euler("xyz", angles).as_matrix()
    return Pose(rotation, float(rng.uniform(1000, 3000)), np.array([500.0, 450.0, 0.0]))


def photographed(points: NDArray[np.float64], pose: Pose, *, distance: float) -> NDArray[np.float64]:
    """Pixels (N, 2) of `points` (N, 3) by a pinhole whose axis meets the head's origin `distance` metres before it."""
    x, y, z = (points @ pose.rotation.T).T
    focal_px = pose.scale * distance
    return np.stack([pose.offset[0] + focal_px * x / (distance - z), pose.offset[1] - focal_px * y / (distance - z)], 1)


def exact_landmarks(
    head: StatisticalHead, positions: NDArray[np.float64], pose: Pose, *, distance: float = FitParams().camera_distance
) -> FaceLandmarks:
    """What a perfect network would say of a photo from `distance` metres, its depth law included."""
    points = head.at_landmarks(positions)
    seen = np.column_stack([photographed(points, pose, distance=distance), pose.seen(points)[:, 2]])
    gain, slope = head.landmark_depth
    across = seen[[263, 362], :2].mean(axis=0) - seen[[33, 133], :2].mean(axis=0)
    down = np.array([-across[1], across[0]]) / np.linalg.norm(across)
    seen[:, 2] = (seen[:, 2] + slope * (seen[:, :2] @ down)) / gain
    return landmarks_of(seen)
