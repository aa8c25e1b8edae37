"""Physically exact films of bouncing balls, from a text, with no display.

    import carom
    scene = carom.load("scene.yaml", set={"balls.a.mass": 1})
    motion = carom.simulate(scene)
    motion.states([0, 0.1, 0.2]).position     # times x balls x 3
    carom.film(scene, motion, "film.mp4")

Metres, seconds, radians; z points up. docs/python.md describes all of it.
"""

import json as _json
import os as _os
from typing import NamedTuple as _NamedTuple

import numpy as _np

from . import _carom
from ._carom import Diagnostic, Error, Motion as _Motion, Scene, SceneError, __version__

__all__ = ["Diagnostic", "Difference", "Error", "Fit", "Motion", "Scene", "SceneError", "States",
           "compare", "film", "fit", "load", "read_png", "simulate", "still", "write_png", "EVENT_DTYPE"]

for _kind in (Diagnostic, Error, Scene, SceneError):
    _kind.__module__ = __name__  # as users name them

EVENT_DTYPE = _np.dtype([
    ("time", "f8"), ("ball", "i4"), ("other", "i4"), ("other_is_surface", "?"), ("kind", "U8"),
    ("point", "f8", 3), ("normal", "f8", 3), ("approach_speed", "f8"), ("separation_speed", "f8"),
    ("restitution", "f8"), ("impulse", "f8"), ("tangential_impulse", "f8")])


class States(_NamedTuple):
    """Of all balls at all times: arrays whose first two axes are times and balls."""

    position: _np.ndarray     # of the centres, m
    orientation: _np.ndarray  # w, x, y, z: world from ball
    velocity: _np.ndarray     # m/s
    spin: _np.ndarray         # rad/s, world axes


class Difference(_NamedTuple):
    """How far two pictures are apart (docs/commands.md)."""

    same_size: bool
    largest: float
    differing_pixels: int
    pixels: int
    psnr_db: float
    ssim: float

    def same(self, tolerance=2, max_differing=0.01):
        """True where both limits hold, which are those of `carom compare`."""
        return (self.same_size and self.largest <= tolerance
                and self.differing_pixels <= max_differing * self.pixels)


class Fit(_NamedTuple):
    """A coefficient of restitution from measurements."""

    restitution: float
    uncertainty: "float | None"  # standard
    low: "float | None"          # of the interval of 95 %
    high: "float | None"
    distance_per_velocity: float  # x / v of the virtual body, s
    material: str                 # YAML to paste into a scene


class Motion:
    """The motion of a scene as a function of time, exact at any instant."""

    def __init__(self, inner):
        self._inner = inner

    duration = property(lambda self: self._inner.duration, doc="s")
    balls = property(lambda self: self._inner.balls, doc="names, in the scene's order")
    surfaces = property(lambda self: self._inner.surfaces, doc="names, in the scene's order")
    hash = property(lambda self: self._inner.hash, doc="equal for equal motions")

    def states(self, times):
        """States at an instant, or at an array of them, in seconds."""
        instants = _np.asarray(times, dtype=float)
        rows = self._inner.states(instants.ravel())
        rows = rows.reshape(instants.shape + rows.shape[1:])
        return States(rows[..., 0:3], rows[..., 3:7], rows[..., 7:10], rows[..., 10:13])

    @property
    def events(self):
        """A structured array (EVENT_DTYPE), by time; `ball` and `other` are indices."""
        columns = self._inner.events()
        rows = _np.zeros(len(columns["time"]), EVENT_DTYPE)
        for name in EVENT_DTYPE.names:
            if len(rows):
                rows[name] = columns[name]
        return rows

    def peaks(self, ball):
        """Rows of time [s] and height of the gap [m], of a ball by name or index."""
        index = self.balls.index(ball) if isinstance(ball, str) else ball
        return _np.array(self._inner.peaks(index), dtype=float).reshape(-1, 2)


def _setting(value):
    """YAML of a value: a text is YAML already."""
    if isinstance(value, str):
        return value
    return _json.dumps(value, default=lambda v: v.tolist() if hasattr(v, "tolist") else str(v))


def load(path_or_text, set=None):
    """A scene from a file, or from YAML in a text of more than one line.

    `set` changes values before they are validated: {"balls.a.mass": 1}. Raises SceneError, which
    has `diagnostics`, and Error where a file cannot be read.
    """
    settings = [(key, _setting(value)) for key, value in (set or {}).items()]
    if isinstance(path_or_text, str) and "\n" in path_or_text:
        return _carom.from_text(path_or_text, settings, "<text>")
    return _carom.from_file(_os.fspath(path_or_text), settings)


def simulate(scene, progress=None):
    """The motion of a scene. `progress` is called now and then with the seconds simulated."""
    return Motion(_carom.simulate(scene, progress))


def still(scene, motion, time):
    """The picture of an instant: rows x columns x 4 (R, G, B, A), uint8."""
    return _carom.still(scene, motion._inner, time)


def film(scene, motion, path, *, codec="", quality="", crf=None, threads=0, overwrite=False, progress=None):
    """Films all frames to `path`, a film by its extension, a name with %05d, or a folder of PNGs.

    The number of frames. `progress` is called now and then with the frames written.
    """
    return _carom.film(scene, motion._inner, _os.fspath(path), codec, quality, crf, threads, overwrite, progress)


def fit(drops=None, rebounds=None, *, intervals=None, constant=4.0, velocity=5.0, reading_error=None):
    """A coefficient from heights [m] of drops and rebounds, or from times between bounces [s]."""
    if (intervals is None) == (drops is None or rebounds is None):
        raise TypeError("fit() wants drops and rebounds, or intervals")
    if intervals is not None:
        return Fit(*_carom.fit_intervals(list(intervals), constant, velocity, reading_error))
    drops = [drops] if _np.ndim(drops) == 0 else list(drops)
    rebounds = [rebounds] if _np.ndim(rebounds) == 0 else list(rebounds)
    return Fit(*_carom.fit_drops(drops, rebounds, constant, velocity, reading_error))


def read_png(path):
    """Any PNG as rows x columns x 4 (R, G, B, A), uint8."""
    return _carom.read_png(_os.fspath(path))


def write_png(path, picture):
    """Writes rows x columns (grey), x 3 or x 4 of uint8; an existing file is replaced."""
    _carom.write_png(_os.fspath(path), _pixels(picture))


def _pixels(picture):
    array = _np.asarray(picture)
    if array.dtype != _np.uint8:
        raise TypeError(f"a picture is an array of uint8, not of {array.dtype}")
    return _np.ascontiguousarray(array)


def compare(a, b):
    """How far two pictures are apart: arrays, or paths of PNGs."""
    a, b = (read_png(p) if isinstance(p, (str, _os.PathLike)) else _pixels(p) for p in (a, b))
    return Difference(*_carom.compare(a, b))
