"""A face's motion on the controls that its rig already has: how much of each control comes nearest to the muscles.

retargeting    the way in: a motion, the controls' effects -> their values over time, and how far they can follow
controls       what the controls of a rig do to a face, and within which limits
sight          what counts of a motion: outer skin, feature points along their FAPs, eyeballs
weighing       what counts how much: skin, points of FAPs, gaze; and fights that are settled
fights         controls that pull against each other, and what it costs to have both on
beyond         what a rig shows beyond the sum of its controls
normal         a motion and the controls' effects as normal equations of least squares
bounded        least squares over time within bounds, smooth and sparing
mirrored       which controls are each other's mirror image
shortfall      what the controls cannot show, FAP by FAP
weight_csv     values of controls over time as a table
"""
