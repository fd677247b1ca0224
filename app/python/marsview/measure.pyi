from typing import Any, Literal

from numpy import float64
from numpy.typing import ArrayLike, NDArray

from . import Map

_Frame = Literal["lonlat", "map"]

def distance(map: Map, points: ArrayLike, frame: _Frame = "lonlat") -> dict[str, Any]:
    """Lengths in meters along the line: geodesic_m, surface_m (along the terrain), straight_m,
    rise_m, and legs. A length along terrain that is partly void is None."""

def profile(
    map: Map, points: ArrayLike, step_m: float | None = None, frame: _Frame = "lonlat"
) -> dict[str, NDArray[float64]]:
    """Elevations along the geodesics between the points: arrays distance_m, lon, lat, x, y and
    elevation_m. By default a point at every edge of the terrain's triangles. Voids are NaN."""

def area(
    map: Map,
    points: ArrayLike,
    base: float | Literal["plane"] | None = None,
    frame: _Frame = "lonlat",
) -> dict[str, Any]:
    """Of the polygon: geodesic_m2, perimeter_m, surface_m2, covered_m2, min_m, max_m, mean_m, and
    with a base volume_above_m3 and volume_below_m3."""

def attitude(
    map: Map,
    points: ArrayLike,
    elevation_error_m: float | None = None,
    frame: _Frame = "lonlat",
) -> dict[str, Any]:
    """Strike and dip of the plane through three or more points, with 95 % errors."""

def crater(map: Map, points: ArrayLike, frame: _Frame = "lonlat") -> dict[str, Any]:
    """Center, diameter_m and depth_m of the crater with these three or more points on its rim."""

def slope(
    map: Map, points: ArrayLike, baseline_m: float | None = None, frame: _Frame = "lonlat"
) -> dict[str, NDArray[float64]]:
    """At each point: arrays elevation_m, slope_deg, and aspect_deg (downhill, clockwise from
    north; NaN where level)."""
