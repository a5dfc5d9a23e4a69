#include "tools/step/occt/build_shape.h"

#include <algorithm>
#include <numeric>

#include <BRepBndLib.hxx>
#include <BRepGProp.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Bnd_Box.hxx>
#include <GProp_GProps.hxx>
#include <Geom2d_BSplineCurve.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Geom_Line.hxx>
#include <Geom_Plane.hxx>
#include <Precision.hxx>
#include <TopLoc_Location.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Shell.hxx>
#include <TopoDS_Solid.hxx>
#include <TopoDS_Vertex.hxx>
#include <TopoDS_Wire.hxx>

namespace intarsia::tools {
namespace {

struct Knots {
  TColStd_Array1OfReal knot;
  TColStd_Array1OfInteger multiplicity;

  Knots(Real low, Real high, int spans) : knot(1, spans + 1), multiplicity(1, spans + 1) {
    for (int i = 0; i <= spans; ++i) {
      knot(i + 1) = i == spans ? high : low + (high - low) * i / spans;
      multiplicity(i + 1) = i == 0 || i == spans ? 4 : 1;
    }
  }
};

class Builder {
 public:
  Builder(const CadModel& model, const Vec3& centre, Real scale) : model_(model), centre_(centre), scale_(scale) {}

  BuiltShape build() {
    make_vertices();
    make_edges();
    for (const CadFace& f : model_.face) face_.push_back(make_face(f));
    return {join_faces(), face_};
  }

 private:
  gp_Pnt point(const Vec3& p) const {
    const Vec3 q = centre_ + scale_ * p;
    return {q.x(), q.y(), q.z()};
  }
  // A little more than measured: the library looks at other places along the curves.
  Real tolerance(Real measured) const { return std::max(1.05 * scale_ * measured, Precision::Confusion()); }

  void make_vertices() {
    vertex_.resize(model_.vertex.size());
    for (std::size_t v = 0; v < vertex_.size(); ++v)
      builder_.MakeVertex(vertex_[v], point(model_.vertex[v].point), 1.05 * tolerance(model_.vertex[v].tolerance));
  }

  void make_edges() {
    edge_.resize(model_.edge.size());
    for (std::size_t e = 0; e < edge_.size(); ++e) {
      const CadEdge& edge = model_.edge[e];
      if (edge.curve.control.empty()) continue;
      const Real length = scale_ * edge.curve.length;
      Handle(Geom_Curve) curve;
      const std::vector<Vec3> control = edge.curve.clamped();
      if (edge.is_line) {
        const Vec3 way = (control.back() - control.front()).normalized();
        curve = new Geom_Line(point(control.front()), gp_Dir(way.x(), way.y(), way.z()));
      } else {
        TColgp_Array1OfPnt poles(1, static_cast<int>(control.size()));
        for (std::size_t i = 0; i < control.size(); ++i) poles(static_cast<int>(i) + 1) = point(control[i]);
        poles(1) = point(model_.vertex[edge.start].point);
        poles(poles.Upper()) = point(model_.vertex[edge.end].point);
        const Knots knots(0, length, edge.curve.spans());
        curve = new Geom_BSplineCurve(poles, knots.knot, knots.multiplicity, 3);
      }
      builder_.MakeEdge(edge_[e], curve, tolerance(edge.tolerance));
      builder_.Add(edge_[e], vertex_[edge.start].Oriented(TopAbs_FORWARD));
      builder_.Add(edge_[e], vertex_[edge.end].Oriented(TopAbs_REVERSED));
      builder_.Range(edge_[e], 0, length);
    }
  }

