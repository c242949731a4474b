"""The head's texture: the place of every texel, and colours known beforehand."""

import numpy as np
import pytest

from tests.head.faces import exact_landmarks
from tress.head.fit import FittedHead, fit_head
from tress.head.pose import Pose
from tress.head.statistical import load_statistical_head
from tress.head.texels import texels
from tress.head.texture import head_texture

HEAD = load_statistical_head()


def facing(yaw: float = 0.0) -> FittedHead:
    cos, sin = np.cos(yaw), np.sin(yaw)
    turn = np.array([[cos, 0, sin], [0, 1, 0], [-sin, 0, cos]])
    return fit_head(exact_landmarks(HEAD, HEAD.mean, Pose(turn, 1500.0, np.array([250.0, 250.0, 0.0]))))


def test_texels_know_their_place() -> None:
    found = texels(HEAD.corner_uv, size=256)
    uv = np.einsum("nk,nkd->nd", found.barycentric, HEAD.corner_uv[found.triangle])
    places = np.stack([(found.column + 0.5) / 256, 1 - (found.row + 0.5) / 256], axis=1)
    assert np.abs(uv - places).max() < 1e-3
    assert len(np.unique(found.row * 256 + found.column)) == len(found.row)


def test_two_triangles_cover_the_square() -> None:
    corner_uv = np.array([[[0, 0], [1, 0], [1, 1]], [[0, 0], [1, 1], [0, 1.0]]])
    assert len(texels(corner_uv, size=16).row) == 256


def test_a_photograph_of_one_colour_gives_a_texture_of_that_colour() -> None:
    image = np.full((500, 500, 3), (200, 150, 120), np.uint8)
    texture = head_texture(image, fitted=facing(), size=256).astype(int)
    near = np.abs(texture - [200, 150, 120]).max(axis=2) <= 2
    assert near.mean() > 0.97


def test_the_hidden_side_takes_the_colour_of_its_mirror_image() -> None:
    fitted = facing(yaw=0.7)
    image = np.full((500, 500, 3), (90, 60, 40), np.uint8)
    x = fitted.project(fitted.positions_in_view)[:, 0]
    ears = [(HEAD.masks["ears"] > 0.5) & (np.sign(HEAD.mean[:, 0]) == side) for side in (-1, 1)]
    image[:, : round(float(x[ears[0]].max())) + 12] = (220, 30, 30)
    texture = head_texture(image, fitted=fitted, size=512).astype(int)

    def color_of(vertices: np.ndarray) -> np.ndarray:
        corners = vertices[HEAD.triangles].all(axis=1)
        u, v = HEAD.corner_uv[corners].mean(axis=1).T
        return np.median(texture[((1 - v) * 512).astype(int), (u * 512).astype(int)], axis=0)

    assert color_of(ears[0]) == pytest.approx([220, 30, 30], abs=12)
    assert color_of(ears[1])[0] > 150


def test_hair_in_the_photograph_is_not_painted_on() -> None:
    image = np.full((500, 500, 3), (200, 150, 120), np.uint8)
    image[:180] = (10, 200, 10)
    skin = np.ones((500, 500), np.float32)
    skin[:185] = 0
    texture = head_texture(image, fitted=facing(), skin=skin, size=256).astype(int)
    assert (texture[..., 1] > texture[..., 0]).mean() < 0.001


def test_the_scalp_takes_the_colour_it_is_given() -> None:
    image = np.full((500, 500, 3), (200, 150, 120), np.uint8)
    texture = head_texture(image, fitted=facing(), scalp_color=np.array([0.0, 0.0, 1.0]), size=256)
    corners = (HEAD.masks["scalp"] > 0.99)[HEAD.triangles].all(axis=1)
    u, v = HEAD.corner_uv[corners].mean(axis=1).T
    assert (texture[((1 - v) * 256).astype(int), (u * 256).astype(int)] == [0, 0, 255]).all(axis=1).mean() > 0.98
