#include "tools/step/cad_shape.h"

#include <algorithm>
#include <fstream>
#include <limits>
#include <set>
#include <sstream>

#include <APIHeaderSection_MakeHeader.hxx>
#include <BRepCheck_Analyzer.hxx>
#include <BRepCheck_ListOfStatus.hxx>
#include <BRepCheck_Result.hxx>
#include <BRepGProp.hxx>
#include <BRepMesh_IncrementalMesh.hxx>
#include <BRep_Tool.hxx>
#include <GProp_GProps.hxx>
#include <Interface_Static.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Message_PrinterOStream.hxx>
#include <Poly_Triangulation.hxx>
#include <STEPControl_Controller.hxx>
#include <STEPControl_Reader.hxx>
#include <STEPControl_Writer.hxx>
#include <Standard_Failure.hxx>
#include <StepData_Protocol.hxx>
#include <StepData_StepModel.hxx>
#include <StepData_StepWriter.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <XSControl_WorkSession.hxx>

#include "engine/base/error.h"
#include "tools/step/occt/build_shape.h"

namespace intarsia::tools {
namespace {

// The library reports to standard output otherwise.
void be_quiet() { Message::DefaultMessenger()->RemovePrinters(STANDARD_TYPE(Message_Printer)); }

const char* name_of(BRepCheck_Status status) {
  constexpr const char* kNames[] = {"NoError",
                                    "InvalidPointOnCurve",
                                    "InvalidPointOnCurveOnSurface",
                                    "InvalidPointOnSurface",
                                    "No3DCurve",
                                    "Multiple3DCurve",
                                    "Invalid3DCurve",
                                    "NoCurveOnSurface",
                                    "InvalidCurveOnSurface",
                                    "InvalidCurveOnClosedSurface",
                                    "InvalidSameRangeFlag",
                                    "InvalidSameParameterFlag",
                                    "InvalidDegeneratedFlag",
                                    "FreeEdge",
                                    "InvalidMultiConnexity",
                                    "InvalidRange",
                                    "EmptyWire",
                                    "RedundantEdge",
                                    "SelfIntersectingWire",
                                    "NoSurface",
                                    "InvalidWire",
                                    "RedundantWire",
                                    "IntersectingWires",
                                    "InvalidImbricationOfWires",
                                    "EmptyShell",
                                    "RedundantFace",
                                    "InvalidImbricationOfShells",
                                    "UnorientableShape",
                                    "NotClosed",
                                    "NotConnected",
                                    "SubshapeNotInShape",
                                    "BadOrientation",
                                    "BadOrientationOfSubshape",
                                    "InvalidPolygonOnTriangulation",
                                    "InvalidToleranceValue",
                                    "EnclosedRegion",
                                    "CheckFail"};
  const auto i = static_cast<std::size_t>(status);
  return i < std::size(kNames) ? kNames[i] : "Unknown";
}

void collect(const BRepCheck_ListOfStatus& list, std::set<std::string>& names) {
  for (const BRepCheck_Status s : list)
    if (s != BRepCheck_NoError) names.insert(name_of(s));
}

Index count_of(const TopoDS_Shape& shape, TopAbs_ShapeEnum kind) {
  TopTools_IndexedMapOfShape map;
  TopExp::MapShapes(shape, kind, map);
  return static_cast<Index>(map.Extent());
}

struct EdgeLengths {
  Real largest_tolerance = 0, shortest_edge = std::numeric_limits<Real>::infinity();
};

EdgeLengths lengths_of(const TopoDS_Shape& shape) {
  EdgeLengths out;
  TopTools_IndexedMapOfShape edges;
  TopExp::MapShapes(shape, TopAbs_EDGE, edges);
  for (int i = 1; i <= edges.Extent(); ++i) {
    GProp_GProps properties;
    BRepGProp::LinearProperties(edges(i), properties);
    out.shortest_edge = std::min(out.shortest_edge, properties.Mass());
    out.largest_tolerance = std::max(out.largest_tolerance, BRep_Tool::Tolerance(TopoDS::Edge(edges(i))));
  }
  return out;
}

}  // namespace

CadShape::CadShape() : impl_(std::make_unique<Impl>()) {}
CadShape::~CadShape() = default;
CadShape::CadShape(CadShape&&) noexcept = default;
CadShape& CadShape::operator=(CadShape&&) noexcept = default;

CadShape::CadShape(const CadModel& model, const Vec3& centre, Real scale) : CadShape() {
  be_quiet();
  try {
    BuiltShape built = build_shape(model, centre, scale);
    impl_->shape = built.shape, impl_->face = std::move(built.face);
    for (const CadVertex& v : model.vertex) impl_->vertex_gap = std::max(impl_->vertex_gap, scale * v.gap);
  } catch (const Standard_Failure& e) {
    throw Error(ErrorCode::internal, std::string("OpenCASCADE could not build the model: ") + e.GetMessageString());
  }
}

CadShape CadShape::read_step(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  if (!file) throw Error(ErrorCode::bad_file, path.string() + ": it cannot be read");
  return read_step_text(text.str());
}

CadShape CadShape::read_step_text(const std::string& text) {
  be_quiet();
  CadShape out;
  try {
    STEPControl_Reader reader;
    std::istringstream stream(text);
    if (reader.ReadStream("layout.step", stream) != IFSelect_RetDone || reader.TransferRoots() < 1)
      throw Error(ErrorCode::bad_file, "OpenCASCADE cannot read this STEP file");
    out.impl_->shape = reader.OneShape();
  } catch (const Standard_Failure& e) {
    throw Error(ErrorCode::bad_file, std::string("OpenCASCADE cannot read this STEP file: ") + e.GetMessageString());
  }
  for (TopExp_Explorer e(out.impl_->shape, TopAbs_FACE); e.More(); e.Next())
    out.impl_->face.push_back(TopoDS::Face(e.Current()));
  return out;
}

CadCheck CadShape::check() const {
  const TopoDS_Shape& shape = impl_->shape;
  CadCheck out;
  const BRepCheck_Analyzer analyzer(shape);
  out.valid = analyzer.IsValid();
  std::set<std::string> names;
  for (std::size_t f = 0; f < impl_->face.size(); ++f) {
    if (!analyzer.IsValid(impl_->face[f])) out.invalid_face.push_back(static_cast<Index>(f));
  }
  if (!out.valid)
    for (const TopAbs_ShapeEnum kind :
         {TopAbs_SOLID, TopAbs_SHELL, TopAbs_FACE, TopAbs_WIRE, TopAbs_EDGE, TopAbs_VERTEX}) {
      TopTools_IndexedMapOfShape map;
      TopExp::MapShapes(shape, kind, map);
      for (int i = 1; i <= map.Extent(); ++i) {
        const Handle(BRepCheck_Result)& result = analyzer.Result(map(i));
        if (result.IsNull()) continue;
        collect(result->Status(), names);
        for (result->InitContextIterator(); result->MoreShapeInContext(); result->NextShapeInContext())
          collect(result->StatusOnShape(), names);
      }
    }
  for (const std::string& n : names) out.trouble += (out.trouble.empty() ? "" : ", ") + n;
  out.faces = count_of(shape, TopAbs_FACE), out.edges = count_of(shape, TopAbs_EDGE);
  out.vertices = count_of(shape, TopAbs_VERTEX);
  out.shells = count_of(shape, TopAbs_SHELL), out.solids = count_of(shape, TopAbs_SOLID);
  TopTools_IndexedDataMapOfShapeListOfShape faces_of_edge;
  TopExp::MapShapesAndUniqueAncestors(shape, TopAbs_EDGE, TopAbs_FACE, faces_of_edge);
  for (int i = 1; i <= faces_of_edge.Extent(); ++i) {
    const TopoDS_Edge& edge = TopoDS::Edge(faces_of_edge.FindKey(i));
    out.largest_tolerance = std::max(out.largest_tolerance, BRep_Tool::Tolerance(edge));
    if (BRep_Tool::Degenerated(edge))
      ++out.degenerate_edges;
    else if (faces_of_edge(i).Extent() == 1 && !BRep_Tool::IsClosed(edge, TopoDS::Face(faces_of_edge(i).First())))
      ++out.free_edges;
  }
  GProp_GProps surface, volume;
  BRepGProp::SurfaceProperties(shape, surface, 1e-3);
  out.area = surface.Mass();
  if (out.solids > 0) {
    BRepGProp::VolumeProperties(shape, volume, 1e-4, Standard_True);
    out.volume = volume.Mass();
  }
  return out;
}

CadTriangles CadShape::triangulate(Real deflection) const {
  CadTriangles out;
  BRepMesh_IncrementalMesh mesher(impl_->shape, deflection, Standard_False, 0.5, Standard_False);
  for (std::size_t f = 0; f < impl_->face.size(); ++f) {
    TopLoc_Location location;
    const Handle(Poly_Triangulation) mesh = BRep_Tool::Triangulation(impl_->face[f], location);
    if (mesh.IsNull() || mesh->NbTriangles() == 0) {
      out.empty.push_back(static_cast<Index>(f));
      continue;
    }
    const Index base = static_cast<Index>(out.x.size());
    for (int i = 1; i <= mesh->NbNodes(); ++i) {
      const gp_Pnt p = mesh->Node(i).Transformed(location.Transformation());
      out.x.push_back(p.X()), out.y.push_back(p.Y()), out.z.push_back(p.Z());
    }
    const bool turned = impl_->face[f].Orientation() == TopAbs_REVERSED;
    for (int i = 1; i <= mesh->NbTriangles(); ++i) {
      int a = 0, b = 0, c = 0;
      mesh->Triangle(i).Get(a, b, c);
      if (turned) std::swap(b, c);
      for (const int v : {a, b, c}) out.corner.push_back(base + static_cast<Index>(v - 1));
      out.face.push_back(static_cast<Index>(f));
    }
  }
  return out;
}

std::string CadShape::step_text(const std::string& name, CadUnit unit, const std::string& version) const {
  be_quiet();
  constexpr const char* kUnits[] = {"MM", "CM", "M", "INCH"};
  const char* unit_name = kUnits[static_cast<std::size_t>(unit)];
  STEPControl_Controller::Init();
  Interface_Static::SetCVal("write.step.unit", unit_name);
  STEPControl_Writer writer;
  Interface_Static::SetCVal("write.step.product.name", name.c_str());
  // The file's uncertainty: readers drop edges that are shorter, and images of edges on faces whose ends are farther
  // than that from the vertices, or their middles farther than twice that from the edge. The images they make instead
  // do not end where their neighbours begin.
  const EdgeLengths lengths = lengths_of(impl_->shape);
  const Real wanted = std::max(0.6 * lengths.largest_tolerance, 1.1 * impl_->vertex_gap);
  writer.SetTolerance(std::max(std::min(wanted, lengths.shortest_edge / 3), 1e-7));
  if (writer.Transfer(impl_->shape, STEPControl_AsIs) != IFSelect_RetDone)
    throw Error(ErrorCode::internal, "OpenCASCADE could not translate the model to STEP");
  const Handle(StepData_StepModel) model = writer.Model();
  APIHeaderSection_MakeHeader header(model);
  const auto text = [](const std::string& s) { return new TCollection_HAsciiString(s.c_str()); };
  header.SetName(text(name));
  header.SetTimeStamp(text("1970-01-01T00:00:00"));
  header.SetAuthorValue(1, text(""));
  header.SetOrganizationValue(1, text(""));
  header.SetOriginatingSystem(text(version));
  header.SetDescriptionValue(1, text("patch layout fitted with B-spline faces"));
  StepData_StepWriter file(model);
  file.SendModel(Handle(StepData_Protocol)::DownCast(writer.WS()->Protocol()));
  std::ostringstream stream;
  if (!file.Print(stream)) throw Error(ErrorCode::internal, "OpenCASCADE could not write the model");
  return stream.str();
}

}  // namespace intarsia::tools
