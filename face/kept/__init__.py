"""What was worked out for a face, kept in a folder of the user's, so that the face is ready at once the next time.

frozen    objects of the package as plain figures and arrays, and back
entries   one file for each thing that is kept: checked, bounded, safe to delete
faces     which face a file is of, and faces out of such files
"""
