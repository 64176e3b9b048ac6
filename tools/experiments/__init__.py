"""Models that were built to be measured, not shipped; docs/experiments.md tells what came of each.

`fat` and `two_layer_skin` are a skin of two layers, `compare_layers` holds it against the one-layer skin.
"""
