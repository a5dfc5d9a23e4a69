#include "tools/export/vtp_file.h"

namespace intarsia::tools {

void VtpFile::add(const char* section, Array array) {
  for (Section& s : section_)
    if (s.name == section) {
      s.array.push_back(std::move(array));
      return;
    }
  section_.push_back({section, {std::move(array)}});
}

void VtpFile::write(const std::filesystem::path& path) const {
  FileWriter out(path);
  const auto cells_in = [&](const char* section) { return cell_section_ == section ? cells_ : 0; };
  out.text(
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\">\n<PolyData>\n<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"0\" NumberOfLines=\"{}\" "
      "NumberOfStrips=\"0\" NumberOfPolys=\"{}\">\n",
      points_, cells_in("Lines"), cells_in("Polys"));
  std::uint64_t offset = 0;
  for (const Section& s : section_) {
    out.text("<{}>\n", s.name);
    for (const Array& a : s.array) {
      out.text("<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"appended\" offset=\"{}\"/>\n",
               a.type, a.name, a.components, offset);
      offset += sizeof(std::uint64_t) + a.bytes;
    }
    out.text("</{}>\n", s.name);
  }
  out.text("</Piece>\n</PolyData>\n<AppendedData encoding=\"raw\">\n_");
  for (const Section& s : section_)
    for (const Array& a : s.array) {
      out.put<std::uint64_t>(a.bytes);
      a.rows(out);
    }
  out.text("\n</AppendedData>\n</VTKFile>\n");
  out.commit();
}

}  // namespace intarsia::tools
