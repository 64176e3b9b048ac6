"""One particular face: parts, feature points, muscles placed on it, FAPs to contractions and back.

The spine, from the public `Face` down; each knows only what stands below it:

face            the public `Face`
simulate        a face in motion, plan by plan
long_motion     a long motion between some of its frames that are posed
pose            a face in balance: request -> plan -> targets -> amounts -> pose
reduced_motion  how skin and mandible follow postures, in a few fields: the production way
clip_balance    the balance of a whole clip
meeting_lips    lips that meet on their way, and the speed that this takes
motion          the same, node by node: for reference
jaw_follower    how the mandible follows
posture         from a plan to amounts, and where they bring the outer skin
assembly        from the outer skin to all vertices
measure         FAPs and features read off a deformed face
unmet           what is asked of a face and does not show
preparation     what a first pose needs, stage by stage
requests        the FAPs, drives and emotions that a caller gives, checked
anatomy         one face prepared for motion; builds all that the rooms hold

The rooms, in the same order (`products`, `retarget` and `kept` stand above `face`):

products        what is made with a whole `Face`: tables for players, shapes for engines, creases, lines to look at
retarget        a motion on the controls that a rig already has
kept            prepared faces in files of their own, ready at once the next time
drive           what is asked, what a face can do of it, and the muscles behind it
response        what muscles do to the skin, and what follows the skin
bodies          eyeballs, teeth, tongue, the head on its spine, and where skin meets them or itself
muscles         the table of muscles, a file for each kind; its rows placed on one face, and their pull
mechanisms      what moves a face, one mechanism per file
skin            the visible skin as a sheet: geometry only
mesh            what is given: vertices, points, parts, openings, the head's frame, the template
figures         figures of anatomy, read from presets/anatomy into dataclasses
mechanism       the names of all mechanisms
contractible    the names of all that can be contracted by hand

Beside them: `fit` finds feature points on any head, `tracked` turns what trackers saw into FAPs, `default_head` is the
head that comes with Risorius.
"""
