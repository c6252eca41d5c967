"""Gesture recognition on video: what did the person do?"""
