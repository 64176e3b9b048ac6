"""Pictures and films of a face.

film                        films
following                   where a face is at each frame, and a camera that goes with it
seen                        whether a render shows a face at all
look, framing, furniture    how a face is pictured; where it is in the world; camera, lights and background
studio                      a scene of its own to picture it in
contact_sheet, lettering    pictures side by side; text as pixels
belief_plot                 beliefs over time as a picture
irises                      irises of eyeballs that bring no colours
gpu_probe                   whether Blender can draw with its GPU engines here
"""
