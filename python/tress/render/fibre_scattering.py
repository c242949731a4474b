"""How a hair scatters light: three lobes after Marschner et al. 2003, and a diffuse one for light that hair hands on.

A fibre is a curve; angles are measured against it. Theta is the inclination to the plane at right angles to the fibre
(0: at right angles), phi the azimuth around it. Light that is reflected at the surface (R) keeps its colour and comes
back at a slightly shifted inclination, since the scales of the cuticle tilt towards the root; light that passes through
(TT) leaves forward, coloured once; light reflected inside (TRT) comes back coloured twice, shifted the other way, which
is the second, coloured highlight. What many fibres hand on among each other is a uniform lobe in the hair's colour.

Chosen for pictures, not for measurement: the lobes' shares are constants instead of Fresnel's for each angle, the
azimuthal lobes have closed forms, and the foreshortening is that of the direction nearer to the plane instead of the
mean of both. With that the scattering function is reciprocal and no angle returns more energy than arrives.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.special import i0e

Array = np.ndarray[Any, Any]

_SURFACE = 0.07
_SHARES = {"through": 0.2, "inside": 0.25, "diffuse": 0.55}
_FORWARD = 3.0
_BACKWARD = 1.5


@dataclass(frozen=True)
class Fibre:
    """Longitudinal width of the surface highlight (standard deviation) and tilt of the cuticle, radians."""

    roughness_rad: float = 0.12
    tilt_rad: float = 0.05


def scattering(along: Array, *, to_light: Array, to_eye: Array, color: Array, fibre: Fibre) -> Array:
    """(K, 3) float32: light that leaves towards the eye for each unit of light that falls on the fibre, per steradian.

    `along` (K, 3) unit, root to tip; `to_light` and `to_eye` (3,) or (K, 3) unit; `color` (K, 3) linear. The radiance
    under a distant light of irradiance E is `scattering * cos(theta_light) * E`. Swapping light and eye changes
    nothing.
    """
    sin_light, sin_eye = _dot(along, to_light), _dot(along, to_eye)
    theta_light, theta_eye = np.arcsin(np.clip([sin_light, sin_eye], -1, 1))
    half = 0.5 * (theta_light + theta_eye)
    cos_phi = _cos_azimuth(along, to_light, to_eye, sin_light, sin_eye)
    inclined = 1 / np.maximum(1 - np.minimum(sin_light**2, sin_eye**2), 1e-6)
    width, tilt = fibre.roughness_rad, fibre.tilt_rad
    rest = 1 - _SURFACE
    surface = _SURFACE * _longitudinal(half + tilt, width) * np.sqrt(np.maximum(0.5 * (1 + cos_phi), 0)) / 4
    through = rest * _SHARES["through"] * _longitudinal(half - 0.5 * tilt, 0.5 * width) * _around(-cos_phi, _FORWARD)
    inside = rest * _SHARES["inside"] * _longitudinal(half - 1.5 * tilt, 2 * width) * _around(cos_phi, _BACKWARD)
    lobes = (surface * inclined)[:, None] + (through * inclined)[:, None] * color
    lobes = lobes + (inside * inclined)[:, None] * color**2 + rest * _SHARES["diffuse"] / np.pi**2 * color
    return lobes.astype(np.float32)


def _longitudinal(offset: Array, width: float) -> Array:
    """Gaussian of the half angle; 1 when integrated over the inclination of one of the two directions."""
    return np.exp(-0.5 * (offset / width) ** 2) / (2 * width * np.sqrt(2 * np.pi))


def _around(cosine: Array, concentration: float) -> Array:
    """Von Mises distribution of the azimuth about the direction where `cosine` is 1; 1 when integrated over a turn."""
    return np.exp(concentration * (cosine - 1)) / (2 * np.pi * i0e(concentration))


def _cos_azimuth(along: Array, to_light: Array, to_eye: Array, sin_light: Array, sin_eye: Array) -> Array:
    cosines = np.sqrt(np.maximum((1 - sin_light**2) * (1 - sin_eye**2), 1e-12))
    return np.clip((_dot(np.broadcast_to(to_light, along.shape), to_eye) - sin_light * sin_eye) / cosines, -1, 1)


def _dot(a: Array, b: Array) -> Array:
    return np.einsum("kc,kc->k", a, np.broadcast_to(b, a.shape))
