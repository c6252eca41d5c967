"""Gesture recognition on video: what did the person do?"""

from recognizer.amplitude import Amplitude, centroid_transition
from recognizer.clip import Clip, open_clip, parse_frame_range
from recognizer.database import Database
from recognizer.decision import Neighbour
from recognizer.errors import ClipError, DatabaseError, RecognizerError
from recognizer.flow import horn_schunck
from recognizer.neighbours import NeighbourClassifier
from recognizer.recognition import Evidence, Recognition
from recognizer.recognizer import Recognizer, RecognizerStream

__all__ = [
    "Amplitude",
    "Clip",
    "ClipError",
    "Database",
    "DatabaseError",
    "Evidence",
    "Neighbour",
    "NeighbourClassifier",
    "Recognition",
    "Recognizer",
    "RecognizerError",
    "RecognizerStream",
    "centroid_transition",
    "horn_schunck",
    "open_clip",
    "parse_frame_range",
]
