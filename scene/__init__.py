"""Between Blender and arrays: meshes, shape keys, actions, cameras and films. Registers nothing.

Every function here is plain Python over bpy and can be called from scripts. Long work is a generator that yields
`Progress` and returns its result; `run` drives one to its end. Reading and computing come first and writing last,
so that an error or a cancelled bake leaves the scene as it was.

blender_types         what is used of Blender's types, for mypy
attributes            one figure of all items at once, to arrays and back
fcurves               the F-curves of an action, whatever Blender keeps them in
shape_mix             the mix of the user's shape keys that the resting face is
posed                 a face that a rig has brought into another shape, and the way back
mesh, head            meshes to arrays and back; the default head
faces, companions     from objects to a face: the head, and what belongs to it
as_read               whether objects are still as they were read
passing               what is in the file only while work goes on, and never stays
fingerprint           which object it is, and which face
following             which objects belong to a face, and how they follow it
parts_found           parts of a face's mesh, told and corrected
progress              the progress of long work, where scripts look for it
refusals              what Risorius refuses to touch, and the remedy
modifiers             modifiers of ours among those of the user's
node_graph            node groups built in a few words
materials             materials and worlds with nodes
sounds                sound on a timeline
gltf                  a face with its clips as glTF
traces                displacements too small to be seen
laid_out             what such a file is made of: copies with each clip on a track of its name
points                feature points on objects: found, kept, bound, shown
bake                  shape keys, actions and strips
rig                   the controls that a character already has, measured and keyed
blendshape_keys       shape keys that engines know by name
live                  previews and readings while the user works
cut                   sewn lips cut open
creases               wrinkles as attributes and node groups
pictures              films, contact sheets, studio, letters
labels                what stands before a camera, for labels
jobs                  whole jobs for the command line
"""
