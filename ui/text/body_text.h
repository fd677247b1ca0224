// Names of bodies as people read them.
#pragma once

#include "core/geo/body.h"

#include <QString>

#include <string_view>

namespace marsview {

/// "Moon", in the language of the window.
QString bodyName(const Body& body);
/// Of a body that need not be known: then as it is.
QString bodyName(std::string_view name);

/// "the Moon", "Mars": a body after "on".
QString bodyInSentence(const Body& body);

} // namespace marsview
