"""Static hand postures on photos (thesis chapter 1): skin, hand, outline, features, neighbours."""

from recognizer.static.recognise import PhotoRecognizer, recognize_photo
from recognizer.static.training import learn_from_model_hand, learn_from_photos

__all__ = ["PhotoRecognizer", "learn_from_model_hand", "learn_from_photos", "recognize_photo"]
