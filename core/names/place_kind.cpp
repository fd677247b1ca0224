#include "core/names/place_kind.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

namespace marsview {
namespace {

// Descriptor terms of the IAU's gazetteer with their plurals.
constexpr std::array<std::pair<std::string_view, PlaceKind>, 58> kDescriptors{{
    {"Catena", PlaceKind::CraterChain}, {"Catenae", PlaceKind::CraterChain},
    {"Cavus", PlaceKind::Hollow},       {"Cavi", PlaceKind::Hollow},
    {"Chaos", PlaceKind::Chaos},        {"Chasma", PlaceKind::Canyon},
    {"Chasmata", PlaceKind::Canyon},    {"Collis", PlaceKind::Mountain},
    {"Colles", PlaceKind::Mountain},    {"Dorsum", PlaceKind::Ridge},
    {"Dorsa", PlaceKind::Ridge},        {"Fossa", PlaceKind::Trough},
    {"Fossae", PlaceKind::Trough},      {"Labyrinthus", PlaceKind::Canyon},
    {"Lacus", PlaceKind::Sea},          {"Mare", PlaceKind::Sea},
    {"Maria", PlaceKind::Sea},          {"Mensa", PlaceKind::Plateau},
    {"Mensae", PlaceKind::Plateau},     {"Mons", PlaceKind::Mountain},
    {"Montes", PlaceKind::Mountain},    {"Oceanus", PlaceKind::Sea},
    {"Palus", PlaceKind::Sea},          {"Paludes", PlaceKind::Sea},
    {"Patera", PlaceKind::Volcano},     {"Paterae", PlaceKind::Volcano},
    {"Planitia", PlaceKind::Plain},     {"Planitiae", PlaceKind::Plain},
    {"Planum", PlaceKind::Plateau},     {"Plana", PlaceKind::Plateau},
    {"Promontorium", PlaceKind::Cape},  {"Promontoria", PlaceKind::Cape},
    {"Regio", PlaceKind::Region},       {"Regiones", PlaceKind::Region},
    {"Rima", PlaceKind::Trough},        {"Rimae", PlaceKind::Trough},
    {"Rupes", PlaceKind::Scarp},        {"Rupēs", PlaceKind::Scarp},
    {"Scopulus", PlaceKind::Scarp},     {"Scopuli", PlaceKind::Scarp},
    {"Sinus", PlaceKind::Sea},          {"Statio", PlaceKind::LandingSite},
    {"Sulcus", PlaceKind::Trough},      {"Sulci", PlaceKind::Trough},
    {"Terra", PlaceKind::Region},       {"Terrae", PlaceKind::Region},
    {"Tholus", PlaceKind::Mountain},    {"Tholi", PlaceKind::Mountain},
    {"Unda", PlaceKind::Dunes},         {"Undae", PlaceKind::Dunes},
    {"Vallis", PlaceKind::Valley},      {"Valles", PlaceKind::Valley},
    {"Vallēs", PlaceKind::Valley},      {"Vastitas", PlaceKind::Plain},
    {"Vastitates", PlaceKind::Plain},   {"Labes", PlaceKind::Scarp},
    {"Fluctus", PlaceKind::Region},     {"Lingula", PlaceKind::Plateau},
}};

std::optional<PlaceKind> kindOfDescriptor(std::string_view word)
{
    const auto* const found =
        std::find_if(kDescriptors.begin(), kDescriptors.end(),
                     [word](const auto& entry) { return entry.first == word; });
    return found != kDescriptors.end() ? std::optional(found->second) : std::nullopt;
}

bool isLetters(std::string_view word)
{
    return !word.empty() && word.size() <= 2 &&
           std::all_of(word.begin(), word.end(),
                       [](char letter) { return letter >= 'A' && letter <= 'Z'; });
}

} // namespace

PlaceKind kindOfName(std::string_view name)
{
    const std::size_t last = name.rfind(' ');
    if (last != std::string_view::npos && isLetters(name.substr(last + 1))) {
        return PlaceKind::LetteredCrater;
    }
    for (std::string_view rest = name; !rest.empty();) {
        const std::size_t end = std::min(rest.find(' '), rest.size());
        if (const auto kind = kindOfDescriptor(rest.substr(0, end))) {
            return *kind;
        }
        rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    return PlaceKind::Other;
}

} // namespace marsview
