// From a document to a Case: one line for each key. Nothing is checked here any more; .value() is a required
// key or one with a default.
#include "case/extract.hpp"

#include <algorithm>

#include "case/view.hpp"

namespace geist {

namespace {

std::string word(const View& view, std::string_view key) { return view.get<std::string>(key).value(); }

Box box_of(const View& view) { return view.get<Box>("box").value(); }

Where where_of(const View& view) {
  Where where;
  const char* const axes[] = {"x", "y", "z"};
  for (std::size_t a = 0; a < 3; ++a) where.axis[a] = view.get<Where::Interval>(axes[a]);
  where.region = view.get<std::string>("region");
  where.source = view.source();
  return where;
}

Ball ball_of(const View& view) {
  return {view.get<Vec3>("centre").value(), view.get<double>("radius").value()};
}

Cylinder cylinder_of(const View& view) {
  return {view.get<Vec3>("from").value(), view.get<Vec3>("to").value(), view.get<double>("radius").value()};
}

Body body_of(const View& view) {
  const auto divisions = view.get<std::vector<long>>("divisions").value();
  const auto n = [&](std::size_t i) { return static_cast<int>(divisions.at(i)); };
  if (const auto ball = view.table("ball")) return BallBody{ball_of(*ball), n(0), n(1)};
  if (const auto cylinder = view.table("cylinder"))
    return CylinderBody{cylinder_of(*cylinder), n(0), n(1), n(2)};
  const auto corners = view.get<std::array<Vec3, 8>>("corners");
  return BlockBody{corners ? *corners : corners_of(box_of(view)), {n(0), n(1), n(2)}};
}

Gradings gradings_of(const View& view) {
  Gradings gradings;
  const auto read = [&](const char* key, Grading& grading) {
    if (const auto graded = view.table(key))
      grading = {towards_of(word(*graded, "towards")), graded->get<double>("ratio").value()};
  };
  read("x", gradings.axis[0]), read("y", gradings.axis[1]), read("z", gradings.axis[2]);
  read("radius", gradings.radius);
  return gradings;
}

HexahedraSpec hexahedra_of(const View& view) {
  HexahedraSpec spec{};
  spec.body = body_of(view);
  if (const auto grading = view.table("grading")) spec.gradings = gradings_of(*grading);
  for (const View& cut : view.tables("minus")) spec.minus.push_back(box_of(cut));
  spec.formulation = word(view, "formulation");
  spec.hourglass = view.get<std::string>("hourglass").value_or("");
  spec.hourglass_coefficient = view.get<double>("hourglass_coefficient").value_or(0);
  return spec;
}

Shape shape_of(const View& view) {
  if (const auto cylinder = view.table("cylinder")) return cylinder_of(*cylinder);
  if (const auto ball = view.table("ball")) return ball_of(*ball);
  return box_of(view);
}

LatticeSpec lattice_of(const View& view) {
  LatticeSpec spec{};
  if (const auto boxes = view.get<std::vector<Box>>("boxes"))
    spec.boxes = *boxes;
  else
    spec.boxes = {box_of(view)};
  for (const View& cut : view.tables("minus")) spec.minus.push_back(shape_of(cut));
  spec.radius = view.get<double>("radius").value();
  spec.rotary_inertia = word(view, "rotary_inertia");
  return spec;
}

RegionSpec region_of(const View& view) {
  RegionSpec spec{view.name(), word(view, "material"), {}, view.source()};
  if (word(view, "type") == "lattice")
    spec.shape = lattice_of(view);
  else
    spec.shape = hexahedra_of(view);
  return spec;
}

/// The six components of a displacement or velocity.
std::array<std::optional<double>, 6> components_of(const std::optional<View>& view) {
  std::array<std::optional<double>, 6> values;
  if (!view) return values;
  const std::vector<std::string> names = key_names(table_of("displacement"));
  for (std::size_t c = 0; c < 6; ++c) values[c] = view->get<double>(names[c]);
  return values;
}

ContactSpec contact_of(const View& view) {
  return {view.get<ContactSpec::Between>("between").value(),
          word(view, "law"),
          view.get<double>("stiffness_factor").value(),
          view.get<double>("restitution").value(),
          view.get<double>("friction").value(),
          view.source()};
}

SupportSpec support_of(const View& view) {
  SupportSpec spec;
  spec.where = where_of(view.table("where").value());
  const std::vector<std::string> names = key_names(table_of("displacement"));
  for (const std::string& component :
       view.get<std::vector<std::string>>("fix").value_or(std::vector<std::string>{}))
    spec.fixed[static_cast<std::size_t>(std::find(names.begin(), names.end(), component) - names.begin())] =
        true;
  spec.displacement = components_of(view.table("displacement"));
  spec.velocity = components_of(view.table("velocity"));
  spec.curve = view.get<std::string>("curve").value_or("");
  spec.source = view.source();
  return spec;
}

LoadSpec load_of(const View& view) {
  LoadSpec spec{};
  if (const auto gravity = view.get<Vec3>("gravity")) {
    spec.kind = LoadSpec::Kind::gravity;
    spec.value = *gravity;
  } else {
    const auto force = view.get<Vec3>("total_force");
    spec.kind = force ? LoadSpec::Kind::total_force : LoadSpec::Kind::traction;
    spec.value = force ? *force : view.get<Vec3>("traction").value();
    spec.where = where_of(view.table("where").value());
  }
  spec.curve = view.get<std::string>("curve").value_or("");
  spec.source = view.source();
  return spec;
}

InitialSpec initial_of(const View& view) {
  InitialSpec spec;
  if (const auto where = view.table("where")) spec.where = where_of(*where);
  spec.velocity = view.get<Vec3>("velocity").value_or(Vec3{});
  spec.spin = view.get<Vec3>("spin").value_or(Vec3{});
  spec.about = view.get<Vec3>("about").value_or(Vec3{});
  spec.source = view.source();
  return spec;
}

AnalysisSpec analysis_of(const View& view) {
  AnalysisSpec spec;
  spec.type = word(view, "type");
  spec.duration = view.get<double>("duration").value_or(0);
  spec.start = view.get<std::string>("start").value_or(spec.start);
  spec.kinematics = word(view, "kinematics");
  spec.max_iterations = view.get<long>("max_iterations").value_or(spec.max_iterations);
  spec.tolerance = view.get<double>("tolerance").value_or(spec.tolerance);
  spec.max_steps = view.get<long>("max_steps").value();
  spec.safety = view.get<double>("safety").value();
  spec.time_step = view.get<double>("time_step");
  spec.subcycling = view.get<bool>("subcycling").value_or(false);
  spec.damping = view.get<double>("damping").value_or(0);
  spec.balance_tolerance = view.get<double>("balance_tolerance").value();
  spec.source = view.source();
  return spec;
}

ProbeSpec probe_of(const View& view) {
  return {view.name(),
          where_of(view.table("where").value()),
          word(view, "quantity"),
          word(view, "component"),
          word(view, "reduce"),
          view.get<double>("expected"),
          view.get<std::string>("expected_from").value_or(""),
          view.source()};
}

OutputSpec output_of(const View& view) {
  OutputSpec spec;
  if (const auto fields = view.table("fields")) {
    spec.fields_every = fields->get<double>("every");
    spec.fields_at = fields->get<std::vector<double>>("at").value_or(std::vector<double>{});
  }
  if (const auto history = view.table("history")) spec.history_every = history->get<double>("every");
  spec.compress = view.get<bool>("compress").value();
  spec.precision = view.get<std::string>("precision").value();
  return spec;
}

Material material_of(const View& view) {
  return {view.name(), view.get<double>("density").value(), view.get<double>("young").value(),
          view.get<double>("poisson").value()};
}

}  // namespace

Case extract(const Document& document) {
  const View root(document);
  Case result;
  result.file = document.file;
  result.title = word(root, "title");
  result.method = word(root, "method");
  const View units = root.table("units").value(), coupling = root.table("coupling").value();
  result.units = {word(units, "length"), word(units, "mass"), word(units, "time")};
  for (const View& view : root.named("materials")) result.materials[view.name()] = material_of(view);
  for (const View& view : root.named("regions")) result.regions.push_back(region_of(view));
  result.coupling = word(coupling, "type");
  result.rotation = word(coupling, "rotation");
  result.coupling_source = coupling.source();
  for (const View& view : root.tables("contact")) result.contact.push_back(contact_of(view));
  for (const View& view : root.named("curves"))
    result.curves[view.name()] = view.get<Curve>("points").value();
  for (const View& view : root.tables("supports")) result.supports.push_back(support_of(view));
  for (const View& view : root.tables("loads")) result.loads.push_back(load_of(view));
  for (const View& view : root.tables("initial")) result.initial.push_back(initial_of(view));
  result.analysis = analysis_of(root.table("analysis").value());
  for (const View& view : root.named("probes")) result.probes.push_back(probe_of(view));
  result.output = output_of(root.table("output").value());
  result.original = document.texts.at(document.file);
  return result;
}

}  // namespace geist
