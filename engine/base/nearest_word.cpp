#include "engine/base/nearest_word.h"

#include <algorithm>
#include <numeric>

namespace intarsia {
namespace {

// Levenshtein's distance.
std::size_t edits(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0]++;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t changed = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({changed, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

}  // namespace

std::string nearest_word(const std::string& word, const std::vector<std::string>& known) {
  const auto nearest = std::min_element(known.begin(), known.end(), [&](const std::string& a, const std::string& b) {
    return edits(word, a) < edits(word, b);
  });
  return nearest == known.end() ? std::string() : *nearest;
}

std::string likely_word(const std::string& word, const std::vector<std::string>& known) {
  std::string nearest = nearest_word(word, known);
  if (!nearest.empty() && 3 * edits(word, nearest) <= std::max(word.size(), nearest.size()) + 1) return nearest;
  constexpr std::size_t kLeastLetters = 3;
  // the last part of a dotted name is what people remember of it
  const std::string bare = word.substr(std::min(word.find_first_not_of('-'), word.size()));
  for (const std::string& k : known)
    if (bare.size() >= kLeastLetters && k.find(bare) != std::string::npos) return k;
  return {};
}

}  // namespace intarsia
