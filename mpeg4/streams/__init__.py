"""Streams of FAPs: in memory (`fap_stream`), what silent FAPs do (`filling`), and in files.

fap_file, fap_json    .fap and JSON
fba                   the standard's own bit stream
capture               what trackers write
"""
