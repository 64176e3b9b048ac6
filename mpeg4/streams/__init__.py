"""Streams of FAPs, in memory and in files.

fap_stream            frames with their mask; filling: what silent FAPs do
fap_file, fap_json    .fap and JSON
fba                   the standard's own bit stream
capture               what trackers write
"""
