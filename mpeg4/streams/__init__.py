"""Streams of FAPs, in memory and in files.

fap_stream, filling   frames with their mask; what silent FAPs do
bridging              what is shown where a stream is unknown for a while
fap_file, fap_json    .fap and JSON
fba                   the standard's own bit stream
capture               what trackers write
"""
