// Points, lines and polygons with attributes.
#pragma once

#include "core/geo/crs.h"
#include "core/geo/frames.h"

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace marsview {

enum class FeatureShape { Point, Line, Polygon };

/// A line, a ring, or the points of a feature, in the CRS of its file. A ring ends with its first
/// point.
struct FeaturePart {
    std::vector<MapPoint> points;
    bool is_hole = false; // in the last ring before it that is not one
    bool operator==(const FeaturePart&) const = default;
};

/// A value of an attribute; empty if it has none.
using FieldValue = std::variant<std::monostate, std::int64_t, double, std::string>;

struct Feature {
    FeatureShape shape = FeatureShape::Point;
    std::vector<FeaturePart> parts;
    std::vector<FieldValue> values; // one for each field of the layer
    bool operator==(const Feature&) const = default;
};

enum class FieldType { Integer, Real, Text };

struct FeatureField {
    std::string name;
    FieldType type = FieldType::Text;
    bool operator==(const FeatureField&) const = default;
};

struct FeatureLayer {
    std::string name;
    std::vector<FeatureField> fields;
    std::vector<Feature> features;
};

/// The content of a vector file: layers in one CRS.
struct FeatureCollection {
    std::optional<Crs> crs;     // empty: coordinates are those of a map without one, or unknown
    const Body* body = nullptr; // null: unknown
    std::vector<FeatureLayer> layers;
};

} // namespace marsview
