"""Where the models and assets are, in a checkout and in an installed wheel alike."""

from __future__ import annotations

from pathlib import Path

from nao_sim.errors import ResourceError

_PACKAGE = Path(__file__).resolve().parent


def resource(*parts: str) -> Path:
    """Return the path of a file or folder below ``models/`` or ``assets/``.

    Args:
        *parts: path components, the first being ``"models"`` or ``"assets"``.

    Raises:
        ResourceError: nothing stands at that place.
    """
    # A wheel carries both folders inside the package; a checkout has them beside it.
    candidates = [root.joinpath(*parts) for root in (_PACKAGE, _PACKAGE.parent)]
    for path in candidates:
        if path.exists():
            return path
    raise ResourceError(f"{'/'.join(parts)} is not in this installation; reinstall nao-sim")
