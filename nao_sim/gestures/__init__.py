"""Gesture files: loading, checking, exchanging."""

from nao_sim.gestures.errors import GestureError, GestureFileError, UnknownGesture
from nao_sim.gestures.formats import load_gesture, save_trajectory
from nao_sim.gestures.gesture import Gesture
from nao_sim.gestures.key_frames import Cycle, KeyFrame, Walk
from nao_sim.gestures.library import find_gesture, library
from nao_sim.gestures.mirror import mirrored, mirrored_trajectory
from nao_sim.gestures.preparation import Prepared, prepare, written
from nao_sim.gestures.vocabulary import Entry, vocabulary

__all__ = [
    "Cycle",
    "Entry",
    "Gesture",
    "GestureError",
    "GestureFileError",
    "KeyFrame",
    "Prepared",
    "UnknownGesture",
    "Walk",
    "find_gesture",
    "library",
    "load_gesture",
    "mirrored",
    "mirrored_trajectory",
    "prepare",
    "save_trajectory",
    "vocabulary",
    "written",
]
