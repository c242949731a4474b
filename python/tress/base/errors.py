"""Errors that a caller can act on. Each message is one sentence: the value, what was expected, how to go on."""


class TressError(Exception):
    """Root of all errors that Tress raises on purpose."""


class InputError(TressError):
    """The user's input cannot be used as it is: a file, a picture, a parameter."""


class ParameterError(InputError):
    """A parameter lies outside its range or has the wrong type."""


class AssetMissingError(TressError):
    """A built asset (head model, network) is absent; the message says how to build it."""


class NoFaceError(InputError):
    """No face was found, or none that can be fitted."""


class NoHairError(InputError):
    """The picture shows no hair that could be reconstructed."""


class FormatError(InputError):
    """A file does not hold what its format promises."""


class OutputError(TressError):
    """The result could not be written; nothing half-written is left behind."""


class CancelledError(TressError):
    """The caller asked for the work to stop."""


class ChangedFileWarning(UserWarning):
    """A file holds something else than was written into it: damage, or the work of another program."""
