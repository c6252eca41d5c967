"""What is said in a session: into the log, and to whatever link speaks."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from nao_sim.game.play.clock import Clock
from nao_sim.game.store.log import Log
from nao_sim.game.words import words_table

Say = Callable[[str], None]
"""Speaks one sentence and returns when it is spoken; a robot's link, a speech program, or nothing."""

CHARACTERS_PER_S = 14.0
"""How fast a sentence is taken to be spoken where nobody waits for it."""


class Voice:
    """Speaks the sentences of a session.

    Args:
        words: the session's own sentences by key of ``assets/game/words.toml``.
        clock: the session's time.
        say: what speaks; None: nobody, the log alone.
    """

    def __init__(self, words: Mapping[str, str], clock: Clock, say: Say | None = None) -> None:
        self._words = {**words_table(), **words}
        self._clock, self._say = clock, say

    def speak(self, log: Log, kind: str, key: str, who: str | None, level: int | None = None, **filled: str) -> float:
        """Say a sentence and write it down.

        Args:
            log: where it is written down.
            kind: kind of event.
            key: which sentence.
            who: pseudonym of the speaker.
            level: of a prompt.
            filled: what stands for the sentence's braces.

        Returns:
            When it began.
        """
        text = self._words[key].format_map(filled)
        begun = self._clock.now
        if self._say is not None:
            self._say(text)
        spoken = len(text) / CHARACTERS_PER_S
        end = self._clock.now if self._say is not None and self._clock.live else begun + spoken
        log.add(kind, begun, end, who=who, text=text, level=level)
        return begun
