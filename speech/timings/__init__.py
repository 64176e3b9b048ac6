"""Files that say which sound is spoken when.

labels       marks in time, and the sounds that they stand for
textgrid     Praat's TextGrids, as aligners write them
rhubarb      mouth shapes of Rhubarb Lip Sync: JSON, XML, TSV
tabular      tables of sounds or visemes with their times
visemes      streams of FAPs with visemes
loudness     a sound alone: as loud as open
presets      timelines saved as presets
documents    JSON of aligners, of speech services, and plain lists
reading      which of them a file is
"""

from .reading import read_marks

__all__ = ["read_marks"]
