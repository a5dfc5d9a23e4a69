// view.html read back: the numbers that the page's script decodes, and the coarser surface of large results.
#include <set>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "tests/tools/export/labelled_cube.h"
#include "tools/view/page_data.h"
#include "tools/view/page_surface.h"
#include "tools/view/read_page.h"
#include "tools/view/write_page.h"

using namespace intarsia;
using namespace intarsia::tools;
using doctest::Approx;

namespace {

std::string part(const std::string& page, const std::string& id) {
  const std::string tag = "id=\"" + id + "\">";
  const std::size_t begin = page.find(tag);
  REQUIRE(begin != std::string::npos);
  return page.substr(begin + tag.size(), page.find("</script>", begin) - begin - tag.size());
}

class Decoder {
 public:
  explicit Decoder(const std::string& text) {
    static const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    unsigned bits = 0, count = 0;
    for (const char c : text) {
      if (c == '=') break;
      bits = bits << 6 | static_cast<unsigned>(digits.find(c)), count += 6;
      if (count >= 8) bytes_ += static_cast<char>(bits >> (count -= 8) & 255);
    }
  }
  Index whole() {
    Index value = 0, shift = 0;
    for (;; shift += 7) {
      const auto byte = static_cast<unsigned char>(bytes_.at(at_++));
      value |= Index{byte & 127u} << shift;
      if (byte < 128) return value;
    }
  }
  int integer() {
    const Index folded = whole();
    return folded % 2 ? -static_cast<int>((folded + 1) / 2) : static_cast<int>(folded / 2);
  }
  bool done() const { return at_ == bytes_.size(); }

 private:
  std::string bytes_;
  std::size_t at_ = 0;
};

}  // namespace

TEST_CASE("the page holds the cube: faces by patch, places on the grid, twelve arcs") {
  test::LabelledCube cube;
  cube.handover.name = "a<b> & c.ply";
  const test::ProgramFolder dir("page");
  write_page(Work(), dir / "view.html", cube.handover);
  const std::string page = test::file_text(dir / "view.html");
  CHECK(page.find("<title>a&lt;b> &amp; c.ply - Intarsia</title>") != std::string::npos);
  for (const char* word : {"http:", "https:", "src=", "@import", "{{"}) {
    CAPTURE(word);
    CHECK(page.find(word) == std::string::npos);  // nothing from elsewhere, nothing left to fill in
  }
  const nlohmann::json meta = nlohmann::json::parse(part(page, "meta"));
  CHECK(meta["name"] == "a<b> & c.ply");
  CHECK(meta["triangles"] == 48);
  CHECK(meta["coarse"] == false);
  CHECK(meta["frame"]["size"] == nlohmann::json({kPageSteps, kPageSteps, kPageSteps}));
  CHECK(meta["colours"].size() == 6);
  for (std::size_t p = 0; p < 6; ++p) {
    CHECK(meta["patches"]["area"][p].get<double>() == Approx(9));
    CHECK(meta["patches"]["neighbours"][p].size() == 4);
  }

  Decoder surface(part(page, "surface-data"));
  CHECK(surface.whole() == 26);
  CHECK(surface.whole() == 48);
  REQUIRE(surface.whole() == 6);
  for (int p = 0; p < 6; ++p) CHECK(surface.whole() == 8);
  std::vector<Index> corner;
  Index known = 0;
  for (int c = 0; c < 144; ++c) {
    const Index back = surface.whole();
    REQUIRE(back <= known);
    corner.push_back(back == 0 ? known++ : known - back);
  }
  CHECK(known == 26);
  std::vector<Vec3> place;
  int last[3] = {0, 0, 0};
  for (int v = 0; v < 26; ++v) {
    for (int& coordinate : last) coordinate += surface.integer();
    place.emplace_back(last[0], last[1], last[2]);
  }
  CHECK(surface.done());
  for (Index p = 0; p < 6; ++p) {  // the faces of a patch lie in one side of the cube and look outwards
    Vec3 normal = Vec3::Zero();
    for (std::size_t c = 24 * p; c < 24 * p + 24; c += 3) {
      const Vec3 a = place[corner[c]], n = (place[corner[c + 1]] - a).cross(place[corner[c + 2]] - a).normalized();
      CHECK(n.cwiseAbs().maxCoeff() > 0.9999);
      CHECK((a - Vec3::Constant(kPageSteps / 2.)).dot(n) > 0);
      if (normal.norm() > 0) CHECK(n.dot(normal) > 0.9999);
      normal = n;
    }
  }
  Decoder arcs(part(page, "arcs-data"));
  CHECK(arcs.whole() == 12);
  CHECK(arcs.whole() == 36);

  Decoder features(part(page, "features-data"));
  CHECK(features.whole() == 1);
  CHECK(features.whole() == 2);
}

