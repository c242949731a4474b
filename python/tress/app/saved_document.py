"""Documents from files named on the command line."""

import sys
import warnings
from pathlib import Path

from tress.base.errors import ChangedFileWarning, FormatError, InputError
from tress.base.report import Report
from tress.io.formats.registry import FORMATS, format_of
from tress.model.document import Document


def opened(path: Path, *, report: Report | None = None) -> Document:
    """The document in `path`. The report, or else standard error, gets what readers warn of.

    Raises `InputError` where there is none, `FormatError` where its format is not read.
    """
    if not path.is_file():
        raise InputError(f"{path} does not exist; name a file that Tress wrote.")
    known = [suffix for form in FORMATS for suffix in form.suffixes]
    if path.suffix.lower() not in known:
        read = ", ".join(suffix for form in FORMATS if form.read for suffix in form.suffixes)
        raise InputError(f"{path.name} has suffix {path.suffix!r}; one of {read} was expected.")
    form = format_of(path)
    if form.read is None:
        raise FormatError(f"{path} is {form.name}, which Tress writes but does not read; name the .usdc instead.")
    with warnings.catch_warnings(record=True) as found:
        warnings.simplefilter("always", ChangedFileWarning)
        document = form.read(path)
    for words in (str(item.message) for item in found if issubclass(item.category, ChangedFileWarning)):
        if report is None:
            print(f"tress: {words}", file=sys.stderr)
        else:
            report.warn(words)
    return document
