import os
from collections.abc import Callable
from typing import Any, Literal, TypedDict, overload

from numpy import bool_, float64, uint8, uint32
from numpy.typing import ArrayLike, NDArray

from . import measure as measure

__version__: str
contact_models: tuple[str, ...]

class Error(RuntimeError):
    """A map, a file or an argument cannot be used. The message names it and says what to do."""

    code: Literal[
        "not-found",
        "unreadable",
        "unsupported",
        "invalid",
        "out-of-range",
        "too-large",
        "canceled",
        "damaged",
    ]

class Map:
    """An open map. Immutable; any thread."""

    @property
    def info(self) -> dict[str, Any]:
        """The fields of `marsview-cli info --json`, without statistics of raw samples."""

    @property
    def shape(self) -> tuple[int, int]:
        """Rows and columns."""

    @overload
    def elevation(self, lon: float, lat: float) -> float: ...  # type: ignore[misc]
    @overload
    def elevation(self, lon: ArrayLike, lat: ArrayLike) -> NDArray[float64]:
        """Elevation of the surface in meters; NaN outside the map and in voids. Degrees east and
        north, broadcast against each other; latitudes of the kind that info names."""

    @overload
    def elevation_map(self, x: float, y: float) -> float: ...  # type: ignore[misc]
    @overload
    def elevation_map(self, x: ArrayLike, y: ArrayLike) -> NDArray[float64]:
        """The same at coordinates in the CRS of the map."""

    def array(self, window: tuple[int, int, int, int] | None = None) -> NDArray[float64]:
        """The samples in meters, NaN where void: of the whole map, or of the window (column, row,
        columns, rows)."""

    def render(
        self,
        *,
        size: tuple[int, int] = (1280, 800),
        look_at: tuple[float, float] | None = None,
        distance_m: float | None = None,
        azimuth_deg: float = 0.0,
        tilt_deg: float | None = None,
        exaggeration: float | None = None,
        error_px: float = 1.0,
        samples: int | None = None,
        shading: Literal["tint", "hillshade", "slope"] = "tint",
        ramp: str | None = None,
        light_deg: tuple[float, float] = (315.0, 45.0),
        contours: bool = False,
    ) -> NDArray[uint8]:
        """A picture, height × width × 3: by default of the whole map. look_at is in the CRS of the
        map. Needs OpenGL, but no display."""

def open(path: str | os.PathLike[str], **overrides: Any) -> Map:
    """Opens a map of any size. overrides replace what the file states: band, crs, body, radii_m,
    geotransform, vertical_unit, scale, offset, vertical_datum, nodata; latitude sets the kind of
    latitudes. A map that does not fit into memory is prepared first, which takes minutes."""

def prepare(
    path: str | os.PathLike[str],
    output: str | os.PathLike[str] | None = None,
    progress: Callable[[float], object] | None = None,
    **overrides: Any,
) -> dict[str, Any]:
    """Builds overviews for a map larger than memory. progress is called with the fraction that is
    done; if it returns False or raises, the work stops, and the next call resumes it."""

class Updates(TypedDict):
    proxy: NDArray[float64]
    contact: NDArray[bool_]
    feature: NDArray[uint8]
    force_direction: NDArray[float64]
    distance_m: NDArray[float64]
    counters: dict[str, NDArray[uint32]]

class ContactModel:
    """A contact model over a map, or over a two-dimensional array of elevations in meters.

    Goals over a map are x and y in its CRS and an elevation, as in `marsview-cli trace`. Over an
    array they are meters: x along a row, y upwards from the last row, and z, which counts
    exaggerated meters. One thread at a time."""

    def __init__(
        self,
        surface: Map | ArrayLike,
        model: str = "continuous-walk",
        *,
        exaggeration: float = 1.0,
        radius_m: float | None = None,
        cell_size_m: float | None = None,
    ) -> None: ...
    def place(self, goal: tuple[float, float, float]) -> tuple[float, float, float]:
        """Puts the proxy at the goal, or on the surface above it."""

    def update(self, goals: ArrayLike) -> Updates:
        """One update for each row of goals, N × 3. feature is 0 for a free proxy, 1 on a vertex,
        2 on an edge, 3 on a face. force_direction has length 1, or is zero."""
