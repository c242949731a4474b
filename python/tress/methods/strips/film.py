"""Moving strips on film: a turntable that plays the motion, and its moments side by side."""

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from scipy.spatial.transform import Rotation

from tress.base.params import Params, param
from tress.base.report import Report
from tress.methods.strips.appearance import Color, for_style, hair_color, strips_scene
from tress.methods.strips.bald_document import HEAD
from tress.model.attachment import surface_mesh
from tress.model.camera import Camera
from tress.model.document import Document
from tress.model.evaluate import Scene
from tress.model.keyframes import Keyframes
from tress.model.strands import Strands
from tress.render.flat_scene import flat_scene
from tress.render.gbuffer import rasterise
from tress.render.picture import premultiplied_rgba, srgb_rgb
from tress.render.preview import contact_sheet
from tress.render.style import Style
from tress.render.styles.textured import TexturedStyle
from tress.render.turntable import BACKDROP
from tress.render.views import framed, pivot, turned

Array = np.ndarray[Any, Any]


@dataclass(frozen=True)
class FilmParams(Params):
    """Size and length of the film."""

    width: int = param(400, low=16, high=4096, unit="px", doc="Width of a frame; even, for the video.")
    height: int = param(500, low=16, high=4096, unit="px", doc="Height of a frame; even, for the video.")
    frames_per_sec: float = param(18.0, low=1.0, high=120.0, unit="1/s", doc="Frames a second.")
    least_secs: float = param(4.0, low=0.1, high=600.0, unit="s", doc="The motion is played until it lasts so long.")
    most_secs: float = param(20.0, low=0.1, high=600.0, unit="s", doc="What is longer is cut off.")


def moving_turntable(
    document: Document,
    *,
    params: FilmParams | None = None,
    color: Color | None = None,
    style: Style | None = None,
    head_motion: Callable[[float], Array] | None = None,
    report: Report | None = None,
) -> Iterator[Array]:
    """Frames (height, width, 3) uint8 sRGB of one turn about the upright axis, while the motion plays whole times.

    Frames are made when they are asked for, in the style `textured` unless told otherwise. With a `head_motion` (poses
    (7,) by seconds, as `tress.dynamics.head_motion` has them) the head moves as it did where the hair was simulated.
    Raises `InputError` for a document with nothing to see.
    """
    settings = params or FilmParams()
    begin, end = motion_span(document)
    times = playing_times(begin, end, settings)
    camera, centre = _standing(document, settings.width, settings.height)
    for index, time in enumerate(times):
        view = turned(camera, angle_rad=2 * math.pi * index / len(times), pivot_in_world=centre)
        if head_motion is not None:
            view = replace(view, xy_from_world=view.xy_from_world @ _world_from_head(head_motion(time)))
        yield _frame(document, time, view, color, style)
        if report is not None:
            report.progress((index + 1) / len(times))


def film_strip(
    document: Document, *, moments: int = 6, azimuth: float = 40.0, height: int = 320, style: Style | None = None
) -> Array:
    """(H, W, 3) uint8: even moments of the motion side by side, seen from `azimuth` (degrees) beside the front."""
    begin, end = motion_span(document)
    camera, centre = _standing(document, round(0.8 * height), height)
    view = turned(camera, angle_rad=math.radians(azimuth), pivot_in_world=centre)
    times = [begin + (end - begin) * index / moments for index in range(moments)]
    captions = [f"{time:.2f} s" for time in times]
    frames = [_frame(document, time, view, None, style) for time in times]
    return contact_sheet(frames, captions=captions, height=height)


def motion_span(document: Document) -> tuple[float, float]:
    """Seconds from the first to the last moment of all keyframes; (0, 0) where there are none."""
    moving = document.of_type(Keyframes).values()
    if not moving:
        return 0.0, 0.0
    return min(float(item.times[0]) for item in moving), max(float(item.times[-1]) for item in moving)


def playing_times(begin: float, end: float, params: FilmParams) -> list[float]:
    """The moment (seconds) that each frame shows: the span again and again, whole times, so that the film repeats."""
    span = min(end - begin, params.most_secs)
    if span <= 0:
        return [begin] * max(round(params.least_secs * params.frames_per_sec), 1)
    again = max(math.ceil(params.least_secs / span - 1e-9), 1)
    count = max(round(again * span * params.frames_per_sec), 1)
    return [begin + (again * span * index / count) % span for index in range(count)]


def _standing(document: Document, width: int, height: int) -> tuple[Camera, Array]:
    """A camera that keeps the hair in the picture at all moments, and what to turn about."""
    begin, end = motion_span(document)
    scenes = [
        strips_scene(document, time=begin + (end - begin) * share, textured=False) for share in (0, 0.25, 0.5, 0.75)
    ]
    seen = np.concatenate([scene.positions for scene in scenes])
    line = {"hair": Strands(points=seen, offsets=np.array([0, len(seen)]))} if len(seen) else {}
    head = surface_mesh(document, HEAD, where="A film")
    framing = flat_scene(Scene(strands=line, meshes={HEAD: head}))
    return framed(framing, width=width, height=height), pivot(framing)


def _frame(document: Document, time: float, view: Camera, color: Color | None, style: Style | None) -> Array:
    shown = style or TexturedStyle()
    scene = strips_scene(document, color=color or hair_color(document), time=time, **for_style(shown))
    seen = rasterise(scene, xy_from_world=view.xy_from_world, width=view.width, height=view.height)
    return srgb_rgb(premultiplied_rgba(seen, style=shown), background=BACKDROP)


def _world_from_head(pose: Array) -> Array:
    """(4, 4) of a quaternion x y z w and a translation."""
    matrix = np.eye(4)
    matrix[:3, :3] = Rotation.from_quat(pose[:4]).as_matrix()
    matrix[:3, 3] = pose[4:]
    return matrix
