"""`.hair` files: bytes as the format lays them out, strands back to the bit, damaged files refused."""

import struct

import numpy as np
import pytest
from documents import strands
from hypothesis import given, settings
from hypothesis import strategies as st

from tress.base.errors import FormatError, InputError
from tress.io.formats.hair import decode_hair, encode_hair
from tress.model.strands import Strands

QUICK = settings(max_examples=60, deadline=None)
HAIR = Strands(
    points=np.arange(15).reshape(5, 3),
    offsets=[0, 2, 5],
    point_attributes={"radius": np.full(5, 0.5), "alpha": np.full(5, 0.75), "color": np.full((5, 3), 0.25)},
)


def test_the_bytes_are_those_of_the_format():
    data = encode_hair(HAIR)
    assert data[:4] == b"HAIR"
    assert struct.unpack_from("<3I", data, 4) == (2, 5, 1 | 2 | 4 | 8 | 16)
    assert struct.unpack_from("<2H", data, 128) == (1, 2)
    assert np.array_equal(np.frombuffer(data, "<f4", 15, 132), np.arange(15))
    assert np.array_equal(np.frombuffer(data, "<f4", 5, 192), np.full(5, 1.0))  # thickness is diameter
    assert np.array_equal(np.frombuffer(data, "<f4", 5, 212), np.full(5, 0.25))  # transparency
    assert np.array_equal(np.frombuffer(data, "<f4", 15, 232), np.full(15, 0.25))
    assert len(data) == 292


@QUICK
@given(strands())
def test_strands_come_back(hair):
    found = decode_hair(encode_hair(hair))
    assert found.points.tobytes() == hair.points.tobytes()
    assert found.offsets.tolist() == hair.offsets.tolist()
    for name in ("color", "radius"):
        assert (name in found.point_attributes) == (name in hair.point_attributes)
        if name in hair.point_attributes:
            assert found.point_attributes[name].tobytes() == hair.point_attributes[name].tobytes()


@QUICK
@given(strands(), st.data())
def test_no_truncated_file_is_taken(hair, data):
    whole = encode_hair(hair)
    cut = data.draw(st.integers(0, len(whole) - 1))
    with pytest.raises(FormatError):
        decode_hair(whole[:cut])


@settings(max_examples=200, deadline=None)
@given(st.integers(0, 291), st.binary(min_size=1, max_size=4))
def test_any_damage_is_refused_or_gives_strands(place, damage):
    data = bytearray(encode_hair(HAIR))
    data[place : place + len(damage)] = damage
    try:
        assert isinstance(decode_hair(bytes(data)), Strands)
    except FormatError as error:
        assert "\n" not in str(error)


@settings(max_examples=100, deadline=None)
@given(st.binary(max_size=300))
def test_noise_is_refused(noise):
    for data in (noise, b"HAIR" + noise):
        with pytest.raises(FormatError):
            decode_hair(data)


@pytest.mark.parametrize("place", [192, 212, 232])
@pytest.mark.parametrize("number", [0x7F810000, 0x7FC00000, 0xFF800000])
def test_attributes_that_are_no_numbers_are_refused(place, number):
    data = bytearray(encode_hair(HAIR))
    struct.pack_into("<I", data, place, number)
    with pytest.raises(FormatError, match="not finite"):
        decode_hair(bytes(data))


def header(strand_count, point_count, bits, *, segments=0):
    return struct.pack("<4s4I5f88s", b"HAIR", strand_count, point_count, bits, segments, 0, 0, 0, 0, 0, b"")


@pytest.mark.parametrize(
    ("data", "message"),
    [
        (b"", "has 0 bytes; a .hair file has a header of 128"),
        (b"RIAH" + bytes(124), "begins with b'RIAH'"),
        (header(0, 0, 1), "holds no points"),
        (header(2**32 - 1, 2**32 - 1, 31), "its header announces"),
        (header(0, 2, 2) + bytes(24), "announces 2 points, but its strands have 0"),
        (header(1, 2, 2, segments=2) + bytes(24), "announces 2 points, but its strands have 3"),
        (header(1, 2, 2, segments=0) + bytes(24), "Strand 0 of the .hair file has no segment"),
        (header(2, 3, 3) + struct.pack("<2H", 2, 0) + bytes(36), "Strand 1 of the .hair file has no segment"),
        (header(9, 2, 2, segments=1) + bytes(24), "announces 9 strands of 2 points"),
        (header(1, 2, 2, segments=1) + bytes(25), "has 153 bytes; its header announces 152"),
        (header(1, 2, 2, segments=1) + struct.pack("<6f", 0, 0, 0, 0, 0, np.nan), "not finite"),
        (header(1, 2, 2, segments=1) + struct.pack("<6f", 0, 0, 0, 0, 0, np.inf), "not finite"),
    ],
)
def test_wrong_files_are_refused_in_a_sentence(data, message):
    with pytest.raises(FormatError, match=message):
        decode_hair(data)


def test_default_segments_are_read():
    found = decode_hair(header(2, 6, 2, segments=2) + np.arange(18, dtype="<f4").tobytes())
    assert found.offsets.tolist() == [0, 3, 6]


def test_the_longest_strand_is_written_and_a_longer_one_refused():
    longest = Strands(points=np.zeros((65_536, 3)), offsets=[0, 65_536])
    assert decode_hair(encode_hair(longest)).offsets.tolist() == [0, 65_536]
    with pytest.raises(InputError, match="65537 points; .hair holds at most 65536"):
        encode_hair(Strands(points=np.zeros((65_537, 3)), offsets=[0, 65_537]))


def test_a_file_by_the_formats_author_is_read(open_data):
    found = decode_hair(open_data("grooms/straight.hair").read_bytes())
    assert (found.count, set(found.lengths.tolist())) == (10_000, {16})
