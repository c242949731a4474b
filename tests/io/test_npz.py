"""`reconstruction.npz`: the members that scorers read, and nothing pickled."""

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from tress.base.errors import FormatError, InputError
from tress.io.formats.npz import Maps, read_npz, write_npz, write_reconstruction
from tress.model.camera import Camera
from tress.model.document import Document
from tress.model.strands import Strands

HAIR = Strands(points=np.arange(15).reshape(5, 3), offsets=[0, 2, 5])
CAMERA = Camera(xy_from_world=[[3000, 0, 0, 4], [0, -3000, 0, 3], [0, 0, 0, 1]], width=8, height=6)
DOCUMENT = Document({"hair": HAIR, "photo": CAMERA})


def test_all_members_are_written_as_they_are(tmp_path):
    maps = Maps(
        orientation=np.full((6, 8), np.nan, np.float32),
        hair_mask=np.full((6, 8), 255, np.uint8),
        rerender=np.zeros((6, 8, 4), np.uint8),
    )
    write_reconstruction(HAIR, tmp_path / "a.npz", camera=CAMERA, maps=maps)
    with np.load(tmp_path / "a.npz", allow_pickle=False) as file:
        assert {"points", "offsets", "xy_from_points", "orientation", "hair_mask", "rerender"} <= set(file)
        assert (file["points"].dtype, file["points"].shape) == (np.float32, (5, 3))
        assert (file["offsets"].dtype, file["offsets"].tolist()) == (np.int64, [0, 2, 5])
        assert (file["xy_from_points"].dtype, file["xy_from_points"].shape) == (np.float64, (3, 4))
        assert np.isnan(file["orientation"]).all()


def test_writing_is_deterministic(tmp_path):
    for name in ("a.npz", "b.npz"):
        write_npz(DOCUMENT, tmp_path / name)
    assert (tmp_path / "a.npz").read_bytes() == (tmp_path / "b.npz").read_bytes()
    assert read_npz(tmp_path / "a.npz") == DOCUMENT


@pytest.mark.parametrize(
    "maps",
    [
        Maps(orientation=np.zeros((8, 6), np.float32)),
        Maps(orientation=np.zeros((6, 8))),
        Maps(hair_mask=np.zeros((6, 8), bool)),
        Maps(rerender=np.zeros((6, 9, 3), np.uint8)),
    ],
)
def test_maps_of_another_size_or_type_are_refused(tmp_path, maps):
    with pytest.raises(InputError, match="was expected"):
        write_reconstruction(HAIR, tmp_path / "a.npz", camera=CAMERA, maps=maps)
    assert list(tmp_path.iterdir()) == []


def test_a_document_without_camera_is_refused(tmp_path):
    with pytest.raises(InputError, match="has 0 cameras"):
        write_npz(Document({"hair": HAIR}), tmp_path / "a.npz")


@settings(max_examples=150, deadline=None, suppress_health_check=list(HealthCheck))
@given(place=st.integers(0, 2000), damage=st.binary(max_size=6))
def test_damaged_files_are_refused_or_read(tmp_path, place, damage):
    path = tmp_path / "a.npz"
    write_npz(DOCUMENT, path)
    data = bytearray(path.read_bytes())
    data[place : place + max(len(damage), 1)] = damage
    path.write_bytes(data)
    try:
        assert isinstance(read_npz(path), Document)
    except FormatError as error:
        assert "\n" not in str(error)


def test_pickles_are_not_opened(tmp_path):
    np.savez(tmp_path / "a.npz", points=np.array([{}], object), offsets=[0], xy_from_points=[0], height_width=[1, 1])
    with pytest.raises(FormatError, match="no reconstruction"):
        read_npz(tmp_path / "a.npz")
