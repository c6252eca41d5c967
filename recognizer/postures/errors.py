"""What can be wrong with a photo of a hand."""

from __future__ import annotations

from recognizer.errors import ClipError


class PhotoError(ClipError):
    """A photo that cannot be read or is too small or too large to use."""


class NoSkinError(PhotoError):
    """Nothing skin-coloured, and nothing that stands out from a plain background."""


class NoHandError(PhotoError):
    """There is skin, but nothing of it has the shape of a hand."""


class HandTooSmallError(NoHandError):
    """A person is in view, but so far away that the hand's fingers cannot be told apart."""
