"""The order of the stages: photograph in, reconstruction out."""

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from tress.base.color import linear_to_srgb8
from tress.base.errors import NoHairError
from tress.base.report import Report
from tress.image.labels import BODY, FACE
from tress.image.layers import Layers
from tress.image.matte import Matte
from tress.image.orient import OrientationMap, brightness
from tress.image.trace import TracedStrands
from tress.io.stage_cache import StageCache
from tress.methods.portrait.corrections import Corrections
from tress.methods.portrait.depth import StrandDepths, depth
from tress.methods.portrait.document import portrait_document
from tress.methods.portrait.grow import GrownHair, grow
from tress.methods.portrait.head import PortraitHead, head_stage
from tress.methods.portrait.layers import has_hair, layers_stage
from tress.methods.portrait.matte import matte_stage
from tress.methods.portrait.orientation import orientation
from tress.methods.portrait.params import PortraitParams
from tress.methods.portrait.pictures import (
    depth_colors,
    layers_picture,
    matte_picture,
    mesh_picture,
    orientation_picture,
    strands_picture,
)
from tress.methods.portrait.stage import Stage, Work, fingerprints, run_stages
from tress.methods.portrait.trace import trace
from tress.methods.portrait.volume import HairVolume, volume
from tress.methods.portrait.volume_picture import volume_picture
from tress.model.document import Document


@dataclass(frozen=True)
class Reconstruction:
    """The finished `work` with the result of every stage, its `document`, and their fingerprints."""

    work: Work
    document: Document
    fingerprints: dict[str, str]


def reconstruct(
    pixels: NDArray[np.uint8],
    *,
    alpha: NDArray[np.uint8] | None = None,
    params: PortraitParams | None = None,
    corrections: Corrections | None = None,
    start_from: str | None = None,
    cache: StageCache | None = None,
    report: Report | None = None,
) -> Reconstruction:
    """Hair from one portrait photograph `pixels` (H, W, 3) uint8 sRGB, upright.

    `alpha` (H, W) uint8 says where the person is, if the photo is a cut-out. With `start_from`, the results of the
    stages before it come from `cache`. Raises `NoFaceError`, `NoHairError`, and `InputError` where cache and inputs do
    not fit together.
    """
    work = Work(pixels, alpha, params or PortraitParams(), corrections or Corrections())
    done = run_stages(STAGES, work, start_from=start_from, cache=cache, report=report or Report())
    return Reconstruction(done, portrait_document(done), fingerprints(STAGES, work))


def _head(work: Work, report: Report) -> PortraitHead:
    return head_stage(
        work.pixels,
        alpha=work.alpha,
        face=work.corrections.face,
        landmarks=work.corrections.landmarks,
        params=work.params.head,
        report=report,
    )


def _head_picture(work: Work) -> NDArray[np.uint8]:
    head: PortraitHead = work["head"]
    matrix = head.fitted.xy_from_view
    xy_px = head.fitted.positions_in_view @ matrix[:2, :3].T + matrix[:2, 3]
    return mesh_picture(work.pixels, xy_px=xy_px, triangles=head.fitted.triangles, landmarks_px=head.landmarks.points)


def _layers(work: Work, report: Report) -> Layers:
    head: PortraitHead = work["head"]
    layers = layers_stage(
        work.pixels,
        landmarks=head.landmarks,
        person=head.person,
        strokes=work.corrections.strokes,
        params=work.params.layers,
        report=report,
    )
    if not has_hair(layers, landmarks=head.landmarks):
        raise NoHairError("No hair was found in the photo; if there is some, mark it with --strokes.")
    return layers


def _layers_picture(work: Work) -> NDArray[np.uint8]:
    return layers_picture(work.pixels, label=work["layers"].label)


def _matte(work: Work, report: Report) -> Matte:
    return matte_stage(
        work.pixels,
        layers=work["layers"],
        landmarks=work["head"].landmarks,
        strokes=work.corrections.strokes,
        params=work.params.matte,
        report=report,
    )


def _matte_picture(work: Work) -> NDArray[np.uint8]:
    return matte_picture(work["matte"].alpha, foreground=work["matte"].foreground)


def _orientation(work: Work, report: Report) -> OrientationMap:
    return orientation(work.pixels, alpha=work["matte"].alpha, params=work.params.orientation, report=report)


def _orientation_picture(work: Work) -> NDArray[np.uint8]:
    found: OrientationMap = work["orientation"]
    return orientation_picture(found.angle, confidence=found.confidence)


def _trace(work: Work, report: Report) -> TracedStrands:
    matte: Matte = work["matte"]
    return trace(
        work["orientation"], alpha=matte.alpha, foreground=matte.foreground, params=work.params.trace, report=report
    )


def _trace_picture(work: Work) -> NDArray[np.uint8]:
    traced: TracedStrands = work["trace"]
    colors = linear_to_srgb8(traced.color)
    return strands_picture(traced.points, offsets=traced.offsets, colors=colors, shape=work.pixels.shape[:2])


def _depth(work: Work, report: Report) -> StrandDepths:
    label = work["layers"].label
    return depth(
        work["trace"],
        head=work["head"].fitted,
        alpha=work["matte"].alpha,
        solid=(label == FACE) | (label == BODY),
        params=work.params.depth,
        depth_strokes=work.corrections.depth_strokes,
        report=report,
    )


def _depth_picture(work: Work) -> NDArray[np.uint8]:
    traced: TracedStrands = work["trace"]
    z = work["depth"].z
    return strands_picture(
        traced.points, offsets=traced.offsets, colors=depth_colors(z), shape=work.pixels.shape[:2], depth=z
    )


def _volume(work: Work, report: Report) -> HairVolume:
    return volume(
        work["depth"],
        traced=work["trace"],
        brightness=brightness(work.pixels),
        alpha=work["matte"].alpha,
        head=work["head"].fitted,
        params=work.params.volume,
        report=report,
    )


def _volume_picture(work: Work) -> NDArray[np.uint8]:
    return volume_picture(work["volume"])


def _strands(work: Work, report: Report) -> GrownHair:
    matte: Matte = work["matte"]
    return grow(
        work["volume"],
        foreground=matte.foreground,
        alpha=matte.alpha,
        head=work["head"].fitted,
        params=work.params.strands,
        seed=work.params.seed,
        report=report,
    )


def _strands_picture(work: Work) -> NDArray[np.uint8]:
    grown: GrownHair = work["strands"]
    matrix = work["head"].fitted.xy_from_view
    xy_px = grown.points @ matrix[:2, :3].T + matrix[:2, 3]
    return strands_picture(
        xy_px,
        offsets=grown.offsets,
        colors=linear_to_srgb8(grown.color),
        shape=work.pixels.shape[:2],
        depth=grown.points[:, 2],
    )


STAGES: Final[tuple[Stage, ...]] = (
    Stage("head", _head, _head_picture, corrections=("face", "landmarks")),
    Stage("layers", _layers, _layers_picture, corrections=("strokes",)),
    Stage("matte", _matte, _matte_picture),
    Stage("orientation", _orientation, _orientation_picture),
    Stage("trace", _trace, _trace_picture),
    Stage("depth", _depth, _depth_picture, corrections=("depth_strokes",)),
    Stage("volume", _volume, _volume_picture),
    Stage("strands", _strands, _strands_picture),
)
"""Every stage in order; a new one is its file and a line here."""
