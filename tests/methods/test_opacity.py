"""Opacities that are fitted to a matte cover as much as it says; what does not show keeps its own."""

import numpy as np
import pytest

from tress.methods.portrait.opacity import with_fitted_opacity
from tress.model.evaluate import Scene
from tress.model.mesh import Mesh
from tress.model.strands import Strands
from tress.render.flat_scene import FlatScene, flat_scene
from tress.render.gbuffer import hair_coverage

SIDE, PX_PER_METRE = 64, 1000.0
CAMERA = np.array([[PX_PER_METRE, 0, 0, SIDE / 2], [0, -PX_PER_METRE, 0, SIDE / 2], [0, 0, 0, 1]])
MESH_Z = -0.05


@pytest.fixture(scope="module")
def scene() -> FlatScene:
    """Ten curtains of upright strands, half a pixel apart, nine before a mesh on the left half and one behind it."""
    half = SIDE / 2 / PX_PER_METRE
    x = np.linspace(-half, half, 2 * SIDE)
    depth = np.append(np.linspace(0.0, 0.009, 9), 2 * MESH_Z)
    starts = np.array([(column, z) for z in depth for column in x])
    heights = np.linspace(-half, half, SIDE)
    points = np.empty((len(starts), SIDE, 3))
    points[..., 0], points[..., 2] = starts[:, :1], starts[:, 1:]
    points[..., 1] = heights
    count = len(starts) * SIDE
    hair = Strands(
        points=points.reshape(-1, 3),
        offsets=np.arange(0, count + 1, SIDE),
        point_attributes={"radius": np.full(count, 0.5 / PX_PER_METRE, np.float32)},
    )
    corners = [[-half, -half, MESH_Z], [0, -half, MESH_Z], [0, half, MESH_Z], [-half, half, MESH_Z]]
    head = Mesh(positions=corners, triangles=[[0, 1, 2], [0, 2, 3]])
    return flat_scene(Scene(strands={"hair": hair}, meshes={"head": head}))


def fitted(
    scene: FlatScene,
    alpha: np.ndarray,
    *,
    covered: np.ndarray | None = None,
    on_skin: np.ndarray | None = None,
    rounds: int = 2,
):
    return with_fitted_opacity(
        scene,
        matte_alpha=alpha.astype(np.float32),
        covered=np.zeros(alpha.shape, bool) if covered is None else covered,
        on_skin=np.zeros(len(scene.points), bool) if on_skin is None else on_skin,
        xy_from_world=CAMERA,
        strand_bias_m=0.0,
        min_width_px=1.0,
        rounds=rounds,
    )


@pytest.mark.parametrize("level", [0.15, 0.4, 0.7])
def test_coverage_meets_the_matte(scene, level):
    seen = fitted(scene, np.full((SIDE, SIDE), level))
    inner = hair_coverage(seen)[4:-4, 4:-4]
    assert abs(float(inner.mean()) - level) < 0.06


def test_coverage_follows_a_soft_edge(scene):
    alpha = np.clip(np.linspace(-0.3, 1.3, SIDE), 0, 1)[:, None] * np.ones(SIDE)
    coverage = hair_coverage(fitted(scene, alpha, rounds=3))
    assert np.abs(coverage.mean(axis=1) - alpha[:, 0])[4:-4].max() < 0.12


def test_solid_hair_is_solid(scene):
    assert hair_coverage(fitted(scene, np.ones((SIDE, SIDE))))[2:-2, 2:-2].min() > 0.99


def test_hair_behind_the_head_keeps_its_opacity(scene):
    seen = fitted(scene, np.full((SIDE, SIDE), 0.3))
    inside = (np.abs(scene.points[:, :2]) < 0.03).all(axis=1) & (scene.points[:, 0] < -0.002)
    behind = inside & (scene.points[:, 2] < MESH_Z)
    before = (scene.points[:, 2] > MESH_Z) & (np.abs(scene.points[:, 1]) < 0.02)
    assert np.array_equal(seen.scene.alpha[behind], scene.alpha[behind])
    assert seen.scene.alpha[before].max() < 0.5


def test_hair_behind_the_body_keeps_its_opacity(scene):
    covered = np.zeros((SIDE, SIDE), bool)
    covered[: SIDE // 2] = True
    seen = fitted(scene, np.zeros((SIDE, SIDE)), covered=covered)
    upper = scene.points[:, 1] > 0.002
    lower = scene.points[:, 1] < -0.002
    assert np.array_equal(seen.scene.alpha[upper], scene.alpha[upper])
    free = lower & (scene.points[:, 2] > MESH_Z)
    assert seen.scene.alpha[free].max() < 0.05


def test_hidden_hair_on_the_skin_keeps_its_opacity(scene):
    on_skin = scene.points[:, 1] > 0
    seen = fitted(scene, np.zeros((SIDE, SIDE)), on_skin=on_skin)
    assert np.array_equal(seen.scene.alpha[on_skin], scene.alpha[on_skin])
