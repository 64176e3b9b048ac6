"""What moves a face, one mechanism per file; their names and the switch that leaves any of them out: `face.mechanism`.

sliding, bulge, hood                    what the skin does beyond the second paper's membrane
nasolabial                              the fold beside the nose, and the fat that heaps up above it
separation                              upper and lower lip and lid, told apart along the skin
jaw, lids, lid_movers                   what turns: the mandible, the lids about the eyeballs, and the lids' muscles
brow, cheek, nose, lips, corners        muscles by region: where they insert, how firmly the skin is held there,
buccinator, chin, orbicularis_oris,       what their pulls have that the paper's three classes lack
  platysma

A mechanism says what it contributes; skin, muscles and actuators add the contributions up.
Its muscles stand in presets/anatomy/muscles/<name>.toml; its other figures in jaw.toml, lids.toml, skin.toml and
regions.toml beside that folder.
"""
