#include "engine/io/read_with_openmesh.h"

#include <mutex>
#include <span>
#include <sstream>

#include <OpenMesh/Core/IO/IOManager.hh>
#include <OpenMesh/Core/IO/importer/BaseImporter.hh>
#include <OpenMesh/Core/System/omstream.hh>

#include "engine/io/face_collector.h"

namespace intarsia {
namespace {

namespace om = OpenMesh;

// Takes vertices and faces as they come; everything else that a reader may offer is not asked for and ignored.
class SoupImporter final : public om::IO::BaseImporter {
 public:
  SoupImporter(const Work& work, const PlainText& plain, FaceCollector& faces)
      : work_(work), plain_(plain), faces_(faces) {}

  std::uint64_t vertices_seen() const { return vertices_; }
  // Those whose turn it is.
  void add_odd_faces() {
    for (; next_odd_ < plain_.odd_face.size() && plain_.odd_face[next_odd_].face == faces_.face_count(); ++next_odd_) {
      const auto& odd = plain_.odd_face[next_odd_];
      faces_.add_polygon(std::span(plain_.odd_corner).subspan(odd.begin, odd.end - odd.begin));
    }
  }

  om::VertexHandle add_vertex(const om::Vec3f&) override { return add_vertex(); }
  om::VertexHandle add_vertex(const om::Vec3d&) override { return add_vertex(); }
  om::VertexHandle add_vertex() override {
    if (vertices_ % 4096 == 0) work_.check();
    return om::VertexHandle(static_cast<int>(vertices_++));
  }
  om::FaceHandle add_face(const VHandles& vertices) override {
    if (faces_.face_count() % 4096 == 0) work_.check();
    add_odd_faces();
    corner_.clear();
    for (const om::VertexHandle v : vertices) corner_.push_back(v.idx());
    faces_.add_polygon(corner_);
    return om::FaceHandle(static_cast<int>(faces_.face_count() - 1));
  }
  // Relative indices of OBJ count back from here.
  size_t n_vertices() const override { return vertices_; }
  size_t n_faces() const override { return faces_.face_count(); }
  size_t n_edges() const override { return 0; }

  om::HalfedgeHandle add_edge(om::VertexHandle, om::VertexHandle) override { return om::HalfedgeHandle(); }
  om::FaceHandle add_face(om::HalfedgeHandle) override { return om::FaceHandle(); }
  void add_face_texcoords(om::FaceHandle, om::VertexHandle, const std::vector<om::Vec2f>&) override {}
  void add_face_texcoords(om::FaceHandle, om::VertexHandle, const std::vector<om::Vec3f>&) override {}
  void set_face_texindex(om::FaceHandle, int) override {}
  void set_point(om::VertexHandle, const om::Vec3f&) override {}
  void set_halfedge(om::VertexHandle, om::HalfedgeHandle) override {}
  void set_normal(om::VertexHandle, const om::Vec3f&) override {}
  void set_normal(om::VertexHandle, const om::Vec3d&) override {}
  void set_color(om::VertexHandle, const om::Vec3uc&) override {}
  void set_color(om::VertexHandle, const om::Vec4uc&) override {}
  void set_color(om::VertexHandle, const om::Vec3f&) override {}
  void set_color(om::VertexHandle, const om::Vec4f&) override {}
  void set_texcoord(om::VertexHandle, const om::Vec2f&) override {}
  void set_texcoord(om::VertexHandle, const om::Vec3f&) override {}
  void set_status(om::VertexHandle, const om::Attributes::StatusInfo&) override {}
  void set_next(om::HalfedgeHandle, om::HalfedgeHandle) override {}
  void set_face(om::HalfedgeHandle, om::FaceHandle) override {}
  void request_face_texcoords2D() override {}
  void set_texcoord(om::HalfedgeHandle, const om::Vec2f&) override {}
  void set_texcoord(om::HalfedgeHandle, const om::Vec3f&) override {}
  void set_status(om::HalfedgeHandle, const om::Attributes::StatusInfo&) override {}
  void set_color(om::EdgeHandle, const om::Vec3uc&) override {}
  void set_color(om::EdgeHandle, const om::Vec4uc&) override {}
  void set_color(om::EdgeHandle, const om::Vec3f&) override {}
  void set_color(om::EdgeHandle, const om::Vec4f&) override {}
  void set_status(om::EdgeHandle, const om::Attributes::StatusInfo&) override {}
  void set_normal(om::FaceHandle, const om::Vec3f&) override {}
  void set_normal(om::FaceHandle, const om::Vec3d&) override {}
  void set_color(om::FaceHandle, const om::Vec3uc&) override {}
  void set_color(om::FaceHandle, const om::Vec4uc&) override {}
  void set_color(om::FaceHandle, const om::Vec3f&) override {}
  void set_color(om::FaceHandle, const om::Vec4f&) override {}
  void set_status(om::FaceHandle, const om::Attributes::StatusInfo&) override {}
  void add_texture_information(int, std::string) override {}

 private:
  const Work& work_;
  const PlainText& plain_;
  FaceCollector& faces_;
  std::uint64_t vertices_ = 0;
  std::size_t next_odd_ = 0;
  std::vector<std::int64_t> corner_;
};

// OpenMesh writes its warnings to the error stream of the process; a library must not.
class SilentOpenMesh {
 public:
  SilentOpenMesh() {
    omlog().disable();
    omerr().disable();
  }
  ~SilentOpenMesh() {
    omlog().enable();
    omerr().enable();
  }
  SilentOpenMesh(const SilentOpenMesh&) = delete;
  SilentOpenMesh& operator=(const SilentOpenMesh&) = delete;
};

}  // namespace

Soup read_with_openmesh(const Work& work, const std::filesystem::path& path, PlainText&& plain, const char* extension) {
  static std::mutex one_at_a_time;
  Soup soup;
  FaceCollector faces(path, plain.x.size(), soup);
  std::istringstream text(std::move(plain.text));
  SoupImporter importer(work, plain, faces);
  bool done = false;
  {
    const std::lock_guard<std::mutex> lock(one_at_a_time);
    const SilentOpenMesh silent;
    om::IO::Options options;
    done = om::IO::IOManager().read(text, extension, importer, options);
  }
  importer.add_odd_faces();
  if (!done || importer.vertices_seen() != plain.x.size() || faces.face_count() != plain.face_count)
    throw Error(ErrorCode::internal, path.string() + ": the text holds " + std::to_string(plain.x.size()) +
                                         " vertices and " + std::to_string(plain.face_count) +
                                         " faces, but OpenMesh delivered others; convert the file to PLY");
  soup.x = std::move(plain.x), soup.y = std::move(plain.y), soup.z = std::move(plain.z);
  return soup;
}

}  // namespace intarsia
