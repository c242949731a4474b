"""What is seen: hair before and behind meshes, several records, the frame of the camera."""

import numpy as np
import pytest
from render.small_scene import CAMERA, SIZE, drawn, fringe, wall

from tress.base.errors import InputError
from tress.kernel import raster
from tress.model.evaluate import Scene
from tress.model.strands import Strands
from tress.render.flat_scene import flat_scene, strand_of_point, tangents
from tress.render.gbuffer import hair_coverage, hair_fragments, rasterise, visible_weight


def test_hair_hides_the_wall_behind_it_and_not_before_it():
    assert hair_coverage(drawn([fringe(radius=4e-3, depth=0.01)], [wall()])).min() == 1
    assert hair_coverage(drawn([fringe(radius=4e-3, depth=-0.05)], [wall()])).max() == 0


def test_a_bias_brings_hair_out_of_the_surface():
    strands = fringe(radius=4e-3, depth=-0.011)
    assert hair_coverage(drawn([strands], [wall()])).max() == 0
    assert hair_coverage(drawn([strands], [wall()], strand_bias_m=0.012)).min() == 1


def test_bias_is_metres_in_perspective_too():
    # Camera at z = 1, looking along -z.
    camera = np.array([[400.0, 0, -40, 40], [0, -400.0, -30, 30], [0, 0, -1, 1]])
    strands = fringe(radius=4e-3, depth=-0.021)
    assert hair_coverage(drawn([strands], [wall()], camera=camera, strand_bias_m=0.010)).max() == 0
    assert hair_coverage(drawn([strands], [wall()], camera=camera, strand_bias_m=0.022)).min() == 1


def test_records_of_a_scene_are_joined():
    one, two = fringe(count=3), fringe(count=5, points=7)
    scene = flat_scene(Scene(strands={"a": one, "b": two}, meshes={"x": wall(), "y": wall(z=1)}))
    assert scene.offsets.tolist() == [0, 12, 24, 36, 43, 50, 57, 64, 71]
    assert scene.triangles.tolist() == [[0, 1, 2], [0, 2, 3], [4, 5, 6], [4, 6, 7]]
    assert scene.first_triangle.tolist() == [0, 2, 4]
    assert strand_of_point(scene)[[0, 35, 36, 70]].tolist() == [0, 2, 3, 7]


def test_an_empty_scene_is_an_empty_picture():
    gbuffer = drawn()
    assert hair_coverage(gbuffer).shape == (60, 80)
    assert len(gbuffer.fragments.weight) == 0


def test_tangents_are_unit_and_stay_within_their_strand():
    strands = Strands(points=[[0, 0, 0], [1, 0, 0], [2, 0, 0], [0, 0, 0], [0, -3, 0]], offsets=[0, 3, 5])
    along = tangents(flat_scene(Scene(strands={"a": strands})))
    assert along.tolist() == [[1, 0, 0]] * 3 + [[0, -1, 0]] * 2


def test_values_are_interpolated_along_the_strand():
    gbuffer = drawn([fringe(count=5, radius=0.004)])
    hair = hair_fragments(gbuffer)
    y = hair.values(gbuffer.scene.points[:, 1])
    row = gbuffer.fragments.pixel[hair.index] // 80 + 0.5
    assert np.abs((30 - row) / 400 - y).max() < 1 / 400


def test_visible_weight_sums_to_the_coverage():
    gbuffer = drawn([fringe()], [wall(z=0.005)])
    assert visible_weight(gbuffer).sum() == pytest.approx(hair_coverage(gbuffer).sum(), rel=1e-5)


def test_away_is_the_camera_axis():
    assert drawn().away.tolist() == [0, 0, -1]
    perspective = np.array([[400.0, 0, -40, 40], [0, -400.0, -30, 30], [0, 0, -1, 1]])
    assert drawn(camera=perspective).away.tolist() == [0, 0, -1]


def test_only_sixteen_samples():
    with pytest.raises(InputError, match="samples is 4; 16"):
        rasterise(flat_scene(Scene()), xy_from_world=CAMERA, samples=4, **SIZE)


def test_points_at_infinity_are_refused():
    with pytest.raises(InputError):
        raster.project([[np.inf, 0, 0]], xy_from_points=CAMERA)
