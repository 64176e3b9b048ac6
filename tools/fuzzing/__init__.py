"""Damaged files for every reader: each must be read to finite numbers, or refused by a RisoriusError, in time.

readers    what is read, and what is done with what was read
seeds      sound files of every kind, in a few lines each
batches    tables, designs and records of a batch
blend      what Risorius keeps in a .blend as text
meshes     meshes with one damage after another
mutations  what happens to files
attempts   one file given to one reader, and what is wrong with what came of it
watch      attempts in a process of their own, watched for crashes, hangs and memory
"""
