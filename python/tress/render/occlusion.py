"""Light that the hair keeps from itself: strands as a fog on a grid, and strips as another."""

from dataclasses import replace
from typing import Any

import numpy as np
from scipy.ndimage import gaussian_filter

from tress.render.flat_scene import FlatScene, tangents
from tress.render.fog import Fog, fog, frame_with_last_axis
from tress.render.mesh_frames import is_cards

Array = np.ndarray[Any, Any]

_DENSITY_PER_M = 70.0
_LAYER = 0.2
"""Absorption of one layer of strips where light comes straight at it."""


def sky_visibility(scene: FlatScene) -> Array:
    """(N,) float32 in [0, 1]: the share of a soft sky that reaches every point of the strands through the hair.

    The same for every view. Coarse by design (4 mm): it darkens the depths of a hairstyle, not single strands. Cost:
    linear in points and cells.
    """
    if scene.sky is not None or len(scene.points) == 0:
        return np.zeros(0, np.float32) if scene.sky is None else scene.sky
    return _fog_of_strands(scene, scene.points).sky()


def mesh_sky_visibility(scene: FlatScene) -> Array:
    """(V,) float32 in [0, 1]: the same for the vertices of the meshes, behind strips.

    Other meshes keep no light from anything: the normals of a head tell its sides well enough.
    """
    if scene.mesh_sky is not None or len(scene.positions) == 0:
        return np.zeros(0, np.float32) if scene.mesh_sky is None else scene.mesh_sky
    return _fog_of_meshes(scene, scene.positions).sky()


def prepared(scene: FlatScene) -> FlatScene:
    """The scene with all that is the same for every view: worth it where more than one picture is made of it."""
    return replace(scene, tangent=tangents(scene), sky=sky_visibility(scene), mesh_sky=mesh_sky_visibility(scene))


def light_transmittance(scene: FlatScene, *, towards_light: Array) -> Array:
    """(N,) float32 in [0, 1]: the share of a distant light in the direction (3,) that reaches every point."""
    if len(scene.points) == 0:
        return np.zeros(0, np.float32)
    return _fog_of_strands(scene, _seen_along(scene.points, towards_light)).light()


def mesh_light_transmittance(scene: FlatScene, *, towards_light: Array) -> Array:
    """(V,) float32 in [0, 1]: the same for the vertices of the meshes."""
    if len(scene.positions) == 0:
        return np.zeros(0, np.float32)
    return _fog_of_meshes(scene, _seen_along(scene.positions, towards_light)).light()


def _seen_along(points: Array, direction: Array) -> Array:
    return points @ frame_with_last_axis(direction).T.astype(np.float32)


def _fog_of_strands(scene: FlatScene, points: Array) -> Fog:
    """Length of strand in every cell, as absorption: the densest tenth of the cells absorbs the most."""

    def absorption(length: Array, cell_m: float) -> Array:
        smooth = gaussian_filter(length, 0.8)
        filled = smooth[length > 0]
        dense = max(float(np.percentile(filled, 90)) if filled.size else 0.0, 1e-12)
        return _DENSITY_PER_M * cell_m * np.minimum(smooth / dense, 1.0)

    return fog(points, amount=_lengths(points, scene.offsets), absorption=absorption)


def _fog_of_meshes(scene: FlatScene, points: Array) -> Fog:
    """Area in every cell as light along each axis meets it, as the number of layers that it has to pass: little where
    it goes along the strips, as light from above does in hair that hangs."""
    weight = np.repeat([_LAYER * is_cards(mesh) for mesh in scene.meshes], np.diff(scene.first_triangle))
    return fog(
        points,
        amount=_areas(points, scene.triangles, weight),
        absorption=lambda area, cell_m: gaussian_filter(area, 1.0) / cell_m**2,
    )


def _areas(positions: Array, triangles: Array, weight: Array) -> Array:
    """(V, 3) square metres that belong to every vertex, projected along each axis: a third of the triangles around it,
    each times its weight."""
    a, b, c = (positions[triangles[:, i]].astype(np.float64) for i in range(3))
    third = weight[:, None] * np.abs(np.cross(b - a, c - a)) / 6
    corners = triangles.ravel()
    columns = [np.bincount(corners, weights=np.repeat(part, 3), minlength=len(positions)) for part in third.T]
    return np.stack(columns, axis=1)


def _lengths(points: Array, offsets: Array) -> Array:
    """(N,) metres of strand that belong to every point: the segment that begins there."""
    step = np.zeros(len(points))
    step[:-1] = np.linalg.norm(np.diff(points, axis=0), axis=1)
    step[offsets[1:] - 1] = 0
    return step
