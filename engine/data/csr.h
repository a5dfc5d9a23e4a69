// Rows of items in two arrays. Rows are ascending unless a header says otherwise: that makes every gather order-stable.
#pragma once

#include <span>
#include <vector>

#include "engine/base/types.h"

namespace intarsia {

struct CsrView {
  std::span<const Index> offset;  // rows + 1
  std::span<const Index> item;

  Index rows() const { return offset.empty() ? 0 : static_cast<Index>(offset.size() - 1); }
  std::span<const Index> row(Index r) const { return item.subspan(offset[r], offset[r + 1] - offset[r]); }
};

struct Csr {
  std::vector<Index> offset;
  std::vector<Index> item;

  Index rows() const { return offset.empty() ? 0 : static_cast<Index>(offset.size() - 1); }
  std::span<const Index> row(Index r) const {
    return std::span<const Index>(item).subspan(offset[r], offset[r + 1] - offset[r]);
  }
  operator CsrView() const { return {offset, item}; }
  bool operator==(const Csr&) const = default;
};

}  // namespace intarsia
