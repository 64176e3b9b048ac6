"""A folder of labels: tables, pictures, a schema and a data card, written whole or not at all."""

from __future__ import annotations

import json
import os
import shutil
import tempfile
from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path

from ..errors import FormatError
from .card import Card
from .png import Pixels, png_bytes
from .tables import Table

SCHEMA, CARD, README = "datapackage.json", "card.json", "README.md"
PICTURES = "pictures"


class Draft:
    """A folder that is being filled beside the place where it will be; nothing of it is seen until it is complete."""

    def __init__(self, folder: Path) -> None:
        """Begin labels for a folder; earlier labels there stay until `finish`.

        Raises
        ------
        FormatError : there is something else than labels in the folder, or it cannot be written.
        """
        refuse_other(folder)
        self.folder = folder
        try:
            folder.parent.mkdir(parents=True, exist_ok=True)
            self._draft = Path(tempfile.mkdtemp(prefix=f".{folder.name}.", suffix=".draft", dir=folder.parent))
        except OSError as error:
            raise _unwritable(folder, error) from error

    def add_picture(self, kind: str, name: str, pixels: Pixels) -> None:
        """Put a picture into the folder of its kind.

        Raises
        ------
        FormatError : it cannot be written.
        """
        path = self._draft / PICTURES / kind / name
        try:
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(png_bytes(pixels))
        except OSError as error:
            raise _unwritable(self.folder, error) from error

    def finish(self, tables: Sequence[Table], card: Card) -> None:
        """Write tables, schema and card, and put all of it in place.

        Raises
        ------
        FormatError : something cannot be written; earlier labels are as they were.
        """
        try:
            for table in tables:
                self._write(f"{table.name}.csv", table.csv_bytes())
                parquet = table.parquet_bytes()
                if parquet is not None:
                    self._write(f"{table.name}.parquet", parquet)
            package = {
                "profile": "tabular-data-package",
                "name": "risorius-labels",
                "resources": [table.described() for table in tables],
            }
            self._write(SCHEMA, _json(package))
            self._write(CARD, _json(card.facts))
            self._write(README, card.page(tables).encode("utf-8"))
            self._draft.chmod(0o777 & ~_umask())
            _put_in_place(self._draft, self.folder)
        except OSError as error:
            raise _unwritable(self.folder, error) from error
        finally:
            self.discard()

    def discard(self) -> None:
        """Take away what has not been put in place."""
        shutil.rmtree(self._draft, ignore_errors=True)

    def _write(self, name: str, content: bytes) -> None:
        (self._draft / name).write_bytes(content)


def _json(content: object) -> bytes:
    return (json.dumps(content, indent=2, ensure_ascii=False) + "\n").encode("utf-8")


def refuse_other(folder: Path) -> None:
    """Refuse a folder that holds anything but labels; they are replaced."""
    if folder.is_dir() and not (folder / CARD).is_file() and any(folder.iterdir()):
        raise FormatError(folder, "is a folder with other files: choose an empty or a new one for labels")
    if folder.exists() and not folder.is_dir():
        raise FormatError(folder, "is a file: choose a folder for labels")


def _put_in_place(draft: Path, folder: Path) -> None:
    """Make a draft the folder; earlier labels go only once it is there."""
    if not folder.exists():
        os.replace(draft, folder)
        return
    aside = Path(tempfile.mkdtemp(prefix=f".{folder.name}.", suffix=".old", dir=folder.parent))
    earlier = aside / folder.name
    os.replace(folder, earlier)
    try:
        os.replace(draft, folder)
    except OSError:
        os.replace(earlier, folder)
        raise
    finally:
        with suppress(OSError):
            shutil.rmtree(aside)


def _umask() -> int:
    """The rights that new files of this process lack."""
    mask = os.umask(0)
    os.umask(mask)
    return mask


def _unwritable(folder: Path, error: OSError) -> FormatError:
    return FormatError(folder, f"cannot be written ({error.strerror}): choose a folder you may write to")
