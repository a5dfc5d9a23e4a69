// Which files a result may hold besides those that every result has, and their names on the command line.
#pragma once

#include <functional>
#include <set>
#include <string>
#include <vector>

#include "tools/export/handover.h"

namespace intarsia::tools {

// Names of files as they stand in a folder of results ("patches.vtp", "quadwild/layout.obj").
using FileSet = std::set<std::string>;

// Files that --write can ask for, in the order of the documentation.
std::vector<std::string> export_names();

// The files of a list like "vtp,obj,labels.npy": names of formats (vtp obj seg npy csv polylines glb html quadwild),
// files, "all", "none".
// Errors: bad_argument naming the item, with the nearest name that there is.
FileSet export_files(const std::vector<std::string>& list);

// What --write is where it is not given: small files that cost next to nothing. The page is left out of large results.
std::vector<std::string> default_exports();

// For --help.
std::string export_help();

// Writes those of `files` that this folder makes (not view.html, which tools/view does).
// path_of: name -> where to write. Files that need the run's feature lines are left out where there are none.
void write_exports(const Work& work, const Handover& handover, const FileSet& files,
                   const std::function<std::filesystem::path(const std::string&)>& path_of);

}  // namespace intarsia::tools
