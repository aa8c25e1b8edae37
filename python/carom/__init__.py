"""Physically exact films of bouncing balls, from a text, with no display.

    import carom
    scene = carom.load("scene.yaml", set={"balls.a.mass": 1})
    motion = carom.simulate(scene)
    motion.states([0, 0.1, 0.2]).position     # times x balls x 3
    carom.film(scene, motion, "film.mp4")

Metres, seconds, radians; z points up. docs/python.md describes all of it.
"""

# NumPy, whose import takes longer than all else here, and json come when they are first needed.
import os as _os
from collections import namedtuple as _namedtuple

from . import _carom
from ._carom import Diagnostic, Error, Motion as _Motion, Scene, SceneError, __version__

__all__ = ["Against", "Diagnostic", "Difference", "Error", "Fit", "Motion", "Scene", "SceneError", "States",
           "compare", "film", "fit", "layers", "load", "read_png", "second_run", "simulate", "still", "write_png",
           "EVENT_DTYPE"]

for _kind in (Diagnostic, Error, Scene, SceneError):
    _kind.__module__ = __name__  # as users name them


def __getattr__(name):
    if name != "EVENT_DTYPE":
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    import numpy
    value = globals()[name] = numpy.dtype([
        ("time", "f8"), ("ball", "i4"), ("other", "i4"), ("other_is_surface", "?"), ("kind", "U8"),
        ("point", "f8", 3), ("normal", "f8", 3), ("approach_speed", "f8"), ("separation_speed", "f8"),
        ("restitution", "f8"), ("impulse", "f8"), ("tangential_impulse", "f8")])
    return value


def __dir__():
    return sorted({*globals(), *__all__})


class States(_namedtuple("States", "position orientation velocity spin")):
    """Of all balls at all times: arrays whose first two axes are times and balls.

    Centres in m; w, x, y, z of the turn to world from ball; m/s; rad/s about world axes.
    """

    __slots__ = ()


class Difference(_namedtuple("Difference", "same_size largest differing_pixels pixels psnr_db ssim")):
    """How far two pictures are apart (docs/commands.md)."""

    __slots__ = ()

    def same(self, tolerance=2, max_differing=0.01):
        """True where both limits hold, which are those of `carom compare`."""
        return (self.same_size and self.largest <= tolerance
                and self.differing_pixels <= max_differing * self.pixels)


class Fit(_namedtuple("Fit", "restitution uncertainty low high distance_per_velocity material")):
    """A coefficient of restitution from measurements.

    `uncertainty` is the standard one and `low` to `high` the interval of 95 %, None where one
    measurement says nothing of them; `distance_per_velocity` is x / v of the virtual body in s;
    `material` is YAML to paste into a scene.
    """

    __slots__ = ()


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
        import numpy as np
        instants = np.asarray(times, dtype=float)
        rows = self._inner.states(instants.ravel())
        rows = rows.reshape(instants.shape + rows.shape[1:])
        return States(rows[..., 0:3], rows[..., 3:7], rows[..., 7:10], rows[..., 10:13])

    @property
    def events(self):
        """A structured array (EVENT_DTYPE), by time; `ball` and `other` are indices."""
        import numpy as np
        columns = self._inner.events()
        dtype = __getattr__("EVENT_DTYPE")
        rows = np.zeros(len(columns["time"]), dtype)
        for name in dtype.names:
            if len(rows):
                rows[name] = columns[name]
        return rows

    def peaks(self, ball):
        """Rows of time [s] and height of the gap [m], of a ball by name or index."""
        index = self.balls.index(ball) if isinstance(ball, str) else ball
        import numpy as np
        return np.array(self._inner.peaks(index), dtype=float).reshape(-1, 2)


def _setting(value):
    """YAML of a value: a text is YAML already."""
    if isinstance(value, str):
        return value
    import json
    return json.dumps(value, default=lambda v: v.tolist() if hasattr(v, "tolist") else str(v))


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


class Against(_namedtuple("Against", "scene motion view", defaults=("ghost",))):
    """A run to show with the first: as ghosts in the same picture, or with the view "side" in a half of its own.

    Balls of equal names are compared; camera, film and overlay are the first scene's.
    """

    __slots__ = ()


def second_run(scene, progress=None):
    """The run that the scene's own key `against` names, simulated: an Against, or None without the key.

    `still`, `film` and `layers` do this at each call; once is enough for many.
    """
    inner = _carom.second_run(scene, progress)
    return inner and Against(inner.scene, Motion(inner.motion), "side" if inner.side else "ghost")


def _against(against):
    if against is None:
        return None
    scene, motion, view = Against(*against)
    if view not in ("ghost", "side"):
        raise ValueError(f"a second run is shown as 'ghost' or 'side', not {view!r}")
    return _carom.Against(scene, motion._inner, view == "side")


def _names(layers):
    return [layers] if isinstance(layers, str) else list(layers)


def still(scene, motion, time, *, against=None):
    """The picture of an instant: rows x columns x 4 (R, G, B, A), uint8.

    `against`: a second run to show, an Against or (scene, motion); else what the scene names, if it does.
    """
    return _carom.still(scene, motion._inner, time, _against(against))


def layers(scene, motion, time, names, *, against=None):
    """What the pixels of an instant show, in numbers: arrays by name (docs/layers.md).

    `names`: "depth", "distance", "segmentation", "normals", "flow", "backflow", "coordinates", one or a list.
    Rows x columns, or rows x columns x channels; float32, of "segmentation" uint16. Of `against` the camera knows.
    """
    return _carom.layers(scene, motion._inner, time, _names(names), _against(against))


def film(scene, motion, path, *, codec="", quality="", crf=None, threads=0, overwrite=False, progress=None,
         against=None, layers=()):
    """Films all frames to `path`, a film by its extension, a name with %05d, or a folder of PNGs.

    The number of frames. `progress` is called now and then with the frames written; `against` as in still();
    `layers` are names, whose files are written beside PNG frames.
    """
    return _carom.film(scene, motion._inner, _os.fspath(path), codec, quality, crf, threads, overwrite, progress,
                       _against(against), _names(layers))


def fit(drops=None, rebounds=None, *, intervals=None, constant=4.0, velocity=5.0, reading_error=None):
    """A coefficient from heights [m] of drops and rebounds, or from times between bounces [s]."""
    if (intervals is None) == (drops is None or rebounds is None):
        raise TypeError("fit() wants drops and rebounds, or intervals")
    if intervals is not None:
        return Fit(*_carom.fit_intervals(list(intervals), constant, velocity, reading_error))
    return Fit(*_carom.fit_drops(_listed(drops), _listed(rebounds), constant, velocity, reading_error))


def _listed(values):
    try:
        return list(values)
    except TypeError:  # a number
        return [values]


def read_png(path):
    """Any PNG as rows x columns x 4 (R, G, B, A), uint8."""
    return _carom.read_png(_os.fspath(path))


def write_png(path, picture):
    """Writes rows x columns (grey), x 3 or x 4 of uint8; an existing file is replaced."""
    _carom.write_png(_os.fspath(path), _pixels(picture))


def _pixels(picture):
    import numpy as np
    array = np.asarray(picture)
    if array.dtype != np.uint8:
        raise TypeError(f"a picture is an array of uint8, not of {array.dtype}")
    return np.ascontiguousarray(array)


def compare(a, b):
    """How far two pictures are apart: arrays, or paths of PNGs."""
    a, b = (read_png(p) if isinstance(p, (str, _os.PathLike)) else _pixels(p) for p in (a, b))
    return Difference(*_carom.compare(a, b))
