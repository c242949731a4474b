"""A ball with textured strips that fall around it: a hairdo of any number of strips, in two groups."""

import numpy as np
from strip_hair import BALL, RADIUS_M

from tress.base.report import Report
from tress.model.document import Document
from tress.model.group import Group
from tress.model.head import Head
from tress.model.keyframes import Keyframes
from tress.model.strip import Strip
from tress.model.strip_shapes import flat_strip
from tress.render.textures.params import TextureParams
from tress.render.textures.strand_atlas import strand_atlas

UP = np.array([0.0, 1.0, 0.0])
ATLAS = strand_atlas(TextureParams(resolution=256, padding=8, strands=80, thickness=0.03), report=Report())


def ball_hair(count=60, *, moving=False, seed=0):
    """`count` strips of 18 to 26 cm, open at the face; with `moving` a sway of two seconds."""
    random = np.random.default_rng(seed)
    records = {"head": Head(mesh=BALL, shape=[], expression=[]), "crown": Group(), "sides": Group(parent="crown")}
    records["atlas"] = ATLAS
    for number in range(count):
        records[f"s{number:04d}"] = _falling(random, region=number * 5 // count)
    if moving:
        records["sway"] = sway()
    return Document(records)


def sway(**changes):
    """All strips from side to side and a little forth, their tips by 3 cm."""
    grown = np.linspace(0, 1, 8)[:, None] ** 1.5
    phase = np.arange(5) * np.pi / 2
    way = np.stack([0.03 * np.sin(phase), 0 * phase, 0.01 * (np.cos(phase) - 1)], axis=1)
    fields = {"interpolation": "cubic", "frame": "head", "loop": True} | changes
    return Keyframes(target="crown", times=phase / np.pi, values=way[:, None, None] * grown[..., None], **fields)


def _falling(random, region):
    """A strip that follows the ball down from its root and then hangs."""
    azimuth, elevation = random.uniform(0.9, 2 * np.pi - 0.9), random.uniform(0.3, 1.5)
    out = np.array([np.sin(azimuth), 0, np.cos(azimuth)])
    side = np.array([np.cos(azimuth), 0, -np.sin(azimuth)])
    radius, length = RADIUS_M + random.uniform(0.002, 0.012), random.uniform(0.18, 0.26)
    flat = flat_strip(length_m=length, width_m=random.uniform(0.018, 0.03), tip_width_m=0.0)
    along = np.linspace(0, length, 8)
    angle = elevation - np.minimum(along / radius, elevation + 0.15)
    rest = np.maximum(along - (elevation + 0.15) * radius, 0)
    middle = radius * (np.cos(angle)[:, None] * out + np.sin(angle)[:, None] * UP)
    middle += rest[:, None] * (0.15 * out - UP)
    points = middle[:, None] + flat.points[..., 1, None] * side
    group = "crown" if elevation > 1.0 else "sides"
    fields = {"weights": flat.weights, "knots_u": flat.knots_u, "knots_v": flat.knots_v}
    return Strip(points=points, group=group, atlas="atlas", region=region, **fields)
