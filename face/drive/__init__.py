"""What is asked of a face, what it can do of it, and the amounts of muscles, lids and jaw behind that.

wishes                  what each way of driving a face asks of the feature points
natural, synergies      the natural mode: ranges, action units and the mixture that explains a request
inverse                 from wanted displacements to amounts
bounded_least_squares   the small problems that both solve
"""
