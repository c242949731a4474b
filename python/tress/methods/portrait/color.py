"""The stage `color`: opacities and colours of the strands with which the hair looks as in the photograph."""

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray
from skimage.metrics import structural_similarity

from tress.base.color import linear_to_srgb8, srgb_to_linear
from tress.base.params import Params, param
from tress.base.report import Report
from tress.image.labels import BODY, FACE
from tress.image.matte import Matte
from tress.kernel import raster
from tress.kernel.raster import strand_picture
from tress.methods.portrait.inside_outline import before_hidden, near_background
from tress.methods.portrait.opacity import with_fitted_opacity
from tress.methods.portrait.rim_tint import with_rim_tint
from tress.model.evaluate import Scene
from tress.render.fit_colors import fit_vertex_colors
from tress.render.flat_scene import flat_scene
from tress.render.gbuffer import GBuffer, hair_coverage
from tress.render.picture import over, srgb_rgba

_MOSTLY_HAIR = 0.5
_BESIDE = 0.02
"""Width of the band beside the hair that is compared with the photo as well, as part of the hair's diagonal."""
_NO_HAIR = 0.02
_LEAST_COVERAGE = 0.05
_BRIGHTEST = 1.5
_RELATIVE = 4.0
"""How much faster the reach around the matte's colour grows with that colour than it starts."""
_LUMA = np.array([0.299, 0.587, 0.114])
_ROOM_PX = 16
_RIM = 0.006
"""Metres from the outline within which hidden hair keeps its own colours."""

Box = tuple[slice, slice]
"""Rows and columns of a picture."""


@dataclass(frozen=True)
class ColorParams(Params):
    """Settings of the fit of opacities and colours, and of the picture that it is held against."""

    iterations: int = param(12, low=0, high=200, doc="Rounds of the fit; 0 keeps the colours that strands grew with.")
    opacity_rounds: int = param(1, low=0, high=10, doc="Rounds in which opacities are fitted to the matte.")
    own_color: float = param(
        0.08, low=0.0, high=10.0, doc="How far colours may stray from the matte's, so that the picture is the photo's."
    )
    rim_tint: float = param(
        0.55,
        low=0.0,
        high=1.0,
        doc="How far the colour of soft rims is drawn towards that of the solid hair near them.",
    )
    least_alpha: float = param(0.1, low=0.0, high=1.0, doc="Pixels with less hair than this say nothing on its colour.")
    min_width_px: float = param(1.0, low=0.1, high=8.0, unit="px", doc="Least width of a strand in pictures.")
    strand_bias: float = param(0.002, low=0.0, high=0.02, unit="m", doc="How far hair may lie in the skin and show.")


@dataclass(frozen=True)
class ColoredHair:
    """The hair as the photo shows it.

    `color` (N, 3) float32 linear and `alpha` (N,) float32 in [0, 1] of every vertex; `rerender` (H, W, 4) uint8
    sRGB, straight alpha, the hair alone from the photo's view; `composite` (H, W, 3) uint8 sRGB, the same over the
    photo's other layers; how like the photo that is where there is hair, `psnr` in dB and `ssim`.
    """

    color: NDArray[np.float32]
    alpha: NDArray[np.float32]
    rerender: NDArray[np.uint8]
    composite: NDArray[np.uint8]
    psnr: float
    ssim: float


def color_stage(
    scene: Scene,
    *,
    pixels: NDArray[np.uint8],
    matte: Matte,
    label: NDArray[np.uint8],
    on_skin: NDArray[np.bool_],
    shown: NDArray[np.bool_],
    xy_from_world: NDArray[np.float64],
    params: ColorParams,
    report: Report,
) -> ColoredHair:
    """Colours for the strands of `scene` (with the head, which hides hair) seen by the photo's camera (3, 4).

    `label` (H, W): the layers, of which face and body may be before hair that the matte does not show. `on_skin` (N,):
    points of hidden hair on the head's skin, which stays opaque. `shown` (N,): points that the photo shows, whose
    colours are fitted; hidden hair near the outline keeps its own, lest it take on the background's at the rim.
    """
    covered = np.isin(label, (BODY, FACE)) & (matte.alpha < _NO_HAIR)
    gbuffer = with_fitted_opacity(
        flat_scene(scene),
        matte_alpha=matte.alpha,
        covered=covered,
        on_skin=on_skin,
        xy_from_world=xy_from_world,
        strand_bias_m=params.strand_bias,
        min_width_px=params.min_width_px,
        rounds=params.opacity_rounds,
    )
    report.progress(0.4)
    coverage = hair_coverage(gbuffer)
    box = _box((matte.alpha > 0) | (coverage > 0))
    color = fit_vertex_colors(
        gbuffer,
        colors=gbuffer.scene.color,
        target_linear=_target(pixels, matte, near_background(label), coverage, box, params),
        weight=np.where(matte.alpha > params.least_alpha, coverage, 0),
        freedom=_freedom(gbuffer, shown, matte.alpha, label),
        iterations=params.iterations,
    )
    hair = strand_picture(gbuffer.fragments, colors=color)
    hair[covered] = 0
    return _compared(hair, color, gbuffer.scene.alpha, pixels, matte, box, report)


