"""Fewer, wider strands cover as much."""

import numpy as np
from render.small_scene import fringe

from tress.model.evaluate import Scene
from tress.render.flat_scene import flat_scene
from tress.render.gbuffer import hair_coverage, rasterise
from tress.render.occlusion import prepared
from tress.render.simplify import simplified
from tress.render.views import framed


def test_fewer_strands_cover_about_as_much():
    whole = prepared(flat_scene(Scene(strands={"hair": fringe(count=4000, radius=2e-6)})))
    fewer = simplified(whole, most_strands=1000)
    assert 950 < len(fewer.offsets) - 1 < 1050
    assert fewer.offsets[-1] == len(fewer.points) == len(fewer.sky) == len(fewer.tangent)
    camera = framed(whole, width=60, height=60)
    covered = [
        float(hair_coverage(rasterise(s, xy_from_world=camera.xy_from_world, width=60, height=60)).sum())
        for s in (whole, fewer)
    ]
    assert covered[0] > 50  # thin hair: where strands lie behind each other, fewer ones cover a little more
    assert abs(covered[1] / covered[0] - 1) < 0.1
    area = [float(s.radius.sum()) for s in (whole, fewer)]
    assert abs(area[1] / area[0] - 1) < 1e-3


def test_strands_stay_whole():
    whole = flat_scene(Scene(strands={"hair": fringe(count=100)}))
    fewer = simplified(whole, most_strands=30)
    starts = {tuple(point) for point in whole.points[whole.offsets[:-1]].tolist()}
    assert all(tuple(point) in starts for point in fewer.points[fewer.offsets[:-1]].tolist())
    assert np.all(np.isin(np.diff(fewer.offsets), np.diff(whole.offsets)))


def test_few_strands_stay_as_they_are():
    whole = flat_scene(Scene(strands={"hair": fringe(count=20)}))
    assert simplified(whole, most_strands=20) is whole
