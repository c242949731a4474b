"""The files of a reconstruction: formats, preview, turntable, report, plain arrays, and the stages."""

import math
from collections.abc import Mapping
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from tress.base.report import Report
from tress.image.labels import FACE
from tress.io.format import Format
from tress.io.formats.npz import Maps, write_reconstruction
from tress.io.report_file import write_report
from tress.io.stage_cache import StageCache
from tress.methods.portrait.pipeline import STAGES, Reconstruction
from tress.methods.portrait.stage import Stage
from tress.model.camera import Camera
from tress.model.evaluate import evaluate
from tress.model.strands import Strands
from tress.render.flat_scene import FlatScene, flat_scene
from tress.render.gbuffer import rasterise
from tress.render.occlusion import prepared
from tress.render.picture import premultiplied_rgba, srgb_rgb
from tress.render.preview import contact_sheet
from tress.render.styles.photo import PhotoStyle
from tress.render.turntable import BACKDROP
from tress.render.turntable import turntable as frames_of_turn
from tress.render.video import write_webm
from tress.render.views import framed, pivot, turned

STAGES_FOLDER: Final = "stages"
PREVIEW_HEIGHT: Final = 640
PREVIEW_ALPHA: Final = 0.5
PREVIEW_AIR: Final = 0.12
"""Air around the head in the preview, as a share of its size."""
PREVIEW_ANGLES: Final = tuple(math.radians(angle) for angle in (-30, 30, 180))
PREVIEW_CAPTIONS: Final = ("photo", "rendered over it", "-30 degrees", "+30 degrees", "back")


def deliver(
    reconstruction: Reconstruction,
    folder: Path,
    *,
    formats: Mapping[str, Format],
    turntable: bool,
    facts: Mapping[str, Any],
    report: Report,
) -> None:
    """Writes every file of a reconstruction into `folder`, which exists. Raises `OSError` and `OutputError`.

    `formats` says which files the hair is written to, by their names, `turntable` whether the film is made, `facts`
    what the report says besides times and figures.
    """
    with report.stage("stages"):
        deliver_stages(reconstruction, folder)
    with report.stage("formats"):
        deliver_formats(reconstruction, folder, formats=formats)
        deliver_arrays(reconstruction, folder)
    scene = prepared(flat_scene(evaluate(reconstruction.document)))
    with report.stage("preview"):
        write_picture(preview(reconstruction, scene), folder / "preview.png")
    if turntable:
        with report.stage("turntable"):
            write_webm(folder / "turntable.webm", frames=frames_of_turn(scene, style=PhotoStyle.soft(), report=report))
    write_report(report, folder / "report.json", facts=facts)


def deliver_stages(reconstruction: Reconstruction, folder: Path) -> None:
    """For every stage its picture (`NN_name.png`) and, for `--from-stage` a later one, its result (`NN_name.npz`)."""
    cache = StageCache(folder / STAGES_FOLDER)
    cache.folder.mkdir()
    with ThreadPoolExecutor() as pool:
        list(pool.map(lambda numbered: _deliver_stage(reconstruction, cache, *numbered), enumerate(STAGES, start=1)))


def _deliver_stage(reconstruction: Reconstruction, cache: StageCache, number: int, stage: Stage) -> None:
    name, work = stage.name, reconstruction.work
    if stage is not STAGES[-1]:
        cache.save(work[name], number=number, name=name, fingerprint=reconstruction.fingerprints[name])
    write_picture(stage.picture(work), cache.path(number, name).with_suffix(".png"))


def deliver_formats(reconstruction: Reconstruction, folder: Path, *, formats: Mapping[str, Format]) -> None:
    """The document in each format, under the given file names."""
    for name, form in formats.items():
        form.write(reconstruction.document, folder / name)


def deliver_arrays(reconstruction: Reconstruction, folder: Path) -> None:
    """`reconstruction.npz`: strands, camera, orientation, hair mask and re-rendered photo as plain arrays."""
    work, records = reconstruction.work, reconstruction.document.records
    maps = Maps(
        orientation=work["orientation"].angle,
        hair_mask=np.rint(work["matte"].alpha * 255).astype(np.uint8),
        rerender=work["color"].composite,
    )
    strands, camera = records["hair"], records["photo"]
    assert isinstance(strands, Strands) and isinstance(camera, Camera)
    write_reconstruction(strands, folder / "reconstruction.npz", camera=camera, maps=maps)


def preview(reconstruction: Reconstruction, scene: FlatScene) -> NDArray[np.uint8]:
    """The photo, the hair rendered over it, the head turned by 30° to either side, and from behind."""
    work = reconstruction.work
    camera = framed(scene, width=round(0.8 * PREVIEW_HEIGHT), height=PREVIEW_HEIGHT)
    cameras = [turned(camera, angle_rad=angle, pivot_in_world=pivot(scene)) for angle in PREVIEW_ANGLES]
    with ThreadPoolExecutor() as pool:  # one view is shaded while another is rasterised
        views = list(pool.map(lambda camera: _view(scene, camera), cameras))
    box = _head_box(work["matte"].alpha, work["layers"].label)
    pictures = [work.pixels[box], work["color"].composite[box], *views]
    return contact_sheet(pictures, captions=PREVIEW_CAPTIONS, height=PREVIEW_HEIGHT)


def _head_box(alpha: NDArray[np.float32], label: NDArray[np.uint8]) -> tuple[slice, slice]:
    """The part of the photo that shows hair and face, with some air around it."""
    shown = (alpha > PREVIEW_ALPHA) | (label == FACE)
    sides = []
    for axis in (1, 0):
        within = np.flatnonzero(shown.any(axis=axis))
        air = round(PREVIEW_AIR * (within[-1] + 1 - within[0]))
        sides.append(slice(max(0, within[0] - air), within[-1] + 1 + air))
    return sides[0], sides[1]


def _view(scene: FlatScene, camera: Camera) -> NDArray[np.uint8]:
    seen = rasterise(scene, xy_from_world=camera.xy_from_world, width=camera.width, height=camera.height)
    return srgb_rgb(premultiplied_rgba(seen, style=PhotoStyle.soft()), background=BACKDROP)


def write_picture(pixels: np.ndarray, path: Path) -> None:
    """`pixels` (H, W, 3 | 4) uint8 sRGB as PNG, quickly: a sixth larger than it need be."""
    Image.fromarray(pixels).save(path, compress_level=1)
