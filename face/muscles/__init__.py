"""The muscles of the anatomy tables, and what each kind of them does to the skin.

row, figures               what every row holds; how tables write what the rows of each kind hold
span, ellipse              muscles from bone to skin; muscles that lie in the skin, in an ellipse
linear, sheet, sphincter   the three classes of the second paper, and what they need on a face
window, band, arch,        a fixed line of pull; round the teeth; air in the cheek
  pressure
kinds                      all of these by name
table                      the rows of presets/anatomy/muscles/
placement                  a row on both sides of one face
insertion                  the skin that it may pull on there, and its pull
"""
