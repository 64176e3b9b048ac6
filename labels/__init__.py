"""The truth beside a picture of a face: what every frame shows, in figures. NumPy and SciPy only; knows no Blender.

view, raster       a camera; what each of its pixels shows, and what hides a place
geometry, areas    what stands before it; lips, teeth, irises and all else of a face
marks, felt        landmarks; words and emotions
spoken             what is said: sounds, visemes, words
frames, pictures   one frame: rows of tables, and pictures of areas, objects, depth and normals
record, tables     frames gathered, as tables with types and units
png, card          pictures as files; what is to be known of the labels
package            the folder that holds all this
"""
