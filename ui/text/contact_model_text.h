// Names and explanations of the contact models.
#pragma once

#include "core/contact/contact_model.h"

#include <QString>

#include <span>

namespace marsview {

/// Untranslated, in the context "WindowActions".
struct ContactModelWords {
    ContactModelKind model;
    const char* text; // with the key of the menu
    const char* tip;
};

/// In the order of the menu.
std::span<const ContactModelWords> contactModelWords();

/// What the menu calls a contact model.
QString contactModelText(ContactModelKind kind);

} // namespace marsview
