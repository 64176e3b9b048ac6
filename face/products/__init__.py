"""What is made with a whole `Face`. Only these import it.

animation_tables, animation_table_building,   Face Animation Tables, for players without muscles
  animation_table_files
blendshapes                                   shape keys that engines and trackers know by name
creases, crease_places, crease_table          where squeezed skin wrinkles, for renderers
efforts                                       what a motion takes of muscles; action units that explain FAPs
head_motion                                   where the skull has gone
landmarks                                     MediaPipe's and iBUG's landmarks on any head
lip_seam, mouth_room                          where sewn lips are to be cut open; mouths without an inside
muscle_lines, trajectories                    muscles as lines; paths of the skin
playing                                       a recording on a face as it is
"""
