"""Laws of change: a diff and its reverse cancel, squashing is doing one after the other, conflicts are refused."""

import pytest
from documents import documents
from hypothesis import HealthCheck, given, settings

from tress.base.errors import InputError
from tress.model.camera import Camera
from tress.model.diff import ConflictError, Diff, apply, difference, reverse, squash
from tress.model.document import Document

QUICK = settings(max_examples=30, deadline=None, suppress_health_check=list(HealthCheck))


def camera(width):
    return Camera(xy_from_world=[[1, 0, 0, 0], [0, -1, 0, 0], [0, 0, 0, 1]], width=width, height=1)


ONE, TWO, THREE = camera(1), camera(2), camera(3)


@QUICK
@given(documents(), documents())
def test_apply_then_reverse_is_identity(before, after):
    diff = difference(before, after)
    assert apply(diff, before) == after
    assert apply(reverse(diff), after) == before
    assert reverse(reverse(diff)) == diff


@QUICK
@given(documents(), documents(), documents(), documents())
def test_squash_is_associative_and_agrees_with_apply(a, b, c, d):
    first, second, third = difference(a, b), difference(b, c), difference(c, d)
    assert apply(squash(first, second), a) == c
    assert squash(squash(first, second), third) == squash(first, squash(second, third))
    assert squash(first, reverse(first)).is_empty
    assert reverse(squash(first, second)) == squash(reverse(second), reverse(first))


@QUICK
@given(documents())
def test_nothing_is_neutral(document):
    assert difference(document, document).is_empty
    diff = difference(Document(), document)
    assert apply(Diff(), document) == document
    assert squash(Diff(), diff) == diff == squash(diff, Diff())


@pytest.mark.parametrize(
    ("diff", "message"),
    [
        (Diff(added={"a": TWO}), "'a' is to be added, but it is there"),
        (Diff(removed={"b": ONE}), "'b' is to be changed, but it is absent"),
        (Diff(updated={"b": (ONE, TWO)}), "'b' is to be changed, but it is absent"),
        (Diff(updated={"a": (TWO, ONE)}), "'a' is to be changed, but it differs"),
        (Diff(removed={"a": TWO}), "'a' is to be changed, but it differs"),
    ],
)
def test_apply_refuses_another_document(diff, message):
    document = Document({"a": ONE})
    with pytest.raises(ConflictError, match=message):
        apply(diff, document)
    assert document == Document({"a": ONE})


def test_squash_refuses_what_does_not_follow():
    with pytest.raises(ConflictError, match="differs"):
        squash(Diff(updated={"a": (ONE, TWO)}), Diff(updated={"a": (THREE, ONE)}))
    with pytest.raises(ConflictError, match="there already"):
        squash(Diff(added={"a": ONE}), Diff(added={"a": ONE}))
    with pytest.raises(ConflictError, match="absent"):
        squash(Diff(removed={"a": ONE}), Diff(removed={"a": ONE}))


def test_an_identifier_stands_once():
    with pytest.raises(InputError, match="'a' stands in several parts"):
        Diff(added={"a": ONE}, removed={"a": ONE})


@pytest.mark.parametrize("identifier", ["", "1a", "two words", "ä", "a.b", "a/b", 3])
def test_identifiers_are_plain(identifier):
    with pytest.raises(InputError, match="letters, digits"):
        Document({identifier: ONE})
