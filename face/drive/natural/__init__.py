"""The natural drive: what a face does when it is asked for a few FAPs.

planning        the plan, step by step
meaning         what the emotion shows, beside what its profile asks
symmetry        left and right, evened and mirrored
ranges          requests held within anatomical ranges
conflicts       how far each request is doubted beside the others
recognition     which emotions a request shows
mixture         the mixture of action units that explains what is asked
synergies       ranges, action units and emotions as sums of them: the tables
"""
