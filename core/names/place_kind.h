// What a name denotes, as the descriptor in it states: "Olympus Mons" is a mountain.
#pragma once

#include <string_view>

namespace marsview {

enum class PlaceKind {
    Other,          // without a descriptor
    LetteredCrater, // "Abbe H": a crater near the one that it is named after
    Canyon,         // Chasma, Labyrinthus
    Cape,           // Promontorium
    Chaos,
    Crater,      // no descriptor
    CraterChain, // Catena
    Dunes,       // Undae
    Hollow,      // Cavus
    LandingSite, // Statio
    Mountain,    // Mons, Tholus, Collis
    Plain,       // Planitia, Vastitas
    Plateau,     // Planum, Mensa
    Region,      // Terra, Regio
    Ridge,       // Dorsum
    Scarp,       // Rupes, Scopulus
    Sea,         // Mare, Oceanus, Sinus, Lacus, Palus
    Trough,      // Fossa, Rima, Sulcus
    Valley,      // Vallis
    Volcano,     // Patera
};

/// Never Crater, since names without a descriptor are not always craters. By the letter at the end
/// of a name of the IAU, or by the first Latin descriptor among its words.
PlaceKind kindOfName(std::string_view name);

} // namespace marsview
