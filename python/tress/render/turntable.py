"""The scene from all around, frame by frame."""

from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from typing import Any

import numpy as np

from tress.base.params import Params, param
from tress.base.report import Report
from tress.model.camera import Camera
from tress.render.flat_scene import FlatScene
from tress.render.gbuffer import rasterise
from tress.render.occlusion import prepared
from tress.render.picture import premultiplied_rgba, srgb_rgb
from tress.render.simplify import simplified
from tress.render.style import Style
from tress.render.views import framed, pivot, turned

Array = np.ndarray[Any, Any]

BACKDROP = np.array([0.50, 0.50, 0.51], np.float32)
"""Linear light grey (sRGB 188): black hair and white hair both read against it."""

_AHEAD = 3
"""Frames in the making at once."""


@dataclass(frozen=True)
class TurntableParams(Params):
    """Size and number of the frames."""

    frames: int = param(24, low=1, high=2000, doc="Frames of one turn.")
    width: int = param(400, low=16, high=4096, unit="px", doc="Width of a frame; even, for the video.")
    height: int = param(500, low=16, high=4096, unit="px", doc="Height of a frame; even, for the video.")
    min_width_px: float = param(1.0, low=0.1, high=8, unit="px", doc="Least width of a strand.")
    strands: int = param(20_000, low=1, high=10_000_000, doc="At most about so many strands; more make finer frames.")


def turntable(
    scene: FlatScene, *, style: Style, params: TurntableParams | None = None, report: Report | None = None
) -> Iterator[Array]:
    """Frames (height, width, 3) uint8 sRGB of one turn about the upright axis, from the front, over light grey.

    Frames are made when they are asked for, a few at a time. Raises `InputError` for an empty scene.
    """
    settings = params or TurntableParams()
    scene = simplified(prepared(scene), most_strands=settings.strands)
    camera = framed(scene, width=settings.width, height=settings.height)
    centre = pivot(scene)
    views = [
        turned(camera, angle_rad=2 * np.pi * i / settings.frames, pivot_in_world=centre) for i in range(settings.frames)
    ]

    def frame(view: Camera) -> Array:
        gbuffer = rasterise(
            scene,
            xy_from_world=view.xy_from_world,
            width=view.width,
            height=view.height,
            min_width_px=settings.min_width_px,
        )
        return srgb_rgb(premultiplied_rgba(gbuffer, style=style), background=BACKDROP)

    with ThreadPoolExecutor(_AHEAD) as pool:  # one frame is shaded while the next is rasterised
        for start in range(0, settings.frames, _AHEAD):
            for done, picture in enumerate(pool.map(frame, views[start : start + _AHEAD]), start=start + 1):
                yield picture
                if report is not None:
                    report.progress(done / settings.frames)
