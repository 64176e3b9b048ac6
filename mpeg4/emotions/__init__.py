"""The emotion model of Raouzaiou et al. 2002.

words, wheel                  emotion words; the wheel of activation and evaluation
profile, archetypes           a profile of FAP ranges; those of the six archetypal emotions (Tables 2, 4, 5)
intermediate, expressions     emotions between two archetypes; from a word or a point to a profile
prototypes                    what an emotion shows: action units by activation
bearing                       where a word turns eyes and head
emotion_presets               words of users, in files
features, recognition         Table 3; from FAPs back to emotions (section 5)
fuzzy, robust                 profiles as fuzzy classes; the robust rule
beside, places                profiles that this knows beside Table 5; FAPs that move together
belief_track                  beliefs over time
action_units                  Table 1
"""
