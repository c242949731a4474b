"""Clumps along the surfaces of another program's file."""

from dataclasses import replace

from tress.base.errors import InputError
from tress.base.report import Report
from tress.edit.add import add
from tress.methods.cartoon.cartoon_params import CartoonParams
from tress.methods.cartoon.face_frame import LEAF
from tress.methods.cartoon.key_hairs import key_hairs
from tress.methods.cartoon.layer import SURFACES
from tress.methods.cartoon.params import ClumpParams, KeyHairParams
from tress.methods.cartoon.tuft import Tuft, clump_surface, surface_patch
from tress.methods.cartoon.variation import ClumpVariation
from tress.methods.strips.bald_document import HEAD, bald_document
from tress.methods.strips.edited import edited
from tress.methods.strips.layers import HAIR
from tress.model.document import Document
from tress.model.group import Group
from tress.model.keyframes import Keyframes
from tress.model.recipe import Recipe, flat_parameters
from tress.model.record import Record
from tress.model.strip import Strip
from tress.model.strip_set import strip_set

HAIRS = 12
FLATNESS = 0.45


def hairdo_of_surfaces(
    surfaces: Document,
    *,
    params: CartoonParams | None = None,
    head: Document | None = None,
    report: Report | None = None,
) -> Document:
    """A document with `head` and clumps along every strip of `surfaces`, each in a group of its own within `hair`.

    Surfaces keep their names and keyframes, in the hidden group `surfaces`; clumps are wide enough to touch halfway,
    run along u from its first parameter, and are kept off the head. Surfaces are in the head frame: metres, Y up,
    facing +Z. Raises `InputError` where there is no surface, or one is called like a record of the head.
    """
    settings, report = params or CartoonParams(), report or Report()
    strips = surfaces.of_type(Strip)
    if not strips:
        raise InputError("There is no NURBS surface to make clumps of; strips or NURBS patches were expected.")
    document = head or bald_document()
    keyframes = {name: item for name, item in surfaces.of_type(Keyframes).items() if item.target in strips}
    records: dict[str, Record] = {HAIR: Group(), SURFACES: Group(hidden=True)}
    records |= {name: _as_surface(surfaces, name) for name in strips} | keyframes
    with report.stage("grow"):
        document = edited(document, add, records=records)
        for index, name in enumerate(strips):
            group = f"{name}_clumps"
            document = edited(document, add, records={group: Group(parent=HAIR)})
            tuft = tuft_for(document, name, settings, seed=settings.seed + index)
            document = edited(document, clump_surface, surface=name, into=group, tuft=tuft, head=HEAD)
        report.number("clumps", settings.count(HAIRS) * len(strips))
    recipe = Recipe(method="cartoon surfaces", seed=settings.seed, parameters=flat_parameters(settings))
    return edited(document, add, records={"recipe": recipe})


def tuft_for(document: Document, surface: str, params: CartoonParams, *, seed: int) -> Tuft:
    """Clumps as wide as half the way between the key hairs of a surface, halfway along, and a fifth over."""
    hairs = KeyHairParams(hairs=params.count(HAIRS), jitter=0.3, seed=seed)
    found = key_hairs(surface_patch(document, surface, time=None), params=replace(hairs, jitter=0.0)).points
    middle = found[:, found.shape[1] // 2]
    apart = ((middle[1:] - middle[:-1]) ** 2).sum(axis=1) ** 0.5
    wide = max(0.6 * float(apart.mean()), 1e-4)
    clump = ClumpParams(vertical_radius=FLATNESS * wide, horizontal_radius=wide, pointiness=params.pointiness)
    variation = ClumpVariation(radius_low=0.9, radius_high=1.15, length_low=0.88, seed=seed)
    return Tuft(hairs=hairs, clump=clump, shape=LEAF, variation=variation)


def _as_surface(document: Document, name: str) -> Strip:
    """The strip in the head frame, by itself."""
    strip = strip_set(document, [name]).records[0]
    net = surface_patch(document, name, time=None).points
    return replace(strip, points=net, root=None, group=SURFACES, atlas="", region=0)
