"""How well feature points are found on any head: measured by `fit_report.py`, pictured by `fit_sheets.py`.

heads          heads with known points: shared, mixed of people, bent
meshes         the same head on other meshes; decimate: with fewer vertices
disguises      what people wear; hard: all hard heads
sets           the sets of heads by name
shapes         what is no face and must be refused
measuring      how far off points are, in any pose; what is refused; what clicks mend
sides          lip and lid points on the wrong side
effect         what errors of points cost a face
page           docs/fit.md
sheet          contact sheets and their overview; portrait: the sheet of one head (Blender)
"""
