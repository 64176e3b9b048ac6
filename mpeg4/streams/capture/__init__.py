"""What trackers write, as FAPs: one file per format, by the tables of presets/capture/.

shapes, columns                      mapping tables: blend shapes and action units in FAPs
shape_names, scores                  what blend shapes are called, and on which scale they are
faces                                one face of several
times, rates, timecode               when rows are, and what that assumes: one model for every format
row_names, stamps                    what tells that in tables, whatever it is called
samples                              from these times to an even rate
rotation                             rotations of a head as FAPs 48 to 50
delimited                            which mark parts the cells of a line, and which the decimals
table_file, json_file, json_layout   CSV and JSON, with errors that name line and column or frame
json_names                           JSON that has the names of its scores once
long_form, json_scores               a row, an entry, a message or a curve for each score, made into frames
seeming                              what a file seems to be that is none of them
text_logs                            Face Cap's files, logs of iFacialMocap and VMC
openface, live_link                  action units with pose and gaze; ARKit blend shapes
py_feat_turns                        how versions of Py-Feat write the head's turn
mediapipe_scores, landmark_file      MediaPipe's blend shapes, and its landmarks (`face.tracked` reads FAPs off them)
fap_csv                              FAPs as CSV, out and in
key_names                            which shape keys a preset of names asks for
"""

from .columns import ColumnTable, arkit_columns, load_columns
from .fap_csv import holds_faps, read_fap_csv, write_fap_csv
from .json_file import JsonFrame, frames_of, read_json_document, read_json_frames
from .key_names import KeyShape, load_key_names
from .landmark_file import Landmarks, holds_landmarks, landmarks_from_csv, landmarks_from_json
from .live_link import read_arkit
from .long_form import frame_by_frame
from .mediapipe_scores import read_scores
from .openface import read_openface
from .samples import Samples
from .shapes import CAPTURE_PRESETS, CaptureShape, load_shapes
from .table_file import TableFile, read_table_file

__all__ = [
    "CAPTURE_PRESETS",
    "CaptureShape",
    "ColumnTable",
    "JsonFrame",
    "KeyShape",
    "Landmarks",
    "Samples",
    "TableFile",
    "arkit_columns",
    "frame_by_frame",
    "frames_of",
    "holds_faps",
    "holds_landmarks",
    "landmarks_from_csv",
    "landmarks_from_json",
    "load_columns",
    "load_key_names",
    "load_shapes",
    "read_arkit",
    "read_fap_csv",
    "read_json_document",
    "read_json_frames",
    "read_openface",
    "read_scores",
    "read_table_file",
    "write_fap_csv",
]
