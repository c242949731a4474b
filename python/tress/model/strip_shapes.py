"""Plain strips to begin with."""

import numpy as np

from tress.kernel.curves import uniform_knots
from tress.model.strip import Strip


def flat_strip(
    *,
    length_m: float,
    width_m: float,
    tip_width_m: float | None = None,
    rows: int = 8,
    columns: int = 4,
    degree: int = 3,
) -> Strip:
    """A flat strip with its root at the origin: x along the hair, y across, facing z; evenly spaced control points.

    The width goes evenly from `width_m` to `tip_width_m` (the same where it is None). Degrees are `degree`, or as many
    as rows and columns allow. This is how patterns for `attach` are drawn. Raises `InputError` for fewer than two rows
    or columns.

    >>> flat_strip(length_m=0.2, width_m=0.02).points[-1, -1].tolist()
    [0.2, 0.01, 0.0]
    """
    along = np.linspace(0, length_m, rows)
    width = np.linspace(width_m, width_m if tip_width_m is None else tip_width_m, rows)
    across = np.linspace(-0.5, 0.5, columns)
    points = np.zeros((rows, columns, 3))
    points[..., 0] = along[:, None]
    points[..., 1] = width[:, None] * across
    return Strip(
        points=points,
        weights=np.ones((rows, columns)),
        knots_u=uniform_knots(rows, degree=min(degree, rows - 1)),
        knots_v=uniform_knots(columns, degree=min(degree, columns - 1)),
    )
