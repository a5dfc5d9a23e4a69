// Artefacts in checkpoints: every field, so none can be forgotten.
#include "engine/io/artefact_file.h"
#include "graph/artefacts.h"

namespace intarsia {

std::uint64_t exact_hash_of(const Soup& a) { return exact_hash(a); }

}  // namespace intarsia

namespace intarsia::graph {

void write_to(ArtefactWriter& to, const Surface& a) { write_value(to, a); }
void write_to(ArtefactWriter& to, const Scale& a) { write_value(to, a); }
void write_to(ArtefactWriter& to, const Sharp& a) { write_value(to, a); }
void write_to(ArtefactWriter& to, const Curvature& a) { write_value(to, a); }
void write_to(ArtefactWriter& to, const Directions& a) { write_value(to, a); }
void write_to(ArtefactWriter& to, const Lines& a) { write_value(to, a); }
void write_to(ArtefactWriter& to, const Ridges& a) { write_value(to, a); }
void write_to(ArtefactWriter& to, const Curves& a) { write_value(to, a); }
void write_to(ArtefactWriter& to, const Guides& a) { write_value(to, a); }
void write_to(ArtefactWriter& to, const Goal& a) { write_value(to, a); }
void write_to(ArtefactWriter& to, const Network& a) { write_value(to, a); }
void write_to(ArtefactWriter& to, const Patches& a) { write_value(to, a); }
void write_to(ArtefactWriter& to, const Smoothing& a) { write_value(to, a); }
void write_to(ArtefactWriter& to, const Layout& a) { write_value(to, a); }

void read_from(ArtefactReader& from, Surface& a) { read_value(from, a); }
void read_from(ArtefactReader& from, Scale& a) { read_value(from, a); }
void read_from(ArtefactReader& from, Sharp& a) { read_value(from, a); }
void read_from(ArtefactReader& from, Curvature& a) { read_value(from, a); }
void read_from(ArtefactReader& from, Directions& a) { read_value(from, a); }
void read_from(ArtefactReader& from, Lines& a) { read_value(from, a); }
void read_from(ArtefactReader& from, Ridges& a) { read_value(from, a); }
void read_from(ArtefactReader& from, Curves& a) { read_value(from, a); }
void read_from(ArtefactReader& from, Guides& a) { read_value(from, a); }
void read_from(ArtefactReader& from, Goal& a) { read_value(from, a); }
void read_from(ArtefactReader& from, Network& a) { read_value(from, a); }
void read_from(ArtefactReader& from, Patches& a) { read_value(from, a); }
void read_from(ArtefactReader& from, Smoothing& a) { read_value(from, a); }
void read_from(ArtefactReader& from, Layout& a) { read_value(from, a); }

}  // namespace intarsia::graph
