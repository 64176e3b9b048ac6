"""Reading what a face shows: beliefs in emotions, FAPs and features, now and over time.

ops      read the animation, show its plot, take away what was written
panel    beliefs, FAPs, features
props    how faces are read, and what is written
live     keeps the reading up to date while a panel shows it
"""
