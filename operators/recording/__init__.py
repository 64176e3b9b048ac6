"""Recordings: streams of FAPs and what trackers wrote, imported onto a face.

fields      what a file may leave open, as fields of the operators and in their dialogs
ops         ask for a file and import it
handler     files dropped on the viewport
props       what the last import had to assume, for the panel
"""
