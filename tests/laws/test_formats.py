"""Laws of every file format: it keeps what it promises, writes the same bytes twice, refuses what it cannot read.

A format in the list is under these laws from the day it is there; one without a page in `docs/formats` fails.
"""

from pathlib import Path

import numpy as np
import pytest
from ball_hair import ball_hair
from small_portrait import portrait

from tress.base.errors import FormatError, InputError, OutputError
from tress.io.format import ALPHA, CAMERA, COLOR, DOCUMENT, HEAD, RADIUS, STRANDS
from tress.io.formats.registry import FORMATS, format_of
from tress.model.document import Document
from tress.model.evaluate import evaluate

DOCS = Path(__file__).parents[2] / "docs" / "formats"
PROMISES = {STRANDS, COLOR, ALPHA, RADIUS, HEAD, CAMERA, DOCUMENT}

every_format = pytest.mark.parametrize("form", FORMATS, ids=lambda form: form.name)
every_reader = pytest.mark.parametrize("form", [form for form in FORMATS if form.read], ids=lambda form: form.name)


def written(form, folder, document):
    path = folder / f"hair{form.suffixes[0]}"
    form.write(document, path)
    return path


@every_reader
def test_what_is_promised_comes_back(form, tmp_path):
    document = portrait()
    found = form.read(written(form, tmp_path, document))
    hair, back = document.records["hair"], found.records["hair"]
    assert form.keeps <= PROMISES and form.nearly <= PROMISES
    if DOCUMENT in form.keeps:
        assert found == document
    if STRANDS in form.keeps:
        assert back.points.tobytes() == hair.points.tobytes()
        assert back.offsets.tolist() == hair.offsets.tolist()
    for name in (COLOR, ALPHA, RADIUS):
        if name in form.keeps:
            assert back.point_attributes[name].tobytes() == hair.point_attributes[name].tobytes()
        if name in form.nearly:
            assert np.abs(back.point_attributes[name] - hair.point_attributes[name]).max() <= form.tolerance
    if CAMERA in form.keeps:
        assert found.records["photo"] == document.records["photo"]
    if HEAD in form.keeps:
        mesh = evaluate(found).meshes["head"]
        assert mesh.positions.tobytes() == document.records["head"].mesh.positions.tobytes()
        assert mesh.triangles.tolist() == document.records["head"].mesh.triangles.tolist()


@every_format
def test_the_same_document_gives_the_same_bytes(form, tmp_path):
    first = written(form, tmp_path, portrait()).read_bytes()
    assert written(form, tmp_path, portrait()).read_bytes() == first


@every_reader
def test_writing_what_was_read_changes_nothing(form, tmp_path):
    path = written(form, tmp_path, portrait())
    first, found = path.read_bytes(), form.read(path)
    if form.keeps >= {STRANDS} or DOCUMENT in form.keeps:
        again = form.read(written(form, tmp_path, found))
        assert again == found
    assert first


@every_format
def test_an_empty_document_is_written_or_refused_in_a_sentence(form, tmp_path):
    try:
        assert written(form, tmp_path, Document()).exists()
    except InputError as error:
        assert "\n" not in str(error)
        assert list(tmp_path.iterdir()) == []


@every_format
def test_strips_are_written_or_refused_in_a_sentence(form, tmp_path):
    if not form.strands_alone:
        assert written(form, tmp_path, ball_hair(6)).stat().st_size > 1000
        return
    with pytest.raises(InputError, match=r"holds strands alone, and the document has 6 strips and no strands"):
        written(form, tmp_path, ball_hair(6))
    assert list(tmp_path.iterdir()) == []


@every_format
def test_places_that_cannot_be_written_are_refused(form, tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(OutputError):
        form.write(portrait(), tmp_path / "file" / f"hair{form.suffixes[0]}")
    assert [path.name for path in tmp_path.iterdir()] == ["file"]


@every_reader
@pytest.mark.parametrize("content", [b"", b"\0" * 300, b"hair", None], ids=["empty", "zeros", "text", "absent"])
def test_other_files_are_refused(form, tmp_path, content):
    path = tmp_path / f"hair{form.suffixes[0]}"
    if content is not None:
        path.write_bytes(content)
    if form.name == "obj" and content is not None:
        assert form.read(path) == Document()  # any text is an OBJ file without objects
        return
    with pytest.raises(FormatError) as caught:
        form.read(path)
    assert "\n" not in str(caught.value)


@every_format
def test_a_suffix_names_its_format(form):
    for suffix in form.suffixes:
        assert format_of(Path(f"out/hair{suffix.upper()}")) is form


def test_names_and_suffixes_are_not_shared():
    suffixes = [suffix for form in FORMATS for suffix in form.suffixes]
    assert len(set(suffixes)) == len(suffixes)
    assert len({form.name for form in FORMATS}) == len(FORMATS)
    with pytest.raises(InputError, match=r"suffix '.fbx'; one of .usdc"):
        format_of(Path("hair.fbx"))


@every_format
def test_every_format_has_a_page(form):
    page = (DOCS / f"{form.name}.md").read_text()
    assert page.startswith("# ")
    assert all(suffix in page for suffix in form.suffixes)
    assert "## Limits" in page


@every_format
def test_the_example_of_the_page_runs(form, tmp_path):
    page = (DOCS / f"{form.name}.md").read_text()
    example = page.partition("## Example")[2].partition("```python")[2].partition("```")[0]
    assert "assert" in example
    exec(example, {"document": portrait(), "path": tmp_path / f"example{form.suffixes[0]}"})