  Handle(Geom_Surface) make_surface(const FaceSurface& s) const {
    if (s.is_plane) {
      const Vec3 n = s.x.cross(s.y);
      return new Geom_Plane(gp_Ax3(point(s.origin), gp_Dir(n.x(), n.y(), n.z()), gp_Dir(s.x.x(), s.x.y(), s.x.z())));
    }
    const SplineDomain& d = s.spline.domain;
    const std::vector<Vec3> control = s.spline.clamped();
    TColgp_Array2OfPnt poles(1, d.u_count(), 1, d.v_count());
    for (int i = 0; i < d.u_count(); ++i)
      for (int j = 0; j < d.v_count(); ++j) poles(i + 1, j + 1) = point(control[i * d.v_count() + j]);
    const Knots u(scale_ * d.low.x(), scale_ * d.high.x(), d.u_spans);
    const Knots v(scale_ * d.low.y(), scale_ * d.high.y(), d.v_spans);
    return new Geom_BSplineSurface(poles, u.knot, v.knot, u.multiplicity, v.multiplicity, 3, 3);
  }

  Handle(Geom2d_Curve) make_image(const CadSide& side) const {
    if (!side.corner.empty()) {
      const int n = static_cast<int>(side.corner.size());
      TColgp_Array1OfPnt2d corners(1, n);
      TColStd_Array1OfReal knot(1, n);
      TColStd_Array1OfInteger multiplicity(1, n);
      for (int i = 0; i < n; ++i) {
        corners(i + 1) = gp_Pnt2d(scale_ * side.corner[i].x(), scale_ * side.corner[i].y());
        knot(i + 1) = scale_ * side.knot[i];
        multiplicity(i + 1) = i == 0 || i + 1 == n ? 2 : 1;
      }
      return new Geom2d_BSplineCurve(corners, knot, multiplicity, 1);
    }
    const std::vector<Vec2> control = side.curve.clamped();
    TColgp_Array1OfPnt2d poles(1, static_cast<int>(control.size()));
    for (std::size_t i = 0; i < control.size(); ++i)
      poles(static_cast<int>(i) + 1) = gp_Pnt2d(scale_ * control[i].x(), scale_ * control[i].y());
    const Knots knots(0, scale_ * side.curve.length, side.curve.spans());
    return new Geom2d_BSplineCurve(poles, knots.knot, knots.multiplicity, 3);
  }

  TopoDS_Face make_face(const CadFace& f) {
    const Handle(Geom_Surface) surface = make_surface(f.surface);
    TopoDS_Face face;
    builder_.MakeFace(face, surface, Precision::Confusion());
    const TopLoc_Location here;
    for (const auto& loop : f.loops) {
      TopoDS_Wire wire;
      builder_.MakeWire(wire);
      for (const CadSide& side : loop) {
        const TopoDS_Edge& edge = edge_[side.edge];
        const auto image = make_image(side);
        const Real edge_tolerance = tolerance(model_.edge[side.edge].tolerance);
        // A seam: the same edge once in each direction.
        const CadSide* twin = nullptr;
        for (const auto& other : f.loops)
          for (const CadSide& o : other)
            if (o.edge == side.edge && o.forward != side.forward) twin = &o;
        if (!twin)
          builder_.UpdateEdge(edge, image, surface, here, edge_tolerance);
        else if (side.forward)
          builder_.UpdateEdge(edge, image, make_image(*twin), surface, here, edge_tolerance);
        builder_.Range(edge, surface, here, 0, scale_ * model_.edge[side.edge].curve.length);
        builder_.SameRange(edge, Standard_True);
        builder_.SameParameter(edge, Standard_True);
        builder_.Add(wire, edge.Oriented(side.forward ? TopAbs_FORWARD : TopAbs_REVERSED));
      }
      wire.Closed(Standard_True);
      builder_.Add(face, wire);
    }
    return face;
  }

