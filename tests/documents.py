"""Documents for property tests: Hypothesis strategies over all records."""

import numpy as np
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

from tress.model.camera import Camera
from tress.model.document import Document
from tress.model.head import Head
from tress.model.mesh import Mesh
from tress.model.recipe import Recipe
from tress.model.strands import Strands
from tress.model.texture import Texture

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


def records():
    """Any record."""
    return st.one_of(strands(), meshes(), textures(), heads(), cameras(), recipes())


def documents(*, most=3):
    """Documents of any records."""
    return st.dictionaries(IDENTIFIERS, records(), max_size=most).map(Document)
