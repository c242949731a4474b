"""The history of a document: any walk of steps, undos and redos ends where it says."""

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tress.base.errors import InputError
from tress.model.camera import Camera
from tress.model.diff import ConflictError, Diff, difference
from tress.model.document import Document
from tress.model.session import Session


def state(width):
    camera = Camera(xy_from_world=[[1, 0, 0, 0], [0, -1, 0, 0], [0, 0, 0, 1]], width=width, height=1)
    return Document({"photo": camera} if width > 1 else {})


def go(session, width):
    session.commit(difference(session.document, state(width)))


def test_undo_and_redo_walk_the_history():
    session = Session(state(1))
    go(session, 2)
    go(session, 3)
    session.undo()
    assert session.document == state(2)
    session.redo()
    assert session.document == state(3)
    session.undo()
    go(session, 5)
    assert not session.can_redo
    session.undo()
    session.undo()
    assert session.document == state(1)
    assert not session.can_undo


def test_a_drag_is_one_step():
    session = Session(state(1))
    session.begin_drag()
    for width in (2, 3, 4):
        go(session, width)
    assert not session.can_undo
    session.end_drag()
    session.undo()
    assert session.document == state(1)
    session.redo()
    assert session.document == state(4)


def test_a_dropped_drag_leaves_nothing():
    session = Session(state(2))
    session.begin_drag()
    go(session, 3)
    session.drop_drag()
    assert session.document == state(2)
    assert not session.can_undo


def test_a_drag_that_comes_back_is_no_step():
    session = Session(state(2))
    session.begin_drag()
    go(session, 3)
    go(session, 2)
    session.end_drag()
    assert not session.can_undo


def test_a_conflict_changes_nothing():
    session = Session(state(2))
    with pytest.raises(ConflictError):
        session.commit(Diff(added=state(3).records))
    assert session.document == state(2)
    assert not session.can_undo


@pytest.mark.parametrize("step", ["undo", "redo", "end_drag", "drop_drag"])
def test_what_cannot_be_done_is_refused(step):
    with pytest.raises(InputError):
        getattr(Session(state(1)), step)()


@settings(max_examples=50, deadline=None)
@given(st.lists(st.sampled_from(["undo", "redo", 1, 2, 3]), max_size=12))
def test_any_walk_agrees_with_two_plain_stacks(steps):
    session, past, future = Session(state(1)), [state(1)], []
    for step in steps:
        if step == "undo" and len(past) > 1:
            session.undo()
            future.append(past.pop())
        elif step == "redo" and future:
            session.redo()
            past.append(future.pop())
        elif isinstance(step, int) and state(step) != past[-1]:
            go(session, step)
            past.append(state(step))
            future = []
        assert session.document == past[-1]
