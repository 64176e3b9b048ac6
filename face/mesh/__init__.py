"""What is given of a face, before anything moves: its mesh, feature points and parts, in head space.

checks                    vertices, polygons, parts and axes of a caller, checked
face_mesh, building       all of it, turned into head space; made step by step
weld                      which vertices at one place are one
head_frame                where the head is, which way it looks
fap_units                 its FAP units
points, own_lip           feature points bound to the mesh
fap_rows                  which point each FAP reads, along which direction, in which unit
parts, segmentation,      which vertex is skin, eyeball, tooth or tongue, and how that is told
  eye_parts, sealed_eyes,
  lid_ball, mouth_parts,
  sphere
told                      objects that hold both eyes or both rows of teeth, told apart
openings, sewn            where lips and lids end; where they are one surface
reach                     which skin a face can move
template                  the template face of the tables, and the warp from it
files, point_files        meshes in files; feature points in files
"""
