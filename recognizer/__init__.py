"""Gesture recognition on video: what did the person do?"""

from recognizer.errors import ClipError, DatabaseError, RecognizerError
from recognizer.learning.database import Database
from recognizer.learning.decision import Neighbour
from recognizer.learning.neighbour_classifier import NeighbourClassifier
from recognizer.motion.amplitude import Amplitude, centroid_transition
from recognizer.motion.flow import horn_schunck
from recognizer.recognition import Evidence, Recognition
from recognizer.recognizer import Recognizer, RecognizerStream
from recognizer.video.clip import Clip, open_clip, parse_frame_range

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
