// OBJ and OFF through the readers of OpenMesh 9, with an importer of ours that collects the plain soup: no half-edges,
// no face dropped, order kept.
#pragma once

#include <filesystem>

#include "engine/data/mesh.h"
#include "engine/io/plain_text.h"
#include "engine/parallel/work.h"

namespace intarsia {

// `extension`: "obj" or "off". `path` is only named in errors. May be called from several threads; OpenMesh's readers
// are single objects with state, so the calls take turns.
// Errors: bad_file (element = face of the file) if a corner names no vertex; too_large; internal if OpenMesh did not
// deliver what the text holds.
Soup read_with_openmesh(const Work& work, const std::filesystem::path& path, PlainText&& plain, const char* extension);

}  // namespace intarsia
