"""Many clips and stills from a table, each made whole or not at all, on one machine or many.

columns     what a row may say: each column with its default, unit and range
values      one cell read by its column's rule
rows        the rows of a CSV or TOML file, as spreadsheets, programs and people write them
table       these rows as jobs; what is wrong with one, cell by cell
jobs        one row as a job: its name, what it was made from, what it is to make
design      factors and levels as the rows of a table
claims      one job is made by one process at a time
place       the folder of a set: jobs done, in work, failed, put aside
records     what is written down of a job that is done, and whether it is still there, byte for byte
whole       whether a file is complete, by its own format
making      one job, by the jobs of scene
doing       the same from its claim to its place: made, kept, or failed with a reason
running     all jobs one after another, beside others who do the same
cluster     the same on the workers of a Dask cluster; not in Blender's zip
measures    how long jobs take, from those that are done
manifest    the list of all that is done
"""
