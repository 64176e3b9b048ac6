"""From a request to the amounts of muscles, lids and jaw behind it: request -> plan -> targets -> amounts.

request                 what is asked of a face at one moment
plan                    what the face is to do, FAP by FAP, and why
natural                 plans of the natural drive: requests weighed, silence filled
targets                 what a plan wants of the feature points of one face
held_together           what sewn lips and shut lids can do of them
filled, lip_middles     what goes with asked FAPs in the exact drive; points that no FAP names
drives                  the four drives: which plan, which targets, who has the last word
inverse                 from targets to amounts, and the elastic correction of what they leave
belief                  how far muscles are believed that explain badly what is asked
by_hand                 contractions set by hand
over_time               plans of streams, and of expressions that come and go
bounded_least_squares   the small problems that mixture and inverse solve
"""
