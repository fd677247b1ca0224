// Names of places on a body.
#pragma once

#include "core/geo/body.h"
#include "core/geo/frames.h"
#include "core/names/place_kind.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace marsview {

struct PlaceName {
    std::string name;
    GeographicPoint position{}; // of its center
    double diameter_m = 0.0;    // its largest extent; 0: unknown
    PlaceKind kind = PlaceKind::Other;
};

/// An immutable list of names with a search. Any thread.
class Gazetteer {
public:
    /// `body` is null if unknown.
    Gazetteer(const Body* body, std::vector<PlaceName> names);

    const Body* body() const noexcept { return body_; }
    /// The largest first; those of unknown size last, in the given order.
    const std::vector<PlaceName>& names() const noexcept { return names_; }
    /// Whether any diameter is known.
    bool hasSizes() const noexcept { return has_sizes_; }

    /// Indexes of the names that match `text`, the best first, at most `count_max`. First the name
    /// that equals the text, then names that begin with it, names with a later word that does, and
    /// names that contain it. Within each group lettered craters come last, and otherwise the
    /// largest first, where a quarter of the length of long features counts. Case, diacritics,
    /// hyphens and apostrophes are ignored. None for a text without letters or digits.
    std::vector<std::size_t> find(std::string_view text, std::size_t count_max) const;

    /// The name that is spelled most like a text that nothing matches; empty if none is near.
    std::string nearest(std::string_view text) const;

private:
    const Body* body_;
    std::vector<PlaceName> names_;
    std::vector<std::string> keys_; // searchText() of each
    bool has_sizes_ = false;
};

} // namespace marsview
