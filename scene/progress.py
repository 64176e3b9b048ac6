"""The progress of long work (`risorius.progress`), also under the name that scripts know it by."""

from ..progress import Progress, Work, part_of, run

__all__ = ["Progress", "Work", "part_of", "run"]
