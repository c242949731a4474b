"""Documents for property tests: Hypothesis strategies over all records."""

import numpy as np
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

from tress.model.atlas import Atlas
from tress.model.attachment import Attachment
from tress.model.camera import Camera
from tress.model.document import Document
from tress.model.group import Group
from tress.model.head import Head
from tress.model.keyframes import FRAMES, Keyframes
from tress.model.mesh import Mesh
from tress.model.recipe import Recipe
from tress.model.strands import Strands
from tress.model.strip import Strip
from tress.model.texture import Texture
from tress.model.tracks import INTERPOLATIONS

NAMES = st.sampled_from(["id", "wind", "displayColor", "own_st", "st", "own_x", "normals", "color2", "widths"])
STRAND_NAMES = st.sampled_from(["group", "displayOpacity", "own_", "extent"])
IDENTIFIERS = st.sampled_from(["hair", "head", "photo", "recipe", "material", "_x1"])
TEXT = st.text(st.characters(exclude_categories=["Cs"], exclude_characters="\0"), max_size=8)


def floats32(shape, *, low=-(2.0**100), high=2.0**100):
    """float32 arrays of finite numbers, negative zero and subnormals among them."""
    return hnp.arrays(np.float32, shape, elements=st.floats(low, high, width=32))


def any_rows(count):
    """Arrays of `count` rows with any dtype and shape that attributes may have."""
    tail = st.sampled_from([(), (1,), (2,), (3,), (4,), (5,), (2, 2), (4, 4)])
    dtype = st.sampled_from(["f4", "f8", "i4", "i8", "u1", "?"])
    return st.tuples(dtype, tail).flatmap(
        lambda pair: hnp.arrays(
            np.dtype(pair[0]),
            (count, *pair[1]),
            elements={"allow_nan": False, "allow_infinity": False} if pair[0][0] == "f" else None,
        )
    )


def attributes(count, standard, names=NAMES):
    """Some attributes of free names, and some of the standard ones."""
    free = st.dictionaries(names, any_rows(count), max_size=2)
    return st.tuples(free, st.fixed_dictionaries({}, optional=standard)).map(lambda parts: parts[0] | parts[1])


@st.composite
def strands(draw, *, least=0, in_gamut=False):
    """Strands, at least `least` of them; `in_gamut` keeps colours in [0, 1], as formats with bytes need it."""
    lengths = draw(st.lists(st.integers(2, 5), min_size=least, max_size=4))
    count, total = len(lengths), sum(lengths)
    unit = {"low": 0, "high": 1}
    standard = {
        "color": floats32((total, 3), **(unit if in_gamut else {})),
        "alpha": floats32(total, **unit),
        "radius": floats32(total, low=0, high=1024),
    }
    on_strands = {"root_barycentric": floats32((count, 3)), "visible": hnp.arrays(bool, count)}
    point, strand = draw(attributes(total, standard)), draw(attributes(count, on_strands, STRAND_NAMES))
    return Strands(
        points=draw(floats32((total, 3))),
        offsets=np.cumsum([0, *lengths]),
        point_attributes=point,
        strand_attributes=strand,
    )


@st.composite
def textures(draw):
    """Small pictures, with and without alpha."""
    shape = draw(st.tuples(st.integers(1, 4), st.integers(1, 4), st.sampled_from([3, 4])))
    return Texture(pixels=draw(hnp.arrays(np.uint8, shape)))


@st.composite
def meshes(draw, *, textured=True):
    """Triangles that name some of a few vertices, some with texture coordinates, some of those with a picture."""
    vertices, faces = draw(st.integers(1, 6)), draw(st.integers(0, 4))
    uv = draw(st.none() | floats32((faces, 3, 2), low=-2, high=2))
    return Mesh(
        positions=draw(floats32((vertices, 3))),
        triangles=draw(hnp.arrays(np.int32, (faces, 3), elements=st.integers(0, vertices - 1))),
        corner_uv=uv,
        vertex_attributes=draw(attributes(vertices, {"scalp": floats32(vertices)})),
        texture=None if uv is None or not textured else draw(st.none() | textures()),
    )


@st.composite
def heads(draw):
    """Heads of any mesh."""
    return Head(
        mesh=draw(meshes()),
        shape=draw(floats32(draw(st.integers(0, 3)))),
        expression=draw(floats32(2)),
        landmarks_px=draw(st.none() | floats32((2, 3))),
    )


@st.composite
def cameras(draw):
    """Affine cameras, degenerate ones too."""
    rows = draw(hnp.arrays(np.float64, (2, 4), elements=st.floats(-1e9, 1e9)))
    size = st.integers(1, 2**31)
    return Camera(xy_from_world=np.vstack([rows, [0, 0, 0, 1]]), width=draw(size), height=draw(size))


def recipes():
    """Recipes with parameters of every kind."""
    value = st.booleans() | st.integers(-(2**63), 2**63 - 1) | st.floats(allow_nan=False) | TEXT
    parameters = st.dictionaries(TEXT.filter(bool), value, max_size=4)
    seed = st.integers(-(2**63), 2**63 - 1)
    return st.builds(Recipe, method=TEXT.filter(bool), seed=seed, parameters=parameters, inputs=parameters)


