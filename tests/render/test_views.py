"""Views, turntable, video, contact sheet."""

from dataclasses import replace

import numpy as np
import pytest
from render.small_scene import SIZE, drawn, fringe, wall

from tress.base.errors import InputError, OutputError
from tress.base.report import Report
from tress.model.camera import Camera
from tress.model.evaluate import Scene
from tress.model.strands import Strands
from tress.render.flat_scene import flat_scene
from tress.render.occlusion import light_transmittance, prepared, sky_visibility
from tress.render.preview import contact_sheet
from tress.render.styles.fibre import FibreStyle
from tress.render.styles.photo import PhotoStyle
from tress.render.turntable import TurntableParams, turntable
from tress.render.video import read_video, write_webm
from tress.render.views import framed, pivot, turned

SCENE = flat_scene(Scene(strands={"hair": fringe(count=60)}, meshes={"wall": wall(half=0.08)}))
FRONT = Camera(xy_from_world=[[100, 0, 0, 50], [0, -100, 0, 50], [0, 0, 0, 1]], width=100, height=100)


def test_a_whole_turn_changes_nothing_and_a_quarter_shows_the_right_hand_side():
    point = np.array([[0.2, 0.1, 0.0]])
    assert np.allclose(
        turned(FRONT, angle_rad=2 * np.pi, pivot_in_world=[1, 2, 3]).project(point), FRONT.project(point)
    )
    quarter = turned(FRONT, angle_rad=np.pi / 2, pivot_in_world=[0, 0, 0])
    assert np.allclose(quarter.project(point), [[50, 40]])
    depth = np.cross(*quarter.xy_from_world[:2, :3]) @ point[0]
    assert depth < 0, "what was on the right is in front"


def test_the_pivot_stays_where_it_is():
    centre = np.array([0.1, 0.2, 0.3])
    moved = turned(FRONT, angle_rad=1.0, pivot_in_world=centre)
    assert np.allclose(moved.project(centre[None]), FRONT.project(centre[None]))


def test_framed_hair_stays_in_the_picture_from_all_sides():
    camera, centre = framed(SCENE, width=120, height=90), pivot(SCENE)
    for angle in np.linspace(0, 6, 13):
        xy = turned(camera, angle_rad=angle, pivot_in_world=centre).project(SCENE.points.astype(float))
        inside = ((xy > 0) & (xy < [120, 90])).all(axis=1)
        assert inside.mean() > 0.98


def test_an_empty_scene_cannot_be_framed():
    with pytest.raises(InputError, match="empty"):
        framed(flat_scene(Scene()), width=10, height=10)


def test_the_turntable_turns_once_and_tells_its_progress():
    events = []
    report = Report(listener=events.append)
    params = TurntableParams(frames=4, width=64, height=48)
    with report.stage("turntable"):
        frames = list(turntable(SCENE, style=PhotoStyle(), params=params, report=report))
    assert [f.shape for f in frames] == [(48, 64, 3)] * 4
    assert [e.fraction for e in events if e.kind == "progress"] == [0.25, 0.5, 0.75, 1.0]
    assert not np.array_equal(frames[0], frames[1])


@pytest.mark.parametrize("codec", ["vp8", "vp9"])
def test_a_video_plays_as_it_was_written(tmp_path, codec, capfd):
    frames = [np.full((48, 64, 3), (200, 40 + 10 * i, 90), np.uint8) for i in range(7)]
    assert write_webm(tmp_path / "turn.webm", frames=frames, frames_per_sec=25, codec=codec) == 7
    found, rate = read_video(tmp_path / "turn.webm")
    assert found.shape == (7, 48, 64, 3)
    assert rate == pytest.approx(25)
    assert np.abs(found.astype(int) - np.stack(frames)).max() <= 8, "colours, red and blue not swapped"
    assert [path.name for path in tmp_path.iterdir()] == ["turn.webm"]
    assert capfd.readouterr() == ("", ""), "libraries do not print"


def test_a_failed_video_leaves_the_old_one(tmp_path):
    def broken():
        yield np.zeros((48, 64, 3), np.uint8)
        raise RuntimeError("renderer failed")

    (tmp_path / "turn.webm").write_bytes(b"old")
    with pytest.raises(RuntimeError, match="renderer failed"):
        write_webm(tmp_path / "turn.webm", frames=broken())
    assert [path.read_bytes() for path in tmp_path.iterdir()] == [b"old"]


@pytest.mark.parametrize(
    ("frames", "message"),
    [
        ([], "no frames"),
        ([np.zeros((47, 64, 3), np.uint8)], "even H and W"),
        ([np.zeros((48, 64, 3), np.uint8), np.zeros((48, 62, 3), np.uint8)], "Frame 1"),
    ],
)
def test_frames_that_fit_no_video_are_refused(tmp_path, frames, message):
    with pytest.raises(InputError, match=message):
        write_webm(tmp_path / "turn.webm", frames=frames)
    assert not list(tmp_path.iterdir())


def test_a_missing_folder_is_an_output_error(tmp_path):
    with pytest.raises(OutputError, match="could not be written"):
        write_webm(tmp_path / "none" / "turn.webm", frames=[np.zeros((48, 64, 3), np.uint8)])


def test_a_contact_sheet_shows_every_picture_at_one_height():
    pictures = [np.full((100, 80, 3), 10, np.uint8), np.full((300, 150, 3), 200, np.uint8)]
    sheet = contact_sheet(pictures, captions=["one", "two"], height=200)
    assert sheet.shape == (200 + 28 + 16, 8 + 160 + 8 + 100 + 8, 3)
    assert (sheet[8:208, 8:168] == 10).all()
    assert (sheet[8:208, 176:276] == 200).all()
    assert sheet[210:235, 8:168].min() < 100, "ink"
    with pytest.raises(InputError, match="2 pictures have 1 captions"):
        contact_sheet(pictures, captions=["one"])


def test_the_depths_of_the_hair_are_darker_than_its_outside():
    rng = np.random.default_rng(0)
    root = rng.normal(0, 0.03, (4000, 3)).astype(np.float32)
    points = np.stack([root, root + [0, 0.002, 0]], axis=1).reshape(-1, 3)
    ball = flat_scene(Scene(strands={"ball": Strands(points=points, offsets=np.arange(0, 8001, 2))}))
    light = sky_visibility(ball)
    distance = np.linalg.norm(points, axis=1)
    assert light[distance < 0.02].mean() < 0.7 * light[distance > 0.06].mean()
    assert 0 <= light.min() <= light.max() <= 1
    lit = light_transmittance(ball, towards_light=np.array([1.0, 0, 0]))
    assert lit[points[:, 0] > 0.03].mean() > 1.5 * lit[points[:, 0] < -0.03].mean()


def test_a_prepared_scene_looks_the_same():
    fringed = drawn([fringe(count=60)])
    ready = replace(fringed, scene=prepared(fringed.scene))
    for style in (PhotoStyle.soft(), FibreStyle()):
        assert np.array_equal(style.shade(fringed), style.shade(ready))


def test_a_video_of_the_turntable(tmp_path):
    params = TurntableParams(frames=3, width=64, height=48)
    write_webm(tmp_path / "turn.webm", frames=turntable(SCENE, style=PhotoStyle.soft(), params=params))
    assert read_video(tmp_path / "turn.webm")[0].shape == (3, 48, 64, 3)


def test_the_gbuffer_has_the_pictures_size():
    assert drawn([fringe(count=3)]).shape == (SIZE["height"], SIZE["width"])
