// What drawn features share in a project file: colors, times and positions.
#pragma once

#include "core/annotations/annotation.h"
#include "core/json/json_members.h"

#include <optional>
#include <string>
#include <vector>

namespace marsview {

/// "#ffdd40"
std::string colorText(const Rgb8& color);
/// Empty for other texts.
std::optional<Rgb8> colorNamed(const std::string& text);
/// The member "color"; empty if there is none.
std::optional<Rgb8> colorFrom(Members& members);

/// "2026-11-23T20:58:21.125Z"
std::string timeText(DrawnTime time);
std::optional<DrawnTime> timeNamed(const std::string& text);
/// The member "time"; the epoch if there is none.
DrawnTime timeFrom(Members& members);

/// As "longitudes_latitudes_deg" or "map_points".
void putVertices(Json& json, const std::vector<DrawnVertex>& vertices);
/// All of one type. At most 10 million.
std::vector<DrawnVertex> verticesFrom(Members& members);

Json annotationJson(const Annotation& annotation);
Annotation annotationFrom(Members& members);

} // namespace marsview
