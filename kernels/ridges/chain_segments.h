// Segments between nodes chained to polylines.
#pragma once

#include <cstdint>
#include <span>

#include "engine/data/csr.h"
#include "engine/parallel/work.h"

namespace intarsia::kernels {

// Segment i joins nodes a[i] and b[i]. Chains run through nodes with exactly two segments and end at all others, and at
// nodes marked in `stop` (empty: none).
// Requires: ids below node_count; a[i] != b[i].
// Ensures: chains partition the segments; open chains first, by their end with the smaller (node, segment), written
// from there; then loops without a stop, by their smallest node, starting and ending with it.
Csr chain_segments(const Work& work, Index node_count, std::span<const Index> a, std::span<const Index> b,
                   std::span<const std::uint8_t> stop);

}  // namespace intarsia::kernels