def floats64(shape, *, low=-1e6, high=1e6):
    """float64 arrays of finite numbers, negative zero and subnormals among them."""
    return hnp.arrays(np.float64, shape, elements=st.floats(low, high))


@st.composite
def knot_vectors(draw, count):
    """Knots of any degree over `count` control points, clamped or not, some of the inner ones repeated."""
    degree = draw(st.integers(1, min(7, count - 1)))
    steps = draw(st.lists(st.floats(0.125, 4), min_size=count + degree, max_size=count + degree))
    knots = np.concatenate([[draw(st.floats(-4, 4))], steps]).cumsum()
    if draw(st.booleans()):
        knots[: degree + 1], knots[count:] = knots[degree], knots[count]
    if count - degree > 2 and degree > 1 and draw(st.booleans()):
        knots[degree + 2] = knots[degree + 1]
    return knots


@st.composite
def attachments(draw, *, surface="head", triangles=1):
    """Roots anywhere on a surface."""
    first, second = draw(st.floats(0, 1)), draw(st.floats(0, 1))
    return Attachment(
        surface=surface,
        triangle=draw(st.integers(0, triangles - 1)),
        barycentric=[first, (1 - first) * second, (1 - first) * (1 - second)],
        offset=draw(floats64(3, low=-1, high=1)),
    )


@st.composite
def strips(draw, *, roots=st.none() | attachments(), groups=st.just(""), atlases=st.just("")):
    """Strips of any degree and net."""
    along, across = draw(st.integers(2, 6)), draw(st.integers(2, 4))
    return Strip(
        points=draw(floats64((along, across, 3))),
        weights=draw(floats64((along, across), low=1e-3, high=1e3)),
        knots_u=draw(knot_vectors(along)),
        knots_v=draw(knot_vectors(across)),
        root=draw(roots),
        group=draw(groups),
        atlas=draw(atlases),
        hidden=draw(st.booleans()),
        locked=draw(st.booleans()),
    )


@st.composite
def keyframes(draw, *, targets=st.just("strip"), net=None):
    """Keyframes of displacements, or of the positions of a net of the size `net`."""
    moments = draw(st.integers(1, 4))
    shape = net or (draw(st.integers(1, 3)), draw(st.integers(1, 3)))
    times = np.cumsum([draw(st.floats(-10, 10)), *(draw(st.floats(0.01, 2)) for _ in range(moments - 1))])
    interpolation = draw(st.sampled_from(INTERPOLATIONS))
    tangents = st.none() | floats64((moments, *shape, 3)) if interpolation == "cubic" else st.none()
    return Keyframes(
        target=draw(targets),
        times=times,
        values=draw(floats64((moments, *shape, 3))),
        tangents=draw(tangents),
        interpolation=interpolation,
        kind="position" if net else "displacement",
        frame="root" if net else draw(st.sampled_from(FRAMES)),
        loop=moments > 1 and draw(st.booleans()),
    )


@st.composite
def atlases(draw):
    """Small atlases with maps of several kinds."""
    height, width = draw(st.integers(1, 4)), draw(st.integers(1, 4))
    low = draw(floats32((draw(st.integers(1, 3)), 2), low=0, high=0.5))
    maps = {
        "normal": hnp.arrays(np.uint8, (height, width, 3)),
        "flow": floats32((height, width, 2)),
        "strand_id": hnp.arrays(np.int32, (height, width)),
    }
    return Atlas(
        color=draw(hnp.arrays(np.uint8, (height, width, 4))),
        regions=np.concatenate([low, low + np.float32(0.25)], axis=1),
        maps=draw(st.fixed_dictionaries({}, optional=maps)),
    )


@st.composite
def hairdos(draw):
    """A ground, groups, an atlas, strips on and off the ground and keyframes of each kind, by identifier."""
    ground = Mesh(
        positions=draw(floats64((1, 3), low=-1, high=1)) + 0.1 * np.eye(4, 3), triangles=[[0, 1, 2], [0, 2, 3]]
    )
    options = {
        "roots": st.none() | attachments(surface="ground", triangles=2),
        "groups": st.sampled_from(["", "outer_group", "inner_group"]),
        "atlases": st.just("atlas"),
    }
    first = draw(strips(**options))
    return {
        "ground": ground,
        "outer_group": Group(hidden=draw(st.booleans()), locked=draw(st.booleans())),
        "inner_group": Group(parent=draw(st.sampled_from(["", "outer_group"]))),
        "atlas": draw(atlases()),
        "strip": first,
        "strip_b": draw(strips(**options)),
        "motion": draw(keyframes(targets=st.sampled_from(["strip", "strip_b", "inner_group", "outer_group"]))),
        "pose": draw(keyframes(net=first.weights.shape)),
    }


def records():
    """Any record that names no other."""
    plain = strips(roots=st.none())
    return st.one_of(strands(), meshes(), textures(), heads(), cameras(), recipes(), atlases(), plain)


def documents(*, most=3):
    """Documents of any records, some with strips that hang together."""
    loose = st.dictionaries(IDENTIFIERS, records(), max_size=most)
    return st.tuples(loose, st.just({}) | hairdos()).map(lambda parts: Document(parts[0] | parts[1]))
