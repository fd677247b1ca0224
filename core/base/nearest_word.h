// Suggestions for mistyped names.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace marsview {

/// The word of `known` that differs from `word` by the fewest insertions, deletions, replacements
/// and swaps of neighboring letters, case ignored; the first of several. A beginning of at least
/// three letters counts as one edit. Empty if more than a third of the letters (at least one edit
/// is always allowed) would change.
std::string nearestWord(std::string_view word, std::span<const std::string> known);

/// The end of a message about an unknown word: `. Did you mean "X"?` with the nearest word; empty
/// if no word is near.
std::string didYouMean(std::string_view word, std::span<const std::string> known);

/// The same; if no word is near, `; known ones are X, Y`.
std::string didYouMeanOrKnown(std::string_view word, std::span<const std::string> known);

} // namespace marsview
