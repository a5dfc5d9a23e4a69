// Connectivity of a triangle mesh from its corners alone: edges by sorting, stars by counting; no hash maps.
#pragma once

#include "engine/data/mesh.h"
#include "engine/parallel/work.h"

namespace intarsia {

// Fills edge_v0, edge_v1, edge_f0, edge_f1, face_edge, vertex_faces, vertex_vertices from x, y, z and corner.
// Requires: corner ids below vertex_count; three different vertices in every face.
// Ensures: edges sorted by (smaller, larger vertex id); all rows ascending.
// Errors: rejected (element = the lower face id) if an edge has more than two faces or two faces that run along it in
// the same direction.
void connect_mesh(const Work& work, Mesh& mesh);

// The same without vertex_vertices, which stays empty.
void connect_faces(const Work& work, Mesh& mesh);

}  // namespace intarsia
