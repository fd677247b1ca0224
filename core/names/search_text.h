// Text as a search compares it.
#pragma once

#include <string>
#include <string_view>

namespace marsview {

/// Lower-case Latin letters without diacritics, runs of blanks, hyphens and apostrophes as one
/// blank, none at either end: "Bečvář D" becomes "becvar d", "Østrem" "ostrem", "Гагарин"
/// "gagarin". Any thread; invalid UTF-8 is replaced.
std::string searchText(std::string_view text);

} // namespace marsview
