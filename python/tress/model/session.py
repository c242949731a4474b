"""The history of one document: undo, redo, and drags that count as one step."""

from tress.base.errors import InputError
from tress.model.diff import Diff, apply, reverse, squash
from tress.model.document import Document


class Session:
    """A document and its history; the notebook, the command line and the studio share it.

    >>> session = Session(Document())
    >>> session.can_undo
    False
    """

    def __init__(self, document: Document) -> None:
        self._document = document
        self._done: list[Diff] = []
        self._undone: list[Diff] = []
        self._drag: Diff | None = None

    @property
    def document(self) -> Document:
        """The document as it is now, with the drag in progress."""
        return self._document

    @property
    def can_undo(self) -> bool:
        """Whether there is a step to take back."""
        return bool(self._done) and self._drag is None

    @property
    def can_redo(self) -> bool:
        """Whether there is a step to take again."""
        return bool(self._undone) and self._drag is None

    def commit(self, diff: Diff) -> None:
        """Applies one step; during a drag it becomes part of the drag. Raises `ConflictError` and changes nothing."""
        self._document = apply(diff, self._document)
        if self._drag is not None:
            self._drag = squash(self._drag, diff)
        else:
            self._push(diff)

    def begin_drag(self) -> None:
        """From here on steps are squashed into one, until `end_drag` or `drop_drag`."""
        if self._drag is not None:
            raise InputError("A drag is in progress; end or drop it first.")
        self._drag = Diff()

    def end_drag(self) -> None:
        """The drag becomes one step of the history."""
        self._push(self._taken_drag())

    def drop_drag(self) -> None:
        """The document is again what it was before the drag."""
        self._document = apply(reverse(self._taken_drag()), self._document)

    def undo(self) -> Diff:
        """Takes the last step back, and returns what changed. Raises `InputError` where there is none."""
        if not self.can_undo:
            raise InputError("There is nothing to undo.")
        return self._move(self._done, self._undone)

    def redo(self) -> Diff:
        """Takes the last undone step again, and returns what changed. Raises `InputError` where there is none."""
        if not self.can_redo:
            raise InputError("There is nothing to redo.")
        return self._move(self._undone, self._done)

    def _move(self, source: list[Diff], target: list[Diff]) -> Diff:
        # Both stacks hold diffs that lead away from the present state when reversed.
        step = reverse(source.pop())
        self._document = apply(step, self._document)
        target.append(step)
        return step

    def _push(self, diff: Diff) -> None:
        if not diff.is_empty:
            self._done.append(diff)
            self._undone.clear()

    def _taken_drag(self) -> Diff:
        if self._drag is None:
            raise InputError("No drag is in progress.")
        drag, self._drag = self._drag, None
        return drag
