// What the user prefers, everywhere and from now on.
#pragma once

#include "core/contact/contact_model.h"
#include "ui/number_text.h"

class QSettings;

namespace marsview {

enum class Theme { System, Light, Dark };

struct Preferences {
    Theme theme = Theme::System;
    HeightUnit height_unit = HeightUnit::Metres;
    bool has_antialiasing = true; // where the driver does it without effort
    int frames_per_s = 30;        // while something moves: 20, 30 or 60
    ContactModelKind contact_model = kContactModelDefault;

    bool operator==(const Preferences&) const = default;
};

/// Defaults for whatever is missing or makes no sense.
Preferences preferencesFrom(const QSettings& settings);
void save(const Preferences& preferences, QSettings& settings);

} // namespace marsview
