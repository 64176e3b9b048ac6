"""The muscles of the anatomy tables (`table`), and their lines placed on one face (`placement`)."""
