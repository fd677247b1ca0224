"""Measurements on the terrain of a map, on the ellipsoid of its body.

Points are pairs of longitude and latitude in degrees, or of map coordinates with frame="map".
"""

from . import _marsview

area = _marsview.measure.area
attitude = _marsview.measure.attitude
crater = _marsview.measure.crater
distance = _marsview.measure.distance
profile = _marsview.measure.profile
slope = _marsview.measure.slope

__all__ = ["area", "attitude", "crater", "distance", "profile", "slope"]
