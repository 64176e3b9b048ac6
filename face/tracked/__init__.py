"""What trackers saw becomes FAPs; and files of FAPs over time, whatever their format.

recording    the way in and out: streams and recordings in files of every format
formats      the formats, and which of them a file has
captured     a tracker's file as samples of FAPs
landmarks    tracked points as FAPs, in that person's own units
"""