TEST_CASE("the page's lines are read back, and damaged ones refused") {
  const test::LabelledCube cube;
  const test::ProgramFolder dir("page");
  write_page(Work(), dir / "view.html", cube.handover);
  const LayoutView& layout = cube.handover.layout;
  const PageGrid grid = grid_of(layout.refined->mesh);
  const PageFeatures read = read_page_features(dir / "view.html", grid);
  REQUIRE(read.raw.count() == 1);
  REQUIRE(read.chosen.count() == 1);
  CHECK(read.raw.kind[0] == CurveKind::ridge);
  CHECK(read.chosen.kind[0] == CurveKind::valley);
  REQUIRE(read.raw.line(0).size() == 2);
  REQUIRE(read.chosen.line(0).size() == 3);
  const auto in_input = [&](const Vec3& p) -> Vec3 { return layout.centre + layout.diagonal * p; };
  for (std::size_t i = 0; i < 2; ++i)
    CHECK((in_input(read.raw.point[i]) - cube.features.point[i]).norm() < 2 * grid.step * layout.diagonal);
  for (std::size_t i = 0; i < 3; ++i)
    CHECK((in_input(read.chosen.point[i]) - cube.features.point[2 + i]).norm() < 2 * grid.step * layout.diagonal);

  const std::string bytes = bytes_of_base64(part(test::file_text(dir / "view.html"), "features-data"));
  CHECK(base64(bytes) == part(test::file_text(dir / "view.html"), "features-data"));
  for (std::size_t n = 0; n < bytes.size(); ++n) {
    // The network's lines come last and are not read here: cuts that reach the others are found.
    try {
      page_features(dir / "view.html", std::string_view(bytes).substr(0, n), grid);
    } catch (const Error& e) {
      CHECK(e.code() == ErrorCode::bad_file);
    }
  }
  CHECK_THROWS_AS(page_features(dir / "view.html", std::string_view(bytes).substr(0, 5), grid), Error);
  CHECK_THROWS_AS(page_features(dir / "view.html", "\xff\xff\xff\xff\xff\xff", grid), Error);
  CHECK(bytes_of_base64("a?b=").empty());
  CHECK(bytes_of_base64("abc").empty());
}

TEST_CASE("a page without the run's lines takes them from the earlier page") {
  test::LabelledCube cube;
  const test::ProgramFolder dir("page");
  std::vector<Real> distance(cube.soup.vertex_count(), 0.01);
  PageDeviation deviation{distance, std::vector<Real>(6, 0.005), 0.02, "caption"};
  PageOptions options;
  options.deviation = &deviation;
  write_page(Work(), dir / "view.html", cube.handover, options);
  const std::string first = test::file_text(dir / "view.html");
  CHECK(nlohmann::json::parse(part(first, "meta"))["deviation"]["top"].get<double>() == Approx(2));
  cube.handover.features = nullptr;
  PageOptions later;
  later.earlier = read_page_parts(dir / "view.html");
  write_page(Work(), dir / "again.html", cube.handover, later);
  CHECK(test::file_text(dir / "again.html") == first);
  write_page(Work(), dir / "bare.html", cube.handover);
  CHECK(part(test::file_text(dir / "bare.html"), "features-data").empty());
  CHECK(read_page_parts(dir / "missing.html").features.empty());
}

TEST_CASE("a coarser surface keeps patches, borders and, on flat sides, the area") {
  const test::LabelledCube cube(24);
  const PageSurface whole = page_surface(Work(), cube.handover.layout, 1'000'000);
  CHECK(!whole.is_coarse);
  CHECK(whole.corner.size() == cube.soup.corner.size());
  const PageSurface coarse = page_surface(Work(), cube.handover.layout, 1500);
  CHECK(coarse.is_coarse);
  CHECK(coarse.corner.size() < whole.corner.size() / 2);
  std::set<Index> kept(coarse.source.begin(), coarse.source.end());
  for (const Index v : cube.graph.arc.item) CHECK(kept.contains(v));
  std::size_t c = 0;
  for (const Index faces : coarse.patch_faces) {
    Real area = 0;
    Vec3 normal = Vec3::Zero();
    for (Index f = 0; f < faces; ++f, c += 3) {
      const Vec3 a = coarse.point[coarse.corner[c]];
      const Vec3 n = (coarse.point[coarse.corner[c + 1]] - a).cross(coarse.point[coarse.corner[c + 2]] - a) / 2;
      area += n.norm(), normal += n;
    }
    CHECK(normal.norm() == Approx(1. / 3));  // a side of the cube of diagonal 1
    CHECK(area < 1. / 3 * 1.02);             // hardly a face is turned over
  }
  CHECK(c == coarse.corner.size());
}
