// Small files of every kind that the readers know, made here: where mutation begins.
#pragma once

#include <string>
#include <vector>

namespace intarsia::fuzz {

std::vector<std::string> ply_seeds();
std::vector<std::string> stl_seeds();
std::vector<std::string> obj_seeds();
std::vector<std::string> off_seeds();
std::vector<std::string> label_seeds();
std::vector<std::string> surface_seeds();

}  // namespace intarsia::fuzz
