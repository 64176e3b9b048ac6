"""A recording, or any stream of FAPs, on a face as it is."""

from __future__ import annotations

from ...arrays import Floats
from ...mpeg4 import FapStream
from ...progress import Prepared
from ..face import Face
from ..simulate import Integrator
from ..tracked.formats import StreamFormat
from ..tracked.recording import Recording


def play(
    face: Face, recording: Recording | FapStream, *, drive: str = "natural", inertia: bool = False
) -> Prepared[Floats]:
    """Positions (V, 3) frame by frame, at the stream's rate; holes of the stream are bridged (`Recording.played`).

    Each frame is in balance: a face that was recorded has moved with its own inertia, and with another its jaw and lips
    would come late.

    Parameters
    ----------
    drive : as for `Face.simulate`.
    inertia : skin and jaw follow with inertia and damping all the same, for streams that were computed without any.

    Raises
    ------
    ParameterError : a stream without frames, or an unknown drive.

    Examples
    --------
    >>> frames = np.full((3, 68), np.nan)
    >>> frames[:, 3 - 1] = 0.0, 300.0, 0.0  # open_jaw
    >>> shown = list(api.play(api.default_face(), api.FapStream(frames, fps=25.0)))
    >>> bool(np.abs(shown[1] - shown[0]).max() > 5e-3)
    True
    """
    taken = recording if isinstance(recording, Recording) else Recording(recording, StreamFormat.FAP)
    frames, _ = taken.played()
    integrator = Integrator.REDUCED if inertia else Integrator.BALANCE
    return face.simulation(frames, taken.stream.fps, drive=drive, integrator=integrator)
