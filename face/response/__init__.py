"""What muscles do to one face's skin, and what follows the skin.

regions                   how firmly each place is held, how stiffly it bends
sheet                     the skin's elastic answer to forces
pulls                     what of the muscles' pull shows
actuators                 muscles, lids and jaw as one list
spring_skin, relaxation   biphasic springs with mass and damping; their equilibrium under muscles
sampled                   these equilibria over a clip, from a few of them
recollection              and of a drag, from those found before
folds                     lines where squeezed skin gives way
followers                 mouth bag and sockets
rotations                 the rotations nearest to matrices
rooted                    lashes, brows and other pieces that grow out of the skin
"""
