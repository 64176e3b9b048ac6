"""Muscles: how far each is contracted, some of them by the user's own hand; and what the skin is made of.

ops      leave muscles to the emotion again
panel    a slider for each muscle
props    contractions set by hand, and the list that shows them
"""
