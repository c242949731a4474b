"""The head's texture: the place of every texel, and colours known beforehand."""

import cv2
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial import KDTree

from tests.head.faces import exact_landmarks
from tress.head.fit import FittedHead, fit_head
from tress.head.pose import Pose
from tress.head.statistical import load_statistical_head
from tress.head.texels import texels
from tress.head.texture import head_texture

HEAD = load_statistical_head()
SKIN = np.array([200, 150, 120])


def facing(yaw: float = 0.0) -> FittedHead:
    cos, sin = np.cos(yaw), np.sin(yaw)
    turn = np.array([[cos, 0, sin], [0, 1, 0], [-sin, 0, cos]])
    return fit_head(exact_landmarks(HEAD, HEAD.mean, Pose(turn, 1500.0, np.array([250.0, 250.0, 0.0]))))


def silhouette(fitted: FittedHead) -> np.ndarray:
    corners = np.round(fitted.project(fitted.positions_in_view)[fitted.triangles]).astype(np.int32)
    out = np.zeros((500, 500), np.uint8)
    for corner in corners:
        cv2.fillConvexPoly(out, corner.reshape(-1, 1, 2), 1)
    return out > 0


def at_vertices(texture: np.ndarray, vertices: np.ndarray) -> np.ndarray:
    """Colours (N, 3) in the middle of the triangles of which all corners are among `vertices` (V,) bool."""
    u, v = HEAD.corner_uv[vertices[HEAD.triangles].all(axis=1)].mean(axis=1).T
    size = len(texture)
    return texture[((1 - v) * size).astype(int), (u * size).astype(int)].astype(int)


def at_vertex(texture: np.ndarray, vertex: int) -> np.ndarray:
    """The colour (3,) at one vertex, in the first triangle that has it."""
    triangle, corner = np.argwhere(HEAD.triangles == vertex)[0]
    u, v = HEAD.corner_uv[triangle, corner]
    size = len(texture)
    return texture[min(int((1 - v) * size), size - 1), min(int(u * size), size - 1)].astype(int)


def mouth() -> np.ndarray:
    return (HEAD.masks["inside"] > 0) & (HEAD.masks["eyes"] < 1)


def test_texels_know_their_place() -> None:
    found = texels(HEAD.corner_uv, size=256)
    uv = np.einsum("nk,nkd->nd", found.barycentric, HEAD.corner_uv[found.triangle])
    places = np.stack([(found.column + 0.5) / 256, 1 - (found.row + 0.5) / 256], axis=1)
    assert np.abs(uv - places).max() < 1e-3
    assert len(np.unique(found.row * 256 + found.column)) == len(found.row)


def test_two_triangles_cover_the_square() -> None:
    corner_uv = np.array([[[0, 0], [1, 0], [1, 1]], [[0, 0], [1, 1], [0, 1.0]]])
    assert len(texels(corner_uv, size=16).row) == 256


def test_every_texel_takes_after_the_closest_covered_one() -> None:
    found = texels(HEAD.corner_uv, size=128)
    covered = np.column_stack([found.row, found.column])
    nearest = covered[found.nearest(size=128)]
    grid = np.stack(np.meshgrid(np.arange(128), np.arange(128), indexing="ij"), axis=-1)
    closest, _ = KDTree(covered).query(grid)
    assert np.linalg.norm(nearest - grid, axis=-1) == pytest.approx(closest, rel=0.05, abs=0.5)
    assert np.array_equal(nearest[found.row, found.column], covered)


@given(st.tuples(*[st.integers(30, 240)] * 3), st.floats(-0.5, 0.5))
@settings(max_examples=8, deadline=None)
def test_a_photograph_of_one_colour_gives_a_texture_of_that_colour(color: tuple[int, ...], yaw: float) -> None:
    texture = head_texture(np.full((500, 500, 3), color, np.uint8), fitted=facing(yaw), size=256)
    skin = at_vertices(texture, ~mouth())
    assert np.abs(skin - color).max() <= 1


def test_the_hidden_side_takes_the_colour_of_its_mirror_image() -> None:
    fitted = facing(yaw=0.7)
    image = np.full((500, 500, 3), SKIN, np.uint8)
    far = np.linalg.norm(HEAD.mean - [-0.045, -0.04, 0.07], axis=1)
    cheek = int(np.argmin(np.where(HEAD.masks["face"] * (1 - HEAD.masks["inside"]) > 0.9, far, 1.0)))
    x, y = np.round(fitted.project(fitted.positions_in_view)[cheek]).astype(int)
    cv2.circle(image, (int(x), int(y)), 3, (140, 90, 60), -1)
    texture = head_texture(image, fitted=fitted, size=1024)
    assert at_vertex(texture, cheek).max() < SKIN.max() - 40
    assert at_vertex(texture, int(HEAD.mirror[cheek])).max() < SKIN.max() - 30


def test_a_symmetric_photograph_gives_a_symmetric_texture() -> None:
    rng = np.random.default_rng(3)
    half = cv2.GaussianBlur(rng.normal(0, 600, (500, 250, 3)), (0, 0), 12) + SKIN
    image = np.clip(np.hstack([half, half[:, ::-1]]), 0, 255).astype(np.uint8)
    texture = head_texture(image, fitted=facing(), size=1024).astype(int)
    skin = np.flatnonzero((np.arange(len(HEAD.mean)) < HEAD.skin_count) & (HEAD.masks["inside"] == 0))
    one = np.array([at_vertex(texture, int(vertex)) for vertex in skin])
    other = np.array([at_vertex(texture, int(vertex)) for vertex in HEAD.mirror[skin]])
    assert one.std(axis=0).min() > 5
    assert np.quantile(np.abs(one - other), 0.99) <= 8


