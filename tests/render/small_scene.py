"""Small scenes for the tests of the render room."""

import numpy as np

from tress.model.evaluate import Scene
from tress.model.mesh import Mesh
from tress.model.strands import Strands
from tress.render.flat_scene import flat_scene
from tress.render.gbuffer import rasterise

CAMERA = np.array([[400.0, 0, 0, 40], [0, -400.0, 0, 30], [0, 0, 0, 1]])
"""80 x 60 px, 400 px a metre, the world's origin in the middle."""
SIZE = {"width": 80, "height": 60}


def fringe(*, count=400, seed=0, radius=1.5e-3, alpha=1.0, points=12, depth=0.0):
    """Strands that hang over the whole picture, in random colours."""
    rng = np.random.default_rng(seed)
    wave = np.sin(np.linspace(0, 6, points) + rng.uniform(0, 6, (count, 1)))
    x = np.linspace(-0.12, 0.12, count)[:, None] + 0.004 * wave
    y = np.broadcast_to(np.linspace(0.08, -0.08, points), x.shape)
    z = np.broadcast_to(rng.uniform(0, 0.01, (count, 1)) + depth, x.shape)
    number = count * points
    return Strands(
        points=np.stack([x, y, z], axis=-1).reshape(-1, 3).astype(np.float32),
        offsets=np.arange(0, number + 1, points),
        point_attributes={
            "color": rng.uniform(0, 1, (number, 3)).astype(np.float32),
            "radius": np.full(number, radius, np.float32),
            "alpha": np.full(number, alpha, np.float32),
        },
    )


def wall(*, z=0.0, half=1.0, **more):
    """A square across the whole picture, facing +Z."""
    corners = [[-half, -half, z], [half, -half, z], [half, half, z], [-half, half, z]]
    return Mesh(positions=np.array(corners, np.float32), triangles=np.array([[0, 1, 2], [0, 2, 3]]), **more)


def drawn(strands=(), meshes=(), camera=CAMERA, **more):
    """GBuffer of records."""
    scene = Scene(
        strands={f"strands{i}": s for i, s in enumerate(strands)}, meshes={f"mesh{i}": m for i, m in enumerate(meshes)}
    )
    return rasterise(flat_scene(scene), xy_from_world=camera, **SIZE, **more)
