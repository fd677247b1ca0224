#include "core/annotations/annotation.h"

#include <algorithm>
#include <cmath>

namespace marsview {

const char* symbolName(MarkSymbol symbol)
{
    switch (symbol) {
    case MarkSymbol::Circle:
        return "circle";
    case MarkSymbol::Square:
        return "square";
    case MarkSymbol::Triangle:
        return "triangle";
    case MarkSymbol::Diamond:
        return "diamond";
    case MarkSymbol::Star:
        return "star";
    case MarkSymbol::Cross:
        return "cross";
    }
    return "";
}

std::optional<MarkSymbol> symbolNamed(std::string_view name)
{
    const auto* const found =
        std::find_if(kMarkSymbols.begin(), kMarkSymbols.end(),
                     [name](MarkSymbol symbol) { return symbolName(symbol) == name; });
    return found != kMarkSymbols.end() ? std::optional(*found) : std::nullopt;
}

DrawnBody drawnBody(const Georeference& map, const Body* body)
{
    const auto& crs = map.crs();
    if (!crs || !crs->ellipsoid()) {
        return {};
    }
    const Body* const named = body != nullptr ? body : crs->body();
    return {.name = named != nullptr ? std::string(named->name) : std::string(),
            .ellipsoid = crs->ellipsoid()};
}

bool isSameBody(const DrawnBody& a, const DrawnBody& b)
{
    if (!a.ellipsoid || !b.ellipsoid) {
        return !a.ellipsoid && !b.ellipsoid;
    }
    if (!a.name.empty() && !b.name.empty()) {
        return a.name == b.name;
    }
    constexpr double kRadiusTolerance = 0.01;
    return std::abs(a.ellipsoid->equatorial_m / b.ellipsoid->equatorial_m - 1.0) <=
           kRadiusTolerance;
}

std::size_t verticesNeeded(FeatureShape shape)
{
    switch (shape) {
    case FeatureShape::Point:
        return 1;
    case FeatureShape::Line:
        return 2;
    case FeatureShape::Polygon:
        return 3;
    }
    return 1;
}

} // namespace marsview
