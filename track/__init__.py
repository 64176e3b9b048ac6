"""From pictures of a face to a FAP stream: the image analysis of the first paper's figure 1. An optional extra.

pictures        a film, pictures or a camera, one picture at a time
face_mesh       landmarks of the face in a picture, by MediaPipe (the only module that needs the extra, with `pictures`)
generic_face    a neutral face of nobody
people          the neutral face of a person guessed from pictures that show none, and its doubt
trust           how far a camera can be trusted for each FAP, and from where it stands
smoothing       trembling taken out, and the delay that this costs
tracking        landmarks to a stream with a confidence for every value
confidence_file  the confidence beside the stream, as a table
"""

from .confidence_file import read_confidence, write_confidence
from .face_mesh import find_faces, find_landmarks
from .generic_face import generic_landmarks
from .pictures import Pictures, open_pictures
from .smoothing import Smoothing, smooth
from .tracking import GENERIC, Track, track_landmarks
from .trust import CameraFap, camera_faps, confidence

__all__ = [
    "GENERIC",
    "CameraFap",
    "Pictures",
    "Smoothing",
    "Track",
    "camera_faps",
    "confidence",
    "find_faces",
    "find_landmarks",
    "generic_landmarks",
    "open_pictures",
    "read_confidence",
    "smooth",
    "track_landmarks",
    "write_confidence",
]
