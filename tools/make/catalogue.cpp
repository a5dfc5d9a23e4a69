#include "tools/make/catalogue.h"

#include <cmath>

#include "tools/make/fields.h"

namespace intarsia::tools {

namespace {

constexpr Real kPi = 3.141592653589793;

std::vector<ShapeInfo> list_shapes() {
  return {
      {"part",
       "cast machine part like a rocker arm: lever, two bosses with holes, pin, block, all edges rounded",
       {{"fillet", "radius of the fillets where two bodies meet", 0.1, 0.03, 0.14},
        {"edge", "radius of the rounded outer edges", 0.035, 0.01, 0.06}},
       -2},
      {"star",
       "smooth star of eight petals, curved crisp ridges that fade out at the poles",
       {{"petals", "number of ridges", 8, 3, 16},
        {"depth", "depth of the valleys between them", 0.45, 0, 0.6},
        {"crease", "width of a ridge's rounded crest", 0.08, 0.005, 1},
        {"twist", "turn of the ridges from the equator to a pole, radians", 0.8, 0, 2}},
       2,
       0,
       true},
      {"head",
       "head-like organic shape: eye sockets, nose, ears, curls",
       {{"bumps", "height of the curls", 0.03, 0, 0.05}},
       2},
      {"rounded-box",
       "box with rounded edges and corners",
       {{"half-x", "half size along x, fillet included", 1, 1e-3, 1e3},
        {"half-y", "half size along y", 1, 1e-3, 1e3},
        {"half-z", "half size along z", 1, 1e-3, 1e3},
        {"fillet", "radius of edges and corners, at most the smallest half size", 0.25, 1e-5, 1e3}},
       2,
       0,
       true},
      {"torus",
       "ring about the z axis",
       {{"ring", "radius of the centre circle", 2, 1e-3, 1e3},
        {"tube", "radius of the tube, below that of the centre circle", 1, 1e-3, 1e3}},
       0},
      {"ellipsoid",
       "ellipsoid along the axes",
       {{"a", "semi-axis along x", 3, 1e-3, 1e3},
        {"b", "semi-axis along y", 2, 1e-3, 1e3},
        {"c", "semi-axis along z", 1, 1e-3, 1e3}},
       2,
       0,
       true},
      {"sphere", "sphere", {{"radius", "radius", 1, 1e-3, 1e3}}},
      {"plane",
       "flat rectangle, facing z",
       {{"size-x", "side along x", 2, 1e-3, 1e3}, {"size-y", "side along y", 2, 1e-3, 1e3}},
       1,
       1},
      {"cube", "cube with sharp edges", {{"half", "half of the side", 1, 1e-3, 1e3}}, 2, 0, true},
      {"cylinder",
       "open tube about the y axis, facing outward",
       {{"radius", "radius", 1, 1e-3, 1e3}, {"height", "length along y", 3, 1e-3, 1e3}},
       0,
       2},
      {"half-pipe",
       "open half-pipe along y with rounded lips and flat decks, facing up",
       {{"radius", "radius of the pipe", 1, 1e-3, 1e3},
        {"lip", "radius of the rounded edge between pipe and deck", 0.15, 1e-3, 1e3},
        {"deck", "width of each deck", 0.6, 1e-3, 1e3},
        {"length", "length along y", 4, 1e-3, 1e3}},
       1,
       1,
       true},
  };
}

}  // namespace

const std::vector<ShapeInfo>& shapes() {
  static const std::vector<ShapeInfo> list = list_shapes();
  return list;
}

const ShapeInfo& shape_info(const std::string& name) {
  std::string names;
  for (const ShapeInfo& s : shapes()) {
    if (s.name == name) return s;
    names += (names.empty() ? "" : ", ") + s.name;
  }
  throw Error(ErrorCode::bad_argument, "there is no shape \"" + name + "\"; there are " + names);
}

Real parameter(const MakeOptions& options, const char* name) {
  if (const auto it = options.parameters.find(name); it != options.parameters.end()) return it->second;
  for (const ShapeParameter& p : shape_info(options.shape).parameters)
    if (p.name == name) return p.value;
  throw Error(ErrorCode::internal, "shape " + options.shape + " has no parameter " + name);
}

MadeShape build_shape(const MakeOptions& options) {
  const auto get = [&](const char* name) { return parameter(options, name); };
  const std::string& name = options.shape;
  const auto demand = [&](bool ok, const char* what) {
    if (!ok) throw Error(ErrorCode::bad_argument, "shape " + name + ": " + what);
  };
  MadeShape shape;
  if (name == "part") {
    shape.field = part_field(get("fillet"), get("edge"));
  } else if (name == "star") {
    shape.field = star_field(get("petals"), get("depth"), get("crease"), get("twist"));
  } else if (name == "head") {
    shape.field = head_field(get("bumps"));
  } else if (name == "sphere") {
    shape.field = sphere_field(get("radius"));
  } else if (name == "ellipsoid") {
    shape.field = ellipsoid_field(get("a"), get("b"), get("c"));
  } else if (name == "torus") {
    demand(get("tube") < get("ring"), "the tube must be thinner than the ring's radius");
    shape.field = torus_field(get("ring"), get("tube"));
  } else if (name == "rounded-box") {
    const Vec3 half(get("half-x"), get("half-y"), get("half-z"));
    demand(get("fillet") <= half.minCoeff(), "the fillet must not exceed the smallest half size");
    shape.field = rounded_box_field(half, get("fillet"));
  } else if (name == "cube") {
    shape.cube_half = get("half");
  } else if (name == "plane") {
    Sheet sheet{Profile(-0.5 * get("size-x"), 0, 0), get("size-y"), false};
    sheet.profile.line(get("size-x"));
    shape.sheet = sheet;
  } else if (name == "cylinder") {
    Sheet sheet{Profile(get("radius"), 0, -0.5 * kPi), get("height"), true};
    sheet.profile.arc(get("radius"), -2 * kPi);
    shape.sheet = sheet;
  } else if (name == "half-pipe") {
    const Real radius = get("radius"), lip = get("lip"), deck = get("deck");
    Sheet sheet{Profile(-radius - lip - deck, 0, 0), get("length"), false};
    sheet.profile.line(deck);
    sheet.profile.arc(lip, -0.5 * kPi);
    sheet.profile.arc(radius, kPi);
    sheet.profile.arc(lip, -0.5 * kPi);
    sheet.profile.line(deck);
    shape.sheet = sheet;
  } else {
    throw Error(ErrorCode::internal, "shape " + name + " is listed but cannot be built");
  }
  return shape;
}

}  // namespace intarsia::tools
