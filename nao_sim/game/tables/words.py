"""The words that the tables' coded columns may hold; every one is written out, none is a number in disguise."""

ROLES = ("robot", "therapist", "child", "family", "other")

CONDITIONS = ("triadic", "dyadic")
"""Triadic: child, therapist and robot; dyadic: child and therapist (thesis, appendix 4)."""

DESIGNS = ("groups", "crossover", "single_case")

PHASES = ("orientation", "baseline", "game", "closing")

SIDES = ("same", "mirrored", "other")
"""The imitator used the model's own side; the side opposite (as a mirror shows it); another body part."""

PROMPT_LEVELS = {0: "independent", 1: "verbal", 2: "model again", 3: "partial help", 4: "full help"}
"""Help given before the answer, from none to most."""

SCALES = ("0/1", "0/1/2")

RULES = {
    "same_class": "1 when what was seen is the gesture asked for, on either side of the body",
    "same_side": "1 when what was seen is the gesture asked for, on the side asked for",
    "same_family": "1 when what was seen is of the family asked for (static, small or large amplitude) and of its side",
    "custom": "as the session file words it",
}
"""When an action counts as related to its target; the wording is stored with the session."""

EXCLUSIONS = {
    "child_left": "the child left",
    "camera_blind": "the camera saw nothing usable",
    "model_failed": "the model was not shown as planned",
    "robot_fell": "the robot fell",
    "no_opportunity": "there was no opportunity to answer",
    "aborted": "the turn was broken off",
    "other": "another reason, see the note",
}
"""Why a turn is no trial. Such a turn is counted apart and never a 0."""

TECHNICAL = ("camera_blind", "model_failed", "robot_fell")
"""The exclusions that are the machine's doing, not the child's."""

OUTCOMES = {
    "independent": "share of valid turns answered without any prompt",
    "success": "share of valid turns answered, at whatever prompt level",
    "mean_score": "mean score of the valid turns, as a share of the highest score",
}
"""Primary outcomes that a session file may name; all are a child's own share between 0 and 1."""

EVENT_KINDS = (
    "phase", "instruction", "model", "movement", "prompt", "praise", "speech", "mark", "pause", "fault",
)  # fmt: skip

SPEECH = ("initiation", "answer", "other")
"""What an utterance was: begun by the speaker, an answer to somebody, or neither."""
