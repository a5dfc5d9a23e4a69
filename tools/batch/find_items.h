// The meshes of a batch: a folder's, or those that a list names; and a shard of them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tools/batch/item.h"

namespace intarsia::tools {

// input: a folder (its .ply .obj .stl .off, folders in it included, hidden ones left out, in order of their paths), or
// a text file with one mesh a line (relative to the list's folder; blank lines and lines that begin with # are
// skipped). Names are those of the files without ending, made unique with the folder's name or a number. Errors:
// bad_file if it is neither, or holds no mesh.
std::vector<BatchItem> find_items(const std::filesystem::path& input);

// Shard i of n, i from 1: items i, i + n, i + 2 n, ...
struct Shard {
  std::size_t index = 1, count = 1;
};

// "i/n"; empty: what Slurm says about the array task that this is (SLURM_ARRAY_TASK_ID, _MIN, _STEP, _COUNT), or
// everything. Errors: bad_argument.
Shard shard_of(const std::string& text);

std::vector<BatchItem> items_of_shard(const std::vector<BatchItem>& items, const Shard& shard);

}  // namespace intarsia::tools
