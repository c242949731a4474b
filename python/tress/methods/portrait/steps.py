"""The stages as the pipeline runs them: what each reads of the work, and the picture that shows its result."""

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
from tress.methods.portrait import pictures
from tress.methods.portrait.color import ColoredHair, color_stage
from tress.methods.portrait.depth import StrandDepths, depth
from tress.methods.portrait.document import bare_scene, photo_camera
from tress.methods.portrait.grow import GrownHair, grow
from tress.methods.portrait.head import PortraitHead, head_stage
from tress.methods.portrait.inside_outline import before_hidden
from tress.methods.portrait.layers import has_hair, layers_stage
from tress.methods.portrait.matte import matte_stage
from tress.methods.portrait.off_bare_skin import bare_skin
from tress.methods.portrait.orientation import orientation
from tress.methods.portrait.stage import Work
from tress.methods.portrait.trace import trace
from tress.methods.portrait.volume import HairVolume, volume
from tress.methods.portrait.volume_picture import volume_picture

Picture = NDArray[np.uint8]


def run_head(work: Work, report: Report) -> PortraitHead:
    """Landmarks, person mask and fitted head."""
    return head_stage(
        work.pixels,
        alpha=work.alpha,
        face=work.corrections.face,
        landmarks=work.corrections.landmarks,
        params=work.params.head,
        report=report,
    )


def show_head(work: Work) -> Picture:
    """The fitted mesh and the landmarks over the photo."""
    head: PortraitHead = work["head"]
    return pictures.mesh_picture(
        work.pixels,
        xy_px=head.fitted.project(head.fitted.positions_in_view),
        triangles=head.fitted.triangles,
        landmarks_px=head.landmarks.points,
    )


def run_layers(work: Work, report: Report) -> Layers:
    """Hair, face, body, background. Raises `NoHairError` where there is next to no hair."""
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


def show_layers(work: Work) -> Picture:
    """The layers in colour over the photo."""
    return pictures.layers_picture(work.pixels, label=work["layers"].label)


def run_matte(work: Work, report: Report) -> Matte:
    """Alpha and true colour of the hair."""
    return matte_stage(
        work.pixels,
        layers=work["layers"],
        landmarks=work["head"].landmarks,
        strokes=work.corrections.strokes,
        params=work.params.matte,
        report=report,
    )


def show_matte(work: Work) -> Picture:
    """Alpha, and the hair on grey."""
    return pictures.matte_picture(work["matte"].alpha, foreground=work["matte"].foreground)


def run_orientation(work: Work, report: Report) -> OrientationMap:
    """Which way the hair runs, and how surely."""
    return orientation(work.pixels, alpha=work["matte"].alpha, params=work.params.orientation, report=report)


def show_orientation(work: Work) -> Picture:
    """Direction as hue, confidence as brightness."""
    found: OrientationMap = work["orientation"]
    return pictures.orientation_picture(found.angle, confidence=found.confidence)


def run_trace(work: Work, report: Report) -> TracedStrands:
    """Strands in the picture."""
    matte: Matte = work["matte"]
    return trace(
        work["orientation"], alpha=matte.alpha, foreground=matte.foreground, params=work.params.trace, report=report
    )


def show_trace(work: Work) -> Picture:
    """The traced strands in their colours."""
    traced: TracedStrands = work["trace"]
    return pictures.strands_picture(
        traced.points, offsets=traced.offsets, colors=linear_to_srgb8(traced.color), shape=work.pixels.shape[:2]
    )


def run_depth(work: Work, report: Report) -> StrandDepths:
    """Depth of every traced vertex."""
    return depth(
        work["trace"],
        head=work["head"].fitted,
        alpha=work["matte"].alpha,
        solid=np.isin(work["layers"].label, (BODY, FACE)),
        depth_strokes=work.corrections.depth_strokes,
        params=work.params.depth,
        report=report,
    )


def show_depth(work: Work) -> Picture:
    """The traced strands, near as bright."""
    traced: TracedStrands = work["trace"]
    z = work["depth"].z
    return pictures.strands_picture(
        traced.points, offsets=traced.offsets, colors=pictures.depth_colors(z), shape=work.pixels.shape[:2], depth=z
    )


def run_volume(work: Work, report: Report) -> HairVolume:
    """Front, middle and back of the hair, and directions between them."""
    return volume(
        work["depth"],
        traced=work["trace"],
        brightness=brightness(work.pixels),
        alpha=work["matte"].alpha,
        head=work["head"].fitted,
        params=work.params.volume,
        report=report,
    )


def show_volume(work: Work) -> Picture:
    """Front, middle and back surface, and slices through the directions."""
    return volume_picture(work["volume"])


def run_strands(work: Work, report: Report) -> GrownHair:
    """Strands in space."""
    matte: Matte = work["matte"]
    return grow(
        work["volume"],
        foreground=matte.foreground,
        alpha=matte.alpha,
        before=before_hidden(matte.alpha, work["layers"].label),
        skin=bare_skin(matte.alpha, work["layers"].label),
        head=work["head"].fitted,
        params=work.params.strands,
        seed=work.params.seed,
        report=report,
    )


def show_strands(work: Work) -> Picture:
    """The strands from the photo's view, near over far, in the colours that they grew with."""
    grown: GrownHair = work["strands"]
    drawn, offsets = pictures.thinned(grown.offsets)
    points = grown.points[drawn]
    return pictures.strands_picture(
        work["head"].fitted.project(points),
        offsets=offsets,
        colors=linear_to_srgb8(grown.color[drawn]),
        shape=work.pixels.shape[:2],
        depth=points[:, 2],
    )


def run_color(work: Work, report: Report) -> ColoredHair:
    """Colours with which the hair looks as in the photo."""
    fitted = work["head"].fitted
    camera = photo_camera(fitted, shape=work.pixels.shape[:2])
    return color_stage(
        bare_scene(fitted, grown=work["strands"]),
        pixels=work.pixels,
        matte=work["matte"],
        label=work["layers"].label,
        on_skin=work["strands"].on_skin,
        shown=work["strands"].shown,
        xy_from_world=camera.xy_from_world,
        params=work.params.color,
        report=report,
    )


def show_color(work: Work) -> Picture:
    """Beside each other: the photo, and the rendered hair over its other layers."""
    return np.hstack([work.pixels, work["color"].composite])
