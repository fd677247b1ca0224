// Annotations as the document holds them: points, lines and polygons that people draw on a map.
#pragma once

#include "core/annotations/drawn_vertex.h"
#include "core/geo/body.h"
#include "core/geo/georeference.h"
#include "core/vector/feature.h"
#include "core/view/color_ramp.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace marsview {

/// How a point is drawn.
enum class MarkSymbol : std::uint8_t { Circle, Square, Triangle, Diamond, Star, Cross };

inline constexpr std::array kMarkSymbols{MarkSymbol::Circle,   MarkSymbol::Square,
                                         MarkSymbol::Triangle, MarkSymbol::Diamond,
                                         MarkSymbol::Star,     MarkSymbol::Cross};

/// In files: "circle", "square", "triangle", "diamond", "star", "cross".
const char* symbolName(MarkSymbol symbol);
/// Empty for other texts.
std::optional<MarkSymbol> symbolNamed(std::string_view name);

/// What positions are on.
struct DrawnBody {
    std::string name{};                   // of knownBodies(); empty if unknown
    std::optional<Ellipsoid> ellipsoid{}; // empty: a map without a body

    bool operator==(const DrawnBody&) const = default;
};

/// The body of a map; `body` replaces the one that its CRS names.
DrawnBody drawnBody(const Georeference& map, const Body* body);

/// The same name, or equatorial radii within 1 % where a name is unknown. Maps without a body are
/// the same for this.
bool isSameBody(const DrawnBody& a, const DrawnBody& b);

struct Annotation {
    FeatureShape shape = FeatureShape::Point;
    std::string name{};
    std::string note{};
    std::optional<Rgb8> color{};            // empty: the usual one
    MarkSymbol symbol = MarkSymbol::Circle; // of a point
    DrawnBody body{};
    /// All of one type. The border of a polygon is closed from the last one to the first.
    std::vector<DrawnVertex> vertices{};
    DrawnTime time{}; // at which it was begun

    bool operator==(const Annotation&) const = default;
};

/// The least number of vertices of a shape: 1, 2, 3.
std::size_t verticesNeeded(FeatureShape shape);

} // namespace marsview
