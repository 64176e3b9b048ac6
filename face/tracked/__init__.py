"""What trackers saw becomes FAPs; and files of FAPs over time, whatever their format.

recording               the way in and out: streams and recordings in files of every format
formats, opening        the formats, and which of them a file has
trackers                the files of trackers, a row each, and how they become samples of FAPs
mediapipe_landmarks     the landmarks of a face mesh as tracked points
neutral                 which rows show the neutral face, and scores counted from it
steady                  trembling taken out
flipping                turns that a recording has the other way round
landmarks               tracked points as FAPs, in that person's own units
"""
