"""Results of stages on disk, so that a method can be rerun from any stage after a correction."""

from dataclasses import dataclass
from pathlib import Path
from typing import Any

from tress.base.errors import InputError
from tress.io.record_file import load_record, save_record


@dataclass(frozen=True)
class StageCache:
    """A folder with one .npz file a stage: `01_head.npz`, `02_layers.npz`, …

    Each file carries the fingerprint of everything its result depends on; a result is only given back for the same
    fingerprint.
    """

    folder: Path

    def path(self, number: int, name: str) -> Path:
        """The file of stage `name`, the `number`-th."""
        return self.folder / f"{number:02d}_{name}.npz"

    def save(self, result: Any, *, number: int, name: str, fingerprint: str) -> None:
        """Stores the result of a stage; replaces an earlier one."""
        self.folder.mkdir(parents=True, exist_ok=True)
        save_record(self.path(number, name), result, header={"stage": name, "fingerprint": fingerprint})

    def load(self, *, number: int, name: str, fingerprint: str) -> Any:
        """The stored result. Raises `InputError` where there is none or where it was made from something else."""
        path = self.path(number, name)
        if not path.exists():
            raise InputError(
                f"{path} is missing, so the work cannot go on after {name}; run without --from-stage once."
            )
        result, header = load_record(path)
        if header.get("fingerprint") != fingerprint:
            raise InputError(
                f"{path} was made from another photo, other corrections, parameters or version; "
                f"give the same ones again, or start from {name} or earlier."
            )
        return result
