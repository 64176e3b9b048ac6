"""Pictures and films of a face.

film, framing, studio       films; where camera and lights stand; a scene of their own
contact_sheet, lettering    pictures side by side; text as pixels
belief_plot                 beliefs over time as a picture
irises                      irises of eyeballs that bring no colours
gpu_probe                   whether Blender can draw with its GPU engines here
"""
