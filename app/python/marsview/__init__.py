"""Topographic maps of planets: elevations, pictures, measurements and contact models.

    import marsview

    mars = marsview.open("mars_mola_4ppd.tif")
    mars.elevation(226.2, 18.65)                      # meters, at 226.2° E, 18.65° N
    mars.elevation(lons, lats)                        # of arrays of any shape
    picture = mars.render(size=(800, 500))            # height × width × 3 bytes
    marsview.measure.distance(mars, [(226, 18), (230, 20)])["geodesic_m"]
    model = marsview.ContactModel(mars)
    touched = model.update(goals)                     # goals: N × 3

Failures are raised as marsview.Error with the sentence that the command line prints. Long work
releases the interpreter and can be interrupted.
"""

import struct as _struct
import zlib as _zlib

from . import measure
from ._marsview import ContactModel, Error, Map, __version__, contact_models, open, prepare

__all__ = ["ContactModel", "Error", "Map", "contact_models", "measure", "open", "prepare"]


def _png(pixels):
    """The bytes of a PNG file with these height × width × 3 bytes."""
    height, width, _ = pixels.shape

    def chunk(kind, data):
        checked = kind + data
        return _struct.pack(">I", len(data)) + checked + _struct.pack(">I", _zlib.crc32(checked))

    rows = b"".join(b"\0" + row.tobytes() for row in pixels)
    header = _struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + b"".join(
        chunk(kind, data)
        for kind, data in ((b"IHDR", header), (b"IDAT", _zlib.compress(rows)), (b"IEND", b""))
    )


def _repr_png_(self):
    """For notebooks: a picture of the map; nothing where the machine cannot draw."""
    try:
        return _png(self.render(size=(640, 400)))
    except Error:
        return None


Map._repr_png_ = _repr_png_
