// CGAL's view of a result: faces, patches and lines. usage: cgal_reads PATCHES.ply NETWORK.polylines.txt
#include <fstream>
#include <iostream>
#include <sstream>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh/IO/PLY.h>

int main(int, char** argument) {
  using Point = CGAL::Simple_cartesian<double>::Point_3;
  CGAL::Surface_mesh<Point> mesh;
  std::ifstream file(argument[1], std::ios::binary);
  std::string comments;
  if (!CGAL::IO::read_PLY(file, mesh, comments)) return 1;
  const auto [patch, found] = mesh.property_map<CGAL::SM_Face_index, int>("f:patch");
  const auto [colour, coloured] = mesh.property_map<CGAL::SM_Face_index, CGAL::IO::Color>("f:color");
  if (!found || !coloured) return 2;
  int lines = 0;
  std::ifstream text(argument[2]);
  for (std::string line; std::getline(text, line) && !line.empty(); ++lines) {  // as the library's examples do
    std::istringstream in(line);
    std::size_t n = 0, read = 0;
    in >> n;
    for (Point p; read < n && in >> p; ++read) continue;
    if (n < 2 || read != n) return 3;
  }
  std::cout << mesh.number_of_vertices() << " " << mesh.number_of_faces() << " " << lines;
  for (const auto f : mesh.faces()) std::cout << " " << patch[f];
}
