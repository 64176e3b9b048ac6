"""The FBA bitstream: facial animation in a few kilobits per second, as MPEG-4 sends it. Predictive coding of FAPs.

bits        writing and reading single bits
arithmetic  the adaptive arithmetic coder
channels    what is coded: steps, limits, levels
syntax      start codes, frame rates, time codes, masks
plan        a stream cut into runs that build on each other
planes      one frame as the decoder reads it
encoder     a stream becomes bytes
decoder     bytes become a stream, from the next start code on where some are damaged

Source: ISO/IEC 14496-2, face and body animation, gathered second-hand (docs/formats.md says what was not available).
"""

from .decoder import Decoded, begins_as_fba, decode_fba, read_fba
from .encoder import encode_fba, write_fba

__all__ = ["Decoded", "begins_as_fba", "decode_fba", "encode_fba", "read_fba", "write_fba"]