def _freedom(
    gbuffer: GBuffer, shown: NDArray[np.bool_], alpha: NDArray[np.float32], label: NDArray[np.uint8]
) -> NDArray[np.float32]:
    """(N,): 1 for points whose colours may be fitted: those that the photo shows, and hidden ones far from its rim."""
    scale = float(np.linalg.norm(gbuffer.xy_from_world[0, :3]))
    before = before_hidden(alpha, label).astype(np.uint8)
    inner = cv2.distanceTransform(before, cv2.DIST_L2, 3) > _RIM * scale
    screen = raster.project(gbuffer.scene.points, xy_from_points=gbuffer.xy_from_world)
    height, width = alpha.shape
    column, row = (np.clip(screen[:, k].astype(np.int64), 0, side - 1) for k, side in ((0, width), (1, height)))
    return (shown | inner[row, column]).astype(np.float32)


def _box(where: NDArray[np.bool_]) -> Box:
    """The part of the picture that holds all pixels `where` (H, W) there is hair, with room for windows around it."""
    sides = []
    for axis in (1, 0):
        within = np.flatnonzero(where.any(axis=axis))
        low, high = (within[0], within[-1] + 1) if len(within) else (0, 1)
        sides.append(slice(max(0, low - _ROOM_PX), high + _ROOM_PX))
    return sides[0], sides[1]


def _target(
    pixels: NDArray[np.uint8],
    matte: Matte,
    outer: NDArray[np.bool_],
    coverage: NDArray[np.float32],
    box: Box,
    params: ColorParams,
) -> NDArray[np.float32]:
    """Colour (H, W, 3) that the strands should show, linear; 0 outside the `box`.

    Where there is mostly hair: the colour with which the strands, covering as much of the pixel as they do, give the
    photo's pixel over the other layers, but near the matte's own colour of hair, lest the background tint it. At soft
    edges: the matte's colour. Rims have the tint of the hair near them, and those `outer` (H, W) ones, which are next
    to the background, its brightness.
    """
    own, seen = matte.foreground[box], coverage[box][..., None]
    exact = (srgb_to_linear(pixels[box]) - (1 - seen) * matte.background[box]) / np.maximum(seen, _LEAST_COVERAGE)
    reach = params.own_color * (1 + _RELATIVE * own)
    near = np.clip(own + np.clip(exact - own, -reach, reach), 0, _BRIGHTEST)
    target = np.zeros(pixels.shape, np.float32)
    wanted = np.where((matte.alpha[box] > _MOSTLY_HAIR)[..., None], near, own)
    target[box] = with_rim_tint(
        wanted, foreground=own, alpha=matte.alpha[box], outer=outer[box], amount=params.rim_tint
    )
    return target


def _compared(
    hair: NDArray[np.float32],
    color: NDArray[np.float32],
    alpha: NDArray[np.float32],
    pixels: NDArray[np.uint8],
    matte: Matte,
    box: Box,
    report: Report,
) -> ColoredHair:
    """`hair` (H, W, 4), premultiplied, over the photo's other layers, and how like the photo that is."""
    composite, rerender = pixels.copy(), np.zeros((*pixels.shape[:2], 4), np.uint8)
    composite[box] = linear_to_srgb8(over(hair[box], background=matte.background[box]))
    rerender[box] = srgb_rgba(hair[box])
    mask = matte.alpha[box] > _MOSTLY_HAIR
    psnr, ssim = _likeness(composite[box], pixels[box], mask)
    report.number("psnr_db", round(psnr, 2))
    report.number("ssim", round(ssim, 4))
    beside = _beside(mask, around=_BESIDE * float(np.hypot(*mask.shape)))
    report.number("psnr_beside_db", round(_likeness(composite[box], pixels[box], beside)[0], 2))
    report.number("covered", round(float(hair[box][..., 3][mask].mean()), 4) if mask.any() else 0.0)
    return ColoredHair(color, alpha, rerender, composite, psnr, ssim)


def _beside(mask: NDArray[np.bool_], *, around: float) -> NDArray[np.bool_]:
    """The pixels outside the hair within `around` pixels of it, where hair that spills would be seen."""
    return ~mask & (cv2.distanceTransform((~mask).astype(np.uint8), cv2.DIST_L2, 3) <= around)


def _likeness(picture: NDArray[np.uint8], photo: NDArray[np.uint8], mask: NDArray[np.bool_]) -> tuple[float, float]:
    """PSNR in dB of the colours, and mean SSIM of the luma (Wang et al. 2004, Gaussian window), where `mask` is."""
    if not mask.any():
        return 0.0, 0.0
    error = (picture[mask].astype(np.float64) - photo[mask]) ** 2
    likeness = structural_similarity(
        picture @ _LUMA,
        photo @ _LUMA,
        data_range=255,
        gaussian_weights=True,
        sigma=1.5,
        use_sample_covariance=False,
        full=True,
    )[-1]
    return float(10 * np.log10(255**2 / max(error.mean(), 1e-9))), float(np.asarray(likeness)[mask].mean())
