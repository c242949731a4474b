"""Grass and leaves with the calls that make hair: `python examples/meadow.py OUT.png`."""

import sys
from typing import Any

import cv2
import numpy as np

from tress.edit.add import add
from tress.edit.attach import attach
from tress.edit.comb import comb
from tress.edit.delete import delete
from tress.edit.variation import HALF_TURN, Variation
from tress.methods.strips.edited import edited
from tress.methods.strips.patterns import lock
from tress.model.document import Document
from tress.model.evaluate import Scene
from tress.model.group import Group
from tress.model.mesh import Mesh
from tress.model.strip import Strip
from tress.model.strip_grid import grid_triangles
from tress.model.strip_mesh import strips_mesh
from tress.model.strips import strip_names
from tress.render.flat_scene import flat_scene
from tress.render.gbuffer import rasterise
from tress.render.picture import premultiplied_rgba, srgb_rgb
from tress.render.styles.photo import PhotoStyle

Array = np.ndarray[Any, Any]

SIDE, EXTENT_M = 24, 1.2
SOIL, GRASS, LEAF = (0.03, 0.05, 0.012), (0.06, 0.17, 0.02), (0.16, 0.24, 0.03)
SKY = np.array([0.45, 0.62, 0.85], np.float32)
WIDTH, HEIGHT, PX_PER_METRE, SLOPE_RAD = 900, 560, 840.0, 0.42


def terrain() -> Mesh:
    """A hilly square of 1.2 m."""
    x, z = (axis.ravel() for axis in np.meshgrid(*[np.linspace(-0.5, 0.5, SIDE) * EXTENT_M] * 2))
    y = 0.05 * np.sin(5 * x) * np.cos(4 * z) + 0.02 * np.sin(11 * z + 2 * x)
    return Mesh(positions=np.stack([x, y, z], axis=1), triangles=grid_triangles(SIDE, SIDE))


def wind(points: Array) -> Array:
    """Up, and in gusts to the right."""
    gust = 0.55 + 0.45 * np.sin(9 * points[:, 0] + 4 * points[:, 2])
    return np.stack([gust, np.ones(len(points)), 0.2 * gust], axis=1)


def meadow(seed: int = 0) -> Document:
    """Blades of grass combed by the wind, and broad leaves low among them."""
    document = Document({"ground": terrain()})
    triangles = np.random.default_rng(seed).integers(0, 2 * (SIDE - 1) ** 2, 4600)
    blade = lock(length_m=0.14, width_m=0.006, root_width=1.0, tip_width=0.05, rows=5)
    leaf = lock(length_m=0.05, width_m=0.026, root_width=0.2, tip_width=0.1, bow=0.4, rows=6)
    for into, pattern, chosen, tilt in (
        ("grass", blade, triangles[:4000], 1.45),
        ("leaves", leaf, triangles[4000:], 0.6),
    ):
        document = edited(document, add, records={"pattern": pattern, into: Group()})
        document = edited(
            document,
            attach,
            names=["pattern"],
            surface="ground",
            triangles=chosen,
            into=into,
            flow=(1, 0, 0),
            variation=Variation(
                location_m=0.03,
                turn_low=-HALF_TURN,
                turn_high=HALF_TURN,
                tilt_low=tilt - 0.3,
                tilt_high=tilt,
                curl_low=-0.6,
                curl_high=0.0,
                length_low=0.5,
                length_high=1.3,
            ),
            seed=seed,
        )
        document = edited(document, delete, names=["pattern"])
    return edited(document, comb, names=["grass"], surface="ground", flow=wind, lift_m=0.01, bend_m=0.15)


def colored(document: Document, group: str, base: tuple[float, ...], seed: int) -> Mesh:
    """The strips of a group, each in a tone of its own, dark at the root."""
    mesh = strips_mesh(document, names=strip_names(document, [group]))
    tone = np.random.default_rng(seed).uniform(0.6, 1.4, len(document.of_type(Strip)))[mesh.vertex_attributes["strip"]]
    shade = tone * (0.35 + 0.8 * mesh.vertex_attributes["fraction"][:, 0])
    color = (np.asarray(base) * shade[:, None]).astype(np.float32)
    return Mesh(positions=mesh.positions, triangles=mesh.triangles, vertex_attributes={"color": color})


def picture(document: Document) -> Array:
    """(HEIGHT, WIDTH, 3) uint8 from a little above."""
    ground = document.records["ground"]
    assert isinstance(ground, Mesh)
    soil = np.tile(np.array(SOIL, np.float32), (len(ground.positions), 1))
    meshes = {
        "ground": Mesh(positions=ground.positions, triangles=ground.triangles, vertex_attributes={"color": soil}),
        "grass": colored(document, "grass", GRASS, 1),
        "leaves": colored(document, "leaves", LEAF, 2),
    }
    cos, sin, scale = np.cos(SLOPE_RAD), np.sin(SLOPE_RAD), PX_PER_METRE
    camera = np.array([[scale, 0, 0, WIDTH / 2], [0, -scale * cos, scale * sin, 0.74 * HEIGHT], [0, 0, 0, 1]])
    seen = rasterise(flat_scene(Scene(meshes=meshes)), xy_from_world=camera, width=WIDTH, height=HEIGHT)
    return srgb_rgb(premultiplied_rgba(seen, style=PhotoStyle()), background=SKY)


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit("usage: python examples/meadow.py OUT.png")
    cv2.imwrite(sys.argv[1], picture(meadow())[..., ::-1])
