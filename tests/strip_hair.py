"""A ball with a few strips on it: a small document with everything that edits of strips need."""

from dataclasses import replace

import numpy as np

from tress.model.atlas import Atlas
from tress.model.attachment import Attachment
from tress.model.document import Document
from tress.model.group import Group
from tress.model.head import Head
from tress.model.keyframes import Keyframes
from tress.model.mesh import Mesh
from tress.model.strip_shapes import flat_strip

RADIUS_M = 0.1
RANDOM = np.random.default_rng(6)


def ball(rings: int = 16, sectors: int = 24) -> Mesh:
    """A closed ball of 10 cm; its upper half is scalp."""
    latitude = np.linspace(0, np.pi, rings + 1)[1:-1]
    longitude = np.arange(sectors) * 2 * np.pi / sectors
    y = np.repeat(np.cos(latitude), sectors)
    x, z = (np.outer(np.sin(latitude), wave).ravel() for wave in (np.cos(longitude), -np.sin(longitude)))
    positions = RADIUS_M * np.vstack([[0, 1, 0], np.stack([x, y, z], axis=1), [0, -1, 0]])
    triangles, last = [], 1 + (rings - 2) * sectors
    for sector in range(sectors):
        right = (sector + 1) % sectors
        triangles.append([0, 1 + sector, 1 + right])
        for ring in range(rings - 2):
            a, b = 1 + ring * sectors + sector, 1 + ring * sectors + right
            triangles += [[a, a + sectors, b + sectors], [a, b + sectors, b]]
        triangles.append([last + sector, len(positions) - 1, last + right])
    scalp = (positions[:, 1] > 0.001).astype(np.float32)
    return Mesh(positions=positions, triangles=triangles, vertex_attributes={"scalp": scalp})


BALL = ball()
SCALP = np.flatnonzero((BALL.vertex_attributes["scalp"][BALL.triangles] > 0).all(axis=1))
MOTION = Keyframes(target="b", times=[0, 1], values=RANDOM.normal(0, 0.01, (2, 8, 4, 3)))
POSE = Keyframes(target="b", times=[0, 1], values=RANDOM.normal(0, 0.01, (2, 8, 4, 3)), kind="position")
WIND = Keyframes(target="tuft", times=[0, 1], values=RANDOM.normal(0, 0.01, (2, 2, 1, 3)), frame="head")


def rooted(triangle, **changes):
    """A slightly crumpled strip on a triangle of the head."""
    strip = flat_strip(length_m=0.12, width_m=0.02)
    bent = strip.points + RANDOM.normal(0, 0.002, strip.points.shape)
    root = Attachment(surface="head", triangle=int(triangle), barycentric=[0.2, 0.3, 0.5], offset=[0, 0, 0.001])
    weights = RANDOM.uniform(0.5, 2, strip.weights.shape)
    return replace(strip, points=bent, weights=weights, root=root, **changes)


BASE = {
    "head": Head(mesh=BALL, shape=[], expression=[]),
    "pattern": flat_strip(length_m=0.1, width_m=0.01),
    "tuft": Group(),
    "a": rooted(SCALP[3], group="tuft"),
    "b": rooted(SCALP[40], group="tuft"),
    "atlas": Atlas(color=np.zeros((2, 2, 4), np.uint8), regions=[[0, 0, 0.5, 1], [0.5, 0, 1, 1]]),
}


def hairdo(**records):
    """A head, a pattern, a group of two strips, an atlas, and more records."""
    return Document(BASE | records)
