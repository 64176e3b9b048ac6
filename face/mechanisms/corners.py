"""The mouth's corners: AU 11, 12, 13, 15 and 20.

Anatomy. Zygomaticus major and minor from the cheekbone, levator anguli oris from the upper jaw, risorius from the
fascia of the cheek and depressor anguli oris from the mandible meet at the mouth's corner and draw it up and back
(smile), up, back and down. They are what the second paper's linear muscle was made for, and need nothing more.

Source: FACS muscle list (docs/sources.md) for the lines of action; own calibration on scanned smile, frown and stretch.
"""
