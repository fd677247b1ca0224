// What the user prefers, everywhere and from now on.
#pragma once

#include "core/contact/contact_model.h"
#include "core/geo/coordinate_format.h"
#include "core/session/map_resources.h"
#include "ui/text/number_text.h"

#include <QString>

#include <cstdint>

class QSettings;

namespace marsview {

enum class Theme { System, Light, Dark };

/// The view needs some hundred tiles at a time.
inline constexpr int kTileMemoryMbMin = 128;

struct Preferences {
    QString language{}; // code as in languages(); empty: the system's
    Theme theme = Theme::System;
    HeightUnit height_unit = HeightUnit::Meters;
    CoordinateFormat coordinates{}; // wherever positions are read or typed
    bool has_antialiasing = true;   // where the driver does it without effort
    int frames_per_s = 30;          // while something moves: 20, 30 or 60
    ContactModelKind contact_model = kContactModelDefault;
    bool reconnects_device = true; // at the start, if it was connected when the window closed
    int tile_memory_mb = 0;        // for tiles of large maps; 0: a quarter of memory
    QString map_folder{};          // of prepared maps; empty: the user's cache folder
    int map_folder_gb = 0;         // that they may take; 0: what suits the disk
    int fetched_gb = 0;            // that tiles from servers may take on disk; 0: kFetchedBytesMax

    bool operator==(const Preferences&) const = default;
};

/// Defaults for whatever is missing or makes no sense.
Preferences preferencesFrom(const QSettings& settings);
/// The resources that maps share: `standard`, overridden by preferences, which are overridden by
/// environment variables.
MapResources resourcesFor(const MapResources& standard, const Preferences& preferences);
/// How many bytes tiles from servers may take on disk.
std::uint64_t fetchedBytesMax(const Preferences& preferences);
void save(const Preferences& preferences, QSettings& settings);

} // namespace marsview
