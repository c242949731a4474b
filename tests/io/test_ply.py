"""PLY: strands back to the bit, colours to the byte, damaged files refused."""

import numpy as np
import pytest
from documents import strands
from hypothesis import given, settings
from hypothesis import strategies as st

from tress.base.errors import FormatError
from tress.io.formats.ply import decode_ply, encode_ply
from tress.model.strands import Strands

QUICK = settings(max_examples=60, deadline=None)
HAIR = Strands(
    points=np.arange(15).reshape(5, 3),
    offsets=[0, 2, 5],
    point_attributes={"radius": np.full(5, 0.5), "alpha": np.ones(5), "color": np.eye(5, 3)},
)
WORDS = [b"ply", b"vertex", b"5", b"edge", b"float", b"x", b"strand", b"int", b"property", b"format", b"end_header"]


def test_the_header_says_what_follows():
    text, _, body = encode_ply(HAIR).partition(b"end_header\n")
    assert text.startswith(b"ply\nformat binary_little_endian 1.0\n")
    assert b"element vertex 5\nproperty float x\n" in text
    assert b"element edge 3\nproperty int vertex1\n" in text
    assert len(body) == 5 * (12 + 4 + 4 + 4) + 3 * 8
    assert np.frombuffer(body, "<i4", 6, 5 * 24).tolist() == [0, 1, 2, 3, 3, 4]


@QUICK
@given(strands(in_gamut=True))
def test_strands_come_back(hair):
    found = decode_ply(encode_ply(hair))
    assert found.points.tobytes() == hair.points.tobytes()
    assert found.offsets.tolist() == hair.offsets.tolist()
    assert encode_ply(found) == encode_ply(hair)


@QUICK
@given(strands(least=1), st.data())
def test_no_truncated_file_is_taken(hair, data):
    whole = encode_ply(hair)
    with pytest.raises(FormatError):
        decode_ply(whole[: data.draw(st.integers(0, len(whole) - 1))])


@settings(max_examples=200, deadline=None)
@given(st.sampled_from(WORDS), st.sampled_from([*WORDS, b"list uchar", b"-1", b"9" * 20, b"\xff", b""]))
def test_any_damage_is_refused_or_gives_strands(old, new):
    try:
        assert isinstance(decode_ply(encode_ply(HAIR).replace(old, new)), Strands)
    except FormatError as error:
        assert "\n" not in str(error)


@settings(max_examples=100, deadline=None)
@given(st.binary(max_size=200))
def test_noise_is_refused(noise):
    for data in (noise, b"ply\nformat binary_little_endian 1.0\n" + noise + b"\nend_header\n"):
        with pytest.raises(FormatError):
            decode_ply(data)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        (b"binary_little_endian", b"ascii", "not binary little-endian"),
        (b"element vertex 5", b"element vertex 50", "ends within its vertex elements"),
        (b"element vertex 5", b"element vertex five", "has a wrong line: 'element vertex five'"),
        (b"property int strand", b"property int root", "no vertices with x, y, z and strand"),
        (b"property float y", b"property float x", "names a property twice"),
        (b"property float x", b"property list uchar int x", "that strands do not have"),
        (np.float32(14).tobytes(), np.float32(np.nan).tobytes(), "not finite"),
    ],
)
def test_wrong_files_are_refused_in_a_sentence(old, new, message):
    data = encode_ply(HAIR)
    assert old in data
    with pytest.raises(FormatError, match=message):
        decode_ply(data.replace(old, new))
