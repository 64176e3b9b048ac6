"""What outside judges see in rendered faces: a check, and no loss to descend.

sittings       what is pictured: a head, a word at an activation, or a sum of scanned actions as control; its pose
paint          brows, lips and irises for heads that bring no paint: where they lie
light          one light for all of them, from one side, that shows relief (needs bpy)
poses          the poses, kept as long as no source of theirs changes
portraits      the pictures, rendered small with Cycles and kept by what is in them (needs bpy)
mini_xception  one judge: the network of the package `fer`, in plain NumPy
judges         asks both about pictures, and keeps what they said
verdicts       what was named: confusion, means, growth
chart          growth with activation as lines
page           docs/strangers.md
sheets         its contact sheets, small JPEGs (needs bpy)

`face_api.cjs`, in Node, is the other judge: the npm package `@vladmandic/face-api`. The judges
run in `.venv-strangers`, which is set up on request and is no part of the product or its tests.
"""
