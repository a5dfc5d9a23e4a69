// intarsia._core: the library's calls with NumPy arrays. The package around it (package/__init__.py) checks arguments,
// raises exceptions and gives names; nothing else should import this.
#include <algorithm>
#include <memory>
#include <variant>
#include <vector>

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "graph/api/intarsia.h"
#include "tools/python/call.h"

namespace py = pybind11;

namespace intarsia::tools {
namespace {

using Positions = py::array_t<double, py::array::c_style>;
using Corners32 = py::array_t<std::int32_t, py::array::c_style>;
using Corners64 = py::array_t<std::int64_t, py::array::c_style>;
using Corners = std::variant<Corners32, Corners64>;

// Hands the memory over: nothing is copied.
template <class T>
py::array array_of(std::vector<T>&& values, std::vector<py::ssize_t> shape) {
  auto owner = std::make_unique<std::vector<T>>(std::move(values));
  T* data = owner->data();
  const py::capsule free(owner.release(), [](void* p) { delete static_cast<std::vector<T>*>(p); });
  return py::array_t<T>(std::move(shape), data, free);
}
template <class T>
py::array array_of(std::vector<T>&& values) {
  const auto n = static_cast<py::ssize_t>(values.size());
  return array_of(std::move(values), {n});
}
template <class T>
py::array rows_of(std::vector<T>&& values, py::ssize_t columns) {
  const auto n = static_cast<py::ssize_t>(values.size()) / columns;
  return array_of(std::move(values), {n, columns});
}

// A value of every item as an array.
template <class Items, class Of>
py::array column(const Items& items, const Of& of) {
  std::vector<std::decay_t<decltype(of(items.front()))>> values;
  values.reserve(items.size());
  for (const auto& item : items) values.push_back(of(item));
  return array_of(std::move(values));
}

template <class T>
std::span<const T> span_of(const py::array_t<T, py::array::c_style>& a) {
  return {a.data(), static_cast<std::size_t>(a.size())};
}

// Requires: the arrays outlive it.
TriangleMesh mesh_of(const Positions& positions, const Corners& corners) {
  return std::visit([&](const auto& c) { return TriangleMesh(span_of(positions), span_of(c)); }, corners);
}

py::dict status_of(const Status& s) {
  py::dict out;
  out["code"] = static_cast<int>(s.code), out["message"] = s.message, out["stage"] = s.stage;
  out["element"] = s.element, out["exit_status"] = s.exit_status();
  return out;
}

py::dict network_of(Network&& n) {
  py::dict out;
  std::vector<double> position;
  for (const Node& node : n.nodes) position.insert(position.end(), node.position.begin(), node.position.end());
  out["nodes"] = rows_of(std::move(position), 3);
  out["node_vertex"] = column(n.nodes, [](const Node& x) { return x.vertex; });
  out["node_is_artificial"] = column(n.nodes, [](const Node& x) { return std::uint8_t{x.is_artificial}; });
  out["kind"] = column(n.arcs, [](const Arc& x) { return static_cast<std::int32_t>(x.kind); });
  out["start"] = column(n.arcs, [](const Arc& x) { return x.start; });
  out["end"] = column(n.arcs, [](const Arc& x) { return x.end; });
  out["left"] = column(n.arcs, [](const Arc& x) { return x.left; });
  out["right"] = column(n.arcs, [](const Arc& x) { return x.right; });
  out["length"] = column(n.arcs, [](const Arc& x) { return x.length; });
  out["strength"] = column(n.arcs, [](const Arc& x) { return x.strength; });
  out["arc_offset"] = array_of(std::move(n.arc_offset)), out["arc_vertex"] = array_of(std::move(n.arc_vertex));
  out["loop_patch"] = array_of(std::move(n.loop_patch)), out["loop_offset"] = array_of(std::move(n.loop_offset));
  out["loop_arc"] = array_of(std::move(n.loop_arc));
  out["loop_is_forward"] = array_of(std::move(n.loop_is_forward));
  return out;
}

py::dict patches_of(const std::vector<Patch>& patches) {
  py::dict out;
  out["triangles"] = column(patches, [](const Patch& p) { return p.triangles; });
  out["area"] = column(patches, [](const Patch& p) { return p.area; });
  out["perimeter"] = column(patches, [](const Patch& p) { return p.perimeter; });
  out["compactness"] = column(patches, [](const Patch& p) { return p.compactness; });
  out["flatness"] = column(patches, [](const Patch& p) { return p.flatness; });
  out["loops"] = column(patches, [](const Patch& p) { return p.loops; });
  out["filled_holes"] = column(patches, [](const Patch& p) { return p.filled_holes; });
  out["is_disc"] = column(patches, [](const Patch& p) { return std::uint8_t{p.is_disc}; });
  return out;
}

py::dict dict_of(Layout&& l) {
  py::dict out;
  out["labels"] = array_of(std::move(l.labels));
  out["vertices"] = rows_of(std::move(l.vertices), 3), out["triangles"] = rows_of(std::move(l.triangles), 3);
  out["triangle_patch"] = array_of(std::move(l.triangle_patch));
  out["triangle_parent"] = array_of(std::move(l.triangle_parent));
  out["network"] = network_of(std::move(l.network));
  py::list interior;
  for (InteriorCurve& c : l.interior)
    interior.append(py::make_tuple(static_cast<int>(c.kind), rows_of(std::move(c.points), 3)));
  out["interior"] = interior;
  out["patches"] = patches_of(l.patches);
  py::list remarks;
  for (const Remark& r : l.remarks) remarks.append(py::make_tuple(r.code, r.stage, r.message, r.count));
  out["remarks"] = remarks;
  out["diagonal"] = l.diagonal, out["hash"] = l.hash, out["report"] = l.report;
  return out;
}

py::dict dict_of(Features&& f) {
  py::dict out;
  out["normals"] = rows_of(std::move(f.normals), 3), out["variation"] = rows_of(std::move(f.variation), 6);
  out["kmax"] = array_of(std::move(f.kmax)), out["kmin"] = array_of(std::move(f.kmin));
  out["tmax"] = rows_of(std::move(f.tmax), 3), out["tmin"] = rows_of(std::move(f.tmin), 3);
  out["emax"] = array_of(std::move(f.emax)), out["emin"] = array_of(std::move(f.emin));
  out["scale"] = array_of(std::move(f.scale)), out["fit_ring"] = array_of(std::move(f.fit_ring));
  out["status"] = array_of(std::move(f.status));
  return out;
}

py::dict dict_of(const DistanceSide& s) {
  py::dict out;
  out["max"] = s.max, out["bound"] = s.bound, out["mean"] = s.mean, out["rms"] = s.rms, out["area"] = s.area;
  out["samples"] = s.samples, out["worst"] = s.worst, out["worst_triangle"] = s.worst_triangle;
  return out;
}

py::dict dict_of(Distance&& d) {
  py::dict out;
  out["hausdorff"] = d.hausdorff, out["mean"] = d.mean, out["rms"] = d.rms, out["diagonal"] = d.diagonal;
  out["forward"] = dict_of(d.forward), out["backward"] = dict_of(d.backward);
  out["vertex_distance"] = array_of(std::move(d.vertex_distance));
  out["triangle_rms"] = array_of(std::move(d.triangle_rms)), out["triangle_max"] = array_of(std::move(d.triangle_max));
  out["sample_point"] = rows_of(std::move(d.sample_point), 3);
  out["sample_distance"] = array_of(std::move(d.sample_distance));
  out["sample_triangle"] = array_of(std::move(d.sample_triangle));
  return out;
}

py::object dict_of(Rebuilt&& r) {
  if (!r.was_made) return py::none();
  py::dict out;
  out["vertices"] = rows_of(std::move(r.vertices), 3), out["triangles"] = rows_of(std::move(r.triangles), 3);
  out["triangle_patch"] = array_of(std::move(r.triangle_patch));
  out["hausdorff"] = r.hausdorff, out["mean"] = r.mean, out["rms"] = r.rms;
  out["forward"] = dict_of(r.forward), out["backward"] = dict_of(r.backward);
  out["patch_rms"] = array_of(std::move(r.patch_rms)), out["patch_max"] = array_of(std::move(r.patch_max));
  out["failed"] = r.failed;
  return out;
}

py::dict dict_of(Evaluation&& e) {
  py::dict out;
  out["triangulated"] = dict_of(std::move(e.triangulated)), out["transfinite"] = dict_of(std::move(e.transfinite));
  out["filled"] = dict_of(std::move(e.filled));
  out["compactness"] = array_of(std::move(e.compactness));
  out["patches"] = e.patches, out["not_discs"] = e.not_discs, out["diagonal"] = e.diagonal, out["report"] = e.report;
  return out;
}

template <class T>
py::tuple answer(Result<T>&& result) {
  py::object value = py::none();
  if (result) value = dict_of(std::move(result.value));
  return py::make_tuple(status_of(result.status), value);
}

Options options_of(const py::dict& given) {
  Options o;
  o.patches = given["patches"].cast<int>(), o.min_feature = given["min_feature"].cast<std::string>();
  o.tolerance = given["tolerance"].cast<std::string>();
  o.curves = given["curves"].cast<std::vector<std::vector<double>>>();
  o.pins = given["pins"].cast<std::vector<std::int32_t>>();
  o.mode = static_cast<Mode>(given["mode"].cast<int>());
  o.subdivide = static_cast<Subdivide>(given["subdivide"].cast<int>());
  o.seed = given["seed"].cast<std::uint64_t>(), o.max_memory = given["max_memory"].cast<std::uint64_t>();
  o.time_limit = given["time_limit"].cast<double>(), o.strict = given["strict"].cast<bool>();
  o.threads = given["threads"].cast<int>();
  o.method = given["method"].cast<std::map<std::string, double, std::less<>>>();
  return o;
}

template <class Function>
auto with_options(Function function) {
  return [function](const Positions& v, const Corners& f, const py::dict& given, const py::object& progress) {
    Options options = options_of(given);
    const TriangleMesh mesh = mesh_of(v, f);
    return answer(PythonCall(progress)(options.threads, [&](const RunControl& control) {
      static_cast<RunControl&>(options) = control;
      return function(mesh, options);
    }));
  };
}

py::tuple measure(const Positions& va, const Corners& fa, const Positions& vb, const Corners& fb, std::uint64_t samples,
                  bool keep_samples, int threads, const py::object& progress) {
  const TriangleMesh a = mesh_of(va, fa), b = mesh_of(vb, fb);
  return answer(PythonCall(progress)(threads, [&](const RunControl& control) {
    DistanceOptions options;
    static_cast<RunControl&>(options) = control;
    options.samples = samples, options.keep_samples = keep_samples;
    return distance(a, b, options);
  }));
}

EvaluateOptions evaluate_options(const py::dict& given) {
  EvaluateOptions o;
  o.samples = given["samples"].cast<std::uint64_t>(), o.smooth = given["smooth"].cast<bool>();
  o.triangulated = given["triangulated"].cast<bool>(), o.transfinite = given["transfinite"].cast<bool>();
  o.filled = given["filled"].cast<bool>(), o.threads = given["threads"].cast<int>();
  return o;
}

template <class T>
std::vector<T> copy_of(const py::handle& array) {
  const auto a = array.cast<py::array_t<T, py::array::c_style | py::array::forcecast>>();
  return {a.data(), a.data() + a.size()};
}

// What network_of gave out; the library checks that the numbers fit together.
Network network_from(const py::dict& given) {
  Network n;
  const auto vertex = copy_of<std::int32_t>(given["node_vertex"]);
  const auto artificial = copy_of<std::uint8_t>(given["node_is_artificial"]);
  const auto kind = copy_of<std::int32_t>(given["kind"]), start = copy_of<std::int32_t>(given["start"]);
  const auto end = copy_of<std::int32_t>(given["end"]), left = copy_of<std::int32_t>(given["left"]);
  const auto right = copy_of<std::int32_t>(given["right"]);
  const auto strength = copy_of<double>(given["strength"]);
  n.nodes.resize(std::min(vertex.size(), artificial.size()));
  for (std::size_t i = 0; i < n.nodes.size(); ++i)
    n.nodes[i].vertex = vertex[i], n.nodes[i].is_artificial = artificial[i] != 0;
  n.arcs.resize(std::min({kind.size(), start.size(), end.size(), left.size(), right.size(), strength.size()}));
  for (std::size_t a = 0; a < n.arcs.size(); ++a)
    n.arcs[a] = {static_cast<ArcKind>(kind[a]), start[a], end[a], left[a], right[a], 0, strength[a]};
  n.arc_offset = copy_of<std::int64_t>(given["arc_offset"]), n.arc_vertex = copy_of<std::int32_t>(given["arc_vertex"]);
  n.loop_patch = copy_of<std::int32_t>(given["loop_patch"]);
  n.loop_offset = copy_of<std::int64_t>(given["loop_offset"]), n.loop_arc = copy_of<std::int32_t>(given["loop_arc"]);
  n.loop_is_forward = copy_of<std::uint8_t>(given["loop_is_forward"]);
  return n;
}

py::tuple evaluate_layout(const Positions& v, const Corners& f, const py::object& layout, const py::dict& given,
                          const py::object& progress) {
  Layout from;
  from.vertices = copy_of<double>(layout.attr("vertices"));
  from.triangles = copy_of<std::int32_t>(layout.attr("triangles"));
  from.triangle_patch = copy_of<std::int32_t>(layout.attr("triangle_patch"));
  from.triangle_parent = copy_of<std::int32_t>(layout.attr("triangle_parent"));
  from.patches.resize(py::len(layout.attr("patches")));
  from.network = network_from(layout.attr("_network"));
  EvaluateOptions options = evaluate_options(given);
  const TriangleMesh mesh = mesh_of(v, f);
  return answer(PythonCall(progress)(options.threads, [&](const RunControl& control) {
    static_cast<RunControl&>(options) = control;
    return evaluate(mesh, from, options);
  }));
}

py::tuple evaluate_labels(const Positions& v, const Corners& f, const Corners32& labels, const py::dict& given,
                          const py::object& progress) {
  EvaluateOptions options = evaluate_options(given);
  const TriangleMesh mesh = mesh_of(v, f);
  return answer(PythonCall(progress)(options.threads, [&](const RunControl& control) {
    static_cast<RunControl&>(options) = control;
    return evaluate(mesh, span_of(labels), options);
  }));
}

py::list list_options(int mode) {
  py::list out;
  for (const OptionInfo& o : method_options(static_cast<Mode>(mode)))
    out.append(py::make_tuple(o.name, o.value, o.least, o.most, o.is_whole, o.help));
  return out;
}

}  // namespace
}  // namespace intarsia::tools

PYBIND11_MODULE(_core, m) {
  using namespace intarsia::tools;
  m.doc() = "What intarsia/__init__.py is made of.";
  m.attr("version") = intarsia::version();
  m.def("layout", with_options([](const auto& mesh, const auto& o) { return intarsia::layout(mesh, o); }));
  m.def("features", with_options([](const auto& mesh, const auto& o) { return intarsia::features(mesh, o); }));
  m.def("distance", &measure);
  m.def("evaluate_layout", &evaluate_layout);
  m.def("evaluate_labels", &evaluate_labels);
  m.def("method_options", &list_options);
}
