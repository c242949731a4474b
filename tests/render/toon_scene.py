"""Balls and strips with closed forms, and what toon shading makes of them."""

import numpy as np

from tress.model.evaluate import Scene
from tress.model.mesh import Mesh
from tress.model.strip_grid import grid_triangles
from tress.render.flat_scene import flat_scene
from tress.render.gbuffer import rasterise
from tress.render.outline import OutlineParams
from tress.render.picture import premultiplied_rgba
from tress.render.ring import RingParams
from tress.render.styles.toon import ToonStyle

WHITE = (1.0, 1.0, 1.0)
NO_RING, NO_LINES = RingParams(by="none"), OutlineParams(width_px=0)
ROWS, COLUMNS = 41, 9


def ball(*, radius=0.1, centre=(0, 0, 0), rings=96, color=WHITE):
    """A ball of a grid of latitude and longitude."""
    down, round_ = np.meshgrid(
        np.linspace(0, np.pi, rings + 1), np.linspace(0, 2 * np.pi, 2 * rings + 1), indexing="ij"
    )
    place = np.stack([np.sin(down) * np.sin(round_), np.cos(down), np.sin(down) * np.cos(round_)], axis=-1)
    welded = np.arange(place[..., 0].size).reshape(down.shape)
    welded[:, -1], welded[0], welded[-1] = welded[:, 0], welded[0, 0], welded[-1, 0]
    triangles = welded.ravel()[grid_triangles(*down.shape)]
    kept = (np.diff(np.sort(triangles, axis=1), axis=1) > 0).all(axis=1)
    positions = radius * place.reshape(-1, 3) + centre
    shown = np.broadcast_to(np.float32(color), positions.shape)
    return Mesh(positions=positions, triangles=triangles[kept], vertex_attributes={"color": shown})


def strips(*places, color=WHITE):
    """Strips of grids of points (R, C, 3), root first, as one mesh."""
    positions, triangles, fraction, strip = [], [], [], []
    for number, place in enumerate(places):
        t, s = np.meshgrid(*(np.linspace(0, 1, count) for count in place.shape[:2]), indexing="ij")
        triangles.append(grid_triangles(*place.shape[:2]) + sum(len(one) for one in positions))
        positions.append(place.reshape(-1, 3))
        fraction.append(np.stack([t.ravel(), s.ravel()], axis=1))
        strip.append(np.full(t.size, number, np.int32))
    positions = np.concatenate(positions)
    return Mesh(
        positions=positions,
        triangles=np.concatenate(triangles),
        vertex_attributes={
            "fraction": np.concatenate(fraction).astype(np.float32),
            "strip": np.concatenate(strip),
            "color": np.broadcast_to(np.float32(color), positions.shape),
        },
    )


def flat(*, left=-0.05, right=0.05, top=0.08, bottom=-0.08, z=0.0):
    """Points (ROWS, COLUMNS, 3) of a rectangle that faces the camera, its root at the top."""
    y, x = np.meshgrid(np.linspace(top, bottom, ROWS), np.linspace(left, right, COLUMNS), indexing="ij")
    return np.stack([x, y, np.full_like(x, z)], axis=-1)


def seen(*meshes, size=128):
    """A GBuffer of what lies within 16 cm about the origin, from ahead."""
    scale = size / 0.32
    camera = np.array([[scale, 0, 0, size / 2], [0, -scale, 0, size / 2], [0, 0, 0, 1]])
    scene = flat_scene(Scene(meshes={f"m{i}": mesh for i, mesh in enumerate(meshes)}))
    return rasterise(scene, xy_from_world=camera, width=size, height=size)


def toon(*meshes, size=128, ring=NO_RING, lines=NO_LINES, **settings):
    """The picture (H, W, 4), premultiplied."""
    return premultiplied_rgba(seen(*meshes, size=size), style=ToonStyle(ring=ring, lines=lines, **settings))
