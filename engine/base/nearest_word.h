// "Did you mean ...?" for words that are not known.
#pragma once

#include <string>
#include <vector>

namespace intarsia {

// The word of `known` with the fewest changes of letters from `word`, the first of those; empty if there is none.
std::string nearest_word(const std::string& word, const std::vector<std::string>& known);

// The same if it is near enough to be what was meant: a third of the letters may be wrong, or it begins with the word.
std::string likely_word(const std::string& word, const std::vector<std::string>& known);

}  // namespace intarsia