@pytest.mark.parametrize("yaw", [0.0, 0.4, -0.8])
def test_the_background_is_not_painted_on_even_where_the_mask_is_too_wide(yaw: float) -> None:
    fitted = facing(yaw)
    shown = silhouette(fitted)
    image = np.full((500, 500, 3), (10, 200, 10), np.uint8)
    image[shown] = SKIN
    skin = np.asarray(cv2.dilate(shown.astype(np.float32), np.ones((9, 9))), np.float32)
    texture = head_texture(image, fitted=fitted, skin=skin, size=512).astype(int)
    assert np.abs(at_vertices(texture, ~mouth()) - SKIN).max() <= 12


def test_clothes_in_the_mask_are_not_painted_on() -> None:
    fitted = facing()
    image = np.full((500, 500, 3), SKIN, np.uint8)
    chin = fitted.project(fitted.positions_in_view)[HEAD.extremes[1], 1]
    image[round(float(chin)) + 12 :] = (60, 70, 160)
    texture = head_texture(image, fitted=fitted, skin=np.ones((500, 500)), size=512).astype(int)
    assert np.abs(at_vertices(texture, ~mouth()) - SKIN).max() <= 12


def test_hair_in_the_photograph_is_not_painted_on() -> None:
    image = np.full((500, 500, 3), SKIN, np.uint8)
    image[:180] = (10, 200, 10)
    skin = np.ones((500, 500), np.float32)
    skin[:185] = 0
    texture = head_texture(image, fitted=facing(), skin=skin, size=256).astype(int)
    assert np.abs(at_vertices(texture, ~mouth()) - SKIN).max() <= 2


def test_a_beard_is_painted_and_a_strand_over_the_cheek_is_not() -> None:
    fitted = facing()
    x, y = fitted.project(fitted.positions_in_view).T
    below = (HEAD.masks["face"] > 0.9) & (HEAD.mean[:, 1] < HEAD.mean[HEAD.masks["lips"] > 0.5, 1].min() - 0.005)
    bearded, strand = (np.full((500, 500, 3), SKIN, np.uint8) for _ in range(2))
    bearded[round(float(y[below].min())) :] = (40, 25, 20)
    strand[:, round(float(x[below].max())) - 25 :] = (40, 25, 20)
    jaw = below & (np.abs(HEAD.mean[:, 0]) > 0.03) & (HEAD.mean[:, 0] > 0)
    dark, light = (
        np.median(at_vertices(head_texture(image, fitted=fitted, size=512), jaw), axis=0) for image in (bearded, strand)
    )
    assert dark.mean() < 90
    assert light == pytest.approx(SKIN, abs=25)


def test_light_from_one_side_leaves_no_seam_in_the_middle() -> None:
    image = (np.full((500, 500, 3), SKIN) * np.linspace(1.2, 0.5, 500)[None, :, None]).astype(np.uint8)
    texture = head_texture(image, fitted=facing(), size=1024).astype(int)
    skin = (np.arange(len(HEAD.mean)) < HEAD.skin_count) & (HEAD.masks["inside"] == 0)
    middle = skin & (np.abs(HEAD.mean[:, 0]) < 1e-3)
    touching = middle[HEAD.triangles].any(axis=1) & skin[HEAD.triangles].all(axis=1)
    uv = HEAD.corner_uv[touching].mean(axis=1)
    color = texture[((1 - uv[:, 1]) * 1024).astype(int), (uv[:, 0] * 1024).astype(int)]
    center = HEAD.mean[HEAD.triangles[touching]].mean(axis=1)
    near = KDTree(center).query_pairs(0.012, output_type="ndarray")
    assert np.abs(color[near[:, 0]] - color[near[:, 1]]).max() <= 25


def test_the_scalp_takes_after_the_colour_it_is_given() -> None:
    image = np.full((500, 500, 3), SKIN, np.uint8)
    texture = head_texture(image, fitted=facing(), scalp_color=np.array([0.0, 0.0, 1.0]), size=256)
    back = (HEAD.masks["scalp"] > 0.99) & (HEAD.mean[:, 2] < 0)
    colors = at_vertices(texture, back)
    assert (colors[:, 2] > SKIN[2] + 20).all() and (colors[:, 0] < SKIN[0] - 20).all()
    neck = at_vertices(texture, HEAD.masks["neck"] > 0.5)
    assert np.abs(neck - SKIN).max() <= 2


def test_a_head_outside_the_photograph_is_of_plain_skin() -> None:
    landmarks = exact_landmarks(HEAD, HEAD.mean, Pose(np.eye(3), 1500.0, np.array([5000.0, 250.0, 0.0])))
    texture = head_texture(np.zeros((500, 500, 3), np.uint8), fitted=fit_head(landmarks), size=64)
    assert (texture == texture[0, 0]).all() and texture[0, 0, 0] > texture[0, 0, 2] > 50
