"""Static hand postures on photos (thesis chapter 1): the thesis's chain, and ours."""

from recognizer.postures.learning.training import learn_from_model_hand, learn_from_photos
from recognizer.postures.photo_recognizer import PhotoRecognizer, recognize_photo

__all__ = ["PhotoRecognizer", "learn_from_model_hand", "learn_from_photos", "recognize_photo"]