  // Faces that share edges, in the order of their first faces.
  std::vector<std::vector<std::size_t>> groups() const {
    std::vector<std::size_t> parent(face_.size());
    std::iota(parent.begin(), parent.end(), std::size_t{0});
    const auto root = [&](std::size_t f) {
      while (parent[f] != f) f = parent[f] = parent[parent[f]];
      return f;
    };
    std::vector<std::size_t> first(edge_.size(), face_.size());
    for (std::size_t f = 0; f < face_.size(); ++f)
      for (const auto& loop : model_.face[f].loops)
        for (const CadSide& side : loop) {
          if (first[side.edge] == face_.size()) first[side.edge] = f;
          const std::size_t a = root(f), b = root(first[side.edge]);
          parent[std::max(a, b)] = std::min(a, b);
        }
    std::vector<std::vector<std::size_t>> out;
    std::vector<std::size_t> place(face_.size());
    for (std::size_t f = 0; f < face_.size(); ++f) {
      if (root(f) == f) place[f] = out.size(), out.emplace_back();
      out[place[root(f)]].push_back(f);
    }
    return out;
  }

  bool is_closed(const std::vector<std::size_t>& group) const {
    std::vector<int> uses(edge_.size(), 0);
    for (const std::size_t f : group)
      for (const auto& loop : model_.face[f].loops)
        for (const CadSide& side : loop) uses[side.edge] += side.forward ? 1 : 1000;
    return std::all_of(uses.begin(), uses.end(), [](int n) { return n == 0 || n == 1001; });
  }

  struct Closed {
    TopoDS_Shell shell;
    Bnd_Box box;
    Real volume = 0;
  };

  TopoDS_Shape join_faces() {
    std::vector<TopoDS_Shape> parts;
    std::vector<Closed> outer, inner;
    for (const auto& group : groups()) {
      TopoDS_Shell shell;
      builder_.MakeShell(shell);
      for (const std::size_t f : group) builder_.Add(shell, face_[f]);
      const bool closed = is_closed(group);
      shell.Closed(closed);
      if (!closed) {
        parts.push_back(shell);
        continue;
      }
      Closed c{shell, {}, 0};
      GProp_GProps properties;
      BRepGProp::VolumeProperties(shell, properties, 1e-2);
      c.volume = properties.Mass();
      BRepBndLib::AddClose(shell, c.box);
      (c.volume > 0 ? outer : inner).push_back(c);
    }
    std::sort(outer.begin(), outer.end(), [](const Closed& a, const Closed& b) { return a.volume < b.volume; });
    std::vector<TopoDS_Solid> solid(outer.size());
    for (std::size_t i = 0; i < outer.size(); ++i) {
      builder_.MakeSolid(solid[i]);
      builder_.Add(solid[i], outer[i].shell);
    }
    for (const Closed& c : inner) {
      std::size_t i = 0;  // the smallest solid around it
      while (i < outer.size() && !holds(outer[i].box, c.box)) ++i;
      if (i < outer.size())
        builder_.Add(solid[i], c.shell);
      else
        parts.push_back(c.shell);
    }
    parts.insert(parts.begin(), solid.begin(), solid.end());
    if (parts.size() == 1) return parts.front();
    TopoDS_Compound all;
    builder_.MakeCompound(all);
    for (const TopoDS_Shape& s : parts) builder_.Add(all, s);
    return all;
  }

  static bool holds(const Bnd_Box& big, const Bnd_Box& small) {
    const gp_Pnt a = big.CornerMin(), b = big.CornerMax(), c = small.CornerMin(), d = small.CornerMax();
    return a.X() < c.X() && a.Y() < c.Y() && a.Z() < c.Z() && b.X() > d.X() && b.Y() > d.Y() && b.Z() > d.Z();
  }

  const CadModel& model_;
  Vec3 centre_;
  Real scale_;
  BRep_Builder builder_;
  std::vector<TopoDS_Vertex> vertex_;
  std::vector<TopoDS_Edge> edge_;
  std::vector<TopoDS_Face> face_;
};

}  // namespace

BuiltShape build_shape(const CadModel& model, const Vec3& centre, Real scale) {
  return Builder(model, centre, scale).build();
}

}  // namespace intarsia::tools
