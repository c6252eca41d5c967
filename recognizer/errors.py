"""The errors a user of the recogniser can meet, each a single line that names the thing and the mend.

::

    RecognizerError
    ├── ClipError        a video or photo that cannot be read or is too short
    └── DatabaseError    a feature database that cannot be read or does not fit
"""

from __future__ import annotations


class RecognizerError(ValueError):
    """Base of every error that a user of ``recognizer`` is expected to meet."""


class ClipError(RecognizerError):
    """A video or photo that cannot be read, or cannot be used as it is."""


class DatabaseError(RecognizerError):
    """A feature database that cannot be read, or does not fit the features."""
